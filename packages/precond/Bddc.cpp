#include <suture/algebra/CostModel.hpp>
#include <suture/algebra/UpdatedInverse.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Progress.hpp>
#include <suture/precond/Bddc.hpp>
#include <suture/precond/MortarRows.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>

#include <algorithm>
#include <map>
#include <sstream>

namespace suture {

namespace {

// A changed row costs a product with a matrix of size n, and each application reads two more vectors for it; a factorisation costs n such
// products.
constexpr int kLeastSizeByChanges = 16;

constexpr double kToldMotion = 1e-8;  // least value of the constraints for a motion of length one

/// The inverse under other constraints; null if a new factorisation is cheaper.
std::shared_ptr<const LocalInverse> updated(const std::shared_ptr<const LocalInverse>& base, const PrimalRows::Rows& old,
                                            const PrimalRows::Rows& now) {
  const std::vector<int> from = rowsIn(old, now);
  const auto kept = static_cast<int>(from.size() - std::count(from.begin(), from.end(), -1));
  const int changes = static_cast<int>(old.rows() + now.rows()) - 2 * kept;
  if (changes * kLeastSizeByChanges > now.cols()) return nullptr;
  return inverseUnder(base, static_cast<int>(old.rows()), from, Matrix(now));
}

}  // namespace

Schema Bddc::schema() {
  Schema schema(
      "Balancing domain decomposition by constraints: local problems held at primal constraints (corners, edges), and their coarse "
      "problem.");
  CoarseOptions::addParameters(schema);
  schema.oneOf(
      "Local Inverses", "Automatic", {"Automatic", "Dense", "Sparse"},
      "Inverses of the local problems. Dense: a matrix of the size of the boundary; Sparse: a factor of interior and boundary, with the "
      "constraints through a small matrix; Automatic: the faster one for each local problem, in 2D Dense.");
  return schema;
}

namespace {
Bddc::Inverses inversesIn(const Parameters& own) {
  const auto name = own.get<std::string>("Local Inverses");
  return name == "Dense" ? Bddc::Inverses::Dense : name == "Sparse" ? Bddc::Inverses::Sparse : Bddc::Inverses::Automatic;
}
}  // namespace

Bddc::Bddc(const Parameters& own) : Bddc(CoarseOptions::from(own), inversesIn(own)) {}

Bddc::Bddc(CoarseOptions levels, Inverses inverses)
    : weighting_(levels.weighting()), primal_(levels.primal()), levels_(std::move(levels)), kind_(inverses) {}

struct Bddc::Work {
  Matrix overlap, sum;
  Matrix flux, trace;       // fluxes of all local problems, concatenated; the trace of one
  std::vector<Vector> own;  // Phi_i^T times each local problem's flux
  Vector values;            // values of one local problem's primal unknowns
  Vector primal;
  MultiVectorPtr averaged;
};

Bddc::~Bddc() = default;

void Bddc::doInitialize() { coarse_.reset(), work_.reset(); }

void Bddc::doCompute() {
  int mine = 0, all = 0;
  for (const auto& local : matrix()->locals()) mine += local != nullptr;
  Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  averaging_.reset();
  // Not broken for adaptive constraints, which bound the condition number on entities, and a mortar has none; nor for two local problems,
  // which are solved exactly with all shared unknowns as vertices.
  const int isBroken = space()->broken() && !primal_->isAdaptive() && all > 2;
  int isBrokenAnywhere = 0;
  Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_MAX, isBroken, Teuchos::outArg(isBrokenAnywhere));
  if (isBrokenAnywhere && computeBroken(all, isBroken)) return;
  broken_ = space();
  const PrimalChoice choice = choose();
  factor(primalRows(*broken_, choice, levels_.goesOn(all, space()->dimension())), all);
  if (primal_->isAdaptive()) countConstraints(choice.rows);
}

PrimalChoice Bddc::choose() {
  weighting_->setup(*broken_, matrix()->locals());
  return primal_->choose(*broken_, matrix()->locals(), *weighting_);
}

void Bddc::factor(std::vector<PrimalRows> rows, int locals) {
  collectively(*space()->comm(), "factoring the local problems of BDDC", [&] { factorLocals(rows); });
  std::vector<int> ids(locals_.size(), -1);
  for (std::size_t i = 0; i < locals_.size(); ++i)
    if (locals_[i]) ids[i] = locals_[i]->id();
  coarse_ = std::make_unique<BddcCoarse>(space()->comm(), space()->dimension(), ids, inverses(), std::move(rows), locals, levels_);
}

BddcCoarse::Inverses Bddc::inverses() const {
  BddcCoarse::Inverses all;
  for (const Constrained& present : present_) all.push_back(present.inverse.get());
  return all;
}

