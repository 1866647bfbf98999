#include "tables.hpp"

#include "arrays.hpp"
#include "errors.hpp"
#include "released.hpp"

#include <gracilis/io/tables/table.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include <filesystem>

namespace py = pybind11;

namespace gracilis::python {

py::object as_python(const Table& table) {
  const py::object result = py::module_::import("gracilis.tables").attr("Table")();
  result["time"] = copied(table.times);
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const Eigen::VectorXd column = table.values.col(static_cast<Eigen::Index>(c));
    result[py::str(table.columns[c])] = copied_column(column);
  }
  result.attr("name") = table.name;
  result.attr("in_degrees") = table.in_degrees;
  result.attr("warnings") = table.warnings;
  return result;
}

Table as_table(const py::dict& columns, const std::string& name, bool in_degrees) {
  if (!columns.contains("time")) refuse("table", "has no column 'time'", "in s, increasing");
  Table table;
  table.name = name;
  table.in_degrees = in_degrees;
  const Eigen::VectorXd times = values_from(columns["time"], "time");
  table.times.assign(times.begin(), times.end());
  table.values.resize(times.size(), static_cast<Eigen::Index>(columns.size()) - 1);
  for (const auto& [key, value] : columns) {
    const std::string column = py::str(key).cast<std::string>();
    if (column == "time") continue;
    const Eigen::VectorXd values = values_from(value, column);
    if (values.size() != times.size())
      refuse(column, fmt::format("has {} rows, and the time {}", values.size(), times.size()));
    table.values.col(static_cast<Eigen::Index>(table.columns.size())) = values;
    table.columns.push_back(column);
  }
  if (!times.allFinite() || !table.values.allFinite()) refuse("table", "holds a number that is not finite");
  for (Eigen::Index i = 1; i < times.size(); ++i)
    if (!(times(i) > times(i - 1))) refuse("time", fmt::format("does not increase in row {}", i));
  return table;
}

static py::object read_sto(const std::filesystem::path& path) {
  return as_python(released([&] { return read_table(path); }));
}

static void write(const std::filesystem::path& path, const py::dict& columns, const py::object& name,
                  const py::object& in_degrees) {
  const auto chosen = [&](const py::object& given, const char* attribute, const py::object& otherwise) -> py::object {
    return given.is_none() ? py::getattr(columns, attribute, otherwise) : given;
  };
  const Table table = as_table(columns, chosen(name, "name", py::str(path.stem().string())).cast<std::string>(),
                               chosen(in_degrees, "in_degrees", py::bool_(false)).cast<bool>());
  released([&] { write_sto(path, table); });
}

void bind_tables(py::module_& module) {
  module.def("read_sto", &read_sto, py::arg("path"), R"(Reads a .sto, .mot or .csv as OpenSim and others write it.

Returns a Table: a dict of (rows,) float64 by columns' names, "time" (s) first, in the file's own units, with the
attributes name, in_degrees and warnings.)");
  module.def("write_sto", &write, py::arg("path"), py::arg("table"), py::arg("name") = py::none(),
             py::arg("in_degrees") = py::none(), R"(Writes a table that OpenSim 4 reads, whole or not at all.

table: a dict of (rows,) numbers by columns' names with "time" (s, increasing). name, in_degrees: those of a Table unless
they are given.)");
}

}  // namespace gracilis::python
