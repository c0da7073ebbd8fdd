#include <suture/algebra/SparseConstrainedInverse.hpp>
#include <suture/algebra/WorkSpace.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/subdomain/SubdomainProblem.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <limits>

namespace suture {

namespace {

double stiffnessOf(const Subdomain& subdomain) { return subdomain.dofs() > 0 ? subdomain.stiffness().diagonal().maxCoeff() : 0.0; }

/// Neumann problem of the whole subdomain, loaded only on its boundary.
class NeumannInverse : public LocalInverse {
 public:
  NeumannInverse(GeneralisedInverse&& inverse, std::vector<int> positions)
      : inverse_(std::move(inverse)), positions_(std::move(positions)) {}

  void apply(ConstLocalView flux, LocalView trace) const override {
    thread_local std::vector<double> kept;
    WorkSpace space(inverse_.size(), flux.cols(), kept);
    LocalView x = space.values;
    x.setZero();
    for (std::size_t i = 0; i < positions_.size(); ++i) x.row(positions_[i]) = flux.row(i);
    inverse_.apply(x);
    for (std::size_t i = 0; i < positions_.size(); ++i) trace.row(i) = x.row(positions_[i]);
  }

 private:
  GeneralisedInverse inverse_;
  std::vector<int> positions_;
};

}  // namespace

std::vector<GlobalId> globalDofs(const Subdomain& subdomain, const std::vector<int>& dofs) {
  std::vector<GlobalId> ids;
  ids.reserve(dofs.size());
  for (int i : dofs) ids.push_back(subdomain.globalDof(i));
  return ids;
}

std::vector<int> nodesOfDofs(const Subdomain& subdomain) {
  std::vector<int> nodes(subdomain.dofs());
  for (int i = 0; i < subdomain.dofs(); ++i) nodes[i] = subdomain.nodeOf(i);
  return nodes;
}

std::vector<Point> placesOfDofs(const Subdomain& subdomain) {
  std::vector<Point> places(subdomain.dofs());
  for (int i = 0; i < subdomain.dofs(); ++i) places[i] = subdomain.mesh().point(subdomain.nodeOf(i));
  return places;
}

SubdomainProblem::SubdomainProblem(int id, const Subdomain& subdomain, const std::vector<int>& boundary, const LocalSolverMaker& solver,
                                   std::unique_ptr<SchurComplement> schur, double softest)
    : LocalProblem(id, "subdomain '" + subdomain.mesh().name + "'", globalDofs(subdomain, boundary)),
      subdomain_(subdomain),
      positions_(boundary),
      solver_(solver),
      schur_(std::move(schur)),
      diagonal_(rowsAt(subdomain.stiffness().diagonal(), boundary)),
      kernel_(rowsAt(subdomain.kernel(), boundary)) {
  schur_->compute(schurData(nodesOfDofs(subdomain), placesOfDofs(subdomain)));
  if (softest > 0.0 && kernel_.cols() > 0 && stiffnessOf(subdomain) > kMuchStiffer * softest) balanced_ = orthonormalBasis(kernel_, 1e-14);
}

SchurData SubdomainProblem::schurData(const std::vector<int>& nodes, const std::vector<Point>& places) const {
  return {subdomain_.stiffness(), subdomain_.load(), positions_, nodes, places, solver_, name(), subdomain_.components()};
}

void SubdomainProblem::reload() {
  if (loadChanges_ == subdomain_.loadChanges()) return;
  loadChanges_ = subdomain_.loadChanges();
  schur_->reload(schurData(nodesOfDofs(subdomain_), placesOfDofs(subdomain_)));
}

void SubdomainProblem::applySchur(ConstLocalView trace, LocalView flux) const {
  schur_->apply(trace, flux);
  if (balanced_.cols() > 0) flux -= balanced_ * (balanced_.transpose() * flux).eval();
}

Vector SubdomainProblem::boundaryForces(const Vector& freeValues) const {
  const Vector forces = subdomain_.stiffness() * freeValues - subdomain_.load();
  Vector flux = rowsAt(forces, positions_);
  if (balanced_.cols() > 0) flux -= balanced_ * (balanced_.transpose() * (flux + condensedLoad())).eval();
  return flux;
}

double softestStiffness(const Comm& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains) {
  double mine = std::numeric_limits<double>::max(), all = mine;
  for (const auto& subdomain : subdomains)
    if (const double own = stiffnessOf(*subdomain); own > 0.0) mine = std::min(mine, own);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(all));
  return all;
}

Matrix SubdomainProblem::schur() const {
  const PackedSymmetric* dense = schur_->dense();
  return dense ? dense->full() : LocalProblem::schur();
}

Matrix SubdomainProblem::schurBlock(const std::vector<int>& positions) const {
  const PackedSymmetric* dense = schur_->dense();
  return dense ? dense->block(positions) : LocalProblem::schurBlock(positions);
}

std::unique_ptr<LocalInverse> SubdomainProblem::sparseInverse(const Matrix& constraints) const {
  // If stiffness jumps within a subdomain, constraints that couple stiff and soft unknowns need the changes of basis of the dense inverse:
  // cubes with bricks 1e6 times as stiff had negative eigenvalues.
  constexpr double kMostJump = 1e4;
  const Vector diagonal = subdomain_.stiffness().diagonal();
  if (diagonal.size() > 0 && diagonal.maxCoeff() > kMostJump * diagonal.minCoeff()) return nullptr;
  return std::make_unique<SparseConstrainedInverse>(subdomain_.stiffness().full(), subdomain_.kernel(), positions_, constraints, solver_,
                                                    name());
}

std::unique_ptr<LocalInverse> SubdomainProblem::inverse() const {
  return std::make_unique<NeumannInverse>(
      GeneralisedInverse(subdomain_.stiffness().full(), subdomain_.kernel(), nodesOfDofs(subdomain_), solver_, name()), positions_);
}

}  // namespace suture
