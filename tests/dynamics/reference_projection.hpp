#pragma once

#include "systems_for_tests.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

/// XPBD written plainly in double precision, one constraint after the other, with gradients by finite differences: what
/// the vectorised projections are compared with.
namespace gracilis::reference {

struct State {
  Points x, start;
  Eigen::VectorXd inverse_masses;
  std::vector<Real> lambda;  ///< per slot
};

inline State state_of(const Particles& particles, const Particles& start, const AlignedVector<float>& lambda) {
  State state;
  state.x.resize(3, particles.count());
  state.start.resize(3, particles.count());
  state.inverse_masses.resize(particles.count());
  for (Index i = 0; i < particles.count(); ++i) {
    state.x.col(i) = particles.position(i).cast<Real>();
    state.start.col(i) = start.position(i).cast<Real>();
    state.inverse_masses[i] = particles.inverse_mass(i);
  }
  state.lambda.assign(lambda.begin(), lambda.end());
  return state;
}

using Value = std::function<Real(const std::vector<Vec3>&)>;

/// One constraint on `members` with value `c` and compliance `alpha`; `motion_limit` (m) holds a projection back.
inline void project(State& state, const std::vector<Index>& members, const Value& value, Real c, Real compliance,
                    Real& lambda, const ProjectionParameters& parameters, Real motion_limit) {
  std::vector<Vec3> x, gradient(members.size());
  for (Index i : members) x.push_back(state.x.col(i));
  constexpr Real step = 1e-7;
  for (std::size_t k = 0; k < members.size(); ++k)
    for (int axis = 0; axis < 3; ++axis) {
      const Real there = x[k][axis];
      x[k][axis] = there + step;
      const Real above = value(x);
      x[k][axis] = there - step;
      gradient[k][axis] = (above - value(x)) / (2 * step);
      x[k][axis] = there;
    }
  const Real dt = parameters.time_step, alpha = compliance / (dt * dt);
  const Real gamma = alpha * dt * parameters.rayleigh_beta;
  Real weight = 0, motion = 0, reach = 0;
  for (std::size_t k = 0; k < members.size(); ++k) {
    const Real w = state.inverse_masses[members[k]];
    weight += w * gradient[k].squaredNorm();
    motion += gradient[k].dot(state.x.col(members[k]) - state.start.col(members[k]));
    reach = std::max(reach, w * gradient[k].norm());
  }
  if (!(weight > 0)) return;
  Real step_size = (-c - alpha * lambda - gamma * motion) / ((1 + gamma) * weight + alpha);
  if (motion_limit > 0 && std::abs(step_size) * reach > motion_limit)
    step_size = std::copysign(motion_limit / reach, step_size);
  lambda += step_size;
  for (std::size_t k = 0; k < members.size(); ++k)
    state.x.col(members[k]) += state.inverse_masses[members[k]] * step_size * gradient[k];
}

inline void project_distances(const DistanceSet& set, const AlignedVector<float>& target, State& state,
                              const ProjectionParameters& parameters) {
  std::vector<Index> slots = set.slot;
  std::sort(slots.begin(), slots.end());
  const Value length = [](const std::vector<Vec3>& x) { return (x[1] - x[0]).norm(); };
  for (Index slot : slots) {
    const auto at = static_cast<std::size_t>(slot);
    const Real c = (state.x.col(set.b[at]) - state.x.col(set.a[at])).norm() - target[at];
    project(state, {set.a[at], set.b[at]}, length, c, set.compliance[at], state.lambda[at], parameters, 0);
  }
}

inline void project_dihedrals(const DihedralSet& set, State& state, const ProjectionParameters& parameters) {
  for (Index slot : slots_of(set)) {
    const auto at = static_cast<std::size_t>(slot);
    const std::vector<Index> members = {set.particles[0][at], set.particles[1][at], set.particles[2][at],
                                        set.particles[3][at]};
    const auto& x = state.x;
    const Real here = dihedral_angle(x.col(members[0]), x.col(members[1]), x.col(members[2]), x.col(members[3]));
    // Measured from where it is now, so that a difference never meets the jump at half a turn.
    const Value turned = [here](const std::vector<Vec3>& p) {
      return std::remainder(dihedral_angle(p[0], p[1], p[2], p[3]) - here, 2 * pi);
    };
    const Real c = std::remainder(here - set.rest_angle[at], 2 * pi);
    project(state, members, turned, c, set.compliance[at], state.lambda[at], parameters,
            parameters.dihedral_limit * static_cast<Real>(set.edge_length[at]));
  }
}

}  // namespace gracilis::reference
