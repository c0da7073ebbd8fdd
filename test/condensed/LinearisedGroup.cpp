#include <Teuchos_UnitTestHarness.hpp>
#include <condensed/GroupScenes.hpp>

namespace suture {
namespace {

using namespace blocks;

// The group's linear problem by a dense saddle system: boundary given, N v = g on the closed pairs. Contact nodes have Cartesian axes here.
struct Bilateral {
  Matrix schur;
  Vector load;  // condensed, gaps included

  Bilateral(const GroupOf& g, const std::vector<ContactState>& status) {
    const std::vector<int>&interior = g.group->interiorPositions(), &boundary = g.group->boundaryPositions();
    const Matrix k(g.group->stiffness());
    Vector f = Vector::Zero(k.rows());
    std::map<GlobalId, int> place;  // 2 node + component -> position
    for (std::size_t m = 0; m < g.members.size(); ++m)
      for (int i = 0; i < g.members[m]->dofs(); ++i) {
        const int at = g.group->positionsOf(int(m))[i];
        f(at) += g.members[m]->load()(i);
        place[g.members[m]->globalDof(i)] = at;
      }
    std::vector<Vector> rows;
    std::vector<double> gaps;
    for (const ContactPair& pair : g.scene.constraints.pairs)
      if (status[pair.id] != kOpen) {
        rows.emplace_back(Vector::Zero(k.rows()));
        for (int c = 0; c < 2; ++c) {
          rows.back()(place.at(2 * pair.ends[0].node + c)) += pair.normal[c];
          rows.back()(place.at(2 * pair.ends[1].node + c)) -= pair.normal[c];
        }
        gaps.push_back(pair.gap);
      }
    const int n = int(interior.size()), p = int(rows.size()), b = int(boundary.size());
    Matrix kkt = Matrix::Zero(n + p, n + p), rhs = Matrix::Zero(n + p, b + 1);
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) kkt(i, j) = k(interior[i], interior[j]);
      for (int i = 0; i < p; ++i) kkt(n + i, j) = kkt(j, n + i) = rows[i](interior[j]);
      for (int i = 0; i < b; ++i) rhs(j, i) = -k(interior[j], boundary[i]);
      rhs(j, b) = f(interior[j]);
    }
    for (int i = 0; i < p; ++i) rhs(n + i, b) = gaps[i];
    const Matrix x = solve(kkt, rhs);
    Matrix ib(n, b), bb(b, b);
    for (int j = 0; j < b; ++j) {
      for (int i = 0; i < n; ++i) ib(i, j) = k(interior[i], boundary[j]);
      for (int i = 0; i < b; ++i) bb(i, j) = k(boundary[i], boundary[j]);
    }
    schur = bb + ib.transpose() * x.topLeftCorner(n, b);
    load = rowsAt(f, boundary) - ib.transpose() * x.topRightCorner(n, 1);
  }
};

TEUCHOS_UNIT_TEST(LinearisedGroup, EqualsTheDenseBilateralGroup) {
  for (const char* solver : {"CHOLMOD", "Amesos2"}) {
    const GroupOf g(wavyBlocks(), solver);
    for (const std::vector<ContactState>& status :
         {g.status(kClosed), g.status(kOpen), {kOpen, kClosed, kClosed, kOpen, kOpen, kClosed, kOpen}}) {
      const LinearisedGroup group(9, *g.group, status);
      const Bilateral expected(g, status);
      TEST_COMPARE(difference(schurOf(group), expected.schur), <, 1e-11);
      TEST_COMPARE(difference(group.condensedLoad(), expected.load), <, 1e-11);
    }
  }
}

