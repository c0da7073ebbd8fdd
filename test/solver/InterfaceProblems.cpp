// The contract of InterfaceProblem, for every formulation that a scene may name.
#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_MultiVector.hpp>
#include <solver/SceneChoices.hpp>
#include <support/Cases.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>

namespace suture {
namespace {

using namespace blocks;

struct Case {
  std::string name;
  Scene scene;
};

std::vector<Case> cases() {
  return casesOf<Case>({{"inclined", turned(pressedBlocks(), 0.5)},
                        {"stacked", stackedBlocks(3)},
                        {"no contact", loadedRectangle()},
                        {"pressed", pressedBlocks()},
                        {"held on the line", heldOnTheLine()}},
                       3);
}

/// Calls `claim` with every formulation of every scene.
template <typename Claim>
void forAll(Teuchos::FancyOStream& out, const Claim& claim) {
  for (const std::string& formulation : formulations())
    for (const Case& one : cases()) {
      out << formulation << ", " << one.name << "\n";
      claim(Formulated(one.scene, world(), formulation));
    }
}

InterfaceState copyOf(const InterfaceState& state) {
  InterfaceState copy = state;
  copy.trace = Teuchos::rcp(new MultiVector(*state.trace, Teuchos::Copy));
  return copy;
}

InterfaceState moved(const InterfaceProblem& problem, const InterfaceState& state, const MultiVector& step, double length) {
  InterfaceState copy = copyOf(state);
  copy.memory.reset();
  problem.update(copy, step, length);
  return copy;
}

bool everywhere(bool here) {
  int mine = here, all = 0;
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_MIN, mine, Teuchos::outArg(all));
  return all == 1;
}

/// Product of the operator with x.
MultiVectorPtr product(const InterfaceOperator& matrix, const MultiVector& x) {
  const MultiVectorPtr y = matrix.space()->vector();
  matrix.apply(x, *y);
  return y;
}

/// The solution of a symmetric positive semidefinite system by conjugate gradients, written out.
MultiVectorPtr solved(const InterfaceOperator& matrix, const MultiVector& right) {
  const MultiVectorPtr x = matrix.space()->vector();
  MultiVector r(right, Teuchos::Copy), p(right, Teuchos::Copy);
  double rho = dot(r, r);
  const double first = rho;
  for (int k = 0; k < 4000 && rho > 1e-28 * first; ++k) {
    const MultiVectorPtr q = product(matrix, p);
    const double alpha = rho / dot(p, *q);
    x->update(alpha, p, 1.0);
    r.update(-alpha, *q, 1.0);
    const double next = dot(r, r);
    p.update(1.0, r, next / rho);
    rho = next;
  }
  return x;
}

/// A state off the solution, with all pairs closed, and the linearisation there.
struct Place {
  InterfaceState state;
  InterfaceProblem::Linearisation linear;

