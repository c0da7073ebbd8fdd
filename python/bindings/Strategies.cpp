// Strategies written in Python, for experiments: they are slow. They are registered like those of a plugin.
#include "Strategies.hpp"

#include <suture/elasticity/MaterialLaw.hpp>
#include <suture/precond/coarse/CoarseSpace.hpp>

namespace suture::python {

std::map<std::string, py::object>& functions() {
  static auto* all = new std::map<std::string, py::object>;
  return *all;
}

Schema withParameters(Schema schema, const Defaults& defaults) {
  for (const auto& [name, value] : defaults) schema.real(name, value, "Passed to the function.");
  return schema;
}

std::string docOf(const py::object& function) {
  const py::object doc = py::getattr(function, "__doc__", py::none());
  return doc.is_none() ? std::string("written in Python") : std::string(py::str(doc));
}

py::dict valuesOf(const Parameters& own, const Defaults& defaults) {
  py::dict values;
  for (const auto& [name, value] : defaults) values[py::str(name)] = own.get<double>(name);
  return values;
}

std::string typeOf(const py::object& found) {
  if (found.is_none()) return "None";
  return "an object of the type " + std::string(py::str(py::type::of(found).attr("__name__")));
}

py::object calledWith(const LocalProblem& local, const py::object& function, const std::string& kind, const py::dict& named) {
  const auto argument = std::make_shared<LocalArgument>(local);
  struct End {
    LocalArgument& argument;
    ~End() { argument.end(); }
  } const end{*argument};
  return called(function, kind, py::make_tuple(argument), named);
}

namespace {

class PythonWeighting : public DiagonalWeighting {
 public:
  PythonWeighting(py::object function, py::dict own) : function_(std::move(function)), own_(std::move(own)) {}

 protected:
  Vector density(const LocalProblem& local) const override {
    const auto found = numbersOf<Vector>(calledWith(local, function_, kind(), own_), kind(), "a weight for each unknown");
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

class PythonCoarseSpace : public CoarseSpace {
 public:
  PythonCoarseSpace(py::object function, py::dict own) : function_(std::move(function)), own_(std::move(own)) {}

  Matrix columns(const LocalProblem& local) const override {
    const auto found = numbersOf<Matrix>(calledWith(local, function_, kind(), own_), kind(), "a matrix, one row per unknown");
    if (found.rows() != local.size() && found.cols() > 0)
      throw InputError(kind(), "the Python function returned a matrix of " + std::to_string(found.rows()) + " x " +
                                   std::to_string(found.cols()) + "; expected one row for each of the " + std::to_string(local.size()) +
                                   " unknowns");
    if (!found.allFinite()) throw InputError(kind(), "the Python function returned values that are not finite");
    return found.cols() > 0 ? found : Matrix(local.size(), 0);
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

/// A pseudo-inverse of S_i, for Python.
struct Inverse {
  std::shared_ptr<LocalInverse> inverse;
  int size;

  Vector apply(const Vector& flux) const {
    if (flux.size() != size)
      throw InputError("local", "inverse: " + std::to_string(flux.size()) + " values for " + std::to_string(size) + " unknowns");
    Matrix right = flux, trace(size, 1);
    inverse->apply(right, trace);
    return trace.col(0);
  }
};

const LocalArgument::Shares& sharesOf(const LocalArgument& argument, const char* name) {
  if (!argument.shares) throw InputError("local", std::string(name) + " exists only for a preconditioner");
  return *argument.shares;
}

void bindLocal(py::module_& module) {
  py::class_<Inverse>(module, "Inverse", "A pseudo-inverse of a Schur complement: inverse(flux) is a trace.")
      .def("__call__", &Inverse::apply);
  py::class_<LocalArgument, std::shared_ptr<LocalArgument>>(module, "Local",
                                                            "A subdomain on its part of the interface, as functions see it.")
      .def_property_readonly(
          "size", [](const LocalArgument& self) { return self.local().size(); }, "number of unknowns on the interface")
      .def_property_readonly("id", [](const LocalArgument& self) { return self.local().id(); })
      .def_property_readonly("name", [](const LocalArgument& self) { return self.local().name(); })
      .def_property_readonly(
          "stiffness_diagonal", [](const LocalArgument& self) { return self.local().stiffnessDiagonal(); },
          "diagonal of the stiffness matrix [force / length]")
      .def_property_readonly(
          "young_modulus",
          [](const LocalArgument& self) -> py::object {
            const Matrix& young = self.local().hint(Hint::kYoungModulus);
            return young.cols() > 0 ? py::cast(Vector(young.col(0))) : py::none();
          },
          "at each unknown [stress]; None if undefined")
      .def_property_readonly(
          "kernel", [](const LocalArgument& self) { return self.local().kernel(); }, "traces that need no force: size x k")
      .def_property_readonly(
          "rigid_modes",
          [](const LocalArgument& self) {
            const Matrix& modes = self.local().hint(Hint::kCoarseModes);
            return modes.cols() > 0 ? modes : self.local().kernel();
          },
          "traces of all rigid-body modes, also of supported subdomains: size x k, columns in no particular order")
      .def(
          "schur", [](const LocalArgument& self) { return self.local().schur(); }, "the Schur complement: size x size")
      .def(
          "inverse",
          [](const LocalArgument& self) {
            return Inverse{self.local().inverse(), self.local().size()};
          },
          "a pseudo-inverse of the Schur complement, as a function of a flux")
      .def_property_readonly(
          "weights",
          [](const LocalArgument& self) {
            const Vector& weights = sharesOf(self, "weights").weights;
            if (weights.size() != self.local().size())
              throw InputError("local", "weights: the chosen Weighting is not diagonal; choose another one");
            return weights;
          },
          "for a preconditioner: share of this subdomain in each unknown, by the chosen Weighting; the shares sum to one")
      .def_property_readonly(
          "assembled_diagonal", [](const LocalArgument& self) { return sharesOf(self, "assembled_diagonal").assembledDiagonal; },
          "for a preconditioner: sum of stiffness_diagonal over the subdomains that share an unknown");
}

}  // namespace

void bindStrategies(py::module_& module) {
  bindLocal(module);
  module.def("register_weighting", [](const std::string& name, const py::object& function, const Defaults& defaults) {
    registerFunction<Weighting>(name, function, defaults, [](const py::object& f, const py::dict& own, const Parameters&) {
      return std::make_unique<PythonWeighting>(f, own);
    });
  });
  module.def("register_coarse_space", [](const std::string& name, const py::object& function, const Defaults& defaults) {
    registerFunction<CoarseSpace>(name, function, defaults, [](const py::object& f, const py::dict& own, const Parameters&) {
      return std::make_unique<PythonCoarseSpace>(f, own);
    });
  });
  module.def("register_material", [](const std::string& name, const py::object& function, const Defaults& defaults) {
    registerFunction<MaterialLaw>(name, function, defaults,
                                  [](const py::object& f, const py::dict& own, const Parameters&) { return lawOf(f, own); });
  });
  bindPreconditioners(module);
}

}  // namespace suture::python
