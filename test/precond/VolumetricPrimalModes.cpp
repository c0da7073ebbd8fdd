// Stiff traces of nearly incompressible subdomains, on a subdomain whose pressures are known in closed form.
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Errors.hpp>
#include <suture/precond/EntitySides.hpp>
#include <suture/precond/VolumetricPrimalModes.hpp>

namespace suture {
namespace {

using namespace blocks;

constexpr int kBlocks = 3, kCells = 6;  // a subdomain's cells along its side

Scene square(Cell cell, double poisson) {
  Box box;
  box.nx = box.ny = kBlocks * kCells;
  box.blocksX = box.blocksY = kBlocks;
  box.cell = cell;
  Scene scene = scenes::fromBoxes({box}, 2 * (1 + poisson), poisson);  // shear modulus 1
  scene.model.materialOfBody[0].element = ElementForm::Mixed;
  scene.hold("body_left", 0, 0.0);
  scene.hold("body_left", 1, 0.0);
  return scene;
}

// Work of the constant pressure 1 and, in the second column, of pressures of alternating sign on the boundary of the square subdomain in
// the middle, by hand: the nodes' forces of four cells of side h are h/2 towards the node's corner of each.
Matrix worksOfPressures(const InterfaceSpace& space, int local) {
  const double h = 1.0 / (kBlocks * kCells);
  Matrix works = Matrix::Zero(space.coupling(local).rows(), 2);
  for (int k = 0; k < works.rows(); ++k) {
    const int place = space.coupling(local).columns()[k];
    const Point &p = space.point(place), &d = space.direction(place);
    const int x = int(std::lround(p[0] / h)) - kCells, y = int(std::lround(p[1] / h)) - kCells;
    for (const int i : {x - 1, x})
      for (const int j : {y - 1, y}) {  // the cell [i, i + 1] x [j, j + 1]
        if (i < 0 || j < 0 || i >= kCells || j >= kCells) continue;
        const double work = h / 2 * ((i < x ? 1 : -1) * d[0] + (j < y ? 1 : -1) * d[1]);
        works(k, 0) += work;
        works(k, 1) += (i + j) % 2 == 0 ? work : -work;
      }
  }
  return works;
}

// Subdomain by its column and row, with which the name of its group ends.
bool isAt(const std::string& place, const LocalProblem& local) { return local.name().find("_" + place + "'") != std::string::npos; }

// The local problem in the middle and its index among those of this rank, or null.
int middle(const Interface& one) {
  for (int i = 0; i < one.space->locals(); ++i)
    if (isAt("1_1", *one.linearised.matrix->locals()[i])) return i;
  return -1;
}

TEUCHOS_UNIT_TEST(VolumetricPrimalModes, AreTheWorkOfPressuresThatDoNoneInside) {
  for (const double poisson : {0.4999, 0.499999}) {
    const double lambda = 2 * poisson / (1 - 2 * poisson);
    const Interface one(square(Cell::Quadrilateral4, poisson), world());
    const int i = middle(one), mine = i >= 0;
    int middles = 0;
    Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(middles));
    TEST_EQUALITY(middles, 1);
    if (i < 0) continue;
    const LocalProblem& local = *one.linearised.matrix->locals()[i];
    const Matrix found = stiffTraces(local);
    TEST_EQUALITY(found.cols(), 2);
    // S >= lambda w w^T / area, and nothing else in it is large: both agree, up to the shear modulus.
    const Matrix works = worksOfPressures(*one.space, i) * (kBlocks * std::sqrt(lambda));
    const double size = works.squaredNorm();
    TEST_COMPARE(size, >, lambda);
    TEST_COMPARE((works * works.transpose() - found * found.transpose()).norm(), <, 50.0);
    const Matrix left = local.schur() - found * found.transpose();
    const Vector values = symmetricEigenpairs(left).values;
    out << "nu " << poisson << ": V of " << size << ", the rest between " << values(0) << " and " << values(values.size() - 1) << "\n";
    TEST_COMPARE(values(0), >, -1.0);
    TEST_COMPARE(values(values.size() - 1), <, 30.0);
  }
}

TEUCHOS_UNIT_TEST(VolumetricPrimalModes, OfStablePairsAreTheFluxAlone) {
  for (const Cell cell : {Cell::Triangle6, Cell::Quadrilateral9}) {
    const Interface one(square(cell, 0.499999), world());
    for (int i = 0; i < one.space->locals(); ++i) {
      const LocalProblem& local = *one.linearised.matrix->locals()[i];
      // Subdomains with a part of the free boundary can change their volume there.
      const bool enclosed = isAt("0_1", local) || isAt("1_1", local);
      TEST_EQUALITY(stiffTraces(local).cols(), enclosed ? 1 : 0);
    }
  }
}

// S of low rank, and nothing else: from the second step on fewer directions remain than were tried.
class FewStiffDirections : public LocalProblem {
 public:
  FewStiffDirections(const Matrix& directions, const Vector& stiffness)
      : LocalProblem(0, "few", std::vector<GlobalId>(std::size_t(directions.rows()))),
        schur_(directions * stiffness.asDiagonal() * directions.transpose()),
        ones_(Vector::Ones(directions.rows())) {}
  void applySchur(ConstLocalView trace, LocalView flux) const override {
    if (flux.cols() != trace.cols()) throw InternalError("as many fluxes as traces");
    flux = schur_ * trace;
  }
  Vector condensedLoad() const override { return Vector::Zero(size()); }
  double constantEnergy() const override { return 0.0; }
  const Vector& stiffnessDiagonal() const override { return ones_; }
  const Matrix& kernel() const override { return none_; }
  std::unique_ptr<LocalInverse> inverse() const override { return nullptr; }

