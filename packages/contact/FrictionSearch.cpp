#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/contact/FrictionSearch.hpp>
#include <suture/contact/PadProblem.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

constexpr int kBlockSteps = 3;        // steps that change all violated pairs without reducing their number
constexpr double kTurned = 1.0;       // turn(), relative to the tolerance of forces, that counts as zero
constexpr double kSharper = 0.1;      // accuracy of the next solve, relative to the turn in the current one
constexpr double kForcing = 0.1;      // accuracy of the next solve, relative to the distance from the laws
constexpr double kNearer = 0.25;      // factor on that squared distance that counts as progress for any number of violated pairs
constexpr double kMuchSharper = 0.5;  // change of the accuracy after which earlier solutions are not comparable
constexpr int kHalvings = 8;          // maximum number of halvings of a descent step
constexpr int kRises = 3;             // descent steps that do not reduce the distance from the laws
constexpr double kLeastFall = 1e-4;   // least relative decrease of that distance, per unit step
constexpr int kNewtonSolves = 30;     // solves before the fallbacks
constexpr int kTrescaSolves = 1;      // solves of the first Tresca problem, which is only a guess

}  // namespace

/// Newton steps from states_ until the laws agree with the solution to the tolerance `last`. If states do not change, the next solve is
/// more accurate; if states change in an accurate solution, the tolerance goes back to the geometric mean of the loosest one and `last`.
FrictionSearch::End FrictionSearch::settle(double last) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::size_t fewest = kNone;  // least number of violated pairs
  int patience = patience_;
  Way way = Way::Block;
  std::vector<PairStates> seen;
  const auto progress = [&](std::size_t violated) {  // progress was made: all pairs may change at once
    fewest = violated;
    patience = patience_;
    way = Way::Block;
    seen.clear();
  };
  nearest_ = std::numeric_limits<double>::infinity();
  while (true) {
    if (left_-- <= 0 || !oracle_.goesOn()) return End::Exhausted;
    ++solves_;
    FrictionAnswer answer = oracle_.solve(states_, tolerance_);
    if (!answer.solved) return End::Failed;
    answer_ = std::move(answer);
    ++answers_;
    PairStates next = projected(states_, answer_);
    violated_.clear();
    double turns = 0.0;
    bool driven = false;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (states_[i].status == next[i].status)
        turns = std::max(turns, turn(i, next[i]));
      else if (holders_[i])
        driven = true;
      else
        violated_.push_back(static_cast<int>(i));
    }
    if (violated_.empty() && turns <= kTurned) {
      // A pair that has been sticking since the start does not have a bound yet.
      for (std::size_t i = 0; i < next.size(); ++i)
        if (states_[i].status == PairStatus::Stick && next[i].status == PairStatus::Stick) states_[i] = next[i];
      if (driven && tolerance_ <= last) {  // other pairs may hold the body
        if (outdone_.size() == 0) outdone_ = outdone();
        if (!relieve(next)) return End::Slides;
        tolerance_ = oracle_.loosest();
        nearest_ = std::numeric_limits<double>::infinity();
        progress(kNone);
        continue;
      }
      if (tolerance_ <= last) return End::Settled;
      // The remaining Newton steps only turn directions: not all of them need be accurate.
      const double between = std::max(last, std::sqrt(last * oracle_.loosest()));
      const bool turning = std::any_of(states_.begin(), states_.end(), [](const ContactState& state) { return state.across > 0.0; });
      tolerance_ = turning && tolerance_ > between ? between : last;
      ++left_;
      progress(kNone);
      continue;
    }
    const double own = violation(answer_.force, answer_.jump);
    const bool nearer = own < kNearer * nearest_;
    if (way != Way::Descent && own < nearest_) {
      nearest_ = own;
      force_ = answer_.force;
      jump_ = answer_.jump;
    }
    if (violated_.empty()) {
      // Newton steps turn directions with increasing accuracy; only the last needs an accurate solve.
      tolerance_ = std::max(last, std::min(tolerance_, kSharper * turns * tolerance_));
    } else {
      // The accuracy of states is limited by the distance from the laws, and that of solves follows it.
      const double between = std::max(last, std::sqrt(last * oracle_.loosest())), before = tolerance_;
      if (const double size = answer_.force.norm(); size > 0.0 && tolerance_ > between)
        tolerance_ = std::clamp(kForcing * std::sqrt(own) / size, between, tolerance_);
      if (tolerance_ <= last) tolerance_ = between;
      if (way == Way::Descent) {
        if (!descend(next)) {
          way = Way::Single;
          seen.clear();
        }
      } else if (violated_.size() < fewest || (way == Way::Block && nearer)) {
        progress(std::min(fewest, violated_.size()));
      } else if (const bool again = std::find(seen.begin(), seen.end(), states_) != seen.end(); again || --patience <= 0) {
        if (way == Way::Single && again) return End::Exhausted;  // pairs cycle
        if (way == Way::Block) {
          way = Way::Descent;
          rises_ = 0;
          if (!descend(next)) way = Way::Single;
        }
      }
      seen.push_back(states_);
      if (way == Way::Single)
        for (std::size_t k = 0; k + 1 < violated_.size(); ++k) next[violated_[k]] = states_[violated_[k]];
      if (way == Way::Block && tolerance_ < kMuchSharper * before) {  // earlier solutions were not in equilibrium and are not comparable
        progress(kNone);
        nearest_ = std::numeric_limits<double>::infinity();
      }
    }
    states_ = follow(next) ? std::move(next) : guarded(std::move(next), states_);
  }
}

