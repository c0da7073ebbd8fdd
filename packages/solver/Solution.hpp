#pragma once
#include <suture/base/Monitor.hpp>
#include <suture/base/Types.hpp>
#include <suture/solver/ErrorEstimate.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// What is known of a contact pair at the end of a run. Signs as in DESIGN: gap > 0 open, pressure and force > 0 compressive.
struct PairResult {
  int id = -1;
  GlobalId node = -1;  ///< that carries it: number in the mesh
  int line = -1;
  int piece = -1;
  PairStatus status = PairStatus::Open;
  double initialGap = 0.0;      ///< [length]
  double gap = 0.0;             ///< initial gap - (u_A - u_B).n [length]
  double force = 0.0;           ///< along the normal, on B; per unit thickness in the plane, of the whole circle if axisymmetric [force]
  double pressure = 0.0;        ///< force / tributary length (axisymmetric: area) [stress]
  double arc = 0.0;             ///< arc length along the line [length]
  Point position{0, 0, 0};      ///< of the node that carries it, undeformed
  Point displacement{0, 0, 0};  ///< of the node that carries it
  Point normal{0, 0, 0};
};

/// The answer of a run and the figures that summary.json reports.
struct Solution {
  bool converged = false;
  bool stopped = false;              ///< on request, before it converged
  std::string failure;               ///< why not
  std::vector<Vector> displacement;  ///< of each subdomain of this rank, in the order of distribute(): node-major, Cartesian [length]
  std::vector<PairResult> pairs;     ///< on rank 0: all, by id

  std::string outerSolver;  ///< "" for a scene without unilateral contact
  int outerIterations = 0;
  int pcgTotal = 0;                                   ///< of the outer iterations, without the auxiliary ones
  double residual = 0.0;                              ///< at the end, in the stopping norm
  double energyError = -1.0;                          ///< algebraic error in the energy norm, estimated; negative: not known
  std::optional<DiscretisationError> discretisation;  ///< estimated, if the scene asks for it
  AuxiliaryRow auxiliary;                             ///< all pairs closed, or the linear problem itself
  int coarseSize = 0;                                 ///< dimension of the preconditioner's coarse problem
  double setupSeconds = 0.0;                          ///< that the preconditioner took on this rank before its first use
  double bytesRead = 0.0;                  ///< what one conjugate gradient iteration reads of this rank's memory, as far as known
  std::map<std::string, int> chosenSchur;  ///< local problems, by how their Schur complement is kept where that was chosen automatically
  double energy = 0.0;                     ///< total potential energy a(u,u)/2 - L(u)
  Point applied{0, 0, 0};                  ///< sum of the loads [force]; x of axisymmetric scenes: of magnitudes round the circle
  Point reactions{0, 0, 0};                ///< sum of the forces of prescribed displacements and rigid obstacles
  double imbalance = 0.0;                  ///< |applied + reactions| (axisymmetric: along the axis) over the largest of the forces that act
  std::map<std::string, double> errors;    ///< against the scene's exact solution, where it has one: see exactErrors()
  std::map<std::string, double> estimates;  ///< of the outer solver: "mu", "contraction bound", "radius", "relaxation", ...
};

/// Sizes of the discrete problem, for the console and summary.json; the same on all ranks.
struct ProblemSize {
  GlobalId nodes = 0, elements = 0, dofs = 0;  ///< of the mesh; dofs: free ones
  GlobalId interfaceDofs = 0;                  ///< unknowns of the interface problem
  int subdomains = 0, groups = 0;
  int pairs = 0, pieces = 0;
};

}  // namespace suture
