#include <suture/algebra/CostModel.hpp>
#include <suture/algebra/UpdatedInverse.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Dense.hpp>
#include <suture/interface/Directory.hpp>
#include <suture/precond/Bddc.hpp>
#include <suture/precond/MortarRows.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace suture {

namespace {

// A row that changes takes a product with a matrix of size n, and an application reads two vectors more for it; a factorisation is worth n
// such products.
constexpr int kLeastSizeByChanges = 16;

constexpr double kToldMotion = 1e-8;  // least that constraints tell of a motion of length one
// Error of a coarse solve, in the energy of the diagonal: rounding times the scaled condition, which jumps of 1e8 leave below 1e8.
constexpr double kRegular = 1e-6;

/// The inverse under other constraints; null where it is better made anew.
std::shared_ptr<const LocalInverse> updated(const std::shared_ptr<const LocalInverse>& base, const PrimalRows::Rows& old,
                                            const PrimalRows::Rows& now) {
  const std::vector<int> from = rowsIn(old, now);
  const auto kept = static_cast<int>(from.size() - std::count(from.begin(), from.end(), -1));
  const int changes = static_cast<int>(old.rows() + now.rows()) - 2 * kept;
  if (changes * kLeastSizeByChanges > now.cols()) return nullptr;
  if (changes == 0 && std::is_sorted(from.begin(), from.end())) return base;
  return UpdatedInverse::make(base, from, Matrix(now));
}

}  // namespace

Schema Bddc::schema() {
  Schema schema(
      "Balancing domain decomposition by constraints: local problems held at corners and edge constraints, and a coarse problem of these.");
  CoarseOptions::addParameters(schema);
  schema.oneOf(
      "Local Inverses", "Automatic", {"Automatic", "Dense", "Sparse"},
      "How local problems are inverted. Dense: a matrix of the size of the boundary; Sparse: a factor of interior and boundary, the "
      "constraints through a small matrix; Automatic: for each local problem what takes less time, in the plane Dense.");
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
  Matrix overlap;
  std::vector<Matrix> flux, trace;  // flux and trace of each local problem
  std::vector<Vector> own;          // values of each local problem's primal unknowns
  Vector primal;
  MultiVectorPtr averaged;
};

Bddc::~Bddc() = default;

void Bddc::doInitialize() { coarse_.reset(); }

void Bddc::doCompute() {
  int mine = 0, all = 0;
  for (const auto& local : matrix()->locals()) mine += local != nullptr;
  Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  averaging_.reset();
  // Adaptive constraints bound the condition on entities, of which a mortar has none. Two local problems with all that they share as
  // vertices are solved exactly.
  const int isTorn = space()->torn() && !primal_->isAdaptive() && all > 2;
  int isTornAnywhere = 0;
  Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_MAX, isTorn, Teuchos::outArg(isTornAnywhere));
  if (isTornAnywhere && computeTorn(all, isTorn)) return;
  torn_ = space();
  const PrimalChoice choice = choose();
  factor(primalRows(*torn_, choice, levels_.goesOn(all)), all);
  if (primal_->isAdaptive()) countConstraints(choice.rows);
}

PrimalChoice Bddc::choose() {
  weighting_->setup(*torn_, matrix()->locals());
  return primal_->choose(*torn_, matrix()->locals(), *weighting_);
}

void Bddc::factor(std::vector<PrimalRows> rows, int locals) {
  collectively(*space()->comm(), "factoring the local problems of BDDC", [&] { factorLocals(std::move(rows)); });
  assembleCoarse(locals);
}

/// In the torn space. False where rows of the mortar leave something loose: a local problem, or bodies as a whole. Then every unknown that
/// a relation of several terms names is primal.
bool Bddc::computeTorn(int locals, bool isTornHere) {
  const LocalProblems& all = matrix()->locals();
  torn_ = isTornHere ? space()->torn() : space();
  const PrimalChoice choice = choose();
  const MortarRows mortar(*space(), *torn_, choice);
  std::vector<PrimalRows> rows = primalRows(*torn_, choice, levels_.goesOn(locals), &mortar);
  int mine = 0, any = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i] && all[i]->kernel().cols() > 0) {
      const Matrix told = rows[i].rows * orthonormalBasis(all[i]->kernel(), kToldMotion);
      mine = mine || nullSpace(told, kToldMotion).cols() > 0;
    }
  Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  if (any) return false;
  try {
    factor(std::move(rows), locals);
  } catch (const NumericalError&) {
    return false;
  }
  if (!coarseIsRegular()) return false;
  averaging_ = std::make_unique<MortarAveraging>(*space(), *torn_, all);
  return true;
}

