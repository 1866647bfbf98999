#include <gracilis/dynamics/contact/surface/touch_normals.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/mesh/particle_normals.hpp>

namespace gracilis {

NormalMaker::NormalMaker(const SurfaceCrowd& crowd, const std::vector<const Particles*>& particles, CrowdState& state)
    : crowd_(crowd), particles_(particles), state_(state), asked_(particles.size()), listed_(particles.size()) {
  for (std::size_t s = 0; s < particles.size(); ++s)
    asked_[s].resize(static_cast<std::size_t>(particles[s]->count()), 0);
}

void NormalMaker::ask(std::size_t surface, Index particle) {
  char& asked = asked_[surface][static_cast<std::size_t>(particle)];
  if (!asked) listed_[surface].push_back(particle);
  asked = 1;
}

void NormalMaker::ask_corners(std::size_t surface, const PointTouch& touch) {
  for (const Index corner : crowd_.surfaces[surface].faces.col(touch.face)) ask(surface, corner);
}

void NormalMaker::ask_ends(std::size_t surface, Index edge) {
  for (const Index end : crowd_.surfaces[surface].edges[static_cast<std::size_t>(edge)].ends) ask(surface, end);
}

void NormalMaker::make() {
  parallel_for_each(listed_.size(), [&](std::size_t s) {
    particle_normals(crowd_.surfaces[s], *particles_[s], listed_[s], state_.normals[s]);
    listed_[s].clear();
  });
}

void ask_to_tell_sides(const SurfaceCrowd& crowd, const CrowdState& state, NormalMaker& normals) {
  const auto ask = [&](std::size_t target, const std::vector<PointTouch>& near) {
    for (const PointTouch& touch : near)
      if (!(touch.barycentric.minCoeff() > 0)) normals.ask_corners(target, touch);
  };
  for (std::size_t i = 0; i < crowd.pairs.size(); ++i) {
    if (state.touches[i].is_calm) continue;
    ask(static_cast<std::size_t>(crowd.pairs[i].second), state.touches[i].near_second);
    ask(static_cast<std::size_t>(crowd.pairs[i].first), state.touches[i].near_first);
  }
}

void ask_to_project(const SurfaceCrowd& crowd, const CrowdState& state, NormalMaker& normals) {
  for (std::size_t i = 0; i < crowd.pairs.size(); ++i) {
    if (state.touches[i].is_calm) continue;
    const auto first = static_cast<std::size_t>(crowd.pairs[i].first),
               second = static_cast<std::size_t>(crowd.pairs[i].second);
    for (const PointTouch& touch : state.touches[i].on_second) normals.ask_corners(second, touch);
    for (const PointTouch& touch : state.touches[i].on_first) normals.ask_corners(first, touch);
    for (const EdgeTouch& touch : state.touches[i].edges) {
      normals.ask_ends(first, touch.first);
      normals.ask_ends(second, touch.second);
    }
  }
}

}  // namespace gracilis
