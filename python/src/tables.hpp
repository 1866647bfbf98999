#pragma once

#include <gracilis/io/tables/table.hpp>

#include <pybind11/pybind11.h>

#include <string>

namespace gracilis::python {

/// A gracilis.Table (tables.py): a dict of columns, "time" first.
pybind11::object as_python(const Table& table);
/// The other way. Throws InputError where it is none.
Table as_table(const pybind11::dict& columns, const std::string& name, bool in_degrees);

/// gracilis.read_sto and write_sto.
void bind_tables(pybind11::module_& module);

}  // namespace gracilis::python
