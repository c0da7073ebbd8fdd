#pragma once
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <Teuchos_ParameterList.hpp>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <suture/base/Registry.hpp>
#include <suture/precond/Weighting.hpp>

#include "Together.hpp"

namespace suture {
namespace SUTURE_HIDDEN python {

/// Parameters of a Python function in the scene, with their defaults.
using Defaults = std::map<std::string, double>;

/// Functions by name; a function may be replaced. Never freed, since registries outlive the interpreter.
std::map<std::string, py::object>& functions();

/// Adds the parameters to a schema.
Schema withParameters(Schema schema, const Defaults& defaults);
/// The documentation of a function.
std::string docOf(const py::object& function);
/// The values of the parameters in a strategy's list.
py::dict valuesOf(const Parameters& own, const Defaults& defaults);

/// Name of the type of an object, for messages: "None", "an object of the type list".
std::string typeOf(const py::object& found);

/// The result of a function as numbers. \throws InputError  it cannot be converted; names its type
template <typename Numbers>
Numbers numbersOf(const py::object& found, const std::string& kind, const std::string& expected) {
  try {
    return found.cast<Numbers>();
  } catch (const py::cast_error&) {
    throw InputError(kind, "the Python function returned " + typeOf(found) + "; expected " + expected);
  }
}

/// A local problem as an argument of a Python function. It may outlive the call, but not be used after that unless it is kept.
class LocalArgument {
 public:
  /// Valid until end().
  explicit LocalArgument(const LocalProblem& local) : local_(&local) {}
  /// Valid as long as it exists.
  explicit LocalArgument(std::shared_ptr<const LocalProblem> local) : kept_(std::move(local)), local_(kept_.get()) {}

  const LocalProblem& local() const {
    if (!local_) throw InputError("local", "this local problem is only valid during the call of the function that received it");
    return *local_;
  }
  void end() {
    if (!kept_) local_ = nullptr;
  }

  /// Only of a preconditioner.
  struct Shares {
    Vector weights;            ///< diagonal of D_i; empty: the weighting is not diagonal
    Vector assembledDiagonal;  ///< sum of the stiffness diagonals at each unknown
  };
  std::optional<Shares> shares;

 private:
  std::shared_ptr<const LocalProblem> kept_;
  const LocalProblem* local_;
};

/// The result of a function that receives a local problem during its call.
py::object calledWith(const LocalProblem& local, const py::object& function, const std::string& kind, const py::dict& named);

/// \param make    creates the strategy from function and parameters in the scene
/// \param schema  of the strategy without the function's own parameters; called when a scene is read
template <typename Base>
void registerFunction(
    const std::string& name, const py::object& function, const Defaults& defaults,
    const std::function<std::unique_ptr<Base>(const py::object&, const py::dict&, const Parameters&)>& make,
    const std::function<Schema(const std::string& doc)>& schema = [](const std::string& doc) { return Schema(doc); }) {
  const std::string key = std::string(Base::kind()) + '/' + name;
  const bool isKnown = functions().count(key) > 0;
  functions()[key] = function;
  if (isKnown) return;
  const std::string doc = docOf(function);
  withParameters(schema(doc), defaults);  // refuses names that are taken
  Registry<Base>::instance().add(
      name, [doc, defaults, schema] { return withParameters(schema(doc), defaults); },
      [key, defaults, make](const Parameters& own) { return make(functions().at(key), valuesOf(own, defaults), own); });
}

void bindPreconditioners(py::module_& module);

}  // namespace python
}  // namespace suture
