#include <gracilis/dynamics/contact/surface/contact_world.hpp>

#include <gracilis/dynamics/coloring.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace gracilis {

void arrange_rounds(ContactWorld& world) {
  std::vector<std::array<Index, 2>> pairs;
  for (const SurfacePair& pair : world.pairs) pairs.push_back({pair.first, pair.second});
  world.rounds = rounds_of(pairs);
}

ContactWorldState make_contact_state(const ContactWorld& world) {
  ContactWorldState state;
  for (const Eigen::Matrix3Xf& rest : world.rest)
    state.before.push_back(make_particles(rest.cast<Real>(), Eigen::VectorXd::Zero(rest.cols())));
  for (std::size_t s = 0; s < world.surfaces.size(); ++s)
    state.trees.push_back(build_patch_tree(world.surfaces[s], world.rest[s]));
  state.normals = world.rest_normals;
  for (const Particles& particles : state.before)
    state.torn.emplace_back(static_cast<std::size_t>(particles.count()), 0);
  state.candidates.resize(world.pairs.size());
  return state;
}

void remember_places(const std::vector<const Particles*>& particles, ContactWorldState& state) {
  for (std::size_t s = 0; s < particles.size(); ++s) {
    state.before[s] = *particles[s];
    std::fill(state.torn[s].begin(), state.torn[s].end(), 0);
  }
}

void begin_contact_frame(const ContactWorld& world, ContactWorldState& state) {
  if (state.frames % world.settings.update_period == 0) forget_candidates(state);
  ++state.frames;
}

void forget_candidates(ContactWorldState& state) {
  for (PairCandidates& candidates : state.candidates) candidates.drift = std::numeric_limits<float>::infinity();
  state.frames = 0;
}

}  // namespace gracilis
