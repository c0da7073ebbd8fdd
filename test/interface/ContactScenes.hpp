#pragma once
#include <interface/Interfaces.hpp>
#include <suture/interface/ContactInterfaceProblem.hpp>

namespace suture::blocks {

std::function<std::unique_ptr<SchurComplement>()> schurOf(const std::string& name = "Explicit");

/// Free values of all subdomains of this rank: zero displacement.
std::vector<Vector> zeros(const Blocks& all);

/// A scene in the formulation Contact On The Interface.
struct OnInterface {
  Blocks all;
  ContactInterfaceProblem problem;

  OnInterface(const Scene& scene, const CommPtr& comm, const std::string& schur = "Explicit")
      : all(scene, comm, std::vector<double>(), false),
        problem(comm, all.partition, all.subdomains, localSolver(), schurOf(schur), scene.constraints.laws) {}
  /// Cut by METIS.
  OnInterface(const Scene& scene, const CommPtr& comm, int count, int seed)
      : all(scene, comm, count, seed, false), problem(comm, all.partition, all.subdomains, localSolver(), schurOf()) {}

  /// The operator at zero displacement with one of `openEvery` pairs open; 0: all closed. Collective.
  Teuchos::RCP<InterfaceOperator> matrix(const Scene& scene, int openEvery = 0) const;
};

/// The two sides of every pair swapped: the same scene.
Scene swapped(Scene scene);

void turn(Point& p, double angle);

/// The whole scene rotated. Contact nodes stay Cartesian, so that a contact row is an equation between four unknowns.
Scene turned(Scene scene, double angle);

/// Two blocks, the lower fixed, some nodes of the line held in one component: one end cannot slide, another node of side A cannot move
/// along the normal, a pair is held on both sides and cannot change. Some pairs interfere, some are open.
Scene heldOnTheLine();

/// Two blocks side by side, in contact with each other and with one below; both pieces, and all three bodies, meet in the point (0, 0). Two
/// nodes there are in two pairs each.
Scene crossingBlocks();

}  // namespace suture::blocks
