#include <gracilis/opensim/static_optimization/static_optimization.hpp>

#include <gracilis/opensim/kinematics/loop_closer.hpp>
#include <gracilis/opensim/static_optimization/active_forces.hpp>
#include <gracilis/opensim/static_optimization/bounded_qp.hpp>
#include <gracilis/opensim/static_optimization/needed_forces.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

static InfeasibleInstant missing_forces(const Model& model, Real time, const Eigen::VectorXd& missing) {
  InfeasibleInstant instant{time, {}};
  for (Eigen::Index i = 0; i < missing.size(); ++i)
    if (std::abs(missing[i]) > 1e-4 * missing.lpNorm<Eigen::Infinity>())
      instant.missing.emplace_back(model.coordinates[static_cast<std::size_t>(i)].name, missing[i]);
  std::sort(instant.missing.begin(), instant.missing.end(),
            [](const auto& a, const auto& b) { return std::abs(a.second) > std::abs(b.second); });
  return instant;
}

/// A table for these rows.
static Table empty_result(std::vector<std::string> columns, const CoordinateMotion& motion,
                          const std::vector<std::size_t>& rows) {
  Table table;
  table.name = "Static Optimization";
  for (const std::size_t row : rows) table.times.push_back(motion.times[row]);
  table.columns = std::move(columns);
  table.values.setZero(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(table.columns.size()));
  return table;
}

static BoundedQp limits(const ActiveForces& active) {
  BoundedQp problem;
  problem.lower.resize(active.count());
  problem.upper.resizeLike(problem.lower);
  Eigen::Index column = 0;
  const auto add = [&](const auto* force) {
    problem.lower[column] = force->min_control;
    problem.upper[column++] = force->max_control;
  };
  for (const Muscle* muscle : active.muscles) add(muscle);
  for (const Actuator* actuator : active.actuators) add(actuator);
  return problem;
}

namespace {

struct InstantSolution {
  Eigen::VectorXd activations;
  Strengths strong;
  Eigen::VectorXd missing;
  bool feasible = false;
};

}  // namespace

/// Where forces grow evenly with activations, one problem; otherwise one after the other, each with forces as straight
/// lines through those at the last one's activations.
static InstantSolution solve_instant(const ActiveForces& active, const InstantForces& instant,
                                     const Eigen::MatrixXd& effects, const Eigen::VectorXd& needed, BoundedQp problem,
                                     const StaticOptimizationSettings& settings) {
  const bool straight = settings.muscle_forces == MuscleForces::opensim || !settings.use_muscle_physiology;
  const auto strong_at = [&](const Eigen::VectorXd& activations) {
    return strengths(active, instant, activations, settings.muscle_forces, settings.use_muscle_physiology);
  };
  InstantSolution solution;
  solution.activations = Eigen::VectorXd::Constant(active.count(), 0.3).cwiseMax(problem.lower).cwiseMin(problem.upper);
  solution.strong = strong_at(solution.activations);
  for (int i = 0; i < 60; ++i) {
    const Strengths& strong = solution.strong;
    problem.a = effects * strong.slopes.asDiagonal();
    problem.b = needed - effects * (strong.forces - strong.slopes.cwiseProduct(solution.activations));
    const BoundedQpSolution next = minimize_powers(problem, settings.exponent);
    const Eigen::VectorXd step = next.x - solution.activations;
    solution.activations += (i < 20 ? 1 : 0.5) * step;
    solution.strong = strong_at(solution.activations);
    solution.feasible = next.feasible;
    if (straight) break;
    if ((step.cwiseAbs().array() < 1e-7 * solution.activations.cwiseAbs().cwiseMax(1).array()).all()) break;
  }
  solution.missing = needed - effects * solution.strong.forces;
  const Eigen::VectorXd largest = effects.cwiseAbs() * solution.strong.slopes.cwiseAbs() + needed.cwiseAbs();
  if ((solution.missing.cwiseAbs().array() > 1e-5 * largest.array()).any()) solution.feasible = false;
  return solution;
}

StaticOptimizationResult static_optimization(const Model& model, const CoordinateMotion& motion,
                                             const ExternalLoads& loads, const std::vector<std::size_t>& rows,
                                             const StaticOptimizationSettings& settings,
                                             const std::function<void(std::size_t)>& progress) {
  const Kinematics kinematics(motion);
  const ActiveForces active(model);
  const BoundedQp problem = limits(active);
  const std::vector<std::string> names = active.names();
  const bool fibers = settings.use_muscle_physiology && settings.muscle_forces != MuscleForces::opensim;
  const auto muscles = static_cast<std::ptrdiff_t>(fibers ? active.muscles.size() : 0);
  StaticOptimizationResult result{empty_result(names, motion, rows),
                                  empty_result(names, motion, rows),
                                  empty_result({names.begin(), names.begin() + muscles}, motion, rows),
                                  {}};
  Skeleton skeleton(model);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(rows[i]);
    const Eigen::VectorXd needed = needed_forces(skeleton, kinematics, loads, rows[i]);
    const InstantForces instant = instant_forces(skeleton, active, motion.values.row(row), kinematics.speeds.row(row));
    const Eigen::MatrixXd asked = free_motions(skeleton, motion.values.row(row));
    const InstantSolution solution = solve_instant(active, instant, asked.transpose() * instant.effects,
                                                   asked.transpose() * needed, problem, settings);
    const auto place = static_cast<Eigen::Index>(i);
    result.activations.values.row(place) = solution.activations;
    result.forces.values.row(place) = solution.strong.forces;
    if (fibers) result.fiber_lengths.values.row(place) = solution.strong.fiber_lengths;
    if (!solution.feasible)
      result.infeasible.push_back(missing_forces(model, motion.times[rows[i]], asked * solution.missing));
    if (progress) progress(i + 1);
  }
  return result;
}

Table inverse_dynamics(const Model& model, const CoordinateMotion& motion, const ExternalLoads& loads,
                       const std::vector<std::size_t>& rows) {
  const Kinematics kinematics(motion);
  Table table;
  table.name = "Inverse Dynamics Generalized Forces";
  for (const Coordinate& coordinate : model.coordinates)
    table.columns.push_back(coordinate.name + (coordinate.rotation ? "_moment" : "_force"));
  table.values.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(table.columns.size()));
  Skeleton skeleton(model);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    table.times.push_back(motion.times[rows[i]]);
    table.values.row(static_cast<Eigen::Index>(i)) = needed_forces(skeleton, kinematics, loads, rows[i]);
  }
  return table;
}

}  // namespace gracilis::opensim