/// Sets up in the broken space. False if the mortar rows leave a local problem or the bodies as a whole loose; then every unknown named by
/// a relation of several terms becomes primal.
bool Bddc::computeBroken(int locals, bool isBrokenHere) {
  const LocalProblems& all = matrix()->locals();
  broken_ = isBrokenHere ? space()->broken() : space();
  const PrimalChoice choice = choose();
  const MortarRows mortar(*space(), *broken_, choice);
  std::vector<PrimalRows> rows = primalRows(*broken_, choice, levels_.goesOn(locals, space()->dimension()), &mortar);
  int mine = 0, any = 0;
  collectively(*space()->comm(), "looking for local problems not held by mortar constraints", [&] {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i] && all[i]->kernel().cols() > 0) {
        const Matrix told = rows[i].rows * orthonormalBasis(all[i]->kernel(), kToldMotion);
        mine = mine || nullSpace(told, kToldMotion).cols() > 0;
      }
  });
  Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  if (any) return false;
  try {
    factor(std::move(rows), locals);
  } catch (const NumericalError&) {
    return false;
  }
  if (!coarse_->isRegular(inverses())) return false;
  averaging_ = std::make_unique<MortarAveraging>(*space(), *broken_, all);
  return true;
}

/// An entity is counted on the rank of its first local problem, an unknown on its owner.
void Bddc::countConstraints(const std::vector<Matrix>& rows) {
  std::map<int, int> here;
  for (int i = 0; i < broken_->locals(); ++i) here[broken_->localId(i)] = i;
  GlobalId mine[2] = {0, 0}, all[2];
  for (std::size_t e = 0; e < rows.size(); ++e)
    if (here.count(broken_->entities()[e].sharers[0])) mine[0] += rows[e].rows();
  for (int place = 0; place < broken_->overlapSize(); ++place)
    mine[1] += broken_->sharers(place).size() > 1 && broken_->ownedRow(place) >= 0;
  Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_SUM, 2, mine, all);
  entityConstraints_ = all[0];
  sharedUnknowns_ = all[1];
}

double Bddc::bytesRead() const {
  double sum = 0.0;
  for (const Constrained& present : present_)
    if (present.inverse) sum += present.inverse->bytesRead() + present.inverse->basisBytesRead();
  return sum;
}

std::string Bddc::remark() const {
  std::ostringstream text;
  text.precision(2);
  const bool exactInstead = coarse_ && coarse_->isExactInstead();
  if (exactInstead) text << "closed pairs of more than two nodes: the coarse problem is solved exactly, without a further level";
  if (const std::string levels = coarse_ ? coarse_->remark() : std::string(); !levels.empty()) text << (exactInstead ? "; " : "") << levels;
  if (!primal_->isAdaptive()) return text.str();
  if (!text.str().empty()) text << "; ";
  text << "adaptive coarse space: " << entityConstraints_ << " edge constraints ("
       << 100.0 * static_cast<double>(entityConstraints_) / static_cast<double>(sharedUnknowns_) << " % of " << sharedUnknowns_
       << " shared unknowns) and " << coarseSize() - entityConstraints_ << " corner unknowns";
  return text.str();
}

namespace {
/// The sparse inverse; null if there is none, or if it is inaccurate (C Phi is not the identity), as with stiff and soft cells under one
/// constraint.
std::unique_ptr<LocalInverse> accurate(const LocalProblem& local, const Matrix& rows) {
  constexpr double kAccurate = 1e-4;
  std::unique_ptr<LocalInverse> made;
  try {
    made = local.sparseInverse(rows);
  } catch (const NumericalError&) {
    return nullptr;  // if the constraints are the reason, the dense inverse reports it
  }
  if (!made) return nullptr;
  const PrimalRows::Rows sparse = rows.sparseView();
  const Matrix error = sparse * made->basis() - Matrix::Identity(rows.rows(), rows.rows());
  if (error.size() > 0 && !(error.cwiseAbs().maxCoeff() < kAccurate)) return nullptr;
  return made;
}
}  // namespace

std::unique_ptr<LocalInverse> Bddc::inverseOf(const LocalProblem& local, const Matrix& rows) const {
  // Assumed number of iterations, as in the choice of Schur complements.
  constexpr double kApplications = 40.0;
  const CostModel cost(space()->dimension());
  const double b = local.size(), n = local.unknowns();
  double dense = cost.denseSeconds(b) + kApplications * cost.productSeconds(b);
  if (space()->dimension() == 3 && !local.keepsSchur()) dense += b * cost.solveSeconds(n);
  const double sparse = cost.factorFlops(n) / CostModel::kFactorRate + kApplications * cost.solveSeconds(n);
  if (kind_ == Inverses::Sparse || (kind_ == Inverses::Automatic && sparse < dense))
    if (auto made = accurate(local, rows)) return made;
  return local.inverse(rows);
}