  Place(const InterfaceProblem& problem, double seed) : state(problem.initialState()), linear(problem.linearise(state)) {
    state = moved(problem, state, *someStep(*linear.matrix->space(), 0.003, seed), 1.0);
    linear = problem.linearise(state);
  }
};

TEUCHOS_UNIT_TEST(InterfaceProblems, AreThePapersAndThatOfTheInterface) { TEST_COMPARE(formulations().size(), >=, 2); }

TEUCHOS_UNIT_TEST(InterfaceProblems, CountTheSamePairsAndPieces) {
  for (const Case& one : cases()) {
    const Formulated first(one.scene, world(), formulations().front());
    for (const std::string& formulation : formulations()) {
      const Formulated other(one.scene, world(), formulation);
      TEST_EQUALITY(other.problem->pieces(), int(one.scene.constraints.pieces.size()));
      if (one.name != "held on the line")  // there a pair cannot change: the paper's groups count it nevertheless
        TEST_EQUALITY(other.problem->pairs(), first.problem->pairs());
    }
  }
}

TEUCHOS_UNIT_TEST(InterfaceProblems, ResidualIsMinusTheGradientOfTheEnergy) {
  forAll(out, [&](const Formulated& one) {
    const double h = 1e-6;
    for (const double seed : {1.0, 2.0, 3.0}) {
      const Place place(*one.problem, seed);
      const MultiVectorPtr step = someStep(*place.linear.matrix->space(), 1.0, 10 * seed);
      const auto here = one.problem->evaluate(place.state);
      const double ahead = one.problem->evaluate(moved(*one.problem, place.state, *step, h)).energy,
                   behind = one.problem->evaluate(moved(*one.problem, place.state, *step, -h)).energy;
      TEST_COMPARE(std::abs((ahead - behind) / (2 * h) + dot(*here.residual, *step)), <, 1e-6 * norm(*here.residual) * norm(*step));
    }
  });
}

TEUCHOS_UNIT_TEST(InterfaceProblems, LinearisationIsSymmetricAndPositive) {
  forAll(out, [&](const Formulated& one) {
    const Place place(*one.problem, 1.0);
    const InterfaceOperator& matrix = *place.linear.matrix;
    const MultiVectorPtr x = someStep(*matrix.space(), 1.0, 3.0), y = someStep(*matrix.space(), 1.0, 4.0);
    const MultiVectorPtr ax = product(matrix, *x), ay = product(matrix, *y);
    TEST_COMPARE(std::abs(dot(*ax, *y) - dot(*ay, *x)), <, 1e-12 * norm(*ax) * norm(*y));
    TEST_COMPARE(dot(*ax, *x), >, 0.0);
  });
}

TEUCHOS_UNIT_TEST(InterfaceProblems, LinearisationIsTheDerivativeOfTheResidual) {
  forAll(out, [&](const Formulated& one) {
    const double h = 1e-6;
    int compared = 0;
    for (double seed = 1.0; seed < 7.0; ++seed) {
      Place place(*one.problem, seed);
      const auto here = one.problem->evaluate(place.state);
      // If the status follows from the trace, the tangent is that of this status.
      if (here.settled) {
        place.state.status = here.next;
        place.linear = one.problem->linearise(place.state);
      }
      const MultiVectorPtr step = someStep(*place.linear.matrix->space(), 1.0, 10 * seed);
      const auto ahead = one.problem->evaluate(moved(*one.problem, place.state, *step, h)),
                 behind = one.problem->evaluate(moved(*one.problem, place.state, *step, -h));
      if (here.settled && !everywhere(here.next == ahead.next && here.next == behind.next)) continue;
      ++compared;
      const MultiVectorPtr change = product(*place.linear.matrix, *step);
      MultiVector difference(*behind.residual, Teuchos::Copy);
      difference.update(-1.0 / (2 * h), *ahead.residual, 1.0 / (2 * h));
      difference.update(-1.0, *change, 1.0);
      TEST_COMPARE(norm(difference), <, 1e-6 * norm(*change));
    }
    TEST_COMPARE(compared, >=, 2);
  });
}

// The right-hand side has the same meaning in all formulations, for any state whose status is that of its trace, with or without closed
// gaps.
TEUCHOS_UNIT_TEST(InterfaceProblems, LoadIsTheResidualOfTheState) {
  forAll(out, [&](const Formulated& one) {
    for (const double seed : {0.0, 1.0, 2.0}) {
      InterfaceState state = seed > 0.0 ? Place(*one.problem, seed).state : one.problem->initialState();
      for (int k = 0; k < 30; ++k) {  // until the status is that of the trace
        const auto value = one.problem->evaluate(state);
        if (value.changed == 0) break;
        state.memory.reset();
        state.status = value.next;
        one.problem->conform(state);
      }
      const auto value = one.problem->evaluate(state);
      const MultiVectorPtr load = one.problem->linearise(state).load;
      const double size = norm(*load);
      load->update(-1.0, *value.residual, 1.0);
      if (value.changed == 0) TEST_COMPARE(norm(*load), <, 1e-10 * size);
    }
  });
}

// F + F_g of (21), the right-hand side of the auxiliary problem.
TEUCHOS_UNIT_TEST(InterfaceProblems, LoadOfTheStartLeadsToTheSolutionOfALinearProblem) {
  for (const std::string& formulation : formulations()) {
    const Formulated one(loadedRectangle(), world(), formulation);
    const InterfaceState start = one.problem->initialState();
    const InterfaceProblem::Linearisation linear = one.problem->linearise(start);
    const InterfaceState end = moved(*one.problem, start, *solved(*linear.matrix, *linear.load), 1.0);
    TEST_COMPARE(norm(*one.problem->evaluate(end).residual), <, 1e-10 * norm(*linear.load));
  }
}

// With the residual as the right-hand side a step ends at zero residual, as long as no status changes.
TEUCHOS_UNIT_TEST(InterfaceProblems, AStepFromTheResidualEndsWithoutOne) {
  int ended = 0;
  forAll(out, [&](const Formulated& one) {
    InterfaceState state = one.problem->initialState();
    for (int k = 0; k < 30; ++k) {
      const auto value = one.problem->evaluate(state);
      if (value.changed > 0) {
        state.memory.reset();
        state.status = value.next;
        one.problem->conform(state);
      }
      const auto linear = one.problem->linearise(state);
      const auto here = one.problem->evaluate(state);
      const double before = norm(*here.residual);
      const InterfaceState end = moved(*one.problem, state, *solved(*linear.matrix, *here.residual), 1.0);
      const auto there = one.problem->evaluate(end);
      if (one.problem->differing(there.next, state.status).empty()) {
        ++ended;
        TEST_COMPARE(norm(*there.residual), <, 1e-9 * before);
        return;
      }
      state = end;
    }
  });
  TEST_COMPARE(ended, >=, int(formulations().size() * cases().size()) - 2);
}

TEUCHOS_UNIT_TEST(InterfaceProblems, StepsAddUp) {
  forAll(out, [&](const Formulated& one) {
    const Place place(*one.problem, 2.0);
    const MultiVectorPtr step = someStep(*place.linear.matrix->space(), 0.002, 5.0);
    InterfaceState whole = moved(*one.problem, place.state, *step, 1.0);
    const InterfaceState parts = moved(*one.problem, moved(*one.problem, place.state, *step, 0.25), *step, 0.75);
    const double size = norm(*whole.trace);
    whole.trace->update(-1.0, *parts.trace, 1.0);
    TEST_COMPARE(norm(*whole.trace), <, 1e-13 * size);
    const auto a = one.problem->evaluate(parts), b = one.problem->evaluate(moved(*one.problem, place.state, *step, 1.0));
    TEST_FLOATING_EQUALITY(a.energy, b.energy, 1e-11);
    TEST_ASSERT(one.problem->differing(a.next, b.next).empty());
  });
}

TEUCHOS_UNIT_TEST(InterfaceProblems, DifferingStatusesAreCountedOnce) {
  forAll(out, [&](const Formulated& one) {
    const Place place(*one.problem, 1.5);
    const auto value = one.problem->evaluate(place.state);
    TEST_ASSERT(one.problem->differing(place.state.status, place.state.status).empty());
    const std::vector<int> there = one.problem->differing(place.state.status, value.next);
    TEST_ASSERT(there == one.problem->differing(value.next, place.state.status));
    TEST_EQUALITY(int(there.size()), value.changed);
    TEST_COMPARE(value.active, <=, one.problem->pairs());
    TEST_COMPARE(value.active, >=, 0);
    TEST_ASSERT(std::is_sorted(there.begin(), there.end()) && std::adjacent_find(there.begin(), there.end()) == there.end());
  });
}

TEUCHOS_UNIT_TEST(InterfaceProblems, RecoveredStatesAreTheSameStates) {
  forAll(out, [&](const Formulated& one) {
    const Place place(*one.problem, 2.5);
    const auto value = one.problem->evaluate(place.state);
    InterfaceState here = place.state;
    if (value.settled) here.status = value.next;
    const InterfaceProblem::Recovered found = one.problem->recover(here);
    TEST_FLOATING_EQUALITY(found.energy, one.problem->evaluate(here).energy, 1e-10);
    const std::vector<Vector> interiors = one.problem->interiors(here);
    TEST_EQUALITY(interiors.size(), found.freeValues.size());
    for (std::size_t i = 0; i < interiors.size(); ++i)
      TEST_COMPARE((interiors[i] - found.freeValues[i]).norm(), <=, 1e-12 * (1e-300 + interiors[i].norm()));

    std::map<int, ContactState> mine;
    for (const PairForce& pair : found.pairs) mine[pair.id] = pair.state;
    Packer packer;
    packer.put(mine);
    std::map<int, ContactState> status;
    for (const std::string& bytes : allGather(*world(), packer.bytes()))
      for (const auto& [pair, of] : Unpacker(bytes).get<std::map<int, ContactState>>()) status[pair] = of;
    const InterfaceState again = one.problem->stateOf(found.freeValues, status);
    MultiVector difference(*again.trace, Teuchos::Copy);
    difference.update(-1.0, *here.trace, 1.0);
    TEST_COMPARE(norm(difference), <, 1e-12 * norm(*here.trace));
    TEST_ASSERT(one.problem->differing(again.status, here.status).empty());
  });
}

TEUCHOS_UNIT_TEST(InterfaceProblems, AreTheSameOnAnyNumberOfRanks) {
  for (const std::string& formulation : formulations())
    for (const Case& one : cases()) {
      out << formulation << ", " << one.name << "\n";
      const Formulated spread(one.scene, world(), formulation), single(one.scene, alone(), formulation);
      TEST_EQUALITY(spread.problem->pairs(), single.problem->pairs());
      TEST_EQUALITY(spread.problem->space()->size(), single.problem->space()->size());
      const auto a = spread.problem->evaluate(spread.problem->initialState()), b = single.problem->evaluate(single.problem->initialState());
      TEST_FLOATING_EQUALITY(a.energy, b.energy, 1e-11);
      TEST_EQUALITY(a.active, b.active);
      TEST_EQUALITY(a.changed, b.changed);
      const double mine = norm(*b.residual);
      TEST_COMPARE(std::abs(norm(*a.residual) - mine), <, 1e-11 * mine);
    }
}

TEUCHOS_UNIT_TEST(InterfaceProblems, WithoutContactIsBelowTheLinearisation) {
  forAll(out, [&](const Formulated& one) {
    const auto without = one.problem->withoutContact();
    if (without.is_null()) return;
    const InterfaceProblem::Linearisation linear = one.problem->linearise(one.problem->initialState());
    for (const double seed : {1.0, 2.0, 3.0}) {
      const MultiVectorPtr x = someStep(*one.problem->space(), 1.0, seed);
      const double part = dot(*product(*without, *x), *x);
      TEST_COMPARE(part, >=, 0.0);
      TEST_COMPARE(part, <=, dot(*product(*linear.matrix, *x), *x) * (1 + 1e-12));
    }
  });
}

TEUCHOS_UNIT_TEST(InterfaceProblems, StatesGoThroughTheFormulationUnchanged) {
  forAll(out, [&](const Formulated& one) {
    const ContactProblem* contact = one.problem->contact();
    if (!contact || one.problem->pairs() == 0) return;
    const InterfaceState start = one.problem->initialState();
    const PairStates closed = contact->statesOf(start.status);
    for (const int every : {1, 2, 3}) {
      PairStates some = closed;
      for (std::size_t i = 0; i < some.size(); ++i)
        if (i % std::size_t(every) != 0) some[i] = PairStatus::Open;
      TEST_ASSERT(contact->statesOf(contact->statusOf(some)) == some);
    }
    TEST_ASSERT(one.problem->differing(contact->statusOf(closed), start.status).empty());
  });
}

}  // namespace
}  // namespace suture
