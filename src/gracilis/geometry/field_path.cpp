#include <gracilis/geometry/field_path.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

/// Between nodes a field may tell more than the distance: by its slope and by rounding off ridges.
static constexpr float trusted_part = 0.9f;
static constexpr int most_steps = 512;
/// A step that brings the end nearer by less than this share of its length slides no further.
static constexpr float least_headway = 0.01f;

BoundedField bounded(const DistanceField& field) {
  const Index nx = field.nodes[0], ny = field.nodes[1], nz = field.nodes[2];
  float border = std::numeric_limits<float>::infinity();
  const auto see = [&](Index i, Index j, Index k) {
    const auto node = static_cast<std::size_t>(i) +
                      static_cast<std::size_t>(nx) *
                          (static_cast<std::size_t>(j) + static_cast<std::size_t>(ny) * static_cast<std::size_t>(k));
    border = std::min(border, field.values[node]);
  };
  for (Index j = 0; j < ny; ++j)
    for (Index i = 0; i < nx; ++i) see(i, j, 0), see(i, j, nz - 1);
  for (Index k = 0; k < nz; ++k) {
    for (Index i = 0; i < nx; ++i) see(i, 0, k), see(i, ny - 1, k);
    for (Index j = 0; j < ny; ++j) see(0, j, k), see(nx - 1, j, k);
  }
  const Vec3 size((nx - 1) * field.cell_size.x(), (ny - 1) * field.cell_size.y(), (nz - 1) * field.cell_size.z());
  return {&field, grid_of(field), std::max(border, 0.0f), field.origin.cast<float>(), size.cast<float>()};
}

float safe_step(const DistanceField& field) { return static_cast<float>(field.cell_size.minCoeff()) / 2; }

Eigen::Vector3f kept_path(const BoundedField& bounded, const Eigen::Vector3f& from, const Eigen::Vector3f& to,
                          float level) {
  const float safe = safe_step(*bounded.field);
  const auto cell = static_cast<float>(bounded.field->cell_size.maxCoeff());
  Eigen::Vector3f p = from;
  FieldSample at = sample_bounded(bounded, p);
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::Vector3f rest = to - p;
    const float left = rest.norm();
    const float stride = std::max(safe, trusted_part * (at.distance - level) - cell);
    if (!(left > 0)) return p;
    Eigen::Vector3f next = stride < left ? Eigen::Vector3f(p + rest * (stride / left)) : to;
    at = sample_bounded(bounded, next);
    if (at.distance < level) {
      const float slope2 = at.gradient.squaredNorm();
      if (slope2 < 1e-4f) return p;
      // A step goes no deeper than it is long; more would be the field's error.
      next += at.gradient * std::min((level - at.distance) / slope2, 2 * safe / std::sqrt(slope2));
      at = sample_bounded(bounded, next);
      // Pushed back as far as it came: nothing is left to slide along.
      if ((to - next).norm() > left - least_headway * std::min(stride, left))
        return at.distance < level - safe ? p : next;
    }
    p = next;
    if (stride >= left) return p;
  }
  return p;
}

}  // namespace gracilis
