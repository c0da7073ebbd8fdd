#include <Teuchos_UnitTestHarness.hpp>
#include <condensed/GroupScenes.hpp>
#include <suture/condensed/ContactCompliance.hpp>

namespace suture {
namespace {

using namespace blocks;

// Two chains of springs with random stiffness, tied to the ground if requested, and pairs between them: v_i - v_j <= g.
struct Chains {
  static constexpr int each = 6;
  SparseMatrix k;
  Matrix kernel;
  ContactRows rows;
  std::unique_ptr<GeneralisedInverse> inverse;
  std::unique_ptr<ContactCompliance> contact;

  Chains(int pairs, bool groundA, bool groundB, unsigned seed) {
    const Matrix stiffness = random(2 * each, each, seed).cwiseAbs();
    std::vector<Eigen::Triplet<double>> entries;
    for (int chain = 0; chain < 2; ++chain)
      for (int i = 0; i < each; ++i)
        for (int j = 0; j < i; ++j) {
          const int a = each * chain + i, b = each * chain + j;
          const double spring = 0.05 + stiffness(a, j);
          entries.insert(entries.end(), {{a, a, spring}, {b, b, spring}, {a, b, -spring}, {b, a, -spring}});
        }
    if (groundA) entries.emplace_back(0, 0, 0.7);
    if (groundB) entries.emplace_back(each, each, 0.4);
    k.resize(2 * each, 2 * each);
    k.setFromTriplets(entries.begin(), entries.end());
    kernel = Matrix::Zero(2 * each, int(!groundA) + int(!groundB));
    if (!groundA) kernel.col(0).head(each).setOnes();
    if (!groundB) kernel.col(kernel.cols() - 1).tail(each).setOnes();

    rows.rows.resize(pairs, 2 * each);
    rows.gap = 0.5 * random(pairs, 1, seed + 100).col(0);  // gaps and interference
    for (int p = 0; p < pairs; ++p) {
      rows.pairIds.push_back(p);
      rows.pressed.push_back(PairStatus::Slip);
      rows.rows.insert(p, p % each) = 1.0;
      rows.rows.insert(p, each + (p + p / each) % each) = -1.0;
    }
    inverse = std::make_unique<GeneralisedInverse>(k, kernel, range(2 * each), localSolver(), "chains");
    contact = std::make_unique<ContactCompliance>(*inverse, rows);
  }

  // Loads that some pair forces can balance, so that there is an equilibrium.
  Vector load(unsigned seed) const {
    Vector b = random(2 * each, 1, seed).col(0);
    if (kernel.cols() > 0) b = withoutSpan(kernel, b);
    return b + rows.rows.transpose() * random(rows.size(), 1, seed + 50).col(0).cwiseAbs();
  }

