#include "moment_arms.hpp"

#include "arrays.hpp"
#include "errors.hpp"
#include "released.hpp"
#include "scene_handle.hpp"

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/simulate/moment_arm_curves.hpp>
#include <gracilis/simulate/run.hpp>

#include <algorithm>

namespace py = pybind11;

namespace gracilis::python {

static const JointAxis& axis_of(const Scene& scene, std::size_t coordinate) {
  for (const Joint& joint : scene.joints) {
    if (coordinate < joint.axes.size()) return joint.axes[coordinate];
    coordinate -= joint.axes.size();
  }
  throw std::out_of_range("coordinate");
}

/// A row for each value, at the usual pace.
static Motion range_of(const std::string& coordinate, const Eigen::VectorXd& values) {
  Motion motion;
  motion.coordinates = {coordinate};
  motion.values = values;
  for (Index i = 0; i < values.size(); ++i) motion.times.push_back(i * usual_time_step);
  return motion;
}

static MomentArmCurves run_through(const LoadedScene& loaded, std::size_t coordinate) {
  static const std::atomic<bool> never = false;
  const Scene& scene = loaded.scene;
  const auto fields = [&](const DistanceFieldSettings& settings) { return cached_bone_fields(scene, settings); };
  const std::unique_ptr<DeformationMethod> method = make_method(scene, fields);
  const Frame capture = capture_frame(scene, capture_pose(scene.bodies.size()), *method);
  const FiberTracker tracker(scene, &capture);
  const std::atomic<bool>* stop = stop_flag();
  return moment_arm_curves(scene, static_cast<Index>(coordinate), *method, tracker, loaded.max_frames,
                           stop ? *stop : never);
}

static py::object curves(const SceneHandle& given, const std::string& coordinate, const py::object& range,
                         const std::string& method, const py::kwargs& settings) {
  LoadedScene loaded = *changed(given, method, settings);
  const std::vector<std::string> names = coordinate_names(loaded.scene);
  const auto found = static_cast<std::size_t>(std::find(names.begin(), names.end(), coordinate) - names.begin());
  if (found == names.size())
    throw ConfigurationError({"", "", "there is no coordinate '" + coordinate + "'", suggestion(coordinate, names)});
  const Eigen::VectorXd shown = values_from(range, "range");
  if (shown.size() < 2 || !shown.allFinite()) refuse("range", "must be two finite numbers or more, degrees (mm)");
  const bool translates = axis_of(loaded.scene, found).translation;
  set_range(loaded.scene, range_of(coordinate, shown * (translates ? 0.001 : radians(1))));
  const MomentArmCurves result = released([&] { return run_through(loaded, found); });
  py::dict arms, lengths;
  for (std::size_t m = 0; m < result.muscles.size(); ++m) {
    const Eigen::VectorXd arm = result.arms.col(static_cast<Index>(m)),
                          length = result.lengths.col(static_cast<Index>(m));
    arms[py::str(result.muscles[m])] = copied_column(arm);
    lengths[py::str(result.muscles[m])] = copied_column(length);
  }
  return py::module_::import("gracilis.arms")
      .attr("MomentArms")(coordinate, copied_column(shown), arms, lengths, translates ? "mm" : "degrees");
}

void bind_moment_arms(py::module_& module) {
  module.def("moment_arms", &curves, py::arg("scene"), py::arg("coordinate"), py::arg("range"), py::arg("method") = "",
             R"(Moment arms of all muscles with fibers, along a range of one coordinate, as 'gracilis rom' finds them.

range: values that the coordinate goes through, degrees (mm for a translation), in their order, as
range(-10, 61, 2) or a NumPy array; steps of some degrees at most. Others keep their value of the capture pose. Muscles settle at
the first value before. method and other keywords: as of Simulation.

Returns MomentArms: coordinate, degrees (n,), arms and lengths, each muscle -> (n,) float64 in m, and the unit of degrees.)");
}

}  // namespace gracilis::python
