#include <gracilis/dynamics/contact/surface/untangling.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/self/unfolding.hpp>

#include <algorithm>
#include <span>

namespace gracilis {

namespace {

/// How far a particle goes at once to be untangled, in neighborhoods (of some edges each).
constexpr float untangled_within = 0.5f;
/// Where no more pairs of faces than these cut each other, as when a needle turns over, they go back to the shape that
/// they had at rest; a tangle of more is relaxed, so many times over. Fewer leave more of it, more take the surface so
/// far from its shape that it folds again in the next steps.
constexpr std::size_t few = 3;
constexpr int relaxing_rounds = 4;

/// The faces that may cut each other: where the surface is folded, and where parts of it meet.
std::vector<Index> suspects(const ContactSurface& surface, const PairCandidates& candidates,
                            const Particles& particles) {
  std::vector<Index> faces;
  gather_folded(surface, particles, faces);
  for (const VertexFaceCandidate& candidate : candidates.on_second) {
    const std::span<const Index> around = surface.vertex_faces.around(candidate.particle);
    faces.insert(faces.end(), around.begin(), around.end());
    faces.push_back(candidate.face);
  }
  for (const EdgeEdgeCandidate& candidate : candidates.edges)
    for (const Index edge : {candidate.first, candidate.second})
      for (const Index face : surface.edges[static_cast<std::size_t>(edge)].faces)
        if (face >= 0) faces.push_back(face);
  return faces;
}

/// Whether a particle that is among `near` (ascending) is behind the face that it is near to.
bool is_inside(const std::vector<VertexFaceCandidate>& near, Index particle) {
  const auto found =
      std::lower_bound(near.begin(), near.end(), particle,
                       [](const VertexFaceCandidate& each, Index wanted) { return each.particle < wanted; });
  return found != near.end() && found->particle == particle && found->distance < 0;
}

/// Whether a particle lay in another surface at rest and still does.
bool is_on_its_way_out(const ContactWorld& world, const ContactWorldState& state, std::size_t surface, Index particle) {
  const auto is_in = [&](const std::vector<char>& lay_in, const std::vector<VertexFaceCandidate>& near) {
    return !lay_in.empty() && lay_in[static_cast<std::size_t>(particle)] && is_inside(near, particle);
  };
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    const SurfacePair& pair = world.pairs[i];
    const PairCandidates& candidates = state.candidates[i];
    if (static_cast<std::size_t>(pair.first) == surface && is_in(pair.first_overlaps, candidates.near_second))
      return true;
    if (static_cast<std::size_t>(pair.second) == surface && is_in(pair.second_overlaps, candidates.near_first))
      return true;
  }
  return false;
}

/// Those on the way out of another surface in which they lay at rest: what is still in and what is out already folds
/// between them. Contact lets go of it; it goes out later.
std::vector<FacePair> let_go_of_overlaps(const ContactWorld& world, const ContactWorldState& state, std::size_t surface,
                                         std::vector<FacePair> folds, std::vector<char>& torn) {
  std::erase_if(folds, [&](const FacePair& fold) {
    bool overlaps = false;
    for (const Index face : fold)
      for (const Index corner : world.surfaces[surface].faces.col(face))
        if (is_on_its_way_out(world, state, surface, corner))
          torn[static_cast<std::size_t>(corner)] = 1, overlaps = true;
    return !overlaps;
  });
  return folds;
}

}  // namespace

bool untangle_surfaces(const ContactWorld& world, ContactWorldState& state, const std::vector<Particles*>& particles,
                       int attempt, Movers& movers) {
  std::vector<char> untangled(world.surfaces.size(), 0);
  parallel_for_each(world.pairs.size(), [&](std::size_t i) {
    const auto at = static_cast<std::size_t>(world.pairs[i].first);
    if (!world.pairs[i].is_self() || !movers.move(at)) return;
    const ContactSurface& surface = world.surfaces[at];
    std::vector<FacePair> cuts = find_self_intersections(surface, world.rest[at], state.before[at], *particles[at],
                                                         suspects(surface, state.candidates[i], *particles[at]));
    std::vector<FacePair> folds = find_folds(surface, world.rest[at], state.before[at], *particles[at]);
    const std::vector<FacePair> overlapping = let_go_of_overlaps(world, state, at, folds, state.torn[at]);
    if (!cuts.empty()) folds = overlapping;
    cuts.insert(cuts.end(), folds.begin(), folds.end());
    const float most = untangled_within * world.neighborhood[at];
    if (cuts.size() <= few)
      unfold(surface, world.rest[at], cuts, most, *particles[at]);
    else if (attempt == 0)
      smooth(surface, cuts, relaxing_rounds, most, *particles[at]);
    else
      restore_shape(surface, world.rest[at], cuts, relaxing_rounds, most, *particles[at]);
    untangled[at] = !cuts.empty();
  });
  movers.listed = std::move(untangled);
  return std::any_of(movers.listed.begin(), movers.listed.end(), [](char each) { return each != 0; });
}

}  // namespace gracilis