 protected:
  Matrix doHint(const std::string& name) const override {
    return name == Hint::kShearDiagonal ? Matrix(ones_) : LocalProblem::doHint(name);
  }

 private:
  Matrix schur_, none_;
  Vector ones_;
};

TEUCHOS_UNIT_TEST(VolumetricPrimalModes, AreFoundWhereNothingElseResists) {
  for (const int n : {5, 9, 12, 40}) {
    const Matrix q =
        orthonormalBasis(Matrix::NullaryExpr(n, 3, [](Eigen::Index i, Eigen::Index j) { return std::sin(1.0 + i * (j + 2)); }), 1e-12);
    const Vector stiffness = (Vector(3) << 1e3, 1e5, 2.0).finished();  // the last is not stiff
    const Matrix traces = stiffTraces(FewStiffDirections(q, stiffness));
    const Matrix expected = q.leftCols(2) * stiffness.head(2).asDiagonal() * q.leftCols(2).transpose();
    TEST_EQUALITY(traces.cols(), 2);
    TEST_COMPARE((traces * traces.transpose() - expected).norm(), <, 1e-9 * expected.norm());
  }
}

TEUCHOS_UNIT_TEST(VolumetricPrimalModes, AddNothingToScenesThatAreNotNearlyIncompressible) {
  const Interface one(square(Cell::Quadrilateral4, 0.45), world());
  const InterfaceOperator& matrix = *one.linearised.matrix;
  const auto weighting = Registry<Weighting>::instance().make("Stiffness Diagonal", Parameters());
  weighting->setup(*one.space, matrix.locals());
  const PrimalChoice plain = MomentConstraints(MomentConstraints::First::Everywhere).choose(*one.space, matrix.locals(), *weighting);
  const PrimalChoice same = VolumetricPrimalModes(std::make_unique<MomentConstraints>(MomentConstraints::First::Everywhere))
                                .choose(*one.space, matrix.locals(), *weighting);
  TEST_ASSERT(same.rows == plain.rows && same.alone == plain.alone);
  for (const auto& local : matrix.locals()) TEST_EQUALITY(stiffTraces(*local).cols(), 0);
}

TEUCHOS_UNIT_TEST(VolumetricPrimalModes, KeepWeightedJumpsOfAnEdgeOrthogonalToThem) {
  for (const char* name : {"Stiffness Diagonal", "Deluxe"}) {
    Scene scene = square(Cell::Quadrilateral4, 0.499999);
    for (int node = 0; node < scene.mesh.nodes(); ++node)  // weights change along seams
      scene.mesh.coordinates[2 * node] +=
          0.01 * std::sin(40 * scene.mesh.coordinates[2 * node + 1] + 60 * scene.mesh.coordinates[2 * node]);
    const Interface one(scene, alone());
    const InterfaceOperator& matrix = *one.linearised.matrix;
    const auto weighting = Registry<Weighting>::instance().make(name, Parameters());
    weighting->setup(*one.space, matrix.locals());
    const PrimalChoice choice =
        Registry<PrimalConstraints>::instance().make("Rigid Modes", Parameters())->choose(*one.space, matrix.locals(), *weighting);
    const std::vector<InterfaceEntity> rest = withoutAlone(*one.space, choice.alone);
    for (std::size_t e = 0; e < rest.size(); ++e) {
      const InterfaceEntity& edge = rest[e];
      if (edge.unknowns.empty()) continue;
      const Matrix jumps = nullSpace(choice.rows[e]);
      for (const int i : edge.sharers) {  // one rank has all, by id
        const std::vector<int>& places = one.space->coupling(i).columns();
        Matrix trace = Matrix::Zero(one.space->coupling(i).rows(), jumps.cols());
        for (std::size_t k = 0; k < edge.unknowns.size(); ++k)
          trace.row(std::find(places.begin(), places.end(), edge.unknowns[k]) - places.begin()) = jumps.row(int(k));
        Matrix weighted = trace;
        weighting->apply(i, weighted);
        weighted = trace - weighted;  // the rest that the other side's average leaves here
        const double energy = (weighted.transpose() * (matrix.locals()[i]->schur() * weighted)).diagonal().maxCoeff();
        TEST_COMPARE(energy, <, 50.0);  // shear modulus 1, lambda 5e5
      }
    }
  }
}

}  // namespace
}  // namespace suture