/// True if the coarse problem gives a vector back that it was applied to: what is nothing but rounding beside the rest, and was factored
/// all the same, does not. A coarse problem of several levels says so itself.
bool Bddc::coarseIsRegular() const {
  if (coarse_->clusters() > 0 || coarse_->size() == 0) return true;
  Vector given(static_cast<int>(names_.size())), image = Vector::Zero(given.size()), diagonal = image;
  for (int k = 0; k < given.size(); ++k) given(k) = 1.0 + 0.5 * std::sin(1.0 + 7.0 * names_[k]);
  for (std::size_t i = 0; i < locals_.size(); ++i) {
    if (!locals_[i]) continue;
    const CoarseElement own = element(i);
    const std::vector<int> places = placesAmong(names_, own.unknowns);
    image(places) += own.matrix * given(places);
    diagonal(places) += own.matrix.diagonal();
  }
  const Vector error = coarse_->solve(image) - given;
  const double mine[2] = {diagonal.dot(error.cwiseAbs2()), diagonal.dot(given.cwiseAbs2())};
  double all[2];
  Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_SUM, 2, mine, all);
  return all[0] < kRegular * kRegular * all[1];
}

/// Entities where their first local problem lives, unknowns where they are owned.
void Bddc::countConstraints(const std::vector<Matrix>& rows) {
  std::map<int, int> here;
  for (int i = 0; i < torn_->locals(); ++i) here[torn_->localId(i)] = i;
  GlobalId mine[2] = {0, 0}, all[2];
  for (std::size_t e = 0; e < rows.size(); ++e)
    if (here.count(torn_->entities()[e].sharers[0])) mine[0] += rows[e].rows();
  for (int place = 0; place < torn_->overlapSize(); ++place) mine[1] += torn_->sharers(place).size() > 1 && torn_->ownedRow(place) >= 0;
  Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_SUM, 2, mine, all);
  entityConstraints_ = all[0];
  sharedUnknowns_ = all[1];
}

double Bddc::bytesRead() const {
  double sum = 0.0;
  for (const auto& inverse : inverses_)
    if (inverse) sum += inverse->bytesRead() + inverse->basisBytesRead();
  return sum;
}

std::string Bddc::remark() const {
  std::ostringstream text;
  text.precision(2);
  if (exactInstead_) text << "closed pairs of more than two nodes: the coarse problem is solved exactly, without a level more";
  if (!primal_->isAdaptive()) return text.str();
  if (exactInstead_) text << "; ";
  text << "adaptive coarse space: " << entityConstraints_ << " edge constraints ("
       << 100.0 * static_cast<double>(entityConstraints_) / static_cast<double>(sharedUnknowns_) << " % of " << sharedUnknowns_
       << " shared unknowns) and " << coarseSize() - entityConstraints_ << " corner unknowns";
  return text.str();
}

std::unique_ptr<LocalInverse> Bddc::inverseOf(const LocalProblem& local, const Matrix& rows) const {
  // Iterations that the choice reckons with, as that of Schur complements does.
  constexpr double kApplications = 40.0;
  const CostModel cost(space()->dimension());
  const double b = local.size(), n = local.unknowns();
  const double dense = cost.denseSeconds(b) + kApplications * cost.productSeconds(b);
  const double sparse = cost.factorFlops(n) / CostModel::kFactorRate + kApplications * cost.solveSeconds(n);
  if (kind_ == Inverses::Sparse || (kind_ == Inverses::Automatic && sparse < dense))
    if (auto made = local.sparseInverse(rows)) return made;
  return local.inverse(rows);
}

void Bddc::factorLocals(std::vector<PrimalRows> constraints) {
  const LocalProblems& locals = matrix()->locals();
  locals_.resize(locals.size());
  bases_.resize(locals.size());
  inverses_.resize(locals.size());
  constraints_.resize(locals.size());
  for (std::size_t i = 0; i < locals.size(); ++i) {
    const bool known = locals_[i] && locals_[i] == locals[i] && inverses_[i];
    const PrimalRows::Rows &before = constraints_[i].rows, &now = constraints[i].rows;
    const bool same = known && before.rows() == now.rows() && before.isApprox(now, 0.0);
    locals_[i] = locals[i];
    constraints_[i] = std::move(constraints[i]);
    if (same) continue;
    inverses_[i] = known ? updated(bases_[i].inverse, bases_[i].rows, constraints_[i].rows) : nullptr;
    if (inverses_[i]) continue;
    bases_[i] = {};
    if (!locals[i]) continue;
    bases_[i] = {constraints_[i].rows, inverseOf(*locals[i], Matrix(constraints_[i].rows))};
    inverses_[i] = bases_[i].inverse;
  }
}

