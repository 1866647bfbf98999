#include <gracilis/methods/xpbd/under_way.hpp>

#include <gracilis/core/state_hash.hpp>
#include <gracilis/methods/xpbd/prediction.hpp>
#include <gracilis/methods/xpbd/step.hpp>

#include <algorithm>
#include <chrono>

namespace gracilis::xpbd {

UnderWay under_way(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields,
                   const std::vector<Pose>& poses) {
  UnderWay u{prepare_muscle(scene, muscle, fields), {}, solve_settings(muscle.xpbd, muscle.xpbd.substeps), {}};
  u.settings.settling_rounds = 0;  // the middle of a solve is looked for, not its end
  u.state = make_muscle_state(u.muscle, scene.bodies.size());
  const auto time_step = static_cast<float>(u.settings.time_step);
  Pose before = poses.front();
  for (const Pose& pose : poses) {
    predict(u.muscle, 0, before, pose, time_step, u.state);
    u.placements = place_fields(u.muscle, pose);
    SolveSettings settings = u.settings;
    if (&pose == &poses.back()) settings.iterations = 3;
    solve_substep(u.muscle.system, u.placements, settings, u.state);
    if (muscle.xpbd.time_mode == TimeMode::dynamic) take_velocities(time_step, u.state);
    before = pose;
  }
  refresh_contacts(u.muscle.system, u.placements, u.state);
  return u;
}

PhaseTime time_projection(const UnderWay& muscle, std::optional<ConstraintKind> kind, int repeats) {
  constexpr int in_a_row = 10;
  PhaseTime time;
  std::vector<double> rows;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    SurfaceState state = muscle.state;
    SolveReport report;
    const auto project = [&](ConstraintKind each) {
      project_kind(each, muscle.muscle.system, muscle.placements, muscle.settings, state, report);
    };
    const auto started = std::chrono::steady_clock::now();
    for (int i = 0; i < in_a_row; ++i) {
      if (kind)
        project(*kind);
      else
        for (const ConstraintKind each : projection_order) project(each);
    }
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - started;
    rows.push_back(elapsed.count() / in_a_row);
    time.hash = hash_of(state.particles.xyzw);
  }
  std::nth_element(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(rows.size() / 2), rows.end());
  time.milliseconds = rows[rows.size() / 2];
  return time;
}

}  // namespace gracilis::xpbd
