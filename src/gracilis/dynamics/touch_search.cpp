#include <gracilis/dynamics/touch_search.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/point_triangle.hpp>

#include <algorithm>

namespace gracilis {

namespace {

constexpr Index bundles_per_task = 16;

/// The nearest face of a patch to which `side_of` gives a side, if it is nearer than `least2` (m², squared). Ties go to
/// the lower face, so that the answer does not depend on the tree.
template <class SideOf>
void consider_patch(const Eigen::Vector3f& p, const SearchedSurface& target, const PatchTree::Node& patch,
                    const SideOf& side_of, PointTouch& nearest, float& least2) {
  for (Index i = patch.begin; i < patch.end; ++i) {
    const Index face = target.tree.faces[static_cast<std::size_t>(i)];
    const auto corners = target.surface.faces.col(face);
    const Eigen::Vector3f a = target.particles.position(corners[0]), b = target.particles.position(corners[1]),
                          c = target.particles.position(corners[2]);
    const Eigen::Vector3f weights = nearest_barycentric(p, a, b, c);
    const float distance2 = (weights[0] * a + weights[1] * b + weights[2] * c - p).squaredNorm();
    if (distance2 > least2 || (distance2 == least2 && nearest.face >= 0 && face > nearest.face)) continue;
    const float side = side_of(face);
    if (side == 0) continue;
    least2 = distance2;
    nearest.face = face, nearest.side = side;
  }
}

/// The nearest face in the patches within `reach` of p to which `side_of` gives a side. The nearest patch comes first,
/// so that few others have to be looked into.
template <class SideOf>
PointTouch nearest_face(const Eigen::Vector3f& p, const SearchedSurface& target, const std::vector<Index>& patches,
                        float reach, const SideOf& side_of) {
  const Eigen::Array4f place(p.x(), p.y(), p.z(), 0);
  const auto distance2_of = [&](Index patch) {
    return target.tree.bounds[static_cast<std::size_t>(patch)].places.squared_distance(place);
  };
  Index first = patches.front();
  float first2 = distance2_of(first);
  for (const Index patch : patches)
    if (const float distance2 = distance2_of(patch); distance2 < first2) first2 = distance2, first = patch;
  PointTouch nearest{-1, -1, 0};
  float least2 = reach * reach;
  if (first2 > least2) return nearest;
  consider_patch(p, target, target.tree.nodes[static_cast<std::size_t>(first)], side_of, nearest, least2);
  for (const Index patch : patches)
    if (patch != first && distance2_of(patch) <= least2)
      consider_patch(p, target, target.tree.nodes[static_cast<std::size_t>(patch)], side_of, nearest, least2);
  return nearest;
}

/// Calls see(bounds) for the bounds of particles, which may change them, and touch(particle, patches) for every
/// particle that has patches of the target within reach; puts the touches with a face together.
template <class See, class Touch>
void search(const SearchedSurface& probe, const SearchedSurface& target, float reach, const See& see,
            const Touch& touch, std::vector<PointTouch>& found) {
  const PatchTree& tree = probe.tree;
  const auto count = static_cast<Index>(tree.bundle_offsets.size()) - 1;
  found =
      collect_in_order<PointTouch>(count, bundles_per_task, [&](Index begin, Index end, std::vector<PointTouch>& part) {
        std::vector<Index> near_bundle, near;
        for (auto bundle = static_cast<std::size_t>(begin); bundle < static_cast<std::size_t>(end); ++bundle) {
          const auto first = static_cast<std::size_t>(tree.bundle_offsets[bundle]),
                     last = static_cast<std::size_t>(tree.bundle_offsets[bundle + 1]);
          PatchTree::Bounds bounds;
          for (std::size_t patch = first; patch < last; ++patch) bounds = bounds.merged(tree.particle_bounds[patch]);
          near_bundle.clear();
          gather_patches(target.tree, see(bounds), reach, near_bundle);
          for (std::size_t patch = first; patch < last && !near_bundle.empty(); ++patch) {
            const PatchTree::Bounds own = see(tree.particle_bounds[patch]);
            near.clear();
            for (const Index node : near_bundle)
              if (may_meet(own, target.tree.bounds[static_cast<std::size_t>(node)], reach)) near.push_back(node);
            if (near.empty()) continue;
            for (Index i = tree.particle_offsets[patch]; i < tree.particle_offsets[patch + 1]; ++i) {
              const Index particle = tree.particles[static_cast<std::size_t>(i)];
              PointTouch nearest = touch(particle, near);
              nearest.particle = particle;
              if (nearest.face >= 0) part.push_back(nearest);
            }
          }
        }
      });
  std::sort(found.begin(), found.end(),
            [](const PointTouch& l, const PointTouch& r) { return l.particle < r.particle; });
}

}  // namespace

void find_near(const SearchedSurface& probe, const Eigen::Vector3f& shift, const SearchedSurface& target, float reach,
               std::vector<PointTouch>& found) {
  search(
      probe, target, reach,
      [&](PatchTree::Bounds bounds) {
        bounds.places.move(shift);
        bounds.normals.low.setConstant(-1), bounds.normals.high.setConstant(1);  // whichever way they face
        return bounds;
      },
      [&](Index particle, const std::vector<Index>& patches) {
        return nearest_face(probe.particles.position(particle) + shift, target, patches, reach,
                            [](Index) { return 1.0f; });
      },
      found);
}

void find_self(const SearchedSurface& surface, const SelfRule& rule, float reach, std::vector<PointTouch>& found) {
  const PatchTree& tree = surface.tree;
  search(
      surface, surface, reach, [](const PatchTree::Bounds& bounds) { return bounds; },
      [&](Index particle, const std::vector<Index>& patches) {
        return nearest_face(surface.particles.position(particle), surface, patches, reach, [&](Index face) {
          return tree.areas.col(face).dot(tree.outward.col(particle)) < 0 ? rule.side_when_facing(particle, face) : 0;
        });
      },
      found);
}

}  // namespace gracilis
