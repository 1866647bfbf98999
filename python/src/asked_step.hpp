#pragma once

#include "live_state.hpp"

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

namespace gracilis::python {

/// A step that a simulation is asked for.
struct AskedStep {
  Pose pose;
  Real time_step = 0;  ///< s
};

/// The step of Simulation.advance: to a pose of the scene's own motion, or to coordinates by their names, of which
/// `pose` is None or a dict of degrees (mm) and `radians` one of rad (m). Raises InputError or ConfigurationError.
AskedStep asked_step(const LiveState& state, const pybind11::object& pose, const pybind11::dict& radians,
                     std::optional<Real> time_step);

/// A finite number; `name` is what it is of. Raises InputError.
Real number_of(const pybind11::handle& value, const std::string& name);

}  // namespace gracilis::python
