#include "cavea/remesh/job.h"

#include "cavea/base/memory.h"
#include "cavea/field/own_sizes.h"
#include "cavea/field/size_regions.h"
#include "cavea/mesh/compact.h"

namespace cavea {
namespace {

TetMesh& compacted(TetMesh& mesh) {
  compact(mesh);
  return mesh;
}

}  // namespace

Job::Job(Input& from, const SizeField& wished, const Options& asked, double finer)
    : input(from),
      loan(from),
      mesh(compacted(loan.mesh())),
      options(asked),
      steps(mesh, options, report.phases),
      field(asked.optim ? own_sizes(mesh) : wished),
      r(resolve(asked, {box_diagonal(mesh), thickness(mesh)}, wished_range(mesh, field))),
      most_bytes(asked.max_memory.value_or(usable_bytes())),
      surface(options, r),
      sizes(r, with_regions(field, asked.size_regions, r.hgrad), asked.max_tets, finer) {}

}  // namespace cavea
