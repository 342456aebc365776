#ifdef CAVEA_HAVE_VTK
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "cavea/base/error.h"
#include "files.h"

namespace cavea::test {
namespace {

vtkSmartPointer<vtkUnstructuredGrid> read_back(const std::filesystem::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

TEST(Vtu, HoldsTheMeshAndItsArrays) {
  const Folder folder;
  MeshData data = kuhn_cube(3);
  data.parts.resize(data.tets.size());
  for (std::size_t t = 0; t < data.tets.size(); ++t) {
    data.tet_refs[t] = std::int32_t(t % 5);
    data.parts[t] = std::int32_t(t / 50);
  }
  for (const Vec3& p : data.vertices) data.sizes.push_back(1 + p.x);
  write_mesh(folder / "a.vtu", data);
  EXPECT_EQ(folder.entries(), 1u);

  const auto grid = read_back(folder / "a.vtu");
  ASSERT_EQ(grid->GetNumberOfPoints(), vtkIdType(data.vertices.size()));
  ASSERT_EQ(grid->GetNumberOfCells(), vtkIdType(data.tets.size()));
  const auto cell = [&](const char* name) { return grid->GetCellData()->GetArray(name); };
  ASSERT_TRUE(cell("reference") && cell("quality") && cell("minimum_dihedral_angle") &&
              cell("part"));
  for (vtkIdType t = 0; t < grid->GetNumberOfCells(); ++t) {
    ASSERT_EQ(grid->GetCellType(t), VTK_TETRA);
    vtkNew<vtkIdList> corners;
    grid->GetCellPoints(t, corners);
    for (int k = 0; k < 4; ++k) EXPECT_EQ(corners->GetId(k), data.tets[t][k]);
    EXPECT_EQ(cell("reference")->GetTuple1(t), data.tet_refs[t]);
    EXPECT_EQ(cell("part")->GetTuple1(t), data.parts[t]);
    // Of a Kuhn tet: edges 1, sqrt 2 and sqrt 3; the angle at its long diagonal is 60 degrees, and
    // two others are 45.
    EXPECT_NEAR(cell("quality")->GetTuple1(t), 0.657267, 1e-5);
    EXPECT_NEAR(cell("minimum_dihedral_angle")->GetTuple1(t), 45, 1e-4);
  }
  for (vtkIdType v = 0; v < grid->GetNumberOfPoints(); ++v) {
    EXPECT_EQ(grid->GetPoint(v)[1], data.vertices[v].y);
    EXPECT_EQ(grid->GetPointData()->GetArray("size")->GetTuple1(v), data.sizes[v]);
  }
}

TEST(Vtu, ArraysWithoutDataAreLeftOut) {
  const Folder folder;
  write_mesh(folder / "a.vtu", single_tet());
  const auto grid = read_back(folder / "a.vtu");
  EXPECT_FALSE(grid->GetCellData()->GetArray("part"));
  EXPECT_FALSE(grid->GetPointData()->GetArray("size"));
  EXPECT_NEAR(grid->GetCellData()->GetArray("quality")->GetTuple1(0), 1, 1e-6);
  EXPECT_NEAR(grid->GetCellData()->GetArray("minimum_dihedral_angle")->GetTuple1(0), 70.528779,
              1e-5);
}

}  // namespace
}  // namespace cavea::test
#endif
