// Constraints that subdomains of BDDC share: points, rows on edges, and the constraints of each local problem built from them.
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <interface/DenseSpace.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/precond/EntitySides.hpp>
#include <suture/precond/PrimalRows.hpp>

namespace suture {
namespace {

using namespace blocks;

PrimalChoice choiceOf(const std::string& name, const InterfaceOperator& matrix) {
  const auto weighting = Registry<Weighting>::instance().make("Multiplicity", Parameters());
  weighting->setup(*matrix.space(), matrix.locals());
  return Registry<PrimalConstraints>::instance().make(name, Parameters())->choose(*matrix.space(), matrix.locals(), *weighting);
}

Matrix projector(const Matrix& columns) {
  const Matrix basis = orthonormalBasis(columns, 1e-8);
  return basis * basis.transpose();
}

// Rows are orthonormal, and span these columns.
void span(const Matrix& rows, const Matrix& columns, bool& success, Teuchos::FancyOStream& out) {
  TEST_COMPARE((rows * rows.transpose() - Matrix::Identity(rows.rows(), rows.rows())).norm(), <, 1e-13);
  TEST_COMPARE((rows.transpose() * rows - projector(columns)).norm(), <, 1e-12);
}

// Translations and the rotation about the origin, of an edge's unknowns.
Matrix motions(const InterfaceSpace& space, const InterfaceEntity& edge) {
  Matrix columns(int(edge.unknowns.size()), 3);
  for (int i = 0; i < columns.rows(); ++i) {
    const Point d = space.direction(edge.unknowns[i]), p = space.point(edge.unknowns[i]);
    columns.row(i) << d[0], d[1], d[1] * p[0] - d[0] * p[1];
  }
  return columns;
}

// Two ranks that describe an edge have the same rows for it.
void sameOnAllRanks(const InterfaceSpace& space, const PrimalChoice& choice, bool& success, Teuchos::FancyOStream& out) {
  Packer packer;
  for (std::size_t e = 0; e < choice.rows.size(); ++e) {
    std::vector<GlobalId> key(space.entities()[e].sharers.begin(), space.entities()[e].sharers.end());
    key.push_back(space.id(space.entities()[e].unknowns[0]));
    packer.put(key);
    packer.put(std::vector<double>(choice.rows[e].data(), choice.rows[e].data() + choice.rows[e].size()));
  }
  std::map<std::vector<GlobalId>, std::vector<double>> known;
  for (const std::string& bytes : allGather(*world(), packer.bytes())) {
    Unpacker unpacker(bytes);
    while (!unpacker.done()) {
      const auto key = unpacker.get<std::vector<GlobalId>>();
      const auto values = unpacker.get<std::vector<double>>();
      TEST_ASSERT(known.emplace(key, values).first->second == values);
    }
  }
}

TEUCHOS_UNIT_TEST(PrimalConstraints, HoldTheMotionsThatTheirNamesSayOnSeams) {
  for (const Scene& scene : {square(3, 4), turned(clampedSquare(2, 3), 0.7), square(2, 2)}) {
    const Twins t(scene);
    const InterfaceSpace& space = *t.spread.space;
    const PrimalChoice none = choiceOf("None", t.spread.matrix()), averages = choiceOf("Averages", t.spread.matrix()),
                       all = choiceOf("Rigid Modes", t.spread.matrix());
    TEST_ASSERT(none.alone == verticesAndEnds(space) && averages.alone == none.alone && all.alone == none.alone);
    const std::vector<InterfaceEntity> rest = withoutAlone(space, all.alone);
    TEST_EQUALITY(all.rows.size(), space.entities().size());
    for (std::size_t e = 0; e < rest.size(); ++e) {
      const InterfaceEntity& edge = rest[e];
      TEST_EQUALITY(edge.unknowns.empty(), edge.kind == EntityKind::Vertex);
      if (edge.unknowns.empty()) continue;
      const Matrix columns = motions(space, edge);
      TEST_EQUALITY(none.rows[e].rows(), 0);
      TEST_EQUALITY(averages.rows[e].rows(), 2);
      TEST_EQUALITY(all.rows[e].rows(), edge.unknowns.size() > 2 ? 3 : 2);  // a single node has no rotation
      span(averages.rows[e], columns.leftCols(2), success, out);
      span(all.rows[e], edge.unknowns.size() > 2 ? columns : Matrix(columns.leftCols(2)), success, out);
    }
    sameOnAllRanks(space, all, success, out);
  }
}

TEUCHOS_UNIT_TEST(PrimalConstraints, HoldAverageAndFirstMomentOnContactLines) {
  const OnInterface one(pressedBlocks(), world());
  const auto matrix = one.problem.linearise(one.problem.initialState()).matrix;
  const InterfaceSpace& space = *matrix->space();
  const PrimalChoice averages = choiceOf("Averages", *matrix), all = choiceOf("Rigid Modes", *matrix);
  const std::vector<InterfaceEntity> rest = withoutAlone(space, all.alone);
  int contact = 0;
  for (std::size_t e = 0; e < rest.size(); ++e) {
    const InterfaceEntity& edge = rest[e];
    if (!edge.contact || edge.unknowns.empty()) continue;
    ++contact;
    Matrix moments(int(edge.unknowns.size()), 2);
    for (int i = 0; i < moments.rows(); ++i) moments.row(i) << 1.0, space.point(edge.unknowns[i])[0];  // the line is y = 0
    span(averages.rows[e], moments.leftCols(1), success, out);
    span(all.rows[e], moments, success, out);
  }
  TEST_EQUALITY(contact > 0, space.locals() > 0);
  sameOnAllRanks(space, all, success, out);
}

// For any trace of the space, neighbours must agree on the value of every primal unknown: this makes M^-1's traces continuous there.
TEUCHOS_UNIT_TEST(PrimalConstraints, PrimalUnknownsHaveOneValueForAllWhoShareThem) {
  for (const Scene& scene : {clampedSquare(3, 4), pressedBlocks(), heldOnTheLine(), turned(crossingBlocks(), 0.5)})
    for (const int open : {0, 3}) {
      const OnInterface one(scene, world());
      const auto matrix = one.matrix(scene, open);
      const InterfaceSpace& space = *matrix->space();
      const DenseSpace all(space);
      Matrix trace;
      space.gather(*all.vector(random(all.size(), 1, 6)), trace);
      const auto constraints = primalRows(space, choiceOf("Rigid Modes", *matrix), false);
      Packer packer;
      int multiple = 0;
      std::vector<std::pair<std::vector<PrimalRows::Term>, double>> several;
      for (int i = 0; i < space.locals(); ++i) {
        Matrix own(space.coupling(i).rows(), 1);
        space.coupling(i).restrictTo(trace, own);
        const Vector values = constraints[i].rows * own.col(0);
        TEST_EQUALITY(constraints[i].rows.rows(), int(constraints[i].terms.size()));
        // rows are independent, otherwise a local problem could not satisfy them
        if (values.size() > 0) TEST_EQUALITY(orthonormalBasis(Matrix(constraints[i].rows.transpose()), 1e-10).cols(), values.size());
        for (int r = 0; r < values.size(); ++r) {
          const auto& terms = constraints[i].terms[r];
          if (terms.empty())
            TEST_EQUALITY(values(r), 0.0)
          else if (terms.size() == 1) {
            packer.put(terms[0].key);
            packer.put(values(r) / terms[0].coefficient);
          } else {
            several.emplace_back(terms, values(r));
            ++multiple;
          }
        }
      }
      std::map<GlobalId, double> known;
      int compared = 0;
      for (const std::string& bytes : allGather(*world(), packer.bytes())) {
        Unpacker unpacker(bytes);
        while (!unpacker.done()) {
          const auto key = unpacker.get<GlobalId>();
          const auto value = unpacker.get<double>();
          const auto at = known.emplace(key, value);
          if (at.second) continue;
          ++compared;
          TEST_COMPARE(std::abs(at.first->second - value), <, 1e-13);
        }
      }
      TEST_COMPARE(compared, >=, int(known.size()) / 2);
      for (const auto& [terms, value] : several) {
        double sum = 0.0;
        for (const auto& term : terms) sum += term.coefficient * known.at(term.key);
        TEST_COMPARE(std::abs(sum - value), <, 1e-12);
      }
      out << "one open of every " << open << ": " << known.size() << " primal unknowns, " << multiple << " rows of several here\n";
    }
}

// The subdomain in the middle of 3 x 3: four corners of two components, four edges of three motions.
TEUCHOS_UNIT_TEST(PrimalConstraints, CountOfPrimalConstraintsByHand) {
  const Twins t(square(3, 4));
  const std::map<std::string, int> perEdge{{"None", 0}, {"Averages", 2}, {"Rigid Modes", 3}};
  for (const auto& [name, count] : perEdge)
    for (const bool withUnknowns : {false, true}) {
      const auto constraints = primalRows(*t.spread.space, choiceOf(name, t.spread.matrix()), withUnknowns);
      int mine = 0, middles = 0;
      for (int i = 0; i < t.spread.space->locals(); ++i) {
        if (t.spread.matrix().locals()[i]->name().find("_1_1'") == std::string::npos) continue;
        ++mine;
        TEST_EQUALITY(constraints[i].rows.rows(), 4 * 2 + 4 * count);
        TEST_EQUALITY(constraints[i].unknowns.size(), withUnknowns ? std::size_t(4 * 2 + 4 * count) : 0);
      }
      Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(middles));
      TEST_EQUALITY(middles, 1);
    }
}

}  // namespace
}  // namespace suture
