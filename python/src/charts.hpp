#pragma once

#include <pybind11/pybind11.h>

namespace gracilis::python {

void bind_charts(pybind11::module_& module);

}  // namespace gracilis::python
