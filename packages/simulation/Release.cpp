#include <suture/simulation/Release.hpp>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <utility>

namespace suture {

Release::Release(double begin, std::vector<double> ends, std::vector<double> fractions)
    : begin_(begin), ends_(std::move(ends)), fractions_(std::move(fractions)) {}

double Release::remaining(double time) const {
  if (time >= ends_.back()) return 0.0;
  const auto step = static_cast<std::size_t>(std::upper_bound(ends_.begin(), ends_.end(), time) - ends_.begin());
  const double from = step > 0 ? ends_[step - 1] : begin_, released = step > 0 ? fractions_[step - 1] : 0.0;
  const double part = std::max(0.0, (time - from) / (ends_[step] - from));
  return 1.0 - (released + part * (fractions_[step] - released));
}

std::string Release::text() const {
  std::ostringstream percent, times;
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    percent << (i > 0 ? ", " : "") << 100.0 * fractions_[i];
    times << (i > 0 ? ", " : "") << ends_[i];
  }
  return "forces released to " + percent.str() + " % at t = " + times.str();
}

}  // namespace suture
