#include <suture/simulation/StepLength.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Where a value that changes linearly reaches zero from above.
double zeroOf(double value, double change) { return change < 0.0 ? std::max(0.0, -value / change) : kNever; }

/// Where a sticking pair reaches its bound: the smallest s >= 0 with |f + s df| = b + s db.
double reachesBound(const PairResult& before, const PairResult& now) {
  if (!(now.bound > 0.0)) return kNever;
  const Point df = minus(now.tangential, before.tangential);
  const double db = now.bound - before.bound;
  const double a = dot(df, df) - db * db, b = dot(now.tangential, df) - now.bound * db,
               c = std::min(dot(now.tangential, now.tangential) - now.bound * now.bound, 0.0);
  if (a == 0.0) return b > 0.0 ? -0.5 * c / b : kNever;
  const double root = b * b - a * c;
  if (root < 0.0) return kNever;
  // Below the bound c < 0: for a > 0 one root is positive; for a < 0 the bound falls faster, and the smaller positive one counts.
  const double sum = b + (b >= 0.0 ? 1.0 : -1.0) * std::sqrt(root);
  const double roots[] = {-sum / a, sum != 0.0 ? -c / sum : kNever};
  double first = kNever;
  for (const double s : roots)
    if (s >= 0.0) first = std::min(first, s);
  return first;
}

/// Fraction of the last step after which a pair changes its state.
double changeOf(const PairResult& before, const PairResult& now) {
  if (before.state.closed() != now.state.closed() || !now.kind.separates) return kNever;
  if (!now.state.closed()) return zeroOf(now.gap, now.gap - before.gap);
  const double opens = zeroOf(now.force, now.force - before.force);
  return before.state.status == PairStatus::Stick && now.state.status == PairStatus::Stick ? std::min(opens, reachesBound(before, now))
                                                                                           : opens;
}

}  // namespace

double predictedLength(const std::vector<PairResult>& before, const std::vector<PairResult>& now, double length, int most) {
  std::vector<double> changes;
  for (std::size_t i = 0; i < now.size() && i < before.size(); ++i)
    if (const double at = changeOf(before[i], now[i]); at < kNever) changes.push_back(at);
  if (static_cast<int>(changes.size()) < most) return kNever;
  std::nth_element(changes.begin(), changes.begin() + (most - 1), changes.end());
  return length * changes[static_cast<std::size_t>(most - 1)];
}

}  // namespace suture
