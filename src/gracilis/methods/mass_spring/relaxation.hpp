#pragma once

#include <gracilis/methods/mass_spring/settings.hpp>
#include <gracilis/methods/mass_spring/spring_net.hpp>

#include <functional>
#include <vector>

/// How the particles of all muscles of a scene are moved by their springs (Janák 2012, sections 2.3 and 5.3).
namespace gracilis::mass_spring {

/// Particles at two instants, one time step apart: velocities are in their difference.
struct Motion {
  Points now;     ///< 3 × n, m
  Points before;  ///< the same
};

/// kg/s: \f$\sqrt{4 k m}\f$, by which one particle on a spring comes to rest soonest without overshooting (eq. 2.10).
Real critical_damping(Real stiffness, Real mass);

/// kg/s: \f$\sqrt{4 k_6 2m}\f$, \f$k_6 = 2 + 4/k_a\f$, k_a the mean stiffness (eq. 2.11). A rule fitted to particles on
/// six springs, which holds for numbers in N/m and kg only.
Real fitted_damping(Real mean_stiffness, Real mass);

/// Of the settings' rule, kg/s.
Real damping_of(const MassSpringSettings& settings, const SpringNet& net);

/// One step of eq. 2.14: \f$x(t + dt) = \frac{F}{m} dt^2 + 2 x(t) - x(t - dt)\f$, F less \f$c (x(t) - x(t-dt)) / dt\f$.
/// The last motion is taken as it is where its step had another length, as published. Not published: damping takes at
/// most all of a velocity, since c dt > 2 m would turn it round and let it grow. Fixed particles (1) stay.
void verlet_step(const Points& forces, Real mass, Real damping, Real step, const std::vector<char>& fixed,
                 Motion& motion);

/// The largest dt (s) with \f$F dt^2 + c d dt + m (d - r) \le 0\f$ (eq. 5.1 with the sign of the damping c that makes
/// the bound on a particle's motion larger): then it moves by at most its radius r (m). `force` F in N, `moved` d =
/// |x(t) - x(t - dt)| in m. 0 where it has moved by its radius or more; infinite where nothing
/// moves it.
Real longest_step(Real force, Real moved, Real radius, Real mass, Real damping);

/// One muscle among those that are moved together.
struct RelaxedMuscle {
  const SpringNet* net = nullptr;
  const std::vector<char>* fixed = nullptr;
  const std::vector<Real>* radii = nullptr;  ///< m, per particle; 0: no sphere
  Real mass = 1;                             ///< kg, of a particle
  Real damping = 0;                          ///< kg/s
  Motion motion = {};
  Real displacement = 0;  ///< m, mean over particles in the last iteration
};

/// When to stop and how long steps are.
struct RelaxationRule {
  int iterations = 100;
  Real stop_displacement = 0;  ///< m, mean over the particles of all muscles; 0: off
  Real stop_milliseconds = 0;  ///< 0: off
  Real step = 0.4;             ///< s
  Real smallest_step = 0;      ///< s; above 0 steps are adaptive, the same for all muscles
};
/// What of the settings is shared by all muscles.
RelaxationRule relaxation_rule(const MassSpringSettings& settings);

/// What happened.
struct Relaxation {
  int iterations = 0;
  Real mean_step = 0;  ///< s
};

/// Moves all particles, iteration after iteration; after each `collide` may move them further. Ends early where a
/// coordinate is not finite.
Relaxation relax(std::vector<RelaxedMuscle>& muscles, const RelaxationRule& rule, const std::function<void()>& collide);

}  // namespace gracilis::mass_spring
