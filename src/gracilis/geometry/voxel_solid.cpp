#include <gracilis/geometry/voxel_solid.hpp>

#include <gracilis/geometry/measures.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

namespace {

/// Share of its size by which a box counts as touched: triangles lie in the sides of boxes, where rounding decides.
constexpr Real touching = 1e-9;
/// Share of its size by which a place in a box keeps off its sides.
constexpr Real hair = 1e-6;

/// Whether a triangle about the center of a box meets it, half as large as `half`: no axis parts them (Akenine-Möller
/// 2001).
bool meets_box(const std::array<Vec3, 3>& corners, const Vec3& half) {
  const auto parted_by = [&](const Vec3& axis) {
    const Real a = corners[0].dot(axis), b = corners[1].dot(axis), c = corners[2].dot(axis);
    const Real reach = half.dot(axis.cwiseAbs());
    return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
  };
  const std::array<Vec3, 3> sides = {corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
  for (int k = 0; k < 3; ++k) {
    if (parted_by(Vec3::Unit(k))) return false;
    for (const Vec3& side : sides)
      if (parted_by(Vec3::Unit(k).cross(side))) return false;
  }
  return !parted_by(sides[0].cross(sides[1]));
}

constexpr std::size_t bits_per_word = 64;

}  // namespace

VoxelSolid::VoxelSolid(const TriangleMesh& surface, int boxes) : count_(boxes) {
  const Eigen::AlignedBox3d bounds = bounding_box(surface.vertices);
  low_ = bounds.min();
  // A flat surface has boxes, too.
  size_ = (bounds.sizes() / boxes).cwiseMax(1e-9);
  const auto all = static_cast<std::size_t>(count_);
  full_.assign((all * all * all + bits_per_word - 1) / bits_per_word, 0);
  fill_touched(surface);
  fill_enclosed();
}

VoxelSolid::Box VoxelSolid::box_of(const Vec3& p) const {
  Box box;
  for (int k = 0; k < 3; ++k) {
    const Real at = (p[k] - low_[k]) / size_[k];
    // Points on the far side belong to the last box.
    const bool is_last = at == static_cast<Real>(count_);
    box[static_cast<std::size_t>(k)] =
        is_last ? count_ - 1 : static_cast<int>(std::floor(std::clamp(at, Real{-1}, static_cast<Real>(count_))));
  }
  return box;
}

bool VoxelSolid::is_inside_grid(const Box& box) const {
  return std::all_of(box.begin(), box.end(), [&](int at) { return at >= 0 && at < count_; });
}

namespace {

std::size_t box_number(const std::array<int, 3>& box, int count) {
  const auto n = static_cast<std::size_t>(count);
  return static_cast<std::size_t>(box[0]) +
         n * (static_cast<std::size_t>(box[1]) + n * static_cast<std::size_t>(box[2]));
}

}  // namespace

bool VoxelSolid::is_full(const Box& box) const {
  if (!is_inside_grid(box)) return false;
  const std::size_t number = box_number(box, count_);
  return (full_[number / bits_per_word] >> (number % bits_per_word) & 1) != 0;
}

void VoxelSolid::set_full(const Box& box) {
  const std::size_t number = box_number(box, count_);
  full_[number / bits_per_word] |= std::uint64_t{1} << (number % bits_per_word);
}

void VoxelSolid::fill_touched(const TriangleMesh& surface) {
  const Vec3 half = (0.5 + touching) * size_;
  for (Index f = 0; f < static_cast<Index>(surface.faces.cols()); ++f) {
    std::array<Vec3, 3> corners;
    Eigen::AlignedBox3d around;
    for (int k = 0; k < 3; ++k) {
      corners[static_cast<std::size_t>(k)] = surface.vertices.col(surface.faces(k, f));
      around.extend(corners[static_cast<std::size_t>(k)]);
    }
    Box first = box_of(around.min() - touching * size_), last = box_of(around.max() + touching * size_);
    for (std::size_t k = 0; k < 3; ++k) first[k] = std::max(first[k], 0), last[k] = std::min(last[k], count_ - 1);
    for (int z = first[2]; z <= last[2]; ++z)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x) {
          const Vec3 center = low_ + size_.cwiseProduct(Vec3(x + 0.5, y + 0.5, z + 0.5));
          if (meets_box({corners[0] - center, corners[1] - center, corners[2] - center}, half)) set_full({x, y, z});
        }
  }
}

void VoxelSolid::fill_enclosed() {
  std::vector<std::uint64_t> reached(full_.size(), 0);
  std::vector<Box> open;
  const auto reach = [&](const Box& box) {
    if (!is_inside_grid(box) || is_full(box)) return;
    const std::size_t number = box_number(box, count_);
    const std::uint64_t bit = std::uint64_t{1} << (number % bits_per_word);
    if ((reached[number / bits_per_word] & bit) != 0) return;
    reached[number / bits_per_word] |= bit;
    open.push_back(box);
  };
  for (int i = 0; i < count_; ++i)
    for (int j = 0; j < count_; ++j)
      for (const int side : {0, count_ - 1}) reach({side, i, j}), reach({i, side, j}), reach({i, j, side});
  while (!open.empty()) {
    const Box box = open.back();
    open.pop_back();
    for (std::size_t k = 0; k < 3; ++k)
      for (const int by : {-1, 1}) {
        Box next = box;
        next[k] += by;
        reach(next);
      }
  }
  for (std::size_t i = 0; i < full_.size(); ++i) full_[i] = ~reached[i];
}

bool VoxelSolid::contains(const Vec3& p) const { return p.allFinite() && is_full(box_of(p)); }

Vec3 VoxelSolid::nearest_empty(const Vec3& p) const {
  if (!contains(p)) return p;
  const Box center = box_of(p);
  Vec3 nearest = p;
  Real least = std::numeric_limits<Real>::infinity();
  const auto ask = [&](const Box& box) {
    if (is_full(box)) return false;
    Vec3 place;
    for (int k = 0; k < 3; ++k) {
      const Real begin = low_[k] + size_[k] * box[static_cast<std::size_t>(k)];
      place[k] = std::clamp(p[k], begin + hair * size_[k], begin + (1 - hair) * size_[k]);
    }
    const Real distance = (place - p).norm();
    if (distance < least) least = distance, nearest = place;
    return true;
  };
  // Along the axes something is soon found; outside of the grid all boxes are empty.
  for (std::size_t k = 0; k < 3; ++k)
    for (const int by : {-1, 1}) {
      Box box = center;
      do box[k] += by;
      while (!ask(box));
    }
  // Nothing nearer begins farther away than that.
  Box reach;
  for (std::size_t k = 0; k < 3; ++k) reach[k] = static_cast<int>(least / size_[static_cast<Index>(k)]) + 1;
  for (int z = -reach[2]; z <= reach[2]; ++z)
    for (int y = -reach[1]; y <= reach[1]; ++y)
      for (int x = -reach[0]; x <= reach[0]; ++x) ask({center[0] + x, center[1] + y, center[2] + z});
  return nearest;
}

Vec3 VoxelSolid::first_empty(const Vec3& from, const Vec3& to) const {
  if (!contains(from)) return from;
  const int steps = static_cast<int>(std::ceil((to - from).cwiseQuotient(size_).norm()));
  for (int step = 1; step < steps; ++step)
    if (Vec3 place = from + (to - from) * (static_cast<Real>(step) / steps); !contains(place)) return place;
  return to;
}

}  // namespace gracilis
