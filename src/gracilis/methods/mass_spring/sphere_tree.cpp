#include <gracilis/methods/mass_spring/sphere_tree.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace gracilis::mass_spring {

namespace {

/// Least share of a parent's volume over the sum of its children's (eq. 3.1).
constexpr Real least_fill = 0.9;

}  // namespace

SphereTree::SphereTree(const Spheres& spheres, TreeUpdate update, std::size_t leaf_size, int most_depth)
    : spheres_(spheres), update_(update), leaf_size_(leaf_size), most_depth_(most_depth) {
  std::vector<Index> all(static_cast<std::size_t>(spheres.count()));
  std::iota(all.begin(), all.end(), 0);
  const Eigen::AlignedBox3d bounds = bounds_of(all);
  new_box({bounds, std::move(all), {}, 0, false});
}

Eigen::AlignedBox3d SphereTree::bounds_of(const std::vector<Index>& spheres) const {
  Eigen::AlignedBox3d bounds;
  for (const Index s : spheres) {
    const Vec3 reach = Vec3::Constant(spheres_.radii[static_cast<std::size_t>(s)]), center = spheres_.centers.col(s);
    bounds.extend(Vec3(center - reach));
    bounds.extend(Vec3(center + reach));
  }
  return bounds;
}

Index SphereTree::new_box(Box box) {
  if (free_.empty()) {
    boxes_.push_back(std::move(box));
    return static_cast<Index>(boxes_.size()) - 1;
  }
  const Index place = free_.back();
  free_.pop_back();
  at(place) = std::move(box);
  return place;
}

void SphereTree::divide(Index box) {
  if (!at(box).children.empty() || at(box).spheres.size() <= leaf_size_ || at(box).depth >= most_depth_) return;
  const Vec3 middle = at(box).bounds.center();
  std::array<std::vector<Index>, 8> octants;
  for (const Index s : at(box).spheres) {
    const Vec3 center = spheres_.centers.col(s);
    octants[(center.x() > middle.x() ? 1u : 0u) + (center.y() > middle.y() ? 2u : 0u) +
            (center.z() > middle.z() ? 4u : 0u)]
        .push_back(s);
  }
  const int depth = at(box).depth + 1;
  for (std::vector<Index>& octant : octants) {
    if (octant.empty()) continue;
    const Eigen::AlignedBox3d bounds = bounds_of(octant);
    const Index child = new_box({bounds, std::move(octant), {}, depth, false});
    at(box).children.push_back(child);  // after new_box, which may move all boxes
  }
}

void SphereTree::drop_descendants(Index box) {
  for (const Index child : std::exchange(at(box).children, {})) {
    drop_descendants(child);
    free_.push_back(child);
  }
}

void SphereTree::refit(Index box) {
  if (update_ == TreeUpdate::rebuild && !at(box).is_asked) drop_descendants(box);
  at(box).is_asked = false;
  if (at(box).children.empty()) {
    at(box).bounds = bounds_of(at(box).spheres);
    return;
  }
  Eigen::AlignedBox3d bounds;
  Real volumes = 0;
  for (const Index child : at(box).children) {
    refit(child);
    bounds.extend(at(child).bounds);
    volumes += at(child).bounds.volume();
  }
  at(box).bounds = bounds;
  if (update_ == TreeUpdate::rebuild && bounds.volume() < least_fill * volumes) drop_descendants(box);
}

void SphereTree::update() { refit(0); }

void SphereTree::collect(SphereTree& one, Index a, SphereTree& other, Index b,
                         std::vector<std::array<Index, 2>>& pairs) {
  if (!one.at(a).bounds.intersects(other.at(b).bounds)) return;
  one.at(a).is_asked = other.at(b).is_asked = true;
  one.divide(a);
  other.divide(b);
  const std::vector<Index> own = {a}, of_other = {b};
  const bool is_leaf = one.at(a).children.empty(), other_is_leaf = other.at(b).children.empty();
  if (is_leaf && other_is_leaf) {
    for (const Index s : one.at(a).spheres)
      for (const Index t : other.at(b).spheres) {
        const Real reach =
            one.spheres_.radii[static_cast<std::size_t>(s)] + other.spheres_.radii[static_cast<std::size_t>(t)];
        if ((one.spheres_.centers.col(s) - other.spheres_.centers.col(t)).squaredNorm() < reach * reach)
          pairs.push_back({s, t});
      }
    return;
  }
  // Copies: dividing boxes further down may move all boxes.
  const std::vector<Index> first = is_leaf ? own : one.at(a).children,
                           second = other_is_leaf ? of_other : other.at(b).children;
  for (const Index i : first)
    for (const Index j : second) collect(one, i, other, j, pairs);
}

std::vector<std::array<Index, 2>> SphereTree::intersecting(SphereTree& one, SphereTree& other) {
  std::vector<std::array<Index, 2>> pairs;
  if (one.spheres_.count() == 0 || other.spheres_.count() == 0) return pairs;
  collect(one, 0, other, 0, pairs);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace gracilis::mass_spring
