#include <suture/algebra/solvers/AmesosSolver.hpp>

#include <Amesos2.hpp>
#include <Teuchos_DefaultSerialComm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

namespace suture {

namespace {
using Crs = Tpetra::CrsMatrix<>;
using MultiVector = Tpetra::MultiVector<>;
using Map = Tpetra::Map<>;
using GO = Map::global_ordinal_type;
}  // namespace

struct AmesosSolver::Impl {
  std::string solver;
  Teuchos::RCP<const Map> map;
  Teuchos::RCP<Amesos2::Solver<Crs, MultiVector>> direct;
};

Schema AmesosSolver::schema() {
  Schema schema("Direct solvers of Amesos2 on one rank.");
  schema.oneOf("Solver", "KLU2", {"KLU2"}, "Name of the solver within Amesos2.");
  return schema;
}

AmesosSolver::AmesosSolver(const Parameters& own) : impl_(std::make_unique<Impl>()) { impl_->solver = own.get<std::string>("Solver"); }

AmesosSolver::~AmesosSolver() = default;

void AmesosSolver::doFactorise(const SparseMatrix& matrix) {
  const int n = static_cast<int>(matrix.rows());
  const Teuchos::RCP<const Comm> alone = Teuchos::rcp(new Teuchos::SerialComm<int>());
  impl_->map = Teuchos::rcp(new Map(static_cast<Tpetra::global_size_t>(n), GO(0), alone));
  Teuchos::ArrayRCP<std::size_t> counts(n);
  for (int j = 0; j < n; ++j) counts[j] = static_cast<std::size_t>(matrix.col(j).nonZeros());
  const auto crs = Teuchos::rcp(new Crs(impl_->map, counts()));
  std::vector<GO> indices;
  std::vector<double> values;
  for (int j = 0; j < n; ++j) {  // symmetric: a column is a row
    indices.clear();
    values.clear();
    for (SparseMatrix::InnerIterator it(matrix, j); it; ++it) {
      indices.push_back(it.row());
      values.push_back(it.value());
    }
    crs->insertGlobalValues(j, static_cast<int>(indices.size()), values.data(), indices.data());
  }
  crs->fillComplete();
  try {
    impl_->direct = Amesos2::create<Crs, MultiVector>(impl_->solver, crs);
    impl_->direct->symbolicFactorization().numericFactorization();
  } catch (const std::exception& error) {
    throw NumericalError("Amesos2 " + impl_->solver + " could not factor a matrix of " + std::to_string(n) + " unknowns: " + error.what());
  }
}

void AmesosSolver::doSolve(LocalView x) const {
  const auto columns = static_cast<std::size_t>(x.cols());
  const auto right = Teuchos::rcp(new MultiVector(impl_->map, columns));
  const auto left = Teuchos::rcp(new MultiVector(impl_->map, columns));
  for (std::size_t j = 0; j < columns; ++j) {
    auto data = right->getDataNonConst(j);
    for (int i = 0; i < x.rows(); ++i) data[i] = x(i, static_cast<int>(j));
  }
  impl_->direct->setX(left);
  impl_->direct->setB(right);
  impl_->direct->solve();
  for (std::size_t j = 0; j < columns; ++j) {
    const auto data = left->getData(j);
    for (int i = 0; i < x.rows(); ++i) x(i, static_cast<int>(j)) = data[i];
  }
}

}  // namespace suture
