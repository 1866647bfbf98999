#include <gracilis/dynamics/contact/surface/vertex_face_search.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/mesh/bounds_lanes.hpp>

#include <algorithm>

namespace gracilis {

namespace {

constexpr Index bundles_searched_per_task = 16;

/// The nearest face of a patch to which `side_of` gives a side, if it is nearer than `least2` (m², squared). Ties go to
/// the lower face, so that the answer does not depend on the tree.
template <class SideOf>
void consider_patch(const Eigen::Vector3f& p, const PatchTree& tree, const PatchTree::Node& patch,
                    const SideOf& side_of, VertexFaceCandidate& nearest, float& least2) {
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

/// The nearest face within `reach` of p, in those of the patches that may face against `outward`, to which `side_of`
/// gives a side. The nearest patch comes first, so that few others have to be looked into. `patches` is workspace.
template <class SideOf>
VertexFaceCandidate nearest_face(const Eigen::Vector3f& p, const Eigen::Vector3f& outward, const PatchTree& tree,
                                 const BoundsLanes& bounds, float reach, const SideOf& side_of,
                                 std::vector<NearPatch>& patches) {
  find_near_patches(bounds, p, outward, reach, patches);
  const auto first = std::min_element(patches.begin(), patches.end(),
                                      [](const NearPatch& l, const NearPatch& r) { return l.distance2 < r.distance2; });
  VertexFaceCandidate nearest{-1, -1, 0};
  float least2 = reach * reach;
  if (first == patches.end()) return nearest;
  std::swap(*first, patches.front());
  for (const NearPatch& patch : patches)
    if (patch.distance2 <= least2)
      consider_patch(p, tree, tree.nodes[static_cast<std::size_t>(patch.node)], side_of, nearest, least2);
  return nearest;
}

/// Calls find(particle, p, bounds, workspace) for every particle that has patches of the target within reach, p in the
/// target's coordinates, with the bounds of those around it; puts the candidates with a face together. see(bounds)
/// turns bounds of particles into what the target sees.
template <class See, class Find>
void search(const SearchedSurface& probe, const Eigen::Vector3f& shift, const SearchedSurface& target, float reach,
            const See& see, const Find& find, std::vector<VertexFaceCandidate>& found) {
  const PatchTree& tree = probe.tree;
  const auto count = static_cast<Index>(tree.particle_bounds.size());
  found = collect_in_order<VertexFaceCandidate>(
      count, bundles_searched_per_task, [&](Index begin, Index end, std::vector<VertexFaceCandidate>& part) {
        std::vector<Index> patches;
        BoundsLanes of_task, of_bundle;
        std::vector<NearPatch> workspace;
        PatchTree::Bounds all;
        for (auto bundle = static_cast<std::size_t>(begin); bundle < static_cast<std::size_t>(end); ++bundle)
          all = all.merged(tree.particle_bounds[bundle]);
        gather_patches(target.tree, see(all), reach, patches);
        if (patches.empty()) return;  // most of two surfaces is nowhere near the other
        of_task.load(target.tree, patches);
        for (auto bundle = static_cast<std::size_t>(begin); bundle < static_cast<std::size_t>(end); ++bundle) {
          find_meeting_patches(of_task, see(tree.particle_bounds[bundle]), reach, patches);
          if (patches.empty()) continue;
          of_bundle.load(target.tree, patches);
          for (const Index particle : tree.particles_of(bundle)) {
            const Eigen::Vector3f p = probe.particles.position(particle) + shift;
            VertexFaceCandidate nearest = find(particle, p, of_bundle, workspace);
            if (nearest.face < 0) continue;
            nearest.particle = particle;
            note_nearest(p, nearest_on_face(p, target.surface, nearest.face, target.particles), target.surface,
                         target.particles, nearest);
            part.push_back(nearest);
          }
        }
      });
  std::sort(found.begin(), found.end(),
            [](const VertexFaceCandidate& l, const VertexFaceCandidate& r) { return l.particle < r.particle; });
}

}  // namespace

void find_near(const SearchedSurface& probe, const Eigen::Vector3f& shift, const SearchedSurface& target, float reach,
               const ExitSide& exit, std::vector<VertexFaceCandidate>& found) {
  search(
      probe, shift, target, reach,
      [&](PatchTree::Bounds bounds) {
        bounds.places.move(shift);
        bounds.normals.low.setConstant(-1), bounds.normals.high.setConstant(1);  // whichever way they face
        return bounds;
      },
      [&](Index particle, const Eigen::Vector3f& p, const BoundsLanes& bounds, std::vector<NearPatch>& workspace) {
        const Eigen::Vector3f any_side = Eigen::Vector3f::Zero();
        VertexFaceCandidate nearest = nearest_face(
            p, any_side, target.tree, bounds, reach, [](Index) { return 1.0f; }, workspace);
        if (nearest.face < 0 || !exit.is_told(particle)) return nearest;
        if (point_gap(p, target.surface, nearest.face, target.particles, target.tree.outward).distance >= 0)
          return nearest;  // it has come out
        const auto side_of = [&](Index face) { return exit.is_exit(particle, face) ? 1.0f : 0.0f; };
        const VertexFaceCandidate out = nearest_face(p, any_side, target.tree, bounds, reach, side_of, workspace);
        return out.face < 0 ? nearest : out;
      },
      found);
}

void find_near(const SearchedSurface& probe, const Eigen::Vector3f& shift, const SearchedSurface& target, float reach,
               std::vector<VertexFaceCandidate>& found) {
  find_near(probe, shift, target, reach, ExitSide{target.surface, {}, {}}, found);
}

void find_self(const SearchedSurface& surface, const SelfRule& rule, float reach,
               std::vector<VertexFaceCandidate>& found) {
  const PatchTree& tree = surface.tree;
  search(
      surface, Eigen::Vector3f::Zero(), surface, reach, [](const PatchTree::Bounds& bounds) { return bounds; },
      [&](Index particle, const Eigen::Vector3f& p, const BoundsLanes& bounds, std::vector<NearPatch>& workspace) {
        const Eigen::Vector3f outward = tree.outward.col(particle);
        const auto side_of = [&](Index face) {
          return tree.areas.col(face).dot(outward) < 0 ? rule.side_when_facing(particle, face) : 0;
        };
        return nearest_face(p, outward, tree, bounds, reach, side_of, workspace);
      },
      found);
}

}  // namespace gracilis
