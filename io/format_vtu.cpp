#include "cavea/base/module.h"
#include "cavea/io/format.h"

namespace cavea {
namespace {

/// VTK stays in a module of its own.
void write(OutputFile& file, const MeshData& data, const WriteOptions&) {
  using Write = void(OutputFile&, const MeshData&);
  static const auto write_vtu =
      reinterpret_cast<Write*>(module_symbol("cavea_vtk", "cavea_write_vtu"));
  write_vtu(file, data);
}

}  // namespace

Format vtu_format() { return {".vtu", "VTK XML unstructured grid", nullptr, write, {}, {}, {}}; }

}  // namespace cavea
