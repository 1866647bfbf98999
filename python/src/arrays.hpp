#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

namespace gracilis::python {

/// 3 × n from an (n, 3) array of floating point numbers. Throws InputError, naming `what`, where it is something else.
Points points_from(const pybind11::handle& object, const std::string& what);
/// 3 × m from an (m, 3) array of integers.
Eigen::Matrix3Xi faces_from(const pybind11::handle& object, const std::string& what);
/// A surface from a pair (vertices, faces).
TriangleMesh mesh_from(const pybind11::handle& object, const std::string& what);
/// Values from a one-dimensional array of numbers.
Eigen::VectorXd values_from(const pybind11::handle& object, const std::string& what);

/// Keeps `owner` alive as long as the result.
template <class T>
pybind11::capsule keeper(std::shared_ptr<const T> owner) {
  return pybind11::capsule(new std::shared_ptr<const T>(std::move(owner)),
                           [](void* kept) { delete static_cast<std::shared_ptr<const T>*>(kept); });
}

/// A read-only array over memory that `owner` holds: nothing is copied.
template <class Value>
pybind11::array view(const Value* data, std::vector<pybind11::ssize_t> shape, const pybind11::handle& owner) {
  pybind11::array_t<Value> array(std::move(shape), data, owner);
  pybind11::detail::array_proxy(array.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// (n, 3) over 3 × n.
template <class Matrix>
pybind11::array rows_view(const Matrix& columns, const pybind11::handle& owner) {
  return view(columns.data(), {static_cast<pybind11::ssize_t>(columns.cols()), 3}, owner);
}

/// An array of its own.
pybind11::array_t<Real> copied(const std::vector<Real>& values);
pybind11::array_t<Real> copied_column(const Eigen::VectorXd& values);
/// rows × columns.
pybind11::array_t<Real> copied(const Eigen::MatrixXd& values);

}  // namespace gracilis::python