void Bddc::assembleCoarse(int locals) {
  std::vector<GlobalId> keys;
  for (std::size_t i = 0; i < locals_.size(); ++i)
    if (locals_[i]) {
      for (const auto& row : constraints_[i].terms)
        for (const auto& term : row) keys.push_back(term.key);
      for (const auto& unknown : constraints_[i].unknowns) keys.push_back(unknown.id);
    }
  CoarseElements coarse;
  coarse.dimension = space()->dimension();
  const std::vector<int> numbers = numberKeys(space()->comm(), keys, coarse.size);
  names_ = numbers;
  std::sort(names_.begin(), names_.end());
  names_.erase(std::unique(names_.begin(), names_.end()), names_.end());
  const std::vector<int> places = placesAmong(names_, numbers);
  values_.assign(locals_.size(), {});
  std::map<int, InterfaceLayout::Unknown> unknowns;
  std::size_t next = 0;
  int mine = 0, any = 0;
  for (std::size_t i = 0; i < locals_.size(); ++i) {
    if (!locals_[i]) continue;
    for (std::size_t row = 0; row < constraints_[i].terms.size(); ++row)
      for (const auto& term : constraints_[i].terms[row]) values_[i].push_back({static_cast<int>(row), places[next++], term.coefficient});
    for (InterfaceLayout::Unknown unknown : constraints_[i].unknowns) {
      unknown.id = numbers[next++];
      unknowns.emplace(static_cast<int>(unknown.id), unknown);
    }
    coarse.elements.push_back(element(i));
    if (static_cast<int>(coarse.elements.back().unknowns.size()) > constraints_[i].rows.rows()) mine = 1;
    constraints_[i].terms = {};  // values_ has them
    constraints_[i].unknowns = {};
  }
  for (const auto& entry : unknowns) coarse.unknowns.push_back(entry.second);
  Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  // Rows of several terms name unknowns that other local problems determine. A cluster without these has motions of which its constraints
  // to other clusters tell little: the condition grows to 1e3 and beyond.
  CoarseOptions levels = levels_;
  exactInstead_ = any && levels.goesOn(locals);
  if (exactInstead_) levels.above = locals;
  coarse_ = makeCoarseSolve(space()->comm(), std::move(coarse), locals, levels);
}

/// A_i^T Phi_i^T S_i Phi_i A_i
CoarseElement Bddc::element(std::size_t i) const {
  CoarseElement made;
  made.id = locals_[i]->id();
  std::vector<int> places;
  for (const Value& value : values_[i]) places.push_back(value.place);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  for (const int place : places) made.unknowns.push_back(names_[place]);
  const Matrix& energy = inverses_[i]->energy();
  Matrix a = Matrix::Zero(energy.rows(), static_cast<int>(places.size()));
  for (const Value& value : values_[i]) {
    const auto at = std::lower_bound(places.begin(), places.end(), value.place) - places.begin();
    a(value.row, at) += value.coefficient;
  }
  made.matrix = a.transpose() * energy * a;
  return made;
}

void Bddc::doApply(const MultiVector& r, MultiVector& z) const {
  if (!work_) work_ = std::make_unique<Work>();
  Work& work = *work_;
  work.flux.resize(locals_.size());
  work.trace.resize(locals_.size());
  work.own.resize(locals_.size());
  for (std::size_t column = 0; column < r.getNumVectors(); ++column) {
    const auto zOne = z.getVectorNonConst(column);
    if (averaging_) {
      if (work.averaged.is_null()) work.averaged = space()->vector();
      work.averaged->assign(*r.getVector(column));
      averaging_->applyTranspose(*work.averaged);
      torn_->gather(*work.averaged, work.overlap);
    } else {
      torn_->gather(*r.getVector(column), work.overlap);
    }
    work.primal.setZero(static_cast<int>(names_.size()));
    for (std::size_t i = 0; i < locals_.size(); ++i) {
      if (!locals_[i]) continue;
      const Coupling& coupling = torn_->coupling(static_cast<int>(i));
      Matrix& flux = work.flux[i];
      flux.resize(coupling.rows(), 1);
      coupling.restrictTo(work.overlap, flux);
      weighting_->applyTranspose(static_cast<int>(i), flux);
      inverses_[i]->applyBasisTransposed(flux.col(0), work.own[i]);
      for (const Value& value : values_[i]) work.primal(value.place) += value.coefficient * work.own[i](value.row);
    }
    const Vector& y = coarse_->solve(work.primal);
    work.overlap.setZero();
    for (std::size_t i = 0; i < locals_.size(); ++i) {
      if (!locals_[i]) continue;
      const Coupling& coupling = torn_->coupling(static_cast<int>(i));
      Matrix& trace = work.trace[i];
      trace.resize(coupling.rows(), 1);
      inverses_[i]->apply(work.flux[i], trace);
      work.own[i].setZero();
      for (const Value& value : values_[i]) work.own[i](value.row) += value.coefficient * y(value.place);
      inverses_[i]->addBasis(work.own[i], trace.col(0));
      weighting_->apply(static_cast<int>(i), trace);
      coupling.addTransposed(trace, work.overlap);
    }
    torn_->scatterAdd(work.overlap, *zOne);
    if (averaging_) averaging_->apply(*zOne);
  }
}

}  // namespace suture
