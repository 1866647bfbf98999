#include <gracilis/geometry/distance_field.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/signed_distance.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gracilis {

namespace {

/// Exact values are computed first on every eighth node, then halving.
constexpr Index coarse_step = 8;
/// How far the distance in the middle of a cell may be from the interpolated one, m.
constexpr float largest_bend = 6e-5f;

Index rounded_up(Index cells) { return (cells + coarse_step - 1) / coarse_step * coarse_step; }

/// The grid while it is filled, from coarse to fine: values far from the surface are interpolated.
class Builder {
 public:
  Builder(const TriangleMesh& mesh, const FieldDomain& domain) : surface_(mesh) {
    field_.origin = domain.box.min();
    for (int axis = 0; axis < 3; ++axis) {
      const Index cells = rounded_up(domain.cells[static_cast<std::size_t>(axis)]);
      field_.cell_size[axis] =
          domain.box.sizes()[axis] / static_cast<Real>(domain.cells[static_cast<std::size_t>(axis)]);
      field_.nodes[static_cast<std::size_t>(axis)] = cells + 1;
      cells_[axis] = cells;
    }
    field_.values.resize(static_cast<std::size_t>(field_.nodes[0]) * static_cast<std::size_t>(field_.nodes[1]) *
                         static_cast<std::size_t>(field_.nodes[2]));
  }

  DistanceField build() {
    parallel_for(cells_[2] / coarse_step + 1, 1, [&](Index k, Index) { fill_coarse_slice(k * coarse_step); });
    // Slabs of whole cells, so that neighbors share what they start from but never write to the same node.
    for (Index size = coarse_step; size > 1; size /= 2)
      parallel_for(cells_[2] / size, 1, [&](Index k, Index) { refine_slab(k * size, size); });
    return std::move(field_);
  }

 private:
  float& value(const Eigen::Vector3i& node) {
    return field_.values[static_cast<std::size_t>(node[0]) +
                         static_cast<std::size_t>(field_.nodes[0]) *
                             (static_cast<std::size_t>(node[1]) +
                              static_cast<std::size_t>(field_.nodes[1]) * static_cast<std::size_t>(node[2]))];
  }

  /// Sets a node to its exact value. `face`, the one nearest to a node close by, becomes the one nearest to this.
  void set_exactly(const Eigen::Vector3i& node, Index& face) {
    const Vec3 at = field_.origin + field_.cell_size.cwiseProduct(node.cast<Real>());
    const SignedDistance::Answer answer = surface_.query_from(face, at);
    value(node) = static_cast<float>(answer.distance);
    face = answer.nearest.face;
  }

  void fill_coarse_slice(Index z) {
    Index face = 0;
    for (Index y = 0; y <= cells_[1]; y += coarse_step)
      for (Index x = 0; x <= cells_[0]; x += coarse_step) set_exactly({x, y, z}, face);
  }

  void refine_slab(Index z, Index size) {
    Index face = 0;
    for (Index y = 0; y < cells_[1]; y += size)
      for (Index x = 0; x < cells_[0]; x += size) refine_cell({x, y, z}, size, face);
  }

  /// Fills the nodes halfway between those of a cell of `size` grid cells which the cell owns: those up to, not
  /// including, its far sides (except at the grid's end).
  void refine_cell(const Eigen::Vector3i& cell, Index size, Index& face) {
    std::array<float, 8> corners;
    float nearest = std::numeric_limits<float>::infinity();
    for (int c = 0; c < 8; ++c) {
      float& corner = corners[static_cast<std::size_t>(c)];
      corner = value(cell + size * Eigen::Vector3i(c & 1, c >> 1 & 1, c >> 2));
      nearest = std::min(nearest, std::abs(corner));
    }
    const Index half = size / 2;
    const Real reach = size * field_.cell_size.norm();
    const bool is_near = nearest < reach, is_doubtful = !is_near && nearest < 2 * reach;
    const Eigen::Vector3i middle = cell + Eigen::Vector3i::Constant(half);
    if (is_doubtful) set_exactly(middle, face);
    const auto bends = [&] {
      return std::abs(value(middle) - interpolated(corners, Eigen::Vector3f::Constant(0.5f))) >= largest_bend;
    };
    const bool exact = is_near || (is_doubtful && bends());
    const auto end = [&](int axis) { return cell[axis] + size == cells_[axis] ? size : half; };
    for (Index z = 0; z <= end(2); z += half)
      for (Index y = 0; y <= end(1); y += half)
        for (Index x = 0; x <= end(0); x += half) {
          const Eigen::Vector3i within(x, y, z);
          if ((within.array() != half).all()) continue;                 // a corner
          if (is_doubtful && (within.array() == half).all()) continue;  // the middle is known
          if (exact)
            set_exactly(cell + within, face);
          else
            value(cell + within) = interpolated(corners, within.cast<float>() / static_cast<float>(size));
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
  Eigen::Vector3i cells_ = Eigen::Vector3i::Zero();
};

}  // namespace

FieldDomain domain_by_cell_size(const TriangleMesh& mesh, Real cell_size, Real margin) {
  FieldDomain domain;
  domain.box = bounding_box(mesh.vertices);
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
  const Eigen::AlignedBox3d box = bounding_box(mesh.vertices);
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
