#include <gracilis/dynamics/touch_search.hpp>

#include <gracilis/core/parallel.hpp>

#include <algorithm>

namespace gracilis {

namespace {

constexpr Index bundles_per_task = 16;

/// The nearest face of a patch to which `side_of` gives a side, if it is nearer than `least2` (m², squared). Ties go to
/// the lower face, so that the answer does not depend on the tree.
template <class SideOf>
void consider_patch(const Eigen::Vector3f& p, const PatchTree& tree, const PatchTree::Node& patch,
                    const SideOf& side_of, PointTouch& nearest, float& least2) {
  const TrianglePack::Lanes distances2 = tree.triangles[static_cast<std::size_t>(patch.patch)].squared_distances(p);
  if (distances2.minCoeff() > least2) return;
  for (Index i = patch.begin; i < patch.end; ++i) {
    const Index face = tree.faces[static_cast<std::size_t>(i)];
    const float distance2 = distances2[i - patch.begin];
    if (distance2 > least2 || (distance2 == least2 && nearest.face >= 0 && face > nearest.face)) continue;
    const float side = side_of(face);
    if (side == 0) continue;
    least2 = distance2;
    nearest.face = face, nearest.side = side;
  }
}

/// The nearest face in the patches within `reach` of p to which `side_of` gives a side. The nearest patch comes first,
/// so that few others have to be looked into, and none whose bounds `may_face` refuses. `distances2` is workspace.
template <class SideOf, class MayFace>
PointTouch nearest_face(const Eigen::Vector3f& p, const PatchTree& tree, const std::vector<Index>& patches, float reach,
                        const SideOf& side_of, const MayFace& may_face, std::vector<float>& distances2) {
  const Eigen::Array4f place(p.x(), p.y(), p.z(), 0);
  distances2.resize(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const PatchTree::Bounds& bounds = tree.bounds[static_cast<std::size_t>(patches[i])];
    distances2[i] = may_face(bounds) ? bounds.places.squared_distance(place) : PatchTree::infinity;
  }
  const auto first = std::min_element(distances2.begin(), distances2.end());
  PointTouch nearest{-1, -1, 0};
  float least2 = reach * reach;
  if (*first > least2) return nearest;
  const auto consider = [&](std::size_t i) {
    consider_patch(p, tree, tree.nodes[static_cast<std::size_t>(patches[i])], side_of, nearest, least2);
  };
  const auto begin = static_cast<std::size_t>(first - distances2.begin());
  consider(begin);
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (i != begin && distances2[i] <= least2) consider(i);
  return nearest;
}

/// Calls see(bounds) for the bounds of particles, which may change them, and touch(particle, patches, workspace) for
/// every particle that has patches of the target within reach; puts the touches with a face together.
template <class See, class Touch>
void search(const SearchedSurface& probe, const SearchedSurface& target, float reach, const See& see,
            const Touch& touch, std::vector<PointTouch>& found) {
  const PatchTree& tree = probe.tree;
  const auto count = static_cast<Index>(tree.bundle_offsets.size()) - 1;
  found =
      collect_in_order<PointTouch>(count, bundles_per_task, [&](Index begin, Index end, std::vector<PointTouch>& part) {
        std::vector<Index> near_bundle, near;
        std::vector<float> workspace;
        const auto bounds_of = [&](std::size_t first, std::size_t last) {
          PatchTree::Bounds bounds;
          for (std::size_t patch = first; patch < last; ++patch) bounds = bounds.merged(tree.particle_bounds[patch]);
          return see(bounds);
        };
        const auto patch_of = [&](Index bundle) {
          return static_cast<std::size_t>(tree.bundle_offsets[static_cast<std::size_t>(bundle)]);
        };
        // Most of two surfaces is nowhere near the other.
        if (!meets_any_patch(target.tree, bounds_of(patch_of(begin), patch_of(end)), reach)) return;
        for (Index bundle = begin; bundle < end; ++bundle) {
          const std::size_t first = patch_of(bundle), last = patch_of(bundle + 1);
          near_bundle.clear();
          gather_patches(target.tree, bounds_of(first, last), reach, near_bundle);
          for (std::size_t patch = first; patch < last && !near_bundle.empty(); ++patch) {
            const PatchTree::Bounds own = see(tree.particle_bounds[patch]);
            near.clear();
            for (const Index node : near_bundle)
              if (may_meet(own, target.tree.bounds[static_cast<std::size_t>(node)], reach)) near.push_back(node);
            if (near.empty()) continue;
            for (Index i = tree.particle_offsets[patch]; i < tree.particle_offsets[patch + 1]; ++i) {
              const Index particle = tree.particles[static_cast<std::size_t>(i)];
              PointTouch nearest = touch(particle, near, workspace);
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
      [&](Index particle, const std::vector<Index>& patches, std::vector<float>& workspace) {
        return nearest_face(
            probe.particles.position(particle) + shift, target.tree, patches, reach, [](Index) { return 1.0f; },
            [](const PatchTree::Bounds&) { return true; }, workspace);
      },
      found);
}

void find_self(const SearchedSurface& surface, const SelfRule& rule, float reach, std::vector<PointTouch>& found) {
  const PatchTree& tree = surface.tree;
  search(
      surface, surface, reach, [](const PatchTree::Bounds& bounds) { return bounds; },
      [&](Index particle, const std::vector<Index>& patches, std::vector<float>& workspace) {
        const auto side_of = [&](Index face) {
          return tree.areas.col(face).dot(tree.outward.col(particle)) < 0 ? rule.side_when_facing(particle, face) : 0;
        };
        const Eigen::Vector3f outward = tree.outward.col(particle);
        const Eigen::Array4f along(outward.x(), outward.y(), outward.z(), 0);
        // Whether any normal of a patch may point against the particle's.
        const auto may_face = [&](const PatchTree::Bounds& bounds) {
          return (along * bounds.normals.low).min(along * bounds.normals.high).sum() <= 0;
        };
        return nearest_face(surface.particles.position(particle), tree, patches, reach, side_of, may_face, workspace);
      },
      found);
}

}  // namespace gracilis
