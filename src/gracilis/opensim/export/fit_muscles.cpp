#include <gracilis/opensim/export/fit_muscles.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/sort_unique.hpp>
#include <gracilis/geometry/sobol_points.hpp>
#include <gracilis/opensim/export/model_samples.hpp>
#include <gracilis/opensim/import/muscle_heads.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>
#include <gracilis/opensim/reader/crossed_coordinates.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace gracilis::opensim {

static constexpr Real no_arm = 1e-6;  // m

/// Those that can change a path's length and that OpenSim lets move by themselves: couplers' own stand for what depends
/// on them.
static std::vector<Index> free_coordinates(const Model& model, const Path& path) {
  std::vector<Index> all = crossed_coordinates(model, path), free;
  // Last first: a coupler may drive another's independent coordinate.
  for (auto coupler = model.couplers.rbegin(); coupler != model.couplers.rend(); ++coupler)
    if (std::find(all.begin(), all.end(), coupler->dependent) != all.end())
      all.insert(all.end(), coupler->independent.begin(), coupler->independent.end());
  sort_unique(all);
  std::copy_if(all.begin(), all.end(), std::back_inserter(free), [&](Index i) {
    return !model.coordinates[static_cast<std::size_t>(i)].locked && !is_dependent(model, i);
  });
  return free;
}

/// OpenSim's polynomials take six (MultivariatePolynomialFunction.h).
static void require_arguments(std::size_t count) {
  if (count > 6)
    throw InputError({"", "", fmt::format("depends on {} coordinates, of which OpenSim takes 6", count), ""});
}

/// The box without the coordinates about which the path has no arm.
static CoordinateBox acting_part(const CoordinateBox& box, const PathSamples& samples) {
  CoordinateBox part;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < box.least.size(); ++i) {
    if (!(samples.arms.col(i).cwiseAbs().maxCoeff() > no_arm && box.most[i] > box.least[i])) continue;
    kept.push_back(i);
    part.coordinates.push_back(box.coordinates[static_cast<std::size_t>(i)]);
  }
  part.least = box.least(kept);
  part.most = box.most(kept);
  return part;
}

/// The poses in which the muscle has a length.
static std::vector<Eigen::Index> known_rows(const MuscleLengths& muscle) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < muscle.lengths.size(); ++row)
    if (std::isfinite(muscle.lengths[row])) rows.push_back(row);
  if (rows.size() < 4) throw InputError({"", "", "is known in too few poses", ""});
  return rows;
}

/// Some columns of the run's coordinates and arms.
static PathSamples samples_of(const LengthSamples& run, const MuscleLengths& muscle, const CoordinateBox& box,
                              const Model& model) {
  const std::vector<Eigen::Index> rows = known_rows(muscle);
  PathSamples samples{run.coordinates(rows, box.coordinates), muscle.lengths(rows), {}, box.scales(model)};
  if (muscle.arms.cols() > 0) samples.arms = muscle.arms(rows, box.coordinates);
  return samples;
}

/// What the run's lengths changed by since the capture pose, beyond what the path did.
static PathSamples beyond_path(const PathSamples& run, const Eigen::MatrixXd& coordinates, Skeleton& skeleton,
                               const Path& path, const CoordinateBox& box) {
  PathSamples difference = run;
  for (Eigen::Index row = 0; row < run.lengths.size(); ++row) {
    const Eigen::VectorXd values = coordinates.row(row);
    skeleton.place(values);
    const PathMeasure measure = measure_path(skeleton, path, values);
    difference.lengths[row] -= measure.length;
    for (Eigen::Index i = 0; i < run.arms.cols(); ++i)
      difference.arms(row, i) -= measure.moment_arms[box.coordinates[static_cast<std::size_t>(i)]];
  }
  difference.lengths.array() -= difference.lengths[0];
  return difference;
}

/// The same beyond what the fibers' lengths did along the model's line, where that is known: of fibers that follow it,
/// though they lie beside it, nothing is left.
static PathSamples beyond_line(const PathSamples& run, const Eigen::VectorXd& line_lengths) {
  PathSamples difference = run;
  difference.lengths -= line_lengths;
  difference.lengths.array() -= difference.lengths[0];
  return difference;
}

/// The correction, drawn to nothing over the whole box.
static PathFit fit_correction(const PathSamples& difference, const CoordinateBox& box, bool spread) {
  PathFitSettings settings;
  const bool known_arms = difference.arms.size() > 0;
  settings.largest_order = spread ? 9 : known_arms ? 6 : 4;
  settings.consecutive_parts = !spread;
  settings.ridges = {1e-3, 1e-2, 0.1, 1, 10};
  const Eigen::MatrixXd poses = spread_poses(box, 512);
  settings.towards = {poses, Eigen::VectorXd::Zero(poses.rows()), Eigen::MatrixXd::Zero(poses.rows(), poses.cols()),
                      difference.scales};
  return fit_path(difference, settings);
}

