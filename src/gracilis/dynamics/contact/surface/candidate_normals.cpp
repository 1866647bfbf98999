#include <gracilis/dynamics/contact/surface/candidate_normals.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/mesh/particle_normals.hpp>

namespace gracilis {

NormalMaker::NormalMaker(const ContactWorld& world, const std::vector<const Particles*>& particles,
                         ContactWorldState& state)
    : world_(world), particles_(particles), state_(state), asked_(particles.size()), listed_(particles.size()) {
  for (std::size_t s = 0; s < particles.size(); ++s)
    asked_[s].resize(static_cast<std::size_t>(particles[s]->count()), 0);
}

void NormalMaker::ask(std::size_t surface, Index particle) {
  char& asked = asked_[surface][static_cast<std::size_t>(particle)];
  if (!asked) listed_[surface].push_back(particle);
  asked = 1;
}

void NormalMaker::ask_corners(std::size_t surface, const VertexFaceCandidate& candidate) {
  for (const Index corner : world_.surfaces[surface].faces.col(candidate.face)) ask(surface, corner);
}

void NormalMaker::ask_ends(std::size_t surface, Index edge) {
  for (const Index end : world_.surfaces[surface].edges[static_cast<std::size_t>(edge)].ends) ask(surface, end);
}

void NormalMaker::make() {
  parallel_for_each(listed_.size(), [&](std::size_t s) {
    particle_normals(world_.surfaces[s], *particles_[s], listed_[s], state_.normals[s]);
    listed_[s].clear();
  });
}

void ask_to_tell_sides(const ContactWorld& world, const ContactWorldState& state, NormalMaker& normals) {
  const auto ask = [&](std::size_t target, const std::vector<VertexFaceCandidate>& near) {
    for (const VertexFaceCandidate& candidate : near)
      if (!(candidate.barycentric.minCoeff() > 0)) normals.ask_corners(target, candidate);
  };
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    if (state.candidates[i].is_calm) continue;
    ask(static_cast<std::size_t>(world.pairs[i].second), state.candidates[i].near_second);
    ask(static_cast<std::size_t>(world.pairs[i].first), state.candidates[i].near_first);
  }
}

void ask_to_project(const ContactWorld& world, const ContactWorldState& state, NormalMaker& normals) {
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    if (state.candidates[i].is_calm) continue;
    const auto first = static_cast<std::size_t>(world.pairs[i].first),
               second = static_cast<std::size_t>(world.pairs[i].second);
    for (const VertexFaceCandidate& candidate : state.candidates[i].on_second) normals.ask_corners(second, candidate);
    for (const VertexFaceCandidate& candidate : state.candidates[i].on_first) normals.ask_corners(first, candidate);
    for (const EdgeEdgeCandidate& candidate : state.candidates[i].edges) {
      normals.ask_ends(first, candidate.first);
      normals.ask_ends(second, candidate.second);
    }
  }
}

}  // namespace gracilis
