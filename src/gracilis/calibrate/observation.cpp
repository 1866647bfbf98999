#include <gracilis/calibrate/observation.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/sort_unique.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/simulate/moment_arm_curves.hpp>
#include <gracilis/simulate/run.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace gracilis {

/// Bones turn by no more between two rows of a sweep.
static constexpr Real sweep_step = radians(2);
/// Vertices of a shape that are compared, at most: distances of more say little else.
static constexpr Index most_shape_points = 500;

std::vector<TargetSweep> sweeps_of(const std::vector<CalibrationTarget>& targets) {
  std::vector<TargetSweep> sweeps;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const auto same = std::find_if(sweeps.begin(), sweeps.end(), [&](const TargetSweep& sweep) {
      return sweep.coordinate == targets[t].coordinate && sweep.pose == targets[t].pose;
    });
    TargetSweep& sweep =
        same != sweeps.end() ? *same : sweeps.emplace_back(TargetSweep{targets[t].coordinate, targets[t].pose, {}, {}});
    sweep.targets.push_back(t);
    if (!is_curve(targets[t].kind)) sweep.at.push_back(0);
    for (const TargetPart& part : targets[t].parts) sweep.at.insert(sweep.at.end(), part.at.begin(), part.at.end());
    // Where arms are slopes of lengths, the first and the last need neighbors, too.
    if (targets[t].kind == TargetKind::moment_arms && !sweep.at.empty()) {
      const auto [low, high] = std::minmax_element(sweep.at.begin(), sweep.at.end());
      sweep.at.insert(sweep.at.end(), {*low - sweep_step / 2, *high + sweep_step / 2});
    }
  }
  for (TargetSweep& sweep : sweeps) sort_unique(sweep.at);
  return sweeps;
}

std::string observation_definition(const std::vector<CalibrationTarget>& targets) {
  std::string text;
  for (const TargetSweep& sweep : sweeps_of(targets)) {
    text += "sweep " + sweep.coordinate;
    for (const auto& [name, value] : sweep.pose) text += fmt::format(" {}={}", name, value);
    for (const Real at : sweep.at) text += fmt::format(" {}", at);
    text += "\n";
  }
  for (const CalibrationTarget& target : targets) {
    text += words_of(target.kind) + " " + target.coordinate + "\n";
    for (const TargetPart& part : target.parts) {
      text += "  " + part.muscle;
      for (const Real at : part.at) text += fmt::format(" {}", at);
      if (part.shape) {
        const auto bytes = static_cast<std::size_t>(part.shape->vertices.size()) * sizeof(Real);
        text += " " + content_hash_of({reinterpret_cast<const char*>(part.shape->vertices.data()), bytes});
      }
      text += "\n";
    }
  }
  return text;
}

namespace {

/// The motion of a sweep, and which of its rows are those asked for.
struct SweepMotion {
  Motion motion;
  std::vector<Index> rows;
};

Real unit_of_coordinate(const Scene& scene, const std::string& name) {
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes)
      if (axis.coordinate == name) return axis.translation ? 0.001 : radians(1);
  return 1;
}

SweepMotion motion_of(const Scene& scene, const TargetSweep& sweep) {
  SweepMotion result;
  Motion& motion = result.motion;
  std::vector<Real> others;
  for (const auto& [name, value] : sweep.pose) {
    motion.coordinates.push_back(name);
    others.push_back(value * unit_of_coordinate(scene, name));
  }
  const bool moves = !sweep.coordinate.empty();
  if (moves) motion.coordinates.push_back(sweep.coordinate);
  if (motion.coordinates.empty()) {  // the capture pose itself
    motion.coordinates.push_back(coordinate_names(scene).front());
    others.push_back(capture_coordinates(scene).front());
  }
  std::vector<Real> values;
  for (std::size_t i = 0; i < sweep.at.size(); ++i) {
    if (i > 0) {
      const Real from = sweep.at[i - 1], to = sweep.at[i];
      const std::int64_t steps = steps_over(to - from, sweep_step);
      for (std::int64_t k = 1; k < steps; ++k)
        values.push_back(from + (to - from) * static_cast<Real>(k) / static_cast<Real>(steps));
    }
    result.rows.push_back(static_cast<Index>(values.size()));
    values.push_back(sweep.at[i]);
  }
  motion.values.resize(static_cast<Index>(values.size()), static_cast<Index>(motion.coordinates.size()));
  for (std::size_t row = 0; row < values.size(); ++row) {
    motion.times.push_back(static_cast<Real>(row) * usual_time_step);
    for (std::size_t c = 0; c < others.size(); ++c)
      motion.values(static_cast<Index>(row), static_cast<Index>(c)) = others[c];
    if (moves) motion.values(static_cast<Index>(row), static_cast<Index>(others.size())) = values[row];
  }
  return result;
}

