#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/self_cuts.hpp>
#include <gracilis/dynamics/surface_contact.hpp>

#include <algorithm>

/// What a surface does about cutting itself: the mending behind surface_contact.hpp.
namespace gracilis {

namespace {

/// How far a particle goes at once to be mended, in neighborhoods (of some edges each).
constexpr float mended_within = 0.5f;

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

}  // namespace

bool mend_self_cuts(const SurfaceCrowd& crowd, const CrowdState& state, int attempt,
                    const std::vector<Particles*>& particles, Movers& movers) {
  std::vector<char> mended(crowd.surfaces.size(), 0);
  parallel_for_each(crowd.pairs.size(), [&](std::size_t i) {
    const auto at = static_cast<std::size_t>(crowd.pairs[i].first);
    if (!crowd.pairs[i].is_self() || !movers.move(at)) return;
    const ContactSurface& surface = crowd.surfaces[at];
    const std::vector<FacePair> cuts = find_self_cuts(surface, crowd.rest[at], state.before[at], *particles[at],
                                                      suspects(surface, state.touches[i], *particles[at]));
    const float most = mended_within * crowd.neighborhood[at];
    if (attempt % 2 == 0)
      unfold(surface, crowd.rest[at], cuts, most, *particles[at]);
    else
      smooth(surface, cuts, attempt + 1, most, *particles[at]);
    mended[at] = !cuts.empty();
  });
  movers.listed = std::move(mended);
  return std::any_of(movers.listed.begin(), movers.listed.end(), [](char each) { return each != 0; });
}

}  // namespace gracilis