/// The model's path and, unless the run's muscles follow it, the correction. Nothing where no coordinate moves it.
static std::optional<FittedMuscle> fit_known(const LengthSamples& run, const MuscleLengths& muscle, const Model& model,
                                             const Path& path, const MuscleFitSettings& settings) {
  Skeleton skeleton(model);
  CoordinateBox box = box_around(model, free_coordinates(model, path), run.coordinates, settings.whole_ranges);
  if (box.coordinates.empty() || static_cast<int>(box.coordinates.size()) > most_sobol_dimensions) return {};
  box = acting_part(box, model_samples(skeleton, path, box, spread_poses(box, 64)));
  if (box.coordinates.empty()) return {};
  require_arguments(box.coordinates.size());
  PathFit fit = fit_path(model_samples(skeleton, path, box, spread_poses(box, settings.poses)));
  FittedMuscle result{muscle.name, box.coordinates, fit.function, {}, {}, {}, false, false};
  PathSamples held_out =
      model_samples(skeleton, path, box, spread_poses(box, std::max<Index>(settings.poses / 4, 64), settings.poses));
  result.held_out = path_errors(fit.function, held_out);
  result.arms = arm_errors(fit.function, held_out);
  if (run.follow_lines) return result;
  const PathSamples of_run = samples_of(run, muscle, box, model);
  const std::vector<Eigen::Index> rows = known_rows(muscle);
  const bool line = muscle.line_lengths.size() > 0 && muscle.arms.cols() == 0;
  const PathSamples difference = line ? beyond_line(of_run, muscle.line_lengths(rows))
                                      : beyond_path(of_run, run.coordinates(rows, Eigen::all), skeleton, path, box);
  const PathFit correction = fit_correction(difference, box, run.spread);
  result.length = sum_of(fit.function, correction.function);
  result.corrects = true;
  result.beside_run = correction.held_out;
  return result;
}

/// The run's own lengths over the coordinates that matter.
static std::optional<FittedMuscle> fit_alone(const LengthSamples& run, const MuscleLengths& muscle, const Model& model,
                                             std::vector<Index> coordinates) {
  PathFitSettings settings;
  settings.largest_order = run.spread ? 9 : 6;
  settings.consecutive_parts = false;
  const auto samples = [&](const std::vector<Index>& over) {
    return samples_of(run, muscle, box_around(model, over, run.coordinates, false), model);
  };
  if (coordinates.empty()) return {};
  PathFit fit = fit_path(samples(coordinates), settings);
  for (std::size_t i = coordinates.size(); i-- > 0 && coordinates.size() > 1;) {
    std::vector<Index> fewer = coordinates;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    PathFit without = fit_path(samples(fewer), settings);
    if (without.left_out > 1.1 * fit.left_out + 1e-7) continue;
    if (muscle.arms.cols() > 0 && muscle.arms.col(coordinates[i]).cwiseAbs().maxCoeff() > 1e-4) continue;
    coordinates = std::move(fewer);
    fit = std::move(without);
  }
  require_arguments(coordinates.size());
  FittedMuscle result{muscle.name, coordinates, fit.function, fit.held_out, {}, fit.held_out, false, true};
  result.arms = arm_errors(fit.function, samples(coordinates));
  return result;
}

FittedMuscles fit_muscles(const LengthSamples& samples, const Model& model, const MuscleFitSettings& settings) {
  FittedMuscles result;
  std::vector<Index> moving;
  for (std::size_t i = 0; i < model.coordinates.size(); ++i) {
    const auto column = samples.coordinates.col(static_cast<Eigen::Index>(i));
    if (!is_dependent(model, static_cast<Index>(i)) && column.maxCoeff() - column.minCoeff() > 1e-6)
      moving.push_back(static_cast<Index>(i));
  }
  for (const MuscleLengths& muscle : samples.muscles) {
    const Index known = index_of(model.muscles, muscle.name);
    if (known < 0 && !model.muscles.empty()) {
      const std::vector<std::string> heads = heads_in_model(model, muscle.name);
      for (const std::string& head : heads) result.left_out.push_back(part_of_sheet(head, muscle.name));
      if (heads.empty()) result.left_out.push_back(fmt::format("{}: the model has no such muscle", muscle.name));
      continue;
    }
    try {
      const Path* path = known < 0 ? nullptr : &model.muscles[static_cast<std::size_t>(known)].path;
      std::vector<Index> over = moving;
      if (path) {
        const std::vector<Index> crossed = free_coordinates(model, *path);
        std::erase_if(over, [&](Index i) { return std::find(crossed.begin(), crossed.end(), i) == crossed.end(); });
      }
      const std::optional<FittedMuscle> fitted = path && !settings.run_alone
                                                     ? fit_known(samples, muscle, model, *path, settings)
                                                     : fit_alone(samples, muscle, model, over);
      if (fitted && std::all_of(fitted->length.coefficients.begin(), fitted->length.coefficients.end(),
                                [](Real c) { return std::isfinite(c); }))
        result.muscles.push_back(*fitted);
      else
        result.left_out.push_back(
            fmt::format("{}: {}", muscle.name,
                        fitted ? "its lengths are not finite" : "no coordinate of the run changes its length"));
    } catch (const Error& error) {
      result.left_out.push_back(fmt::format("{}: {}", muscle.name, error.what()));
    }
  }
  return result;
}

}  // namespace gracilis::opensim
