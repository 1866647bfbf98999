#include <gracilis/dynamics/contact/surface/surface_mending.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/self/self_cuts.hpp>

#include <algorithm>
#include <span>

namespace gracilis {

namespace {

/// How far a particle goes at once to be mended, in neighborhoods (of some edges each).
constexpr float mended_within = 0.5f;
/// Where no more pairs of faces than these cut each other, as when a needle turns over, they go back to the shape that
/// they had at rest; a tangle of more is smoothed, so many times over. Fewer leave more of it, more take the surface so
/// far from its shape that it folds again in the next steps.
constexpr std::size_t few = 3;
constexpr int smoothing_rounds = 4;

/// The faces that may cut each other: where the surface is folded, and where parts of it meet.
std::vector<Index> suspects(const ContactSurface& surface, const PairTouches& touches, const Particles& particles) {
  std::vector<Index> faces;
  gather_folded(surface, particles, faces);
  for (const PointTouch& touch : touches.on_second) {
    const std::span<const Index> around = surface.fans.around(touch.particle);
    faces.insert(faces.end(), around.begin(), around.end());
    faces.push_back(touch.face);
  }
  for (const EdgeTouch& touch : touches.edges)
    for (const Index edge : {touch.first, touch.second})
      for (const Index face : surface.edges[static_cast<std::size_t>(edge)].faces)
        if (face >= 0) faces.push_back(face);
  return faces;
}

/// Whether a particle lies in another surface at rest.
bool overlaps_at_rest(const SurfaceCrowd& crowd, std::size_t surface, Index particle) {
  const auto lies_in = [&](const std::vector<char>& overlaps) {
    return !overlaps.empty() && overlaps[static_cast<std::size_t>(particle)] != 0;
  };
  return std::any_of(crowd.pairs.begin(), crowd.pairs.end(), [&](const SurfacePair& pair) {
    return (static_cast<std::size_t>(pair.first) == surface && lies_in(pair.first_overlaps)) ||
           (static_cast<std::size_t>(pair.second) == surface && lies_in(pair.second_overlaps));
  });
}

/// Those on the way out of another surface in which they lie at rest: what is still in and what is out already folds
/// between them. Contact lets go of it; it goes out later.
std::vector<FacePair> let_go_of_overlaps(const SurfaceCrowd& crowd, std::size_t surface, std::vector<FacePair> folds,
                                         std::vector<char>& torn) {
  std::erase_if(folds, [&](const FacePair& fold) {
    bool overlaps = false;
    for (const Index face : fold)
      for (const Index corner : crowd.surfaces[surface].faces.col(face))
        if (overlaps_at_rest(crowd, surface, corner)) torn[static_cast<std::size_t>(corner)] = 1, overlaps = true;
    return !overlaps;
  });
  return folds;
}

}  // namespace

bool mend_surfaces(const SurfaceCrowd& crowd, CrowdState& state, const std::vector<Particles*>& particles,
                   Movers& movers) {
  std::vector<char> mended(crowd.surfaces.size(), 0);
  parallel_for_each(crowd.pairs.size(), [&](std::size_t i) {
    const auto at = static_cast<std::size_t>(crowd.pairs[i].first);
    if (!crowd.pairs[i].is_self() || !movers.move(at)) return;
    const ContactSurface& surface = crowd.surfaces[at];
    std::vector<FacePair> cuts = find_self_cuts(surface, crowd.rest[at], state.before[at], *particles[at],
                                                suspects(surface, state.touches[i], *particles[at]));
    std::vector<FacePair> folds = find_folds(surface, crowd.rest[at], state.before[at], *particles[at]);
    const std::vector<FacePair> overlapping = let_go_of_overlaps(crowd, at, folds, state.torn[at]);
    if (!cuts.empty()) folds = overlapping;
    cuts.insert(cuts.end(), folds.begin(), folds.end());
    const float most = mended_within * crowd.neighborhood[at];
    if (cuts.size() <= few)
      unfold(surface, crowd.rest[at], cuts, most, *particles[at]);
    else
      smooth(surface, cuts, smoothing_rounds, most, *particles[at]);
    mended[at] = !cuts.empty();
  });
  movers.listed = std::move(mended);
  return std::any_of(movers.listed.begin(), movers.listed.end(), [](char each) { return each != 0; });
}

}  // namespace gracilis
