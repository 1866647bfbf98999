#pragma once

#include <pybind11/pybind11.h>

namespace gracilis::python {

/// gracilis.prepare, where it is built in.
void bind_preparing(pybind11::module_& module);

}  // namespace gracilis::python