/// Moves from the closest state towards the solution until the distance from the laws decreases; combinations of solutions are in
/// equilibrium and cost no solve. False if no decrease is possible.
/// \param next  receives the states there
bool FrictionSearch::descend(PairStates& next) {
  for (int repeated = 0; repeated < kHalvings; ++repeated) {
    const Matrix force = answer_.force - force_, jump = answer_.jump - jump_;
    double least = std::numeric_limits<double>::infinity(), best = 1.0, part = 1.0;
    for (int halved = 0; halved <= kHalvings; ++halved, part *= 0.5) {
      const double own = violation(force_ + part * force, jump_ + part * jump);
      if (own < least) least = own, best = part;
      if (own < (1.0 - kLeastFall * part) * nearest_) break;
    }
    if (!(least < nearest_) && ++rises_ > kRises) return false;
    nearest_ = least;
    force_ += best * force;
    jump_ += best * jump;
    if (best == 1.0) return true;
    violation(force_, jump_, &next);
    if (guarded(next, states_) != states_) return true;
  }
  return false;
}

/// Normal forces of the solution, used as bounds of a Tresca problem.
Vector FrictionSearch::normalForces() const {
  Vector all = Vector::Zero(static_cast<Eigen::Index>(states_.size()));
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (states_[i].closed()) all(at) = std::max(0.0, answer_.force(at, 0));
  }
  return all;
}

FrictionSearch::End FrictionSearch::limited(int most, double last) {
  const int left = left_;
  left_ = std::min(left_, most);
  const int given = left_;
  const End found = settle(last);
  left_ = left - (given - left_);
  return found;
}

/// Newton steps by the laws, starting from a Tresca problem; on failure from the other side; finally the fixed point.
FrictionSearch::End FrictionSearch::solveByNewton(const Vector& normal) {
  End end = End::Settled;
  Vector tresca;
  if (normal.size() > 0) {
    normal_ = normal;
    end = limited(kTrescaSolves, oracle_.loosest());
    normal_ = Vector();
    if (end != End::Failed && answer_.force.size() > 0) {
      tresca = normalForces();
      states_ = guarded(projected(states_, answer_), states_);
    }
  }
  if (end != End::Failed) {
    tolerance_ = oracle_.loosest();
    end = limited(kNewtonSolves, oracle_.tightest());
    if (end == End::Settled && tresca.size() > 0) {
      const Vector found = normalForces();
      const bool slips = std::any_of(states_.begin(), states_.end(), [](const ContactState& state) { return state.drags(); });
      if (const double from = (normal - found).norm(); !slips)
        contraction_ = 0.0;  // no bound affects the solution
      else if (from > 0.0)
        contraction_ = (tresca - found).norm() / from;
    }
  }
  if (end == End::Settled) return end;
  if (outdone_.size() == 0) outdone_ = outdone();
  if (outdone_.size() == 0 && collapses()) return End::Slides;
  const int answers = end == End::Failed ? answers_ : -1;
  if (goesOn()) end = tryAgain(end);  // before failure is reported
  if (end == End::Exhausted && goesOn() && answer_.force.size() > 0) {
    end = fixedPoint(normalForces());
    thaw();
  }
  // Single linear problems without a solution do not imply that the scene has none.
  return end == End::Failed && answers_ > answers ? End::Exhausted : end;
}

FrictionSearch::Result FrictionSearch::run(PairStates start, const Vector& normal) {
  holders_.assign(start.size(), 0);
  spent_ = holders_;
  states_ = guarded(start, start);
  patience_ = kBlockSteps;
  tolerance_ = oracle_.loosest();
  const End end = oracle_.drags() ? solveByNewton(normal) : solveAsTresca(normal);
  Result result;
  result.converged = end == End::Settled;
  result.states = states_;
  result.solves = solves_;
  result.contraction = contraction_;
  result.multiple = multiple_;
  if (end != End::Settled && mechanism_.size() > 0)
    result.slides = mechanism_;
  else if (end == End::Slides)
    result.slides = slides_;
  else if (!result.converged && outdone_.size() > 0) {
    // The motion of the proof opens pairs because of the widths of their cones; the motion of a sliding body keeps them closed.
    ClosedSet closed(states_.size(), 0);
    for (std::size_t i = 0; i < closed.size(); ++i) closed[i] = states_[i].closed() && rigid_.data().able[i];
    const Matrix kept = rigid_.loose(closed);
    result.slides = kept * (kept.transpose() * outdone_);
    if (!(result.slides.norm() > kDependentRows)) result.slides = outdone_;
  }
  if (end == End::Exhausted && result.slides.size() == 0) result.alternating = violated_;
  return result;
}

}  // namespace suture
