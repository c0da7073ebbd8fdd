// Constraints that edges choose for themselves. Two subdomains with one edge have a theory without constants: with z the jump along the
// edge and w_i the traces,  largest eigenvalue of M^-1 S = max |P_D w|^2 / |w|^2 = largest value of the edge's pencil that is left.
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <precond/BrickScenes.hpp>
#include <precond/DensePair.hpp>
#include <precond/Preconditioners.hpp>
#include <precond/Sheets.hpp>
#include <support/Cases.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/precond/AdaptiveConstraints.hpp>

namespace suture {
namespace {

using namespace blocks;

Teuchos::RCP<Preconditioner> adaptive(const Teuchos::RCP<const InterfaceOperator>& matrix, double threshold,
                                      const std::string& weighting = "Deluxe") {
  std::ostringstream value;
  value.precision(17);
  value << threshold;
  return bddcWith(matrix, {"Weighting=" + weighting, "Edge Constraints=Adaptive", "Adaptive/Threshold=" + value.str()});
}

/// Largest number of edges of a subdomain, over all ranks.
int edgesOfASubdomain(const InterfaceSpace& space) {
  int mine = 0, all = 0;
  for (int i = 0; i < space.locals(); ++i) {
    const auto touches = [&](const InterfaceEntity& e) {
      return e.kind == EntityKind::Edge && std::count(e.sharers.begin(), e.sharers.end(), space.localId(i)) > 0;
    };
    mine = std::max(mine, int(std::count_if(space.entities().begin(), space.entities().end(), touches)));
  }
  Teuchos::reduceAll(*space.comm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  return all;
}

// |P_D w|^2 <= m^2 threshold |w|^2 with at most m edges of a subdomain: one m from the sum over its edges in P_D w, one m from its energy,
// which each of them counts.
void staysBelowItsBound(const Teuchos::RCP<const InterfaceOperator>& matrix, double threshold, const std::string& weighting, bool& success,
                        Teuchos::FancyOStream& out) {
  const auto m = adaptive(matrix, threshold, weighting);
  const DensePair pair(*matrix, *m);
  const Vector values = pair.eigenvalues();
  const double edges = edgesOfASubdomain(*matrix->space());
  out << weighting << ", threshold " << threshold << ": " << m->coarseSize() << " coarse unknowns, eigenvalues " << values(0) << " .. "
      << values(values.size() - 1) << ", bound " << edges * edges * threshold << "\n";
  TEST_COMPARE(difference(pair.m, pair.m.transpose()), <, 1e-9);
  TEST_COMPARE(values(0), >, 1.0 - 1e-7);
  TEST_COMPARE(values(values.size() - 1), <, edges * edges * threshold);
  // the bound is crude; the method is useful because it is never nearly attained
  TEST_COMPARE(values(values.size() - 1), <, 2.0 * threshold);
}

/// The edge between two subdomains without any code of the library except assembly: stiffness condensed to the seam, and from it the
/// pencil.
struct EdgeByHand {
  Vector values;  ///< eigenvalues of the pencil, ascending

  EdgeByHand(const Scene& scene, const std::string& weighting) {
    const Blocks all(scene, alone());
    std::vector<int> shared[2];
    for (int s = 0; s < 2; ++s) shared[s] = sharedDofs(*all.subdomains[s]);
    const Subdomain& first = *all.subdomains[0];
    const auto onEdge = [&](int k) {  // neither of the seam's ends, which are corners
      const double y = first.mesh().point(first.nodeOf(shared[0][k]))[1];
      return y > 1e-9 && y < 1 - 1e-9;
    };
    std::vector<int> edge, order[2];
    Matrix t[2];  // the sides condensed to the whole seam
    for (int s = 0; s < 2; ++s) t[s] = denseSchur(all.subdomains[s]->stiffness().dense(), shared[s]);
    for (std::size_t k = 0; k < shared[0].size(); ++k) {
      if (onEdge(int(k))) edge.push_back(int(k));
      if (first.globalDof(shared[0][k]) != all.subdomains[1]->globalDof(shared[1][k])) throw InternalError("the sides differ in order");
    }
    const int n = int(edge.size());
    Matrix block[2], weights[2];
    for (int s = 0; s < 2; ++s) block[s] = rowsAt(rowsAt(t[s], edge).transpose(), edge);
    for (int s = 0; s < 2; ++s) weights[s] = solveSymmetric(block[0] + block[1], block[s]);
    if (weighting == "Multiplicity") weights[0] = weights[1] = 0.5 * Matrix::Identity(n, n);
    const Matrix cost = weights[1].transpose() * block[0] * weights[1] + weights[0].transpose() * block[1] * weights[0];
    // Least energy with a given jump z, zero at the corners: min over u of (u + z).T_1 (u + z) + u.T_2 u. The clamp is on the left: T_1 and
    // the sum are regular.
    const Matrix stored = t[0] - t[0] * solveSymmetric(t[0] + t[1], t[0]);
    const Matrix least = rowsAt(rowsAt(stored, edge).transpose(), edge);
    values = eigenvalues(cost, 0.5 * (least + least.transpose()));
  }
  int above(double threshold) const { return int((values.array() > threshold).count()); }
  double largestBelow(double threshold) const {
    double largest = 1.0;
    for (const double value : values)
      if (value <= threshold) largest = std::max(largest, value);
    return largest;
  }
};

TEUCHOS_UNIT_TEST(AdaptiveConstraints, OfOneEdgeLeaveExactlyTheEigenvaluesBelowTheThreshold) {
  const Scene scene = bricks(2, 1, 9);
  const Twins t(scene);
  for (const std::string weighting : {"Deluxe", "Multiplicity"}) {
    const EdgeByHand edge(scene, weighting);
    const int corners = bddc(t.spread.linearised.matrix, "None", weighting)->coarseSize();
    TEST_EQUALITY(corners, 4);
    TEST_COMPARE(edge.values(edge.values.size() - 1), >, 100.0);  // there is something to choose
    for (const double threshold : {1.5, 3.0, 10.0, 100.0, 1000.0, 1e6}) {
      const auto m = adaptive(t.spread.linearised.matrix, threshold, weighting);
      const Vector values = DensePair(t.spread.matrix(), *m).eigenvalues();
      out << weighting << ", threshold " << threshold << ": " << m->coarseSize() - corners << " constraints, largest eigenvalue "
          << values(values.size() - 1) << " against " << edge.largestBelow(threshold) << "\n";
      TEST_EQUALITY(m->coarseSize() - corners, edge.above(threshold));
      TEST_FLOATING_EQUALITY(values(values.size() - 1), edge.largestBelow(threshold), 1e-6);
      TEST_COMPARE(values(0), >, 1.0 - 1e-8);
    }
  }
}

TEUCHOS_UNIT_TEST(AdaptiveConstraints, KeepTheSpectrumBelowAMultipleOfTheThresholdOnUnalignedBricks) {
  for (const Scene& scene : casesOf({bricks(3, 3, 5), bricks(2, 2, 7)})) {
    const Twins t(scene);
    for (const double threshold : {2.0, 5.0, 20.0}) staysBelowItsBound(t.spread.linearised.matrix, threshold, "Deluxe", success, out);
    staysBelowItsBound(t.spread.linearised.matrix, 5.0, "Stiffness Diagonal", success, out);
    // the effect of the constraints: with rigid modes the same weighting is far off
    const double rigid = DensePair(t.spread.matrix(), *bddc(t.spread.linearised.matrix, "Rigid Modes", "Deluxe")).eigenvalues().maxCoeff();
    out << "Rigid Modes " << rigid << "\n";
    TEST_COMPARE(rigid, >, 40.0);
  }
}

TEUCHOS_UNIT_TEST(AdaptiveConstraints, KeepTheSpectrumBelowAMultipleOfTheThresholdOnContactLines) {
  for (const Scene& scene :
       casesOf({turned(brickBlocks(), 0.5), turned(crossingBlocks(), 0.5), brickBlocks(), pressedBlocks(), heldOnTheLine()}, 2))
    for (const int open : {0, 5}) {
      const OnInterface one(scene, world());
      const auto matrix = one.matrix(scene, open);
      int mine = 0, contact = 0;
      for (const InterfaceEntity& edge : matrix->space()->entities()) mine += edge.contact && edge.kind == EntityKind::Edge;
      Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(contact));
      out << contact << " contact edges, of each rank that sees them\n";
      for (const double threshold : {1.5, 5.0}) staysBelowItsBound(matrix, threshold, "Deluxe", success, out);
      if (scene.mesh.regions.empty() || open > 0) continue;
      const double none = DensePair(*matrix, *bddc(matrix, "None", "Deluxe")).eigenvalues().maxCoeff();
      out << "None " << none << "\n";
      TEST_COMPARE(none, >, 20.0);
    }
}

TEUCHOS_UNIT_TEST(AdaptiveConstraints, OnContactLinesAreTheSameOnAnyNumberOfRanks) {
  const OnInterface spread(brickBlocks(), world()), single(brickBlocks(), alone());
  const auto a = spread.problem.linearise(spread.problem.initialState()).matrix;
  const auto b = single.problem.linearise(single.problem.initialState()).matrix;
  const auto contact = [](const InterfaceEntity& edge) { return edge.contact && edge.unknowns.size() > 5; };
  TEST_EQUALITY(std::count_if(b->space()->entities().begin(), b->space()->entities().end(), contact), 2);
  const auto m = adaptive(a, 3.0), other = adaptive(b, 3.0);
  TEST_EQUALITY(m->coarseSize(), other->coarseSize());
  TEST_COMPARE(difference(DensePair(*a, *m).m, DensePair(*b, *other).m), <, 1e-7);
}

// S_0, which excludes contact groups: an edge to one of them has one side, and no jump.
TEUCHOS_UNIT_TEST(AdaptiveConstraints, DoNotAskForLocalProblemsThatDoNotTakePart) {
  Scene scene = brickBlocks(4);
  scene.hold("upper_top", 1, 0.0);
  const Twins t(scene);
  const auto plain = t.spread.problem.withoutContact();
  for (const char* weighting : {"Deluxe", "Stiffness Diagonal"}) staysBelowItsBound(plain, 3.0, weighting, success, out);
  TEST_COMPARE(DensePair(*plain, *bddc(plain, "None", "Deluxe")).eigenvalues().maxCoeff(), >, 20.0);
}

/// Largest value of the pencil of the line that three sheets share, jumps against energy, without any code of the library: all traces that
/// are equal at the ends, continuous ones excluded.
Vector pencilOfSheets(const Sheets& sheets, const std::vector<Matrix>& weights) {
  const int n = int(sheets.inner.size()), all = int(sheets.schur[0].rows()), free = 3 * n + (all - n);
  std::vector<int> ends;
  for (int k = 0; k < all; ++k)
    if (std::find(sheets.inner.begin(), sheets.inner.end(), k) == sheets.inner.end()) ends.push_back(k);
  Matrix energy = Matrix::Zero(free, free), cost = Matrix::Zero(free, free);
  for (int i = 0; i < 3; ++i) {
    Matrix trace = Matrix::Zero(all, free), jump = Matrix::Zero(n, free);
    for (int k = 0; k < n; ++k) trace(sheets.inner[k], i * n + k) = 1.0;
    for (std::size_t k = 0; k < ends.size(); ++k) trace(ends[k], 3 * n + int(k)) = 1.0;
    for (int j = 0; j < 3; ++j) jump.middleCols(j * n, n) -= weights[j];
    jump.middleCols(i * n, n) += Matrix::Identity(n, n);
    energy += trace.transpose() * sheets.schur[i] * trace;
    cost += jump.transpose() * pick(sheets.schur[i], sheets.inner, sheets.inner) * jump;
  }
  return eigenvalues(cost, energy);  // two sheets are clamped: regular, since rigid motions are the same at the ends
}

// Three sharers: symmetric, definite, and no eigenvalue above the threshold, which points alone exceed by far. With one entity there is no
// constant in the bound.
TEUCHOS_UNIT_TEST(AdaptiveConstraints, KeepTheSpectrumBelowTheThresholdOnAnEdgeOfThreeSharers) {
  for (const std::string weighting : {"Deluxe", "Stiffness Diagonal"}) {
    const Sheets sheets(world());
    const auto none = bddcWith(sheets.matrix, {"Weighting=" + weighting, "Edge Constraints=None"});
    const double before = DensePair(*sheets.matrix, *none).eigenvalues().maxCoeff();
    TEST_EQUALITY(none->coarseSize(), 4);
    int last = none->coarseSize();
    for (const double threshold : {1e3, 100.0, 10.0}) {
      const auto m = adaptive(sheets.matrix, threshold, weighting);
      const DensePair pair(*sheets.matrix, *m);
      const Vector values = pair.eigenvalues();
      out << weighting << ", threshold " << threshold << ": " << m->coarseSize() << " coarse unknowns, eigenvalues " << values(0) << " .. "
          << values(values.size() - 1) << ", points alone " << before << "\n";
      TEST_COMPARE(difference(pair.m, pair.m.transpose()), <, 1e-9);
      TEST_COMPARE(values(0), >, 1.0 - 1e-7);
      TEST_COMPARE(values(values.size() - 1), <, threshold * (1 + 1e-6));
      TEST_COMPARE(m->coarseSize(), >=, last);
      last = m->coarseSize();
    }
    TEST_COMPARE(before, >, 100.0);
    if (weighting == "Deluxe") TEST_COMPARE(last, <, 16);
  }
}

// Points alone leave exactly the largest value of the pencil.
TEUCHOS_UNIT_TEST(AdaptiveConstraints, OfThreeSharersHaveThePencilOfTheJumps) {
  const Sheets sheets(world());
  const int n = int(sheets.inner.size());
  Matrix sum = Matrix::Zero(n, n);
  std::vector<Matrix> weights;
  for (const Matrix& schur : sheets.schur) sum += pick(schur, sheets.inner, sheets.inner);
  for (const Matrix& schur : sheets.schur) weights.push_back(solveSymmetric(sum, pick(schur, sheets.inner, sheets.inner)));
  const Vector values = pencilOfSheets(sheets, weights);
  const double largest = values(values.size() - 1);
  const auto none = bddcWith(sheets.matrix, {"Weighting=Deluxe", "Edge Constraints=None"});
  const double before = DensePair(*sheets.matrix, *none).eigenvalues().maxCoeff();
  out << "points alone " << before << ", pencil " << largest << "\n";
  TEST_FLOATING_EQUALITY(before, largest, 1e-5);
  TEST_EQUALITY(adaptive(sheets.matrix, largest * (1 + 1e-4))->coarseSize(), none->coarseSize());
  TEST_EQUALITY(adaptive(sheets.matrix, largest * (1 - 1e-4))->coarseSize(), none->coarseSize() + 2);  // one row for each of two jumps
}

TEUCHOS_UNIT_TEST(AdaptiveConstraints, OfThreeSharersAreTheSameOnAnyNumberOfRanks) {
  const Sheets spread(world()), single(alone());
  const auto m = adaptive(spread.matrix, 5.0), other = adaptive(single.matrix, 5.0);
  TEST_EQUALITY(m->coarseSize(), other->coarseSize());
  TEST_COMPARE(difference(DensePair(*spread.matrix, *m).m, DensePair(*single.matrix, *other).m), <, 1e-7);
}

// Aligned jumps: a sheet much stiffer or softer than the others adds no cost.
TEUCHOS_UNIT_TEST(AdaptiveConstraints, OfThreeSharersDoNotFeelAnAlignedJump) {
  std::map<double, int> sizes;
  for (const double jump : {1.0, 1e3, 1e-3, 1e6, 1e-6}) {
    const Sheets sheets(world(), 1.0, {1.0, jump, 1.0});
    const auto m = adaptive(sheets.matrix, 5.0);
    const Vector values = DensePair(*sheets.matrix, *m).eigenvalues();
    sizes[jump] = m->coarseSize();
    out << "jump " << jump << ": " << m->coarseSize() << " coarse unknowns, largest " << values.maxCoeff() << "\n";
    TEST_COMPARE(values.maxCoeff(), <, 5.0 * (1 + 1e-4));
    TEST_COMPARE(m->coarseSize(), <=, 10);
  }
}

TEUCHOS_UNIT_TEST(AdaptiveConstraints, AreNoFewerForALowerThreshold) {
  const Twins t(bricks(3, 3, 5));
  int last = 0;
  double largest = 1e300;
  for (const double threshold : {1e6, 1e3, 100.0, 20.0, 5.0, 2.0}) {
    const auto m = adaptive(t.spread.linearised.matrix, threshold);
    const double now = DensePair(t.spread.matrix(), *m).eigenvalues().maxCoeff();
    out << "threshold " << threshold << ": " << m->coarseSize() << " coarse unknowns, largest eigenvalue " << now << "\n";
    TEST_COMPARE(m->coarseSize(), >=, last);
    TEST_COMPARE(now, <, largest * (1 + 1e-6));  // eigenvectors are nested
    last = m->coarseSize();
    largest = now;
  }
}

TEUCHOS_UNIT_TEST(AdaptiveConstraints, DemandNothingWithoutAJump) {
  const Twins t(clampedSquare(3, 5));
  const auto none = bddc(t.spread.linearised.matrix, "None", "Deluxe");
  const auto m = adaptive(t.spread.linearised.matrix, 50.0);
  TEST_EQUALITY(m->coarseSize(), none->coarseSize());
  TEST_COMPARE(difference(DensePair(t.spread.matrix(), *m).m, DensePair(t.spread.matrix(), *none).m), <, 1e-11);
  // at a low threshold they equal rigid modes, or are fewer
  const auto low = adaptive(t.spread.linearised.matrix, 3.0);
  out << none->coarseSize() << " corners, " << low->coarseSize() << " coarse unknowns at 3\n";
  TEST_COMPARE(low->coarseSize(), <=, bddc(t.spread.linearised.matrix, "Rigid Modes")->coarseSize());
}

// Eigenvalues do not depend on the unit of stress.
TEUCHOS_UNIT_TEST(AdaptiveConstraints, DoNotChangeWhenAllIsStifferAlike) {
  Scene scene = bricks(2, 2, 7);
  const Twins soft(scene);
  scene.model.materialOfBody[0].young *= 1e9;
  for (Material& material : scene.model.materialOfRegion) material.young *= 1e9;
  const Twins stiff(scene);
  const auto a = adaptive(soft.spread.linearised.matrix, 5.0), b = adaptive(stiff.spread.linearised.matrix, 5.0);
  TEST_EQUALITY(a->coarseSize(), b->coarseSize());
  TEST_COMPARE(difference(1e9 * DensePair(stiff.spread.matrix(), *b).m, DensePair(soft.spread.matrix(), *a).m), <, 1e-6);
}

TEUCHOS_UNIT_TEST(AdaptiveConstraints, AreTheSameOnAnyNumberOfRanks) {
  const Twins t(bricks(3, 3, 5));
  for (const double threshold : {3.0, 30.0}) {
    const auto spread = adaptive(t.spread.linearised.matrix, threshold), single = adaptive(t.single.linearised.matrix, threshold);
    TEST_EQUALITY(spread->coarseSize(), single->coarseSize());
    TEST_COMPARE(difference(DensePair(t.spread.matrix(), *spread).m, DensePair(t.single.matrix(), *single).m), <, 1e-7);
  }
}

TEUCHOS_UNIT_TEST(AdaptiveConstraints, ThatWouldBeMostOfTheInterfaceAreRefused) {
  const Twins t(bricks(3, 3, 6));  // 12 edges of five nodes: 120 unknowns
  try {
    adaptive(t.spread.linearised.matrix, 1.0 + 1e-9);
    success = false;
    out << "not refused\n";
  } catch (const InputError& error) {
    TEST_EQUALITY(error.problems().front().path, "Preconditioner/BDDC/Adaptive/Threshold");
    TEST_ASSERT(std::string(error.what()).find("120 unknowns on edges") != std::string::npos);
    out << error.what() << "\n";
  }
}

}  // namespace
}  // namespace suture
