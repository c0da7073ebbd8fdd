#include <Teuchos_UnitTestHarness.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/subdomain/NodalAssembly.hpp>

#include <random>

namespace suture {
namespace {

// Sums of random element matrices, entry by entry.
Matrix expected(const CellBlock& mesh, int components, const ElementMatrices& matrices) {
  Matrix sum = Matrix::Zero(mesh.nodes() * components, mesh.nodes() * components);
  std::size_t next = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    const auto nodes = mesh.nodesOf(e);
    for (std::size_t b = 0; b < nodes.size() * components; ++b)
      for (std::size_t a = 0; a < nodes.size() * components; ++a)
        sum(nodes[a / components] * components + a % components, nodes[b / components] * components + b % components) += matrices[next++];
  }
  return sum;
}

void makeSymmetric(const CellBlock& mesh, int components, ElementMatrices& matrices) {
  double* next = matrices.data();
  for (int e = 0; e < mesh.elements(); ++e) {
    const auto size = static_cast<Eigen::Index>(mesh.nodesOf(e).size()) * components;
    Eigen::Map<Matrix> own(next, size, size);
    own = (own + own.transpose()).eval();
    next += size * size;
  }
}

TEUCHOS_UNIT_TEST(NodalAssembly, IsTheSumOfElementMatrices) {
  std::mt19937 generator(4);
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8, Cell::Quadrilateral9})
    for (const int components : {1, 2, 3}) {
      Box box;
      box.name = "body";
      box.nx = 4;
      box.ny = 3;
      box.cell = cell;
      const Mesh mesh = boxes({box});
      ElementMatrices matrices;
      for (int e = 0; e < mesh.elements(); ++e)
        for (std::size_t k = 0; k < mesh.nodesOf(e).size() * components * mesh.nodesOf(e).size() * components; ++k)
          matrices.push_back(generator() / 2147483647.5 - 1.0);
      makeSymmetric(mesh, components, matrices);
      const SparseMatrix sum = assembleNodal(mesh, components, matrices);
      const Matrix whole = Matrix(sum).selfadjointView<Eigen::Lower>();
      TEST_COMPARE((whole - expected(mesh, components, matrices)).norm(), <, 1e-14 * whole.norm());
      TEST_EQUALITY(Matrix(Matrix(sum).triangularView<Eigen::StrictlyUpper>()).norm(), 0.0);
      TEST_ASSERT(sum.isCompressed());
      for (int j = 0; j < sum.cols(); ++j) {  // rows ascend, as CHOLMOD requires
        int last = j - 1;
        for (SparseMatrix::InnerIterator it(sum, j); it; ++it) {
          TEST_ASSERT(it.row() > last);
          last = static_cast<int>(it.row());
        }
      }
    }
}

TEUCHOS_UNIT_TEST(NodalAssembly, OfNothingIsNothing) {
  const CellBlock none;
  TEST_EQUALITY(assembleNodal(none, 2, {}).rows(), 0);
}

TEUCHOS_UNIT_TEST(SparseMatrix, BlockIsThatOfTheDenseMatrix) {
  std::mt19937 generator(7);
  Matrix dense = Matrix::Zero(9, 9);
  for (int k = 0; k < 30; ++k) dense(generator() % 9, generator() % 9) = 1.0 + k;
  const SparseMatrix sparse = dense.sparseView();
  const std::vector<int> rows{4, 0, 8, 3}, columns{7, 2, 5, 6, 1};  // neither in order
  const SparseMatrix found = block(sparse, rows, columns);
  TEST_EQUALITY((Matrix(found) - dense(rows, columns)).norm(), 0.0);
  for (int j = 0; j < found.cols(); ++j)
    for (SparseMatrix::InnerIterator it(found, j), last = it; it; last = it, ++it) TEST_ASSERT(last.row() <= it.row());
  TEST_EQUALITY(block(sparse, {}, columns).rows(), 0);
  TEST_EQUALITY(block(sparse, rows, {}).cols(), 0);
}

}  // namespace
}  // namespace suture
