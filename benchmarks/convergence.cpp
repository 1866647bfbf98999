#include <gracilis/core/parallel.hpp>
#include <gracilis/core/state_hash.hpp>
#include <gracilis/dynamics/contact/field/field_contact_listing.hpp>
#include <gracilis/dynamics/solver/bone_contact.hpp>
#include <gracilis/dynamics/solver/constraint_table.hpp>
#include <gracilis/dynamics/solver/solver.hpp>
#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/methods/xpbd/prediction.hpp>
#include <gracilis/methods/xpbd/xpbd_method.hpp>
#include <gracilis/view/charts/line_chart.hpp>

#include "acceleration.hpp"
#include "benchmark_hip.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ctime>

/// How near to the converged shape one frame comes in how much processor time, muscle by muscle: one degree of flexion
/// from 44 to 45 on one thread, each muscle alone, bones included. The reference is the same step after 3000 plain
/// iterations; the error is the mean distance of its vertices. Writes a table to stdout and a chart per muscle into the
/// folder given.
namespace gracilis {
namespace {

struct Sample {
  int count = 0;  ///< iterations or substeps
  Real milliseconds = 0, error = 0;
  std::uint64_t hash = 0;
};

struct Curve {
  std::string name;
  std::vector<Sample> samples;
};

/// One muscle's step: the frames before it and its pose.
struct Step {
  Scene scene;              ///< with this muscle alone, without settling rounds
  std::vector<Pose> poses;  ///< of all frames up to the last
  Frame before, last;
  Pose pose;
  Points reference;
};

constexpr int reference_iterations = 3000;
constexpr int looked_at[] = {1, 2, 4, 8, 15, 30, 60, 120, 240};

/// Of this process, ms: on one thread other programs disturb it less than a clock on the wall.
Real processor_time() { return 1000 * static_cast<Real>(std::clock()) / CLOCKS_PER_SEC; }

Real error_of(const Points& shape, const Points& reference) {
  return 1000 * (shape - reference).colwise().norm().mean();
}

Step step_of(std::size_t muscle) {
  Step step{benchmark_hip().scene, {}, {}, {}, benchmark_hip().flexed(radians(45)), {}};
  step.scene.muscles = {benchmark_hip().scene.muscles[muscle]};
  step.scene.method.contact["muscle"] = "none";
  step.scene.method.settings["settling_rounds"] = 0;
  const auto method = make_xpbd_method(step.scene, benchmark_hip().fields, benchmark_hip().far_fields);
  step.poses = {benchmark_hip().flexed(0)};
  for (int degree = 2; degree <= 44; ++degree) {
    step.before = step.last;
    step.last.pose = benchmark_hip().flexed(radians(degree));
    step.poses.push_back(step.last.pose);
    method->advance(step.last.pose, usual_time_step);
    method->write(step.last);
  }
  return step;
}

/// The step with other settings, by the method as users have it.
Sample by_method(const Step& step, int count, const std::function<void(SettingValues&)>& change) {
  constexpr int repeats = 3;
  Scene scene = step.scene;
  change(scene.method.settings);
  scene.muscles[0].settings.clear();
  const auto method = make_xpbd_method(scene, benchmark_hip().fields, benchmark_hip().far_fields);
  std::vector<Real> times;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    method->restore(step.poses, step.before, step.last);
    const Real started = processor_time();
    method->advance(step.pose, usual_time_step);
    times.push_back(processor_time() - started);
  }
  std::sort(times.begin(), times.end());
  Frame frame;
  method->write(frame);
  const Points& shape = frame.muscles[0].points;
  const Real error = step.reference.cols() > 0 ? error_of(shape, step.reference) : 0;
  return {count, times[repeats / 2], error, hash_of(shape)};
}

/// The prediction from which all iterations of the step begin.
struct Prediction {
  xpbd::PreparedMuscle muscle;
  std::vector<FieldPlacement> placements;
  SolveSettings settings;
  xpbd::MuscleState state;
};

Prediction predict(const Step& step) {
  const BenchmarkHip& hip = benchmark_hip();
  const Muscle& muscle = step.scene.muscles[0];
  const xpbd::CarryingStrings carrying = xpbd::carrying_strings(step.scene, muscle, hip.bones);
  Prediction p{xpbd::prepare_muscle(step.scene, muscle, hip.fields, carrying), {}, {}, {}};
  p.settings = xpbd::solve_settings(p.muscle.settings, p.muscle.settings.substeps);
  p.state = xpbd::make_muscle_state(p.muscle, step.scene.bodies.size());
  for (const Pose& pose : step.poses) xpbd::follow_strings(p.muscle, pose, p.state);
  for (Index i = 0; i < p.state.particles.count(); ++i)
    p.state.particles.position(i) =
        (step.last.muscles[0].points.col(p.muscle.order[static_cast<std::size_t>(i)]) - p.muscle.origin).cast<float>();
  remember_sides(p.muscle.system, xpbd::place_fields(p.muscle, step.last.pose), p.state);
  xpbd::predict(p.muscle, 0, step.last.pose, step.pose, static_cast<float>(p.settings.time_step), p.state);
  p.placements = xpbd::place_fields(p.muscle, step.pose);
  return p;
}

Points shape_of(const Prediction& p, const SurfaceState& state) {
  Points shape(3, state.particles.count());
  for (Index i = 0; i < shape.cols(); ++i)
    shape.col(p.muscle.order[static_cast<std::size_t>(i)]) = state.particles.position(i).cast<Real>() + p.muscle.origin;
  return shape;
}

/// Iterates and looks at the error on the way, off the clock.
Curve iterate(const std::string& name, const Step& step, const Prediction& begin, Accelerator accelerate) {
  Curve curve{name, {}};
  SurfaceState state = begin.state;
  SurfaceSolve surface{&begin.muscle.system, &begin.placements, begin.settings, &state, {}};
  Real spent = 0;
  int done = 0;
  for (const int count : looked_at) {
    const Real started = processor_time();
    for (; done < count; ++done) {
      if (done == 0 || (done % 4 == 0 && largest_motion(state.listed, state.particles) > listed_motion))
        refresh_contacts(begin.muscle.system, begin.placements, state);
      for (const ConstraintRow& row : constraint_table()) project_kind(row.kind, surface);
      if (!accelerate.improve(state)) continue;
      project_kind(ConstraintKind::bone_contact, surface);
    }
    spent += processor_time() - started;
    const Points shape = shape_of(begin, state);
    curve.samples.push_back({count, spent, error_of(shape, step.reference), hash_of(shape)});
  }
  return curve;
}

std::vector<Curve> curves_of(Step& step) {
  const auto plain = [](int iterations) { return [=](SettingValues& s) { s["iterations"] = iterations; }; };
  const Prediction begin = predict(step);
  SurfaceState converged = begin.state;
  SolveSettings settings = begin.settings;
  settings.iterations = reference_iterations;
  solve_substep(begin.muscle.system, begin.placements, settings, converged);
  step.reference = shape_of(begin, converged);

  std::vector<Curve> curves;
  curves.push_back(iterate("iterations", step, begin, Accelerator::none()));
  curves.push_back(iterate("Chebyshev 0.9", step, begin, Accelerator::chebyshev(0.9f)));
  curves.push_back(iterate("Chebyshev 0.98", step, begin, Accelerator::chebyshev(0.98f)));
  curves.push_back(iterate("Anderson 5", step, begin, Accelerator::anderson(5)));
  curves.push_back({"whole frame, iterations", {}});
  for (const int count : {4, 8, 15, 30, 60, 120}) curves.back().samples.push_back(by_method(step, count, plain(count)));
  curves.push_back({"whole frame, small steps", {}});
  for (const int count : {1, 2, 4, 8, 15, 30})
    curves.back().samples.push_back(by_method(step, count, [=](SettingValues& s) {
      s["substeps"] = count;
      s["iterations"] = 1;
    }));
  for (const Real edge : {0.004, 0.006}) {
    curves.push_back({fmt::format("whole frame, copy of {:g} mm", 1000 * edge), {}});
    for (const int count : {4, 8, 15, 30, 60})
      curves.back().samples.push_back(by_method(step, count, [=](SettingValues& s) {
        s["iterations"] = count;
        s["simulated_edge"] = edge;
        s["full_iterations"] = 1;
      }));
  }
  return curves;
}

void print(const Step& step, const std::vector<Curve>& curves) {
  for (const Curve& curve : curves)
    for (const Sample& sample : curve.samples)
      fmt::print("| {} | {} | {} | {:.3f} | {:.5f} | `{:016x}` |\n", step.scene.muscles[0].name, curve.name,
                 sample.count, sample.milliseconds, sample.error, sample.hash);
  std::fflush(stdout);
}

void draw(const Step& step, const std::vector<Curve>& curves, const std::filesystem::path& folder) {
  LineChart chart{step.scene.muscles[0].name + ": one degree of flexion",
                  "log10 of milliseconds of processor time",
                  "log10 of the mean error in mm",
                  {}};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    ChartSeries series;
    series.name = curves[i].name;
    series.color = series_color(static_cast<Index>(i));
    series.width = 2;
    for (const Sample& sample : curves[i].samples) {
      series.x.push_back(std::log10(sample.milliseconds));
      series.y.push_back(std::log10(sample.error));
    }
    chart.series.push_back(series);
  }
  write_chart(folder / ("convergence_" + step.scene.muscles[0].name + ".svg"), chart);
}

}  // namespace
}  // namespace gracilis

int main(int count, char** arguments) {
  using namespace gracilis;
  const ThreadLimit limit(1);
  for (std::size_t m = 0; m < benchmark_hip().scene.muscles.size(); ++m) {
    Step step = step_of(m);
    const std::vector<Curve> curves = curves_of(step);
    print(step, curves);
    if (count > 1) draw(step, curves, arguments[1]);
  }
}
