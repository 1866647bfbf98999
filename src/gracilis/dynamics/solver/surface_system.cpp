#include <gracilis/dynamics/solver/surface_system.hpp>

#include <algorithm>

namespace gracilis {

SurfaceState make_state(const SurfaceSystem& system) {
  SurfaceState state;
  state.particles = system.rest;
  state.start = system.rest;
  state.velocities.assign(3 * static_cast<std::size_t>(system.rest.count()), 0);
  state.target_length = system.distances.rest_length;
  state.tension_length = system.tensions.rest_length;
  state.distance_lambda.assign(system.distances.a.size(), 0);
  state.tension_lambda.assign(system.tensions.a.size(), 0);
  state.dihedral_lambda.assign(system.dihedrals.rest_angle.size(), 0);
  state.volume = system.volume.target;
  state.near.resize(system.contacts.size());
  return state;
}

void reset_multipliers(SurfaceState& state) {
  std::fill(state.distance_lambda.begin(), state.distance_lambda.end(), 0.0f);
  std::fill(state.tension_lambda.begin(), state.tension_lambda.end(), 0.0f);
  std::fill(state.dihedral_lambda.begin(), state.dihedral_lambda.end(), 0.0f);
  state.volume_lambda = 0;
}

}  // namespace gracilis
