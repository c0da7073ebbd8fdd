// Errors of the library as exceptions, with the text and the exit code of the programs.
#include <pybind11/stl.h>
#include <suture/base/Errors.hpp>

#include "Bindings.hpp"

namespace suture::python {

namespace {

struct Classes {
  PyObject *error, *input, *numerical, *environment, *internal;
};
Classes classes{};  // never freed

void raise(PyObject* type, const Error& error) {
  py::object value = py::reinterpret_borrow<py::object>(type)(std::string(error.what()));
  value.attr("code") = static_cast<int>(error.code());
  if (const auto* input = dynamic_cast<const InputError*>(&error)) {
    py::list problems;
    for (const Problem& problem : input->problems()) problems.append(py::make_tuple(problem.path, problem.message));
    value.attr("problems") = problems;
  }
  PyErr_SetObject(type, value.ptr());
}

PyObject* addClass(py::module_& module, const char* name, PyObject* base, const char* doc) {
  PyObject* type = PyErr_NewExceptionWithDoc((std::string("suture.") + name).c_str(), doc, base, nullptr);
  if (!type) throw py::error_already_set();
  module.attr(name) = py::reinterpret_borrow<py::object>(type);
  return type;
}

}  // namespace

void bindErrors(py::module_& module) {
  classes.error = addClass(module, "Error", PyExc_RuntimeError, "Base of all errors; `code` is the exit code that a program would return.");
  classes.input = addClass(module, "InputError", classes.error,
                           "Errors in a scene, its mesh or its groups; `problems` lists all, each as a path and a message.");
  classes.numerical = addClass(module, "NumericalError", classes.error, "Not converged, or a breakdown.");
  classes.environment =
      addClass(module, "EnvironmentError", classes.error, "An error of the environment: no memory, a folder that is not writable.");
  classes.internal = addClass(module, "InternalError", classes.error, "A bug in the library.");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise(classes.input, error);
    } catch (const NumericalError& error) {
      raise(classes.numerical, error);
    } catch (const EnvironmentError& error) {
      raise(classes.environment, error);
    } catch (const InternalError& error) {
      raise(classes.internal, error);
    } catch (const Error& error) {
      raise(classes.error, error);
    }
  });
}

}  // namespace suture::python