TEUCHOS_UNIT_TEST(LinearisedGroup, TangentAgreesWithFiniteDifferences) {
  const GroupOf g(wavyBlocks());
  int compared = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Vector u = 0.05 * random(g.size(), 1, seed).col(0), d = random(g.size(), 1, seed + 50).col(0);
    const double h = 1e-5;
    const auto ahead = g.respond(u + h * d), behind = g.respond(u - h * d), at = g.respond(u);
    if (ahead.status != at.status || behind.status != at.status) continue;
    const LinearisedGroup tangent(9, *g.group, at.status);
    Matrix flux(g.size(), 1);
    tangent.applySchur(d, flux);
    TEST_COMPARE(difference(flux, (ahead.flux - behind.flux) / (2 * h)), <, 1e-8);
    // piecewise linear: the linear problem of the state itself gives the flux
    tangent.applySchur(u, flux);
    TEST_COMPARE(difference(flux - tangent.condensedLoad(), at.flux), <, 1e-10);
    ++compared;
  }
  TEST_COMPARE(compared, >=, 4);
}

TEUCHOS_UNIT_TEST(LinearisedGroup, LiesBetweenZeroAndTheBilateralGroup) {
  const GroupOf g(wavyBlocks());
  const Matrix closed = schurOf(LinearisedGroup(9, *g.group, g.status(kClosed)));
  const std::vector<ContactState> some{kOpen, kClosed, kClosed, kOpen, kOpen, kClosed, kOpen};
  for (const auto& status : {some, g.status(kOpen)}) {
    const Matrix tangent = schurOf(LinearisedGroup(9, *g.group, status));
    TEST_COMPARE(difference(tangent, tangent.transpose()), <, 1e-12);
    TEST_COMPARE(eigenvalues(tangent)(0), >, -1e-12 * closed.norm());
    TEST_COMPARE(eigenvalues(closed - tangent)(0), >, -1e-12 * closed.norm());
    TEST_COMPARE((closed - tangent).norm(), >, 1e-3 * closed.norm());
  }
}

TEUCHOS_UNIT_TEST(LinearisedGroup, KnowsItsKernel) {
  const GroupOf g(wavyBlocks());
  const std::vector<ContactState> one{kOpen, kOpen, kOpen, kClosed, kOpen, kOpen, kOpen};
  const std::vector<std::pair<std::vector<ContactState>, int>> cases{{g.status(kClosed), 4}, {one, 5}, {g.status(kOpen), 6}};
  for (const auto& [status, expected] : cases) {
    const LinearisedGroup group(9, *g.group, status);
    TEST_EQUALITY(group.kernel().cols(), expected);
    const Matrix s = schurOf(group);
    TEST_COMPARE((s * group.kernel()).norm(), <, 1e-12 * s.norm() * group.kernel().norm());
    const Vector values = eigenvalues(s);
    TEST_COMPARE(values(expected - 1), <, 1e-12 * s.norm());
    TEST_COMPARE(values(expected), >, 1e-5 * s.norm());
    const Matrix& modes = group.hint(Hint::kCoarseModes);
    TEST_EQUALITY(modes.cols(), 3 * 4 + expected);  // all rigid modes of all members, and the kernel
    TEST_EQUALITY(difference(modes.rightCols(expected), group.kernel()), 0.0);
  }
}

TEUCHOS_UNIT_TEST(LinearisedGroup, TheLocalInverseSolvesBalancedFluxes) {
  Scene held = wavyBlocks();
  held.hold("lower_left", 0, 0.0);
  for (const Scene& scene : {wavyBlocks(), held}) {
    const GroupOf g(scene);
    for (const std::vector<ContactState>& status :
         {g.status(kClosed), g.status(kOpen), {kOpen, kClosed, kClosed, kOpen, kOpen, kClosed, kOpen}}) {
      const LinearisedGroup group(9, *g.group, status);
      const int n = group.size();
      Matrix f = random(n, 3), trace(n, 3);
      const Matrix& z = group.kernel();
      f = withoutSpan(z, f);
      const auto inverse = group.inverse();
      inverse->apply(f, trace);
      TEST_COMPARE(difference(schurOf(group) * trace, f), <, 1e-10);
      Matrix whole(n, n);
      inverse->apply(Matrix::Identity(n, n), whole);
      TEST_COMPARE(difference(whole, whole.transpose()), <, 1e-10);
      TEST_COMPARE(eigenvalues(whole)(0), >, -1e-10 * whole.norm());
    }
  }
}

}  // namespace
}  // namespace suture
