#pragma once

#include <pybind11/pybind11.h>

namespace gracilis::python {

/// gracilis.run: what `gracilis run` does.
void bind_running(pybind11::module_& module);

}  // namespace gracilis::python
