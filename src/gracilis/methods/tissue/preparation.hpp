#pragma once

#include <gracilis/core/group_by_key.hpp>
#include <gracilis/geometry/field_path.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/methods/tissue/cell_lanes.hpp>
#include <gracilis/methods/tissue/large_faces.hpp>
#include <gracilis/methods/tissue/settings.hpp>

#include <string>
#include <vector>

namespace gracilis::tissue {

/// Fascia from a vertex to a body.
struct Tie {
  Index body = -1;
  Vec3 along = Vec3::Zero();  ///< the fibers' direction at rest, unit; 0: there is none
  Real stiffness = 0;         ///< N/m
};

/// A vertex of the muscle's surface, or a point on one of its triangles.
struct SurfacePoint {
  EmbeddedPoint at;
  Vec3 rest = Vec3::Zero();
  Real area = 0;                              ///< m², that it stands for
  Real vertex_area = 0;                       ///< m², of a vertex without points on its triangles; 0 of these
  Real held_area = 0;                         ///< m², of it, that of triangles all of whose corners are held alike
  Index held_by = -1;                         ///< the body that it is attached to, or -1
  AttachmentEnd end = AttachmentEnd::origin;  ///< of the attachment, where it is held
  Index ties_begin = 0, ties_end = 0;
  Real joined_stiffness = 0;  ///< N/m, of the springs to ends of muscles that lie on it
};

/// What a bone asks of the surface.
struct BoneGap {
  Index body = -1;
  BoundedField field;
  std::vector<Real> gaps;        ///< m, per point, by the field
  std::vector<Real> seen_least;  ///< m, per vertex: exact distance from it, see `seen_clearance`
  std::vector<Real> edge_least;  ///< m, likewise, of the middles of `PreparedTissue::edges`
};

/// A muscle prepared for the minimizer; constant during a run.
struct PreparedTissue {
  std::string name;
  TissueSettings settings;
  Lattice lattice;
  std::vector<Real> relative_tension;  ///< per cell: the mean section over the section there, by the fibers' flux
  Points directions;                   ///< per cell: of the fibers at rest, unit, or 0
  std::vector<Real> fiber_density;  ///< per cell, 1/m: what a tension (Pa) counts with, by volume, in the muscle's (N)
  Real mean_section = 0;            ///< m², across the fibers, of the belly
  std::vector<std::vector<Index>> fiber_cells;  ///< of each of the muscle's fibers: the cells it runs through
  std::vector<SurfacePoint> points;             ///< the surface's vertices in their order, then the others
  Index vertex_count = 0;
  Eigen::Matrix3Xi faces;                   ///< of the surface
  std::vector<std::array<Index, 2>> edges;  ///< of the surface, those with a free end, each once
  GroupedByKey edges_of_vertices;           ///< edge * 2 + end, by their ends
  LargeFaces large_faces;
  Real volume = 0;        ///< m³, that the surface encloses at rest
  std::vector<Tie> ties;  ///< of points, one after the other
  std::vector<BoneGap> bones;
  GroupedByKey points_of_nodes;      ///< point * 4 + corner, by their nodes
  std::vector<Real> point_weights;   ///< of a point's corners, by the same numbers
  CellLanes cells;                   ///< of the lattice, for the vector kernel
  GroupedByKey corners_of_nodes;     ///< where corners stand in `cells`, by their nodes
  std::vector<Index> carriers;       ///< bodies that carry the muscle
  Eigen::MatrixXd skinning_weights;  ///< nodes × carriers; rows sum to 1, or are 0
};

/// Lattice, fibers, attachments, fascia and gaps of a muscle. `fields` and `distances` have one entry per bone; fields
/// must outlive the result. Precondition: the scene is valid.
PreparedTissue prepare_tissue(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields,
                              const std::vector<SignedDistance>& distances);

/// Lanes of the lattice's cells, and what of cells and points acts on each node.
void sort_by_nodes(PreparedTissue& prepared);

/// The laws of all cells; `tension` scales what fibers do, 0 to 1.
std::vector<CellLaw> cell_laws(const PreparedTissue& muscle, Real activation, Real tension);

}  // namespace gracilis::tissue
