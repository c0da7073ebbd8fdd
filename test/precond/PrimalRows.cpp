#include <Teuchos_UnitTestHarness.hpp>
#include <interface/Interfaces.hpp>
#include <suture/precond/PrimalRows.hpp>

using namespace suture;
using namespace suture::blocks;

TEUCHOS_UNIT_TEST(PrimalRows, PrimalUnknownsMoveWithRigidBodies) {
  const Interface one(clampedSquare(3, 4), world());
  const PrimalChoice choice = automaticConstraints()->choose(*one.space, one.linearised.matrix->locals(),
                                                             *Registry<Weighting>::instance().make("Multiplicity", Parameters()));
  const std::vector<PrimalRows> all = primalRows(*one.space, choice, true);
  const double translation[2] = {0.3, -0.7}, turn = 1.9;  // about the origin
  int corners = 0, moments = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::vector<int>& places = one.space->coupling(int(i)).columns();
    Vector trace(places.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Point &p = one.space->point(places[k]), &d = one.space->direction(places[k]);
      trace(int(k)) = d[0] * (translation[0] - turn * p[1]) + d[1] * (translation[1] + turn * p[0]);
    }
    const Vector values = all[i].rows * trace;
    for (int row = 0; row < values.size(); ++row) {
      TEST_EQUALITY(int(all[i].terms[row].size()), 1);
      const auto& term = all[i].terms[row][0];
      const auto unknown = std::find_if(all[i].unknowns.begin(), all[i].unknowns.end(), [&](const auto& u) { return u.id == term.key; });
      const Point &p = unknown->point, &d = unknown->direction;
      const double moved = d[0] * (translation[0] - turn * p[1]) + d[1] * (translation[1] + turn * p[0]) + turn * unknown->moment[2];
      TEST_COMPARE(std::abs(values(row) - term.coefficient * moved), <, 1e-13);
      ++(std::abs(unknown->moment[2]) > 1e-10 ? moments : corners);
    }
    TEST_EQUALITY(all[i].rows.rows(), rank(Matrix(all[i].rows)));
  }
  if (!all.empty()) {
    TEST_COMPARE(corners, >, 0);
    TEST_COMPARE(moments, >, 0);  // every edge rotates
  }
}

TEUCHOS_UNIT_TEST(PrimalRows, FindsTheRowsThatAreTheSame) {
  Matrix old = Matrix::Zero(4, 6);
  old(0, 1) = old(1, 1) = old(2, 5) = 1.0;
  old(1, 2) = -0.5;
  old(3, 5) = 1.0;  // twice the same
  Matrix now = Matrix::Zero(5, 6);
  now(0, 5) = 1.0;
  now(1, 1) = 1.0;
  now(1, 2) = -0.25;  // another value
  now(2, 1) = 1.0;
  now(3, 3) = 1.0;  // another place
  now(4, 5) = 1.0;
  const PrimalRows::Rows a = old.sparseView(), b = now.sparseView();
  TEST_COMPARE_ARRAYS(rowsIn(a, b), (std::vector<int>{2, -1, 0, -1, 3}));
  TEST_COMPARE_ARRAYS(rowsIn(a, a), (std::vector<int>{0, 1, 2, 3}));
}
