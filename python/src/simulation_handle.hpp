#pragma once

#include <pybind11/pybind11.h>

namespace gracilis::python {

/// gracilis.Simulation, its muscles, bones, activations and checkpoints.
void bind_simulation(pybind11::module_& module);

}  // namespace gracilis::python
