// Section 4.4.2 of the paper: a domain is remeshed four times for the linear interpolation of
// f(p) = tanh(y^3) tanh((z - 2)^3). Prints one JSON object: for each step the mesh and the
// interpolation error, with its histogram over the tets. The paper's domain is not available; here
// it is a ball.
//
// cavea_paper_adaptation [OUT.mesh]
#include <Eigen/Dense>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "cavea/base/error.h"
#include "cavea/io/formats.h"
#include "cavea/mesh/build.h"
#include "cavea/remesh/remesh.h"
#include "support/meshes.h"

namespace {

using cavea::Vec3;

constexpr double kError = 0.01;           // eps_m
constexpr double kHmin = 0.2, kHmax = 3;  // as in the paper, and
constexpr double kHgrad = 1.4, kHausd = 0.3;
constexpr int kSteps = 4;
constexpr double kRadius = 4.5;  // about as many vertices as the paper reports
constexpr int kBins = 8;  // of the histogram: powers of ten from 1e-6 up to 10

double f(const Vec3& p) { return std::tanh(p.y * p.y * p.y) * std::tanh(std::pow(p.z - 2, 3)); }

/// Largest eigenvalue of the Hessian of f, by size; f does not depend on x.
double curvature(const Vec3& p) {
  // g(t) = tanh(t^3) with its first two derivatives.
  struct Factor {
    explicit Factor(double t) {
      const double t3 = t * t * t;
      value = std::tanh(t3);
      const double sech2 = 1 - value * value;
      first = 3 * t * t * sech2;
      second = 6 * t * sech2 - 18 * t * t3 * sech2 * value;
    }
    double value, first, second;
  };
  const Factor y(p.y), z(p.z - 2);
  Eigen::Matrix2d hessian;
  hessian << y.second * z.value, y.first * z.first, y.first * z.first, y.value * z.second;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(hessian, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .cwiseAbs()
      .maxCoeff();
}

/// The edge with which linear interpolation errs by kError at most: on a simplex of three
/// dimensions the error is within 9/32 h^2 times the largest second derivative (the paper's [4]).
double wanted_size(const Vec3& p) {
  const double k = curvature(p);
  return k > 0 ? std::clamp(std::sqrt(32 * kError / (9 * k)), kHmin, kHmax) : kHmax;
}

/// A coarse ball of radius kRadius.
cavea::MeshData start() {
  constexpr int kCells = 8;
  cavea::MeshData data = cavea::test::ball(kCells);
  for (Vec3& p : data.vertices) p *= kRadius;
  return data;
}

/// The interpolation error in the tets: largest, mean over the volume, histogram of the largest in
/// each tet. Samples: a lattice of barycentric coordinates in steps of 1/4.
nlohmann::json interpolation_error(const cavea::TetMesh& mesh) {
  constexpr int kLattice = 4;
  double worst = 0, sum = 0, volume = 0;
  std::vector<int> histogram(kBins, 0);
  for (const auto& k : mesh.tets) {
    std::array<Vec3, 4> x;
    std::array<double, 4> value;
    for (std::size_t i = 0; i < 4; ++i) x[i] = mesh.points[k[i]], value[i] = f(x[i]);
    double here = 0, mean = 0;
    int count = 0;
    for (int a = 0; a <= kLattice; ++a)
      for (int b = 0; a + b <= kLattice; ++b)
        for (int c = 0; a + b + c <= kLattice; ++c) {
          const double w[4] = {double(a) / kLattice, double(b) / kLattice, double(c) / kLattice,
                               double(kLattice - a - b - c) / kLattice};
          Vec3 p{};
          double linear = 0;
          for (std::size_t i = 0; i < 4; ++i) p += w[i] * x[i], linear += w[i] * value[i];
          const double error = std::abs(f(p) - linear);
          here = std::max(here, error), mean += error, ++count;
        }
    const double v = cavea::volume6(x[0], x[1], x[2], x[3]) / 6;
    sum += v * mean / count, volume += v;
    worst = std::max(worst, here);
    ++histogram[std::size_t(
        std::clamp(int(std::floor(std::log10(here + 1e-30))) + 6, 0, kBins - 1))];
  }
  return {{"worst", worst}, {"mean", sum / volume}, {"histogram", histogram}};
}

nlohmann::json step_json(const cavea::TetMesh& mesh, const cavea::Report* report) {
  nlohmann::json j = {{"vertices", mesh.points.size()},
                      {"tets", mesh.tets.size()},
                      {"error", interpolation_error(mesh)}};
  if (report) {
    j["seconds"] = report->seconds;
    j["worst_quality"] = report->after.quality.worst;
    j["mean_quality"] = report->after.quality.mean;
    j["conforming_percent"] = report->after.lengths.conforming_percent();
  }
  return j;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    cavea::TetMesh mesh = cavea::build(start()).mesh;
    nlohmann::json steps = {step_json(mesh, nullptr)};
    cavea::Options options;
    options.hausd = kHausd, options.hmin = kHmin, options.hmax = kHmax, options.hgrad = kHgrad;
    for (int step = 0; step < kSteps; ++step) {
      const cavea::Report report = cavea::remesh(mesh, wanted_size, options);
      steps.push_back(step_json(mesh, &report));
    }
    if (argc > 1) cavea::write_mesh(argv[1], cavea::to_data(mesh));
    std::cout << nlohmann::json{{"eps_m", kError}, {"steps", steps}}.dump(2) << "\n";
    return 0;
  } catch (const std::exception& e) {
    std::cerr << e.what() << "\n";
    return 1;
  }
}
