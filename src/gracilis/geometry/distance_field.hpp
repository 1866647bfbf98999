#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <array>
#include <limits>
#include <vector>

namespace gracilis {

/// Distance to a surface sampled on a regular grid, negative inside; trilinear between the nodes.
struct DistanceField {
  Vec3 origin = Vec3::Zero();           ///< of node (0, 0, 0), m
  Vec3 cell_size = Vec3::Ones();        ///< m
  std::array<Index, 3> nodes{0, 0, 0};  ///< along x, y, z
  std::vector<float> values;            ///< m; node (i, j, k) at i + nodes[0] (j + nodes[1] k)
};

/// A field's answer at one point.
struct FieldSample {
  float distance = std::numeric_limits<float>::infinity();  ///< m; infinity outside of the grid
  Eigen::Vector3f gradient = Eigen::Vector3f::Zero();       ///< of the trilinear interpolant, nearly unit
};

/// The extent and fineness of a field.
struct FieldDomain {
  Eigen::AlignedBox3d box;
  std::array<Index, 3> cells{0, 0, 0};
};

/// A domain of cubic cells of about `cell_size` that holds the mesh and `margin` around it.
FieldDomain domain_by_cell_size(const TriangleMesh& mesh, Real cell_size, Real margin);

/// The published choice: the bounding box scaled by `factor` about its center, `resolution` cells along each axis.
FieldDomain domain_by_resolution(const TriangleMesh& mesh, int resolution, Real factor);

/// Samples the signed distance of `mesh` over `domain`. Within three cells of the surface every node holds the exact
/// distance; up to twice that where halving coarser cells would bend it by more than 0.06 mm; farther away, where only
/// the sign and the order of magnitude matter, nodes between exact ones are interpolated. Signs as in SignedDistance,
/// so surfaces with holes are welcome. Preconditions: at least one face, finite coordinates.
DistanceField build_distance_field(const TriangleMesh& mesh, const FieldDomain& domain);

/// A field as the solver asks it, in single precision like its positions; the field must outlive it.
struct FieldGrid {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();  ///< m
  Eigen::Vector3f cells_per_metre = Eigen::Vector3f::Ones();
  std::array<Index, 3> nodes{0, 0, 0};
  const float* values = nullptr;
};

FieldGrid grid_of(const DistanceField& field);

/// Distance and gradient at one point.
FieldSample sample(const FieldGrid& grid, const Eigen::Vector3f& p);
FieldSample sample(const DistanceField& field, const Eigen::Vector3f& p);

/// The batched query: columns of `points` → distances (n) and, where asked for, gradients (3 × n).
void sample(const DistanceField& field, const Points& points, Eigen::VectorXd& distances, Points* gradients = nullptr);

/// The field as queries in single precision need it. Keeps pointing at its values.
inline FieldGrid grid_of(const DistanceField& field) {
  return {field.origin.cast<float>(), field.cell_size.cast<float>().cwiseInverse(), field.nodes, field.values.data()};
}

/// Always inlined: many want no gradient, and do not have to pay for it.
[[gnu::always_inline]] inline FieldSample sample(const FieldGrid& grid, const Eigen::Vector3f& p) {
  const Eigen::Vector3f f = (p - grid.origin).cwiseProduct(grid.cells_per_metre);
  const bool inside = f.x() >= 0 && f.y() >= 0 && f.z() >= 0 && f.x() < static_cast<float>(grid.nodes[0] - 1) &&
                      f.y() < static_cast<float>(grid.nodes[1] - 1) && f.z() < static_cast<float>(grid.nodes[2] - 1);
  if (!inside) return {};
  const auto i = static_cast<Index>(f.x()), j = static_cast<Index>(f.y()), k = static_cast<Index>(f.z());
  const float x = f.x() - static_cast<float>(i), y = f.y() - static_cast<float>(j), z = f.z() - static_cast<float>(k);
  const std::size_t row = static_cast<std::size_t>(grid.nodes[0]),
                    slice = row * static_cast<std::size_t>(grid.nodes[1]);
  const float* v = grid.values + static_cast<std::size_t>(i) + row * static_cast<std::size_t>(j) +
                   slice * static_cast<std::size_t>(k);
  const float v000 = v[0], v100 = v[1], v010 = v[row], v110 = v[row + 1];
  const float v001 = v[slice], v101 = v[slice + 1], v011 = v[slice + row], v111 = v[slice + row + 1];
  const float d00 = v100 - v000, d10 = v110 - v010, d01 = v101 - v001, d11 = v111 - v011;
  const float v00 = v000 + x * d00, v10 = v010 + x * d10, v01 = v001 + x * d01, v11 = v011 + x * d11;
  const float v0 = v00 + y * (v10 - v00), v1 = v01 + y * (v11 - v01);
  const float dx0 = d00 + y * (d10 - d00), dx1 = d01 + y * (d11 - d01);
  const Eigen::Vector3f per_cell = {dx0 + z * (dx1 - dx0), (v10 - v00) + z * ((v11 - v01) - (v10 - v00)), v1 - v0};
  return {v0 + z * (v1 - v0), per_cell.cwiseProduct(grid.cells_per_metre)};
}

/// The same of the field itself.
inline FieldSample sample(const DistanceField& field, const Eigen::Vector3f& p) { return sample(grid_of(field), p); }

}  // namespace gracilis
