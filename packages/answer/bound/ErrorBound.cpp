#include <suture/answer/bound/AirySweeps.hpp>
#include <suture/answer/bound/BoundLifts.hpp>
#include <suture/answer/bound/ContactTractions.hpp>
#include <suture/answer/bound/EquilibratedTractions.hpp>
#include <suture/answer/bound/ErrorBound.hpp>
#include <suture/answer/bound/RestForces.hpp>
#include <suture/answer/bound/SharedStresses.hpp>
#include <suture/answer/bound/TractionSweeps.hpp>
#include <suture/base/AgreedDimension.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Gather.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace suture {

namespace {

// Resultants of elements, relative to their forces, up to which stresses count as in equilibrium.
constexpr double kInEquilibrium = 1e-8;
// Error of a solution by round-off, relative to it: a bound cannot be smaller.
constexpr double kRoundOffOfSolution = 1e-12;

std::vector<std::string> everywhere(const Comm& comm, const std::set<std::string>& mine) {
  Packer packer;
  packer.put(std::vector<std::string>(mine.begin(), mine.end()));
  std::set<std::string> all;
  for (const std::string& bytes : allGather(comm, packer.bytes()))
    for (std::string& reason : Unpacker(bytes).get<std::vector<std::string>>()) all.insert(std::move(reason));
  return {all.begin(), all.end()};
}

double sumOver(const Comm& comm, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

BoundaryParts broadcastParts(const Comm& comm, const BoundaryParts& mine) {
  Packer packer;
  packer.put(mine);
  BoundaryParts parts;
  Unpacker(broadcast(comm, packer.bytes())).get(parts);
  return parts;
}

ErrorBound notAvailable(const std::string& reason) {
  ErrorBound bound;
  bound.reasons.push_back(reason);
  return bound;
}

bool hasPointForce(const ElasticModel& model) {
  return std::any_of(model.loads.begin(), model.loads.end(), [](const Load& load) { return load.kind == Load::Kind::PointForce; });
}

/// Squared energies of the own simplices after some sweeps.
template <typename Sweeps, typename Mesh>
Vector improved(const Mesh& mesh, const Matrix& tractions, int sweeps, double& imbalance) {
  Sweeps stresses(mesh, tractions);
  stresses.run(sweeps);
  imbalance = stresses.imbalance();
  return stresses.energies();
}

/// Squared contributions of the elements of each mesh: those of their simplices, and of what the displacement differs from its interpolant.
template <int D>
std::vector<Vector> squaresOfElements(const BoundParts<D>& parts, const Vector& squares) {
  std::vector<Vector> all = parts.interpolation;
  for (std::size_t m = 0; m < all.size(); ++m) {
    const std::vector<int>& first = parts.ofMesh[m];
    if (all[m].size() == 0) all[m] = Vector::Zero(Eigen::Index(first.size()) - 1);
    for (std::size_t e = 0; e + 1 < first.size(); ++e)
      for (int t = first[e]; t < first[e + 1]; ++t) all[m][Eigen::Index(e)] += squares[t];
  }
  return all;
}

template <int D>
ErrorBound boundOf(const Comm& comm, const BoundedSolution& solution, const BoundaryParts& contacts, const ContactLaws& laws,
                   const BoundKind& kind, bool hasSolids, int sweeps) {
  BoundParts<D> parts;
  std::optional<SharedStresses> shared;
  if (hasSolids) shared.emplace(comm, solution, kind);
  collectively(comm, "bounding the error", [&] {
    parts = boundParts<D>(solution, contacts, kind, shared ? &*shared : nullptr);
    if (comm.getRank() == 0) parts.reasons.insert(solution.reasons.begin(), solution.reasons.end());
  });
  const ContactTractions contact = contactTractions<D>(comm, solution, contacts, laws, parts);
  Lifts lifted;
  collectively(comm, "bounding the error", [&] { lifted = liftParts<D>(parts, solution, contact.lifts); });
  if (!carryRestForces(comm, solution, contact.rests, parts))
    parts.reasons.insert("contact pressures balance the nodal forces only on the average");
  if constexpr (D == 2) raiseDegree(parts);
  const StarMesh<D> mesh(comm, solution.meshes, kind, std::move(parts.elements), parts.ofMesh, std::move(parts.boundary));
  const EquilibratedTractions<D> tractions = equilibratedTractions(mesh);
  if (tractions.unbalanced > 0) {
    parts.reasons.insert("forces at " + std::to_string(tractions.unbalanced) + (tractions.unbalanced == 1 ? " node are" : " nodes are") +
                         " not balanced by tractions, most near " + placeText(tractions.worst, D) +
                         (hasPointForce(solution.model) ? ": forces at points have an infinite exact energy" : ""));
    if (!solution.notBalanced.empty()) parts.reasons.insert(solution.notBalanced);
  }
  ErrorBound bound;
  Vector squares;
  double imbalance = 0.0;
  if constexpr (D == 3)
    squares = kind.degree == 1 ? improved<TractionSweeps<1>>(mesh, tractions.values, sweeps, imbalance)
                               : improved<TractionSweeps<2>>(mesh, tractions.values, sweeps, imbalance);
  else
    squares = kind.degree == 1 ? improved<AirySweeps<1>>(mesh, tractions.values, sweeps, imbalance)
                               : improved<AirySweeps<2>>(mesh, tractions.values, sweeps, imbalance);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, imbalance, Teuchos::outArg(bound.imbalance));
  if (bound.imbalance > kInEquilibrium) parts.reasons.insert("stresses are not exactly in equilibrium");
  bound.exists = true;
  bound.reasons = everywhere(comm, parts.reasons);
  bound.strict = bound.reasons.empty();
  bound.solutionNorm = std::sqrt(sumOver(comm, parts.solutionNorm) + contact.layerEnergy);
  bound.oscillation = std::sqrt(sumOver(comm, parts.oscillation));
  const std::vector<Vector> ofElements = squaresOfElements(parts, squares);
  double ofStresses = 0.0;
  for (const Vector& of : ofElements) ofStresses += of.sum();
  const double stresses = std::max(0.0, sumOver(comm, ofStresses)), lift = sumOver(comm, lifted.squares.sum());
  const double square = stresses + contact.liftedGapWork + contact.layerWork + lift;
  // The correction of the solver is orthogonal to the rest before the sweeps, and nearly so after them.
  const double algebraic = solution.balancing ? solution.balancing->energy : 0.0;
  bound.algebraic = std::sqrt(algebraic);
  bound.discretisation = std::sqrt(std::max(0.0, square - algebraic));
  bound.total = std::sqrt(square) + bound.oscillation + kRoundOffOfSolution * bound.solutionNorm;
  const double energy = solution.energy + sumOver(comm, parts.energyOfForm) + contact.layerLift + contact.frictionEnergy;
  bound.energyUpper = energy + contact.liftWork + sumOver(comm, lifted.energy) + lift / 2;
  bound.energyLower = energy - (stresses + contact.gapWork + contact.layerWork) / 2;
  for (std::size_t m = 0; m < ofElements.size(); ++m) {
    bound.ofElements.push_back(ofElements[m].cwiseMax(0.0));
    Vector& own = bound.ofElements.back();
    for (Eigen::Index e = 0; e < own.size(); ++e)
      for (int t = parts.ofMesh[m][std::size_t(e)]; t < parts.ofMesh[m][std::size_t(e) + 1]; ++t) own[e] += lifted.squares[t];
    own = own.cwiseSqrt().eval();
  }
  return bound;
}

}  // namespace

ErrorBound errorBound(const Comm& comm, const BoundedSolution& solution, const ContactLaws& laws, int sweeps) {
  const int dimension = agreedDimensionOf(comm, solution.meshes);
  const BoundaryParts parts = broadcastParts(comm, solution.parts);
  if (!parts.isKnown) return notAvailable("the mesh was partitioned by suture_partition");
  std::array<int, 2> orders{{2, 1}};
  const bool simplices = hasOnlySimplices(solution.meshes, orders);
  const int here[3] = {-orders[0], orders[1], simplices ? 0 : 1};
  int all[3];
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 3, here, all);
  if (-all[0] != all[1]) return notAvailable("the mesh has elements of both orders");
  const bool hasCells = all[2] != 0;
  if (hasCells && solution.model.axisymmetric) return notAvailable("the scene is axisymmetric, and its mesh has quadrilaterals");
  BoundKind kind;
  kind.order = all[1];
  kind.degree = hasCells && dimension == 2 ? 2 : kind.order;
  return dimension == 3 ? boundOf<3>(comm, solution, parts, laws, kind, hasCells, sweeps)
                        : boundOf<2>(comm, solution, parts, laws, kind, false, sweeps);
}

}  // namespace suture
