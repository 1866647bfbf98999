#pragma once

#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/scene/pose.hpp>

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

namespace gracilis::python {

/// gracilis.Scene: constant, shared by all that stands on it.
struct SceneHandle {
  std::shared_ptr<const LoadedScene> loaded;
  pybind11::object recipe;  ///< calling it makes the same scene again, in another process, too
};

/// A pose of a scene's own motion, and how long after the last one it comes.
struct MotionPose {
  Pose pose;
  Real time_step = 0;
  std::shared_ptr<const LoadedScene> of;
};

/// The same scene by another method (empty: its own), with other settings. What there is to warn about is warned about.
std::shared_ptr<const LoadedScene> changed(const SceneHandle& scene, const std::string& method,
                                           const pybind11::dict& settings);

/// name -> value of all coordinates, which are in rad and m: in degrees and mm, or as they are.
pybind11::dict coordinates_by_name(const Scene& scene, const std::vector<Real>& values, bool in_degrees);

void bind_scene(pybind11::module_& module);

}  // namespace gracilis::python
