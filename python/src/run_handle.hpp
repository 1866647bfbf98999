#pragma once

#include <pybind11/pybind11.h>

namespace gracilis::python {

/// gracilis.Run: a run folder.
void bind_run(pybind11::module_& module);

}  // namespace gracilis::python
