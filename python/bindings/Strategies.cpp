// Strategies written in Python, for experiments: they are slow. They are registered like those of a plugin.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <Teuchos_ParameterList.hpp>
#include <map>
#include <suture/elasticity/MaterialLaw.hpp>
#include <suture/precond/Weighting.hpp>

#include "Together.hpp"

namespace suture::python {

namespace {

using Defaults = std::map<std::string, double>;

/// Functions by name; a function may be replaced. Never freed, since registries outlive the interpreter.
std::map<std::string, py::object>& functions() {
  static auto* all = new std::map<std::string, py::object>;
  return *all;
}

Schema schemaOf(const std::string& doc, const Defaults& defaults) {
  Schema schema(doc);
  for (const auto& [name, value] : defaults) schema.real(name, value, "Passed to the function.");
  return schema;
}

py::dict valuesOf(const Parameters& own, const Defaults& defaults) {
  py::dict values;
  for (const auto& [name, value] : defaults) values[py::str(name)] = own.get<double>(name);
  return values;
}

/// The result of a function as numbers. \throws InputError  it cannot be converted; names its type
template <typename Numbers>
Numbers numbersOf(const py::object& found, const std::string& kind, const std::string& expected) {
  try {
    return found.cast<Numbers>();
  } catch (const py::cast_error&) {
    throw InputError(kind, "the Python function returned " +
                               (found.is_none() ? std::string("None")
                                                : "an object of the type " + std::string(py::str(py::type::of(found).attr("__name__")))) +
                               "; expected " + expected);
  }
}

class PythonWeighting : public DiagonalWeighting {
 public:
  PythonWeighting(py::object function, py::dict own) : function_(std::move(function)), own_(std::move(own)) {}

 protected:
  Vector density(const LocalProblem& local) const override {
    const py::object boundary = py::module_::import("types").attr("SimpleNamespace")(
        py::arg("size") = local.size(), py::arg("stiffness_diagonal") = local.stiffnessDiagonal(),
        py::arg("young_modulus") =
            local.hint(Hint::kYoungModulus).cols() > 0 ? py::cast(Vector(local.hint(Hint::kYoungModulus).col(0))) : py::none());
    const auto found = numbersOf<Vector>(called(function_, kind(), py::make_tuple(boundary), own_), kind(), "a weight for each unknown");
    if (!found.allFinite() || (found.size() > 0 && found.minCoeff() < 0.0))
      throw InputError(kind(), "the Python function returned weights that are negative or not numbers");
    if (found.size() != local.size())
      throw InputError(kind(), "the Python function returned " + std::to_string(found.size()) + " weights for " +
                                   std::to_string(local.size()) + " unknowns");
    return found;
  }

 private:
  py::object function_;
  py::dict own_;
};

std::unique_ptr<MaterialLaw> lawOf(const py::object& function, const py::dict& own) {
  const auto stiffness =
      numbersOf<Matrix>(called(function, MaterialLaw::kind(), py::tuple(), own), MaterialLaw::kind(), "a matrix of 6 x 6");
  if (stiffness.rows() != 6 || stiffness.cols() != 6)
    throw InputError(MaterialLaw::kind(), "the Python function returned a matrix of " + std::to_string(stiffness.rows()) + " x " +
                                              std::to_string(stiffness.cols()) + "; a stiffness is 6 x 6 (xx, yy, zz, xy, yz, xz)");
  return std::make_unique<GivenLaw>(stiffness);
}

/// \param make  creates the strategy from function and parameters
template <typename Base, typename Make>
void registerFunction(const std::string& name, const py::object& function, const Defaults& defaults, const Make& make) {
  const std::string key = std::string(Base::kind()) + '/' + name;
  const bool isKnown = functions().count(key) > 0;
  functions()[key] = function;
  if (isKnown) return;
  const std::string doc =
      py::str(py::getattr(function, "__doc__", py::none()).is_none() ? py::str("written in Python") : py::str(function.attr("__doc__")));
  Registry<Base>::instance().add(name, schemaOf(doc, defaults), [key, defaults, make](const Parameters& own) {
    return make(functions().at(key), valuesOf(own, defaults));
  });
}

}  // namespace

void bindStrategies(py::module_& module) {
  module.def("register_weighting", [](const std::string& name, const py::object& function, const Defaults& defaults) {
    registerFunction<Weighting>(name, function, defaults, [](const py::object& f, const py::dict& own) -> std::unique_ptr<Weighting> {
      return std::make_unique<PythonWeighting>(f, own);
    });
  });
  module.def("register_material", [](const std::string& name, const py::object& function, const Defaults& defaults) {
    registerFunction<MaterialLaw>(name, function, defaults, lawOf);
  });
}

}  // namespace suture::python
