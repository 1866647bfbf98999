#pragma once

#include <pybind11/pybind11.h>

namespace gracilis::python {

/// gracilis.moment_arms.
void bind_moment_arms(pybind11::module_& module);

}  // namespace gracilis::python