  struct Best {
    Vector v, force;
    double energy = 1e300;
  };
  // min v.K v / 2 - b.v over N v <= g: of all 2^p sets of closed pairs, those whose equality problem has forces and gaps >= 0.
  Best bruteForce(const Vector& b) const {
    const Matrix n(rows.rows), dense(k);
    Best best;
    for (int set = 0; set < (1 << rows.size()); ++set) {
      std::vector<int> closed;
      for (int p = 0; p < rows.size(); ++p)
        if (set >> p & 1) closed.push_back(p);
      const int m = 2 * each, a = int(closed.size());
      Matrix kkt = Matrix::Zero(m + a, m + a);
      Vector rhs(m + a);
      kkt.topLeftCorner(m, m) = dense;
      kkt.bottomLeftCorner(a, m) = rowsAt(n, closed);
      kkt.topRightCorner(m, a) = rowsAt(n, closed).transpose();
      rhs << b, rowsAt(rows.gap, closed);
      const Vector x = leastSquares(kkt, rhs);
      if ((kkt * x - rhs).norm() > 1e-9 || (a > 0 && x.tail(a).minCoeff() < -1e-9)) continue;
      const Vector v = x.head(m);
      if ((n * v - rows.gap).maxCoeff() > 1e-9) continue;
      const double energy = 0.5 * v.dot(dense * v) - b.dot(v);
      if (energy > best.energy - 1e-12) continue;
      best.energy = energy;
      best.v = v;
      best.force = Vector::Zero(rows.size());
      for (int i = 0; i < a; ++i) best.force(closed[i]) = x(m + i);
    }
    return best;
  }
};

TEUCHOS_UNIT_TEST(ContactCompliance, FindsWhatEnumerationOfAllActiveSetsFinds) {
  int mixed = 0, cases = 0;
  for (int pairs : {1, 3, 6, 8})
    for (int ground = 0; ground < 4; ++ground)
      for (unsigned seed = 1; seed <= 6; ++seed) {
        const Chains chains(pairs, ground & 1, ground & 2, seed);
        const Vector b = chains.load(seed + 10);
        const Chains::Best best = chains.bruteForce(b);
        TEST_COMPARE(best.energy, <, 1e299);
        const auto alternating = [&](int p) { return (p + int(seed)) % 2 ? kOpen : kClosed; };
        for (int start = 0; start < 3; ++start) {
          std::vector<ContactState> status(pairs, start == 0 ? kClosed : kOpen);
          if (start == 2)
            for (int p = 0; p < pairs; ++p) status[p] = alternating(p);
          Matrix v = b;
          const ContactCompliance::State state = chains.contact->solve(v, status);
          const double energy = 0.5 * v.col(0).dot(chains.k * v.col(0)) - b.dot(v.col(0));
          TEST_FLOATING_EQUALITY(energy, best.energy, 1e-9);
          TEST_COMPARE((state.force - best.force).norm(), <, 1e-9 * (1 + best.force.norm()));
          const Vector gap = chains.rows.gap - chains.rows.rows * v.col(0);
          TEST_COMPARE(gap.minCoeff(), >, -1e-10);
          TEST_COMPARE(state.force.minCoeff(), >, -1e-10);
          int closed = 0;
          for (int p = 0; p < pairs; ++p) {
            if (state.status[p] == kOpen)
              TEST_EQUALITY(state.force(p), 0.0)
            else
              TEST_COMPARE(std::abs(gap(p)), <, 1e-10);
            closed += state.status[p] != kOpen;
          }
          TEST_COMPARE((chains.k * v.col(0) + chains.rows.rows.transpose() * state.force - b).norm(), <, 1e-9);
          mixed += closed > 0 && closed < pairs;
          ++cases;
        }
      }
  TEST_COMPARE(mixed, >, cases / 4);  // otherwise the cases would prove little
}

TEUCHOS_UNIT_TEST(ContactCompliance, ReportsABodyThatIsPushedAway) {
  const Chains chains(4, true, false, 3);
  Matrix v = Matrix::Zero(2 * Chains::each, 1);
  v.bottomRows(Chains::each).setOnes();  // the pairs say v_A - v_B <= g: the floating B is pulled off
  TEST_THROW(chains.contact->solve(v, std::vector<ContactState>(4, kClosed)), NumericalError);
  v.bottomRows(Chains::each).setConstant(-1.0);  // and pushed on
  TEST_NOTHROW(chains.contact->solve(v, std::vector<ContactState>(4, kOpen)));
}

TEUCHOS_UNIT_TEST(ContactCompliance, ClosedPairsKeepTheirGapsAndBalance) {
  for (int ground = 0; ground < 4; ++ground) {
    const Chains chains(6, ground & 1, ground & 2, 5);
    const std::vector<ContactState> status{kClosed, kOpen, kClosed, kClosed, kOpen, kClosed};
    const ContactCompliance::Closed closed(*chains.contact, status);
    const int left = ground == 0 ? 1 : 0;  // both floating: they move together
    TEST_EQUALITY(closed.kernel().cols(), left);
    Matrix b = random(2 * Chains::each, 3);
    if (left > 0) b.rowwise() -= b.colwise().mean();
    for (double gaps : {0.0, 1.0}) {
      Matrix v = b, force;
      closed.solve(v, gaps, &force);
      const Matrix n(chains.rows.rows);
      for (int p = 0; p < 6; ++p)
        for (int c = 0; c < 3; ++c) {
          if (status[p] == kOpen)
            TEST_EQUALITY(force(p, c), 0.0)
          else
            TEST_COMPARE(std::abs(n.row(p).dot(v.col(c)) - gaps * chains.rows.gap(p)), <, 1e-13);
        }
      TEST_COMPARE((chains.k * v + n.transpose() * force - b).norm(), <, 1e-11);
    }
    if (left > 0) {
      TEST_COMPARE((chains.k * closed.kernel()).norm(), <, 1e-13);
      TEST_COMPARE((rowsAt(Matrix(chains.rows.rows), {0, 2, 3, 5}) * closed.kernel()).norm(), <, 1e-13);
    }
  }
}

TEUCHOS_UNIT_TEST(ContactCompliance, TheConstrainedInverseIsSymmetricAndPositive) {
  for (int ground = 0; ground < 4; ++ground) {
    const Chains chains(5, ground & 1, ground & 2, 2);
    const ContactCompliance::Closed closed(*chains.contact, {kClosed, kClosed, kOpen, kClosed, kOpen});
    Matrix v = Matrix::Identity(2 * Chains::each, 2 * Chains::each);
    closed.solve(v, 0.0);
    TEST_COMPARE(difference(v, v.transpose()), <, 1e-12);
    TEST_COMPARE(eigenvalues(v)(0), >, -1e-12 * v.norm());
  }
}

TEUCHOS_UNIT_TEST(ContactCompliance, FourMotionsAreLeftToTwoBodiesGluedOnAStraightLine) {
  std::vector<Box> all(2);  // one subdomain per body: the group is everything
  all[0].name = "lower";
  all[1].name = "upper";
  all[0].y0 = -1;
  all[0].y1 = 0;
  Scene scene = scenes::fromBoxes(all, 1e9);
  scene.pairUp();
  const GroupOf two(scene);
  TEST_EQUALITY(two.size(), 0);
  TEST_EQUALITY(two.group->rigidKernel(false).cols(), 6);
  const ContactCompliance::Closed closed(two.group->floating(), two.status(kClosed));
  TEST_EQUALITY(closed.kernel().cols(), 4);  // translations of both along the line, a common one across, a common rotation
  TEST_COMPARE((two.group->stiffness() * closed.kernel()).norm(), <, 1e-13 * two.group->stiffness().norm() * closed.kernel().norm());
  TEST_COMPARE((two.group->rows().rows * closed.kernel()).norm(), <, 1e-12 * closed.kernel().norm());
  TEST_EQUALITY(rank(closed.kernel()), 4);
  TEST_EQUALITY(ContactCompliance::Closed(two.group->floating(), two.status(kOpen)).kernel().cols(), 6);
}

}  // namespace
}  // namespace suture
