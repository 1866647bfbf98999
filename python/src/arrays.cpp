#include "arrays.hpp"

#include "errors.hpp"

#include <fmt/format.h>

#include <limits>

namespace py = pybind11;

namespace gracilis::python {

static std::string shape_of(const py::array& array) { return py::str(array.attr("shape")).cast<std::string>(); }

static py::array as_array(const py::handle& object, const std::string& what, const std::string& wanted) {
  const py::array array = py::array::ensure(object);
  if (!array) {
    PyErr_Clear();
    refuse(what, "must be " + wanted + ", and is no array", "");
  }
  return array;
}

static bool is_number(char kind) { return kind == 'f' || kind == 'i' || kind == 'u'; }

/// The array as `Value`, in C order. Numbers that would change are refused.
template <class Value>
static py::array_t<Value, py::array::c_style | py::array::forcecast> rows_of_three(const py::handle& object,
                                                                                   const std::string& what,
                                                                                   const std::string& wanted) {
  const py::array array = as_array(object, what, wanted);
  const char kind = array.dtype().kind();
  const bool fits = std::is_floating_point_v<Value> ? kind == 'f' : kind == 'i' || kind == 'u';
  if (!fits || array.ndim() != 2 || array.shape(1) != 3)
    refuse(what, fmt::format("must be {}, and is {} {}", wanted, py::str(array.dtype()).cast<std::string>(),
                             shape_of(array)));
  return py::array_t<Value, py::array::c_style | py::array::forcecast>(array);
}

Points points_from(const py::handle& object, const std::string& what) {
  const auto rows = rows_of_three<Real>(object, what, "float64 (n, 3), in m");
  return Eigen::Map<const Points>(rows.data(), 3, rows.shape(0));
}

Eigen::Matrix3Xi faces_from(const py::handle& object, const std::string& what) {
  const auto rows = rows_of_three<std::int64_t>(object, what, "int32 (m, 3)");
  const Eigen::Map<const Eigen::Matrix<std::int64_t, 3, Eigen::Dynamic>> wide(rows.data(), 3, rows.shape(0));
  constexpr std::int64_t largest = std::numeric_limits<Index>::max();
  if (wide.size() > 0 && (wide.minCoeff() < 0 || wide.maxCoeff() > largest))
    refuse(what, fmt::format("has an index outside of 0 to {}: {} to {}", largest, wide.minCoeff(), wide.maxCoeff()));
  return wide.cast<Index>();
}

TriangleMesh mesh_from(const py::handle& object, const std::string& what) {
  if (!py::isinstance<py::sequence>(object) || py::isinstance<py::str>(object) || py::len(object) != 2)
    refuse(what, "must be a pair (vertices, faces)", "float64 (n, 3) in m and int32 (m, 3)");
  const py::sequence pair = py::reinterpret_borrow<py::sequence>(object);
  return {points_from(py::object(pair[0]), what + ": vertices"), faces_from(py::object(pair[1]), what + ": faces")};
}

Eigen::VectorXd values_from(const py::handle& object, const std::string& what) {
  const py::array array = as_array(object, what, "a one-dimensional array of numbers");
  if (!is_number(array.dtype().kind()) || array.ndim() != 1)
    refuse(what, fmt::format("must be a one-dimensional array of numbers, and is {} {}",
                             py::str(array.dtype()).cast<std::string>(), shape_of(array)));
  const py::array_t<Real, py::array::c_style | py::array::forcecast> values(array);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
}

py::array_t<Real> copied(const std::vector<Real>& values) {
  return py::array_t<Real>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::array_t<Real> copied_column(const Eigen::VectorXd& values) {
  return py::array_t<Real>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::array_t<Real> copied(const Eigen::MatrixXd& values) {
  py::array_t<Real> array({values.rows(), values.cols()});
  Eigen::Map<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(array.mutable_data(), values.rows(),
                                                                                   values.cols()) = values;
  return array;
}

}  // namespace gracilis::python
