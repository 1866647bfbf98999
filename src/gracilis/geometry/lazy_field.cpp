#include <gracilis/geometry/lazy_field.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

namespace {

constexpr Index coarse_cells = 4;  ///< fine cells along a coarse one
constexpr float near = 0.012f;     ///< m

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

std::unique_ptr<std::atomic<float>[]> unknown_nodes(const Eigen::Vector3i& counts) {
  const std::size_t count =
      static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1]) * static_cast<std::size_t>(counts[2]);
  auto nodes = std::make_unique<std::atomic<float>[]>(count);
  for (std::size_t i = 0; i < count; ++i) nodes[i].store(unknown, std::memory_order_relaxed);
  return nodes;
}

}  // namespace

LazyField::LazyField(const TriangleMesh& surface, const SignedDistance& exact, Real cell_size, Real margin)
    : exact_(&exact),
      box_(surface.vertices.rowwise().minCoeff().array() - margin,
           surface.vertices.rowwise().maxCoeff().array() + margin),
      cell_(cell_size) {
  coarse_counts_ = (box_.sizes() / (cell_ * coarse_cells)).array().ceil().cast<int>() + 1;
  counts_ = (coarse_counts_.array() - 1) * coarse_cells + 1;
  nodes_ = unknown_nodes(counts_);
  coarse_ = unknown_nodes(coarse_counts_);
}

float LazyField::node(const Nodes& nodes, const Eigen::Vector3i& counts, Real cell, const Eigen::Vector3i& at) const {
  std::atomic<float>& value = nodes[static_cast<std::size_t>(at[0]) +
                                    static_cast<std::size_t>(counts[0]) *
                                        (static_cast<std::size_t>(at[1]) +
                                         static_cast<std::size_t>(counts[1]) * static_cast<std::size_t>(at[2]))];
  const float known = value.load(std::memory_order_relaxed);
  if (!std::isnan(known)) return known;
  const Vec3 place = box_.min() + cell * at.cast<Real>();
  const auto distance = static_cast<float>(exact_->query(place).distance);
  value.store(distance, std::memory_order_relaxed);  // whoever else asks stores the same
  return distance;
}

FieldSample LazyField::sample(const Vec3& p) const {
  FieldSample answer;
  const Vec3 clamped = p.cwiseMax(box_.min()).cwiseMin(box_.max());
  const Real coarse_cell = cell_ * coarse_cells;
  const Eigen::Vector3i nearest = ((clamped - box_.min()) / coarse_cell).array().round().cast<int>();
  const Vec3 from = p - (box_.min() + coarse_cell * nearest.cast<Real>());
  const float about = node(coarse_, coarse_counts_, coarse_cell, nearest);
  answer.distance = about - static_cast<float>(from.norm());
  if (answer.distance > near || clamped != p) {
    answer.distance = std::max(answer.distance, static_cast<float>((p - clamped).norm()));
    return answer;
  }
  const Vec3 f = (p - box_.min()) / cell_;
  const Eigen::Vector3i low = f.array().floor().cast<int>().min(counts_.array() - 2);
  const Eigen::Vector3f t = (f - low.cast<Real>()).cast<float>(), s = Eigen::Vector3f::Ones() - t;
  float v[2][2][2];
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) v[k][j][i] = node(nodes_, counts_, cell_, low + Eigen::Vector3i(i, j, k));
  const auto blend = [](float a, float b, float u) { return a + u * (b - a); };
  float x[2][2], dx[2][2];
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j) x[k][j] = blend(v[k][j][0], v[k][j][1], t.x()), dx[k][j] = v[k][j][1] - v[k][j][0];
  const float y0 = blend(x[0][0], x[0][1], t.y()), y1 = blend(x[1][0], x[1][1], t.y());
  answer.distance = blend(y0, y1, t.z());
  answer.gradient = Eigen::Vector3f(s.z() * blend(dx[0][0], dx[0][1], t.y()) + t.z() * blend(dx[1][0], dx[1][1], t.y()),
                                    blend(x[0][1] - x[0][0], x[1][1] - x[1][0], t.z()), y1 - y0) /
                    static_cast<float>(cell_);
  return answer;
}

}  // namespace gracilis
