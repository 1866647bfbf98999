#pragma once

#include <pybind11/pybind11.h>

namespace gracilis::python {

/// gracilis.import_model, paths and static_optimization: what is asked of OpenSim's models.
void bind_opensim(pybind11::module_& module);

}  // namespace gracilis::python
