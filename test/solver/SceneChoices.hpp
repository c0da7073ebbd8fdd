#pragma once
#include <solver/ContactMethods.hpp>
#include <suture/interface/Formulation.hpp>
#include <suture/solver/SolveInterface.hpp>

namespace suture::blocks {

/// Schema of the scene's lists for the solver packages.
Schema solverSchema();

/// A scene's parameters of the solver packages with these settings.
Parameters solverParameters(const std::vector<std::string>& settings);

/// Pseudo-random numbers per unknown, independent of the number of ranks.
MultiVectorPtr someStep(const InterfaceSpace& space, double size, double seed);

/// Euclidean norm over all ranks.
double norm(const MultiVector& x);

/// Every formulation that a scene may name.
inline std::vector<std::string> formulations() { return solverSchema().find("Formulation")->allowed; }

/// A scene in a formulation, by its name.
struct Formulated {
  Parameters parameters;
  Blocks all;
  std::unique_ptr<InterfaceProblem> problem;

  Formulated(const Scene& scene, const CommPtr& comm, const std::string& formulation, std::vector<std::string> settings = {})
      : parameters(solverParameters((settings.push_back("Formulation=" + formulation), settings))),
        all(scene, comm, std::vector<double>(), formulationOf(parameters)->keepsGroupsWhole()),
        problem(makeInterfaceProblem(comm, all.partition, all.subdomains, parameters)) {}
};

}  // namespace suture::blocks
