#include <gracilis/dynamics/contact/surface/surface_crowd.hpp>

#include <gracilis/dynamics/coloring.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace gracilis {

void arrange_rounds(SurfaceCrowd& crowd) {
  std::vector<std::array<Index, 2>> pairs;
  for (const SurfacePair& pair : crowd.pairs) pairs.push_back({pair.first, pair.second});
  crowd.rounds = rounds_of(pairs);
}

CrowdState make_crowd_state(const SurfaceCrowd& crowd) {
  CrowdState state;
  for (const Eigen::Matrix3Xf& rest : crowd.rest)
    state.before.push_back(make_particles(rest.cast<Real>(), Eigen::VectorXd::Zero(rest.cols())));
  for (std::size_t s = 0; s < crowd.surfaces.size(); ++s)
    state.trees.push_back(build_patch_tree(crowd.surfaces[s], crowd.rest[s]));
  state.normals = crowd.rest_normals;
  for (const Particles& particles : state.before)
    state.torn.emplace_back(static_cast<std::size_t>(particles.count()), 0);
  state.touches.resize(crowd.pairs.size());
  return state;
}

void remember_places(const std::vector<const Particles*>& particles, CrowdState& state) {
  for (std::size_t s = 0; s < particles.size(); ++s) {
    state.before[s] = *particles[s];
    std::fill(state.torn[s].begin(), state.torn[s].end(), 0);
  }
}

void begin_touch_frame(const SurfaceCrowd& crowd, CrowdState& state) {
  if (state.frames % crowd.settings.update_period == 0) forget_touches(state);
  ++state.frames;
}

void forget_touches(CrowdState& state) {
  for (PairTouches& touches : state.touches) touches.drift = std::numeric_limits<float>::infinity();
  state.frames = 0;
}

}  // namespace gracilis
