#pragma once
#include <corpus/CorpusScene.hpp>
#include <suture/answer/Solution.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>

namespace suture::corpus {

/// A method to solve a scene.
struct Way {
  std::string name, formulation, outerSolver;
  std::vector<std::string> overrides() const { return {"Formulation=" + formulation, "Outer Solver/Type=" + outerSolver}; }
};
const std::vector<Way>& ways();

enum class Ending { Solved, Refused, Lost };

/// End of a run and, on rank 0, its results.
struct Outcome {
  Ending ending = Ending::Lost;
  std::string reason;   ///< reason of a refusal or loss
  Vector displacement;  ///< displacement of the whole mesh: node-major, Cartesian
  double seam = 0.0;    ///< largest difference between subdomains that share a node, relative to the largest displacement of its body
  std::vector<double> forces;  ///< force of each pair
  int iterations = 0, pcg = 0;
  double seconds = 0.0;
};

/// The scene as all runs use it, on rank 0.
struct Whole {
  Mesh mesh;
  Constraints constraints;
  ElasticModel model;
};

/// Runs a scene through the stages of suture_solve. Catches every exception. Collective.
/// \param whole  gets mesh, constraints and model where the scene was accepted
Outcome run(const CommPtr& comm, const CorpusScene& scene, const Way& way, Whole& whole);

}  // namespace suture::corpus
