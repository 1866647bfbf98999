#include <gracilis/methods/xpbd/pass_recorder.hpp>

#include <gracilis/dynamics/solver/constraint_table.hpp>

#include <algorithm>
#include <memory>

namespace gracilis::xpbd {

SolveTrace record_passes(const std::vector<MuscleStep>& steps, const std::vector<SurfaceSolve>& solves) {
  const auto is_traced = [](const MuscleStep& step) { return step.trace && *step.trace; };
  if (!std::all_of(steps.begin(), steps.end(), is_traced)) return {};
  const auto before = std::make_shared<std::vector<Particles>>();
  for (const MuscleStep& step : steps) before->push_back(step.state->particles);
  return [&steps, &solves, before](std::size_t i, ConstraintKind kind) {
    const MuscleStep& step = steps[i];
    const Particles& now = step.state->particles;
    SolverPass pass{step.number, name_of(kind), step.report->iterations + solves[i].report.iterations,
                    Points(3, now.count())};
    for (Index p = 0; p < now.count(); ++p)
      pass.moved.col(step.muscle->order[static_cast<std::size_t>(p)]) =
          (now.position(p) - (*before)[i].position(p)).cast<Real>();
    (*before)[i] = now;
    (*step.trace)(pass);
  };
}

}  // namespace gracilis::xpbd
