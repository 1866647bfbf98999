#include <gracilis/methods/xpbd/mid_solve_snapshot.hpp>

#include <gracilis/core/state_hash.hpp>
#include <gracilis/dynamics/solver/bone_contact.hpp>
#include <gracilis/dynamics/solver/solver.hpp>
#include <gracilis/methods/xpbd/prediction.hpp>
#include <gracilis/methods/xpbd/step.hpp>
#include <gracilis/strings/bone_distances.hpp>

#include <algorithm>
#include <chrono>

namespace gracilis::xpbd {

MidSolveSnapshot mid_solve_snapshot(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields,
                                    const std::vector<Pose>& poses, const CarryingStrings& carrying) {
  MidSolveSnapshot u{prepare_muscle(scene, muscle, fields, carrying), {}, {}, {}};
  SolverSettings& asked = u.muscle.settings;
  if (!(asked.time_step > 0)) asked.time_step = usual_time_step;
  u.settings = solve_settings(u.muscle.settings, asked.substeps);
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
    if (asked.time_mode == TimeMode::dynamic) take_velocities(time_step, u.state);
    before = pose;
  }
  refresh_contacts(u.muscle.system, u.placements, u.state);
  return u;
}

PhaseTime time_projection(const MidSolveSnapshot& muscle, std::optional<ConstraintKind> kind, int repeats) {
  constexpr int in_a_row = 10;
  PhaseTime time;
  std::vector<double> rows;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    SurfaceState state = muscle.state;
    SurfaceSolve surface{&muscle.muscle.system, &muscle.placements, muscle.settings, &state, {}};
    const auto started = std::chrono::steady_clock::now();
    for (int i = 0; i < in_a_row; ++i) {
      if (kind)
        project_kind(*kind, surface);
      else
        for (const ConstraintRow& row : constraint_table()) project_kind(row.kind, surface);
    }
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - started;
    rows.push_back(elapsed.count() / in_a_row);
    time.hash = hash_of(state.particles.xyzw);
  }
  std::nth_element(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(rows.size() / 2), rows.end());
  time.milliseconds = rows[rows.size() / 2];
  return time;
}

namespace {

struct Phase {
  std::string_view name;
  std::optional<ConstraintKind> kind;  ///< none: all
};

constexpr Phase phases_of_iteration[] = {{"iteration", std::nullopt},
                                         {"distance", ConstraintKind::distance},
                                         {"dihedral", ConstraintKind::dihedral},
                                         {"volume", ConstraintKind::volume},
                                         {"stretch_limit", ConstraintKind::strain_limit},
                                         {"bone_contact", ConstraintKind::bone_contact}};

class MidSolveTimer final : public PhaseTimer {
 public:
  MidSolveTimer(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields,
                const std::vector<DistanceField>& far_fields, const std::vector<Pose>& poses)
      : bones_(strings::bone_distances(scene, far_fields)),
        muscle_(mid_solve_snapshot(scene, muscle, fields, poses, carrying_strings(scene, muscle, bones_))) {}
  Index triangles() const override { return static_cast<Index>(muscle_.muscle.faces.cols()); }
  std::vector<std::string_view> phases() const override {
    std::vector<std::string_view> names;
    for (const Phase& phase : phases_of_iteration) names.push_back(phase.name);
    return names;
  }
  PhaseTime time(std::size_t phase, int repeats) const override {
    return time_projection(muscle_, phases_of_iteration[phase].kind, repeats);
  }

 private:
  strings::BoneDistances bones_;
  MidSolveSnapshot muscle_;
};

}  // namespace

std::unique_ptr<PhaseTimer> phase_timer(const Scene& scene, const Muscle& muscle,
                                        const std::vector<DistanceField>& fields,
                                        const std::vector<DistanceField>& far_fields, const std::vector<Pose>& poses) {
  return std::make_unique<MidSolveTimer>(scene, muscle, fields, far_fields, poses);
}

}  // namespace gracilis::xpbd
