#pragma once

#include <pybind11/pybind11.h>

namespace gracilis::python {

/// gracilis.read_sto and write_sto.
void bind_tables(pybind11::module_& module);

}  // namespace gracilis::python
