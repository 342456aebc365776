#include <cavea/base/error.h>
#include <cavea/io/formats.h>
#include <cavea/mesh/build.h>
#include <cavea/remesh/remesh.h>

#include <cmath>
#include <iostream>

int main() {
  try {
    std::vector<std::string> warnings;
    cavea::TetMesh mesh = cavea::build(cavea::read_mesh("part.mesh", &warnings)).mesh;

    cavea::Options options;
    options.hausd = 0.1;  // what is not set follows from the bounding box
    options.threads = 2;
    const auto size = [](const cavea::Vec3& p) { return 3 + 0.05 * std::abs(p.x); };
    const cavea::Report report = cavea::remesh(mesh, size, options);

    cavea::write_mesh("part.out.meshb", cavea::to_data(mesh));
    std::cout << report.after.counts.tets << " tets, worst quality " << report.after.quality.worst
              << ", mean " << report.after.quality.mean << "\n";
    return report.targets_met() ? 0 : 1;
  } catch (const cavea::Error& e) {
    std::cerr << e.what() << "\n";
    return 2;
  }
}