std::size_t muscle_number(const Scene& scene, const std::string& name) {
  for (std::size_t m = 0; m < scene.muscles.size(); ++m)
    if (scene.muscles[m].name == name) return m;
  throw InputError({"", "", "there is no muscle '" + name + "'", ""});
}

std::vector<Real> distances_from(const SignedDistance& target, const Points& points) {
  const auto count = static_cast<Index>(points.cols());
  const Index stride = std::max<Index>(1, (count + most_shape_points - 1) / most_shape_points);
  std::vector<Real> distances;
  for (Index i = 0; i < count; i += stride) distances.push_back(target.query(points.col(i)).distance);
  return distances;
}

class Observer {
 public:
  Observer(const LoadedScene& loaded, const std::vector<CalibrationTarget>& targets, const std::atomic<bool>& stop)
      : loaded_(loaded), scene_(loaded.scene), targets_(targets), stop_(stop) {
    for (const CalibrationTarget& target : targets) {
      observed_.emplace_back(target.parts.size());
      surfaces_.emplace_back();
      for (const TargetPart& part : target.parts)
        surfaces_.back().push_back(part.shape ? std::make_unique<SignedDistance>(*part.shape) : nullptr);
    }
    const StopScope scope(&stop);
    method_ = make_method(
        scene_, [this](const DistanceFieldSettings& settings) { return cached_bone_fields(scene_, settings); });
    const Frame capture = capture_frame(scene_, capture_pose(scene_.bodies.size()), *method_);
    tracker_.emplace(scene_, &capture);
  }

  Observation observe() {
    for (const TargetSweep& sweep : sweeps_of(targets_)) go_through(sweep);
    return std::move(observed_);
  }

 private:
  void go_through(const TargetSweep& sweep) {
    SweepMotion way = motion_of(scene_, sweep);
    set_range(scene_, std::move(way.motion));
    const std::vector<std::string> names = coordinate_names(scene_);
    const auto moved = std::find(names.begin(), names.end(), sweep.coordinate);
    const Index coordinate = moved == names.end() ? 0 : static_cast<Index>(moved - names.begin());
    const MomentArmCurves curves = moment_arm_curves(scene_, coordinate, *method_, *tracker_, loaded_.max_frames, stop_,
                                                     [&](Index, const Frame& frame) { look(sweep, frame); });
    for (const std::size_t t : sweep.targets)
      if (is_curve(targets_[t].kind)) take_curves(sweep, way.rows, curves, t);
  }

  /// Volumes and shapes, of a sweep that is one pose.
  void look(const TargetSweep& sweep, const Frame& frame) {
    for (const std::size_t t : sweep.targets) {
      if (is_curve(targets_[t].kind)) continue;
      for (std::size_t p = 0; p < targets_[t].parts.size(); ++p) {
        const std::size_t m = muscle_number(scene_, targets_[t].parts[p].muscle);
        const Points& points = frame.muscles[m].points;
        observed_[t][p] = surfaces_[t][p] ? distances_from(*surfaces_[t][p], points)
                                          : std::vector<Real>{enclosed_volume(points, scene_.muscles[m].surface.faces)};
      }
    }
  }

  void take_curves(const TargetSweep& sweep, const std::vector<Index>& rows, const MomentArmCurves& curves,
                   std::size_t t) {
    const CalibrationTarget& target = targets_[t];
    for (std::size_t p = 0; p < target.parts.size(); ++p) {
      const TargetPart& part = target.parts[p];
      const auto found = std::find(curves.muscles.begin(), curves.muscles.end(), part.muscle);
      if (found == curves.muscles.end())
        throw ConfigurationError({"", "", "'" + part.muscle + "' has no fibers", "set fibers.count above 0"});
      const auto column = static_cast<Index>(found - curves.muscles.begin());
      for (const Real at : part.at) {
        const auto place = std::lower_bound(sweep.at.begin(), sweep.at.end(), at) - sweep.at.begin();
        const Index row = rows[static_cast<std::size_t>(place)];
        observed_[t][p].push_back(target.kind == TargetKind::lengths ? curves.lengths(row, column)
                                                                     : curves.arms(row, column));
      }
    }
  }

  const LoadedScene& loaded_;
  Scene scene_;
  const std::vector<CalibrationTarget>& targets_;
  const std::atomic<bool>& stop_;
  std::vector<std::vector<std::unique_ptr<SignedDistance>>> surfaces_;  ///< per target and part
  std::unique_ptr<DeformationMethod> method_;
  std::optional<FiberTracker> tracker_;
  Observation observed_;
};

}  // namespace

Observation observe(const LoadedScene& loaded, const std::vector<CalibrationTarget>& targets,
                    const std::atomic<bool>& stop) {
  return Observer(loaded, targets, stop).observe();
}

}  // namespace gracilis
