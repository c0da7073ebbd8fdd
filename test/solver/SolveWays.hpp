#pragma once
#include <interface/ContactScenes.hpp>
#include <suture/answer/verdict/Verify.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/interface/Formulation.hpp>
#include <suture/motion/RigidMotionLifting.hpp>
#include <suture/motion/TakeOutLift.hpp>
#include <suture/solver/Method.hpp>
#include <suture/solver/SolverSchema.hpp>

#include <support/ExtendedReference.hpp>

namespace suture::blocks {

/// Solves a scene by the program's stages, with everything at its default except the method.
struct Solved {
  bool converged = false;
  std::string failure;
  Vector deformation, motion;  ///< motions of the mesh's nodes, on all ranks: those computed, and those taken out before
  std::vector<PairResult> pairs;
  Verification verdict;
  std::vector<std::string> notes;
  int pcg = 0;
};

const std::vector<std::string>& ways();

Parameters defaultsOf(const Scene& scene, const std::string& way, std::vector<std::string> settings = {});

struct Notes : Monitor {
  std::vector<std::string> said;
  void note(const std::string& text) override { said.push_back(text); }
};

/// \param subdomains  by METIS; 0: the named blocks
Solved solveAs(const std::string& way, const Scene& given, std::vector<std::string> settings = {}, int subdomains = 0);

/// Distance of an answer from a reference, body by body.
struct BodyByBody {
  double force = 0.0;         ///< force of a pair, relative to the largest of the body that has the smaller one
  double displacement = 0.0;  ///< displacement of a node, less the rigid motion, relative to the body's largest
  int otherwise = 0;          ///< pairs of another status
};

/// Deviation of `field` from the best rigid motion of each body, node-major.
Eigen::Matrix<long double, Eigen::Dynamic, 1> lessRigid(const Mesh& mesh, Eigen::Matrix<long double, Eigen::Dynamic, 1> field);

BodyByBody compareOnRoot(const Scene& scene, const Solved& found, const scenes::ExtendedReference& reference);

/// Collective; the same on all ranks.
BodyByBody compare(const Scene& scene, const Solved& found, const scenes::ExtendedReference& reference);

}  // namespace suture::blocks
