#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <suture/base/Types.hpp>

#include <string>
#include <vector>

/// Hides the symbols of the bindings; the registries of the library stay visible to the whole process.
#define SUTURE_HIDDEN [[gnu::visibility("hidden")]]

namespace suture {
namespace SUTURE_HIDDEN python {

namespace py = pybind11;

/// The communicator of an mpi4py communicator, which the caller must keep alive.
CommPtr commOf(const py::object& comm);

/// A read-only array that exposes values of a C++ object without a copy and keeps the object alive.
/// \param strides  bytes between neighbours along each axis
template <typename T>
py::array_t<T> view(const T* first, const std::vector<py::ssize_t>& shape, const std::vector<py::ssize_t>& strides,
                    const py::object& owner) {
  py::array_t<T> array(shape, strides, first, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}
/// The same for contiguous values in row-major order.
template <typename T>
py::array_t<T> view(const T* first, const std::vector<py::ssize_t>& shape, const py::object& owner) {
  std::vector<py::ssize_t> strides(shape.size(), sizeof(T));
  for (std::size_t k = shape.size(); k-- > 1;) strides[k - 1] = strides[k] * shape[k];
  return view(first, shape, strides, owner);
}

void bindErrors(py::module_& module);
void bindRuns(py::module_& module);
void bindStrategies(py::module_& module);
void bindStudies(py::module_& module);

}  // namespace python
}  // namespace suture