/// Moves the rows out of `constraints`.
void Bddc::factorLocals(std::vector<PrimalRows>& constraints) {
  const LocalProblems& locals = matrix()->locals();
  locals_.resize(locals.size());
  bases_.resize(locals.size());
  present_.resize(locals.size());
  for (std::size_t i = 0; i < locals.size(); ++i) {
    Progress::count("subdomains", static_cast<long>(locals.size()));
    Constrained& present = present_[i];
    const bool known = locals_[i] && locals_[i] == locals[i] && present.inverse;
    auto rows = std::make_shared<PrimalRows::Rows>();
    rows->swap(constraints[i].rows);  // Eigen 3.4 copies sparse matrices instead of moving them
    const bool same = known && present.rows->rows() == rows->rows() && present.rows->isApprox(*rows, 0.0);
    locals_[i] = locals[i];
    if (same) continue;
    present = {rows, known ? updated(bases_[i].inverse, *bases_[i].rows, *rows) : nullptr};
    if (present.inverse) continue;
    bases_[i] = {};
    if (!locals[i]) continue;
    present.inverse = inverseOf(*locals[i], Matrix(*rows));
    bases_[i] = present;
  }
}

template <typename Each>
void Bddc::solveLocals(const MultiVector& r, const Each& each) const {
  if (!work_) work_ = std::make_unique<Work>();
  Work& work = *work_;
  const auto room = [](int rows) {
    return rows + rows % 2;
  };  // aligns each flux to Eigen's packets, so that sums do not depend on the others
  int rows = 0;
  for (std::size_t i = 0; i < locals_.size(); ++i)
    if (locals_[i]) rows += room(broken_->coupling(static_cast<int>(i)).rows());
  work.flux.resize(rows, 1);
  work.trace.resize(broken_->mostRows(), 1);
  work.own.resize(locals_.size());
  if (averaging_) {
    if (work.averaged.is_null()) work.averaged = space()->vector();
    work.averaged->assign(r);
    averaging_->applyTranspose(*work.averaged);
    broken_->gather(*work.averaged, work.overlap);
  } else {
    broken_->gather(r, work.overlap);
  }
  work.primal.setZero(coarse_->sizeHere());
  int begin = 0;
  for (std::size_t i = 0; i < locals_.size(); ++i) {
    if (!locals_[i]) continue;
    const Coupling& coupling = broken_->coupling(static_cast<int>(i));
    auto flux = work.flux.middleRows(begin, coupling.rows());
    begin += room(coupling.rows());
    coupling.restrictTo(work.overlap, flux);
    weighting_->applyTranspose(static_cast<int>(i), flux);
    present_[i].inverse->applyBasisTransposed(flux.col(0), work.own[i]);
    coarse_->addToPrimal(i, work.own[i], work.primal);
  }
  const Vector& y = coarse_->solve(work.primal);
  begin = 0;
  for (std::size_t i = 0; i < locals_.size(); ++i) {
    if (!locals_[i]) continue;
    const Coupling& coupling = broken_->coupling(static_cast<int>(i));
    auto trace = work.trace.topRows(coupling.rows());
    work.values.setZero(work.own[i].size());
    coarse_->addToValues(i, y, work.values);
    present_[i].inverse->applyWithBasis(work.flux.middleRows(begin, coupling.rows()), work.own[i], work.values, trace);
    begin += room(coupling.rows());
    each(static_cast<int>(i), trace);
  }
}

void Bddc::doApply(const MultiVector& r, MultiVector& z) const {
  if (!work_) work_ = std::make_unique<Work>();
  for (std::size_t column = 0; column < r.getNumVectors(); ++column) {
    const auto zOne = z.getVectorNonConst(column);
    Matrix& sum = work_->sum;
    sum.setZero(broken_->overlapSize(), 1);
    solveLocals(*r.getVector(column), [&](int i, auto trace) {
      weighting_->apply(i, trace);
      broken_->coupling(i).addTransposed(trace, sum);
    });
    broken_->scatterAdd(sum, *zOne);
    if (averaging_) averaging_->apply(*zOne);
  }
}

std::optional<std::vector<Vector>> Bddc::doBrokenCorrection(const MultiVector& r) const {
  std::vector<Vector> traces(locals_.size());
  solveLocals(r, [&](int i, const auto& trace) { traces[static_cast<std::size_t>(i)] = trace.col(0); });
  return traces;
}

}  // namespace suture
