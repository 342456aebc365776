#pragma once
#include "cavea/mesh/tet_mesh.h"
#include "cavea/surface/features.h"
#include "cavea/surface/surface_model.h"

namespace cavea {

/// Classifies the surface of a mesh after the model of another mesh's surface, its truth: ridges
/// are kept and detected only along the model's feature curves; the triangles take the patches of
/// the model, by majority of area over each piece between feature edges; vertices get their anchors
/// on it, and those that are not on the ideal surface kOffSurface. Corners and required vertices
/// stay where they are. \param tolerance hausd
/// \return the share of the area that lies farther from its own patch than from another, by more
/// than follows from the tolerance: the model has a ridge there and the mesh has none.
double attach_to(TetMesh& mesh, const SurfaceModel& model, const FeatureOptions& options,
                 double tolerance);

/// A surface vertex and its distance from all of a model's facets.
struct OffVertex {
  VertexId vertex = kNone;
  double distance = 0;
};

/// The farthest one.
OffVertex farthest_vertex(const TetMesh& mesh, const SurfaceModel& model);

}  // namespace cavea
