#include <gracilis/methods/xpbd/prediction.hpp>

#include <gracilis/methods/xpbd/contraction.hpp>
#include <gracilis/methods/xpbd/step.hpp>

namespace gracilis::xpbd {

SolveSettings solve_settings(const XpbdSettings& settings, int substeps) {
  SolveSettings solve;
  solve.iterations = settings.iterations;
  solve.settling_rounds = settings.settling_rounds;
  solve.time_step = settings.time_step / (settings.time_mode == TimeMode::dynamic ? substeps : settings.substeps);
  solve.projection.time_step =
      static_cast<float>(settings.constraint_time_step > 0 ? settings.constraint_time_step : solve.time_step);
  solve.projection.rayleigh_beta = static_cast<float>(settings.rayleigh_beta);
  solve.projection.dihedral_limit = static_cast<float>(settings.dihedral_limit);
  solve.projection.arccos_dihedrals = settings.dihedral_formula == DihedralFormula::arccos;
  solve.pressure = settings.pressure;
  solve.strain_limit = static_cast<float>(settings.stretch_limit);
  solve.shape_limits = shape_limits_of(settings);
  solve.stop_displacement = static_cast<float>(settings.stop_displacement);
  solve.stop_milliseconds = settings.stop_milliseconds / substeps;
  return solve;
}

/// x += dt v + dt² g, v the damped velocity (dynamic mode).
static void predict_inertially(const SolverSettings& settings, float time_step, SurfaceState& state) {
  for (Index p = 0; p < state.particles.count(); ++p) {
    if (!(state.particles.inverse_mass(p) > 0)) continue;
    Eigen::Map<Eigen::Vector3f> velocity = velocity_of(state, p);
    velocity = static_cast<float>(settings.damping) * velocity + time_step * settings.gravity.cast<float>();
    state.particles.position(p) += time_step * velocity;
  }
}

void carry(const PreparedMuscle& muscle, bool active, const Pose& before, const Pose& pose, MuscleState& state) {
  skin_free(muscle, before, pose, active, state);
  if (!muscle.predicted) return;
  move_attached(muscle, pose, state.particles);
  Points points = positions_of(state.particles).cast<Real>();
  const Vec3 origin = muscle.origin;
  muscle.predicted->bring_nearer(
      [&](Points& places) {
        places.colwise() += origin;
        muscle.predicted_bones.push_out(pose, places);
        places.colwise() -= origin;
      },
      points);
  for (Index p = 0; p < state.particles.count(); ++p)
    if (state.particles.inverse_mass(p) > 0) state.particles.position(p) = points.col(p).cast<float>();
}

void predict(const PreparedMuscle& muscle, Real activation, const Pose& before, const Pose& pose, float time_step,
             MuscleState& state) {
  const XpbdSettings& settings = muscle.settings;
  state.start = state.particles;
  const bool is_carried = settings.predictor != Predictor::none;
  if (is_carried)
    carry(muscle, contraction_strength(muscle.contraction, activation) > 0, before, pose, state);
  else
    follow_strings(muscle, pose, state);
  // Velocities are relative to the carried motion, so the predictor adds no momentum of its own.
  if (is_carried) state.start = state.particles;
  if (settings.time_mode == TimeMode::dynamic) predict_inertially(settings, time_step, state);
  move_attached(muscle, pose, state.particles);
  move_attached(muscle, pose, state.start);
  set_target_lengths(muscle, pose, state);
  set_contraction_lengths(muscle, activation, state.skinned.get(), state.tension_length);
}

}  // namespace gracilis::xpbd
