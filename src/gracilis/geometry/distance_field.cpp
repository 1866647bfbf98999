#include <gracilis/geometry/distance_field.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/signed_distance.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

/// Exact values are computed first on every fourth node.
constexpr Index coarse_step = 4;

Eigen::AlignedBox3d bounding_box(const TriangleMesh& mesh) {
  return {mesh.vertices.rowwise().minCoeff(), mesh.vertices.rowwise().maxCoeff()};
}

Index rounded_up(Index cells) { return (cells + coarse_step - 1) / coarse_step * coarse_step; }

/// The grid while it is filled: node positions, coarse pass, fine pass.
class Builder {
 public:
  Builder(const TriangleMesh& mesh, const FieldDomain& domain) : surface_(mesh) {
    field_.origin = domain.box.min();
    for (int axis = 0; axis < 3; ++axis) {
      const Index cells = rounded_up(domain.cells[static_cast<std::size_t>(axis)]);
      field_.cell_size[axis] =
          domain.box.sizes()[axis] / static_cast<Real>(domain.cells[static_cast<std::size_t>(axis)]);
      field_.nodes[static_cast<std::size_t>(axis)] = cells + 1;
      coarse_cells_[axis] = cells / coarse_step;
    }
    field_.values.resize(static_cast<std::size_t>(field_.nodes[0]) * static_cast<std::size_t>(field_.nodes[1]) *
                         static_cast<std::size_t>(field_.nodes[2]));
  }

  DistanceField build() {
    // Slices of whole coarse cells, so that neighbors share work but never write to the same node.
    parallel_for(coarse_cells_[2] + 1, 1, [&](Index k, Index) { fill_coarse_slice(k); });
    parallel_for(coarse_cells_[2], 1, [&](Index k, Index) { fill_slab(k); });
    return std::move(field_);
  }

 private:
  std::size_t node(Index i, Index j, Index k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(field_.nodes[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(field_.nodes[1]) * static_cast<std::size_t>(k));
  }

  Vec3 position(Index i, Index j, Index k) const {
    return field_.origin +
           field_.cell_size.cwiseProduct(Vec3(static_cast<Real>(i), static_cast<Real>(j), static_cast<Real>(k)));
  }

  void fill_coarse_slice(Index k) {
    for (Index j = 0; j <= coarse_cells_[1]; ++j)
      for (Index i = 0; i <= coarse_cells_[0]; ++i) {
        const Index x = i * coarse_step, y = j * coarse_step, z = k * coarse_step;
        field_.values[node(x, y, z)] = static_cast<float>(surface_.query(position(x, y, z)).distance);
      }
  }

  void fill_slab(Index k) {
    for (Index j = 0; j < coarse_cells_[1]; ++j)
      for (Index i = 0; i < coarse_cells_[0]; ++i) fill_coarse_cell({i, j, k});
  }

  /// Fills the nodes that coarse cell `cell` owns: those up to, not including, its far faces (except at the grid's
  /// end).
  void fill_coarse_cell(const Eigen::Vector3i& cell) {
    std::array<float, 8> corners;
    for (int c = 0; c < 8; ++c)
      corners[static_cast<std::size_t>(c)] =
          field_.values[node((cell[0] + (c & 1)) * coarse_step, (cell[1] + (c >> 1 & 1)) * coarse_step,
                             (cell[2] + (c >> 2)) * coarse_step)];
    float nearest = std::abs(corners[0]);
    for (float corner : corners) nearest = std::min(nearest, std::abs(corner));
    const Real diagonal = coarse_step * field_.cell_size.norm();
    const bool exact = nearest < 2 * diagonal;
    Eigen::Vector3i end = Eigen::Vector3i::Constant(coarse_step);
    for (int axis = 0; axis < 3; ++axis)
      if (cell[axis] == coarse_cells_[axis] - 1) ++end[axis];
    for (Index z = 0; z < end[2]; ++z)
      for (Index y = 0; y < end[1]; ++y)
        for (Index x = 0; x < end[0]; ++x) {
          const bool on_coarse_grid = x % coarse_step == 0 && y % coarse_step == 0 && z % coarse_step == 0;
          if (on_coarse_grid) continue;
          const Index i = cell[0] * coarse_step + x, j = cell[1] * coarse_step + y, k = cell[2] * coarse_step + z;
          field_.values[node(i, j, k)] =
              exact ? static_cast<float>(surface_.query(position(i, j, k), nearest + diagonal).distance)
                    : interpolated(corners, Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y),
                                                            static_cast<float>(z)) /
                                                static_cast<float>(coarse_step));
        }
  }

  static float interpolated(const std::array<float, 8>& corners, const Eigen::Vector3f& t) {
    float value = 0;
    for (int c = 0; c < 8; ++c)
      value += corners[static_cast<std::size_t>(c)] * ((c & 1) ? t.x() : 1 - t.x()) * ((c & 2) ? t.y() : 1 - t.y()) *
               ((c & 4) ? t.z() : 1 - t.z());
    return value;
  }

  SignedDistance surface_;
  DistanceField field_;
  Eigen::Vector3i coarse_cells_ = Eigen::Vector3i::Zero();
};

}  // namespace

FieldDomain domain_by_cell_size(const TriangleMesh& mesh, Real cell_size, Real margin) {
  FieldDomain domain;
  domain.box = bounding_box(mesh);
  domain.box.min().array() -= margin;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cells = static_cast<Index>(std::ceil((domain.box.sizes()[axis] + margin) / cell_size));
    domain.cells[static_cast<std::size_t>(axis)] = std::max(cells, Index{1});
  }
  for (int axis = 0; axis < 3; ++axis)
    domain.box.max()[axis] =
        domain.box.min()[axis] + cell_size * static_cast<Real>(domain.cells[static_cast<std::size_t>(axis)]);
  return domain;
}

FieldDomain domain_by_resolution(const TriangleMesh& mesh, int resolution, Real factor) {
  FieldDomain domain;
  const Eigen::AlignedBox3d box = bounding_box(mesh);
  const Vec3 half = (box.sizes() / 2 * factor).cwiseMax(1e-6);
  domain.box = {box.center() - half, box.center() + half};
  domain.cells.fill(resolution);
  return domain;
}

DistanceField build_distance_field(const TriangleMesh& mesh, const FieldDomain& domain) {
  return Builder(mesh, domain).build();
}

void sample(const DistanceField& field, const Points& points, Eigen::VectorXd& distances, Points* gradients) {
  distances.resize(points.cols());
  if (gradients) gradients->resize(3, points.cols());
  for (Index i = 0; i < points.cols(); ++i) {
    const FieldSample answer = sample(field, Eigen::Vector3f(points.col(i).cast<float>()));
    distances[i] = static_cast<Real>(answer.distance);
    if (gradients) gradients->col(i) = answer.gradient.cast<Real>();
  }
}

}  // namespace gracilis
