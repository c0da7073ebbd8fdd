#include "Orders.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <suture/report/Format.hpp>

namespace suture::study {
namespace {

using Points = std::vector<std::pair<double, double>>;  // log x, log y

double slopeOf(const Points& points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const double n = static_cast<double>(points.size());
  for (const auto& [a, b] : points) x += a / n, y += b / n;
  for (const auto& [a, b] : points) xx += (a - x) * (a - x), xy += (a - x) * (b - y);
  return xy / xx;
}

std::string labelOf(const Study& study, const Order& order, const Row& row) {
  std::string label;
  for (const std::size_t s : order.by)
    label += (label.empty() ? "" : ", ") + study.sweeps[s].name + " " + study.sweeps[s].labels[row.run->choice[s]];
  return label;
}

struct Line {
  Points points;
  int missing = 0;
};

Verdict judge(const Order& order, const std::string& label, Line line) {
  Verdict verdict{order.name + (label.empty() ? "" : ", " + label), false, true, order.y + " against " + order.x + ": "};
  std::sort(line.points.begin(), line.points.end());
  // Smallest x first: the finest meshes show the order.
  if (order.last > 0 && static_cast<int>(line.points.size()) > order.last) line.points.resize(std::size_t(order.last));
  if (line.points.size() + std::size_t(line.missing) < 2) {
    verdict.judged = false;
    verdict.sentence += "only one run was run; an order needs two or more";
    return verdict;
  }
  if (line.points.size() < 2 || line.points.front().first == line.points.back().first) {
    verdict.sentence += "no order of " + counted(static_cast<long long>(line.points.size()), "run") + " with positive figures";
    return verdict;
  }
  const double slope = slopeOf(line.points);
  verdict.kept = line.missing == 0 && (!order.atLeast || slope >= *order.atLeast) && (!order.atMost || slope <= *order.atMost);
  verdict.sentence += format("order %.3f", slope) + " over " + counted(static_cast<long long>(line.points.size()), "run");
  if (order.atLeast) verdict.sentence += format(", at least %.4g", *order.atLeast);
  if (order.atMost) verdict.sentence += format(", at most %.4g", *order.atMost);
  if (line.missing > 0) verdict.sentence += "; " + counted(line.missing, "run") + " without a value";
  return verdict;
}

}  // namespace

std::vector<Verdict> judgeOrders(const Study& study, const std::vector<Row>& rows) {
  std::vector<Verdict> verdicts;
  for (std::size_t o = 0; o < study.orders.size(); ++o) {
    const Order& order = study.orders[o];
    std::vector<std::pair<std::string, Line>> lines;  // in the order of the study
    for (const Row& row : rows) {
      if (!passes(order.where, study.sweeps, row.run->choice)) continue;
      const std::string label = labelOf(study, order, row);
      auto line = std::find_if(lines.begin(), lines.end(), [&](const auto& one) { return one.first == label; });
      if (line == lines.end()) line = lines.insert(lines.end(), {label, {}});
      const auto& [x, y] = row.ordered[o];
      if (x.isNumber() && y.isNumber() && x.number > 0 && y.number > 0)
        line->second.points.emplace_back(std::log(x.number), std::log(y.number));
      else
        ++line->second.missing;
    }
    for (const auto& [label, line] : lines) verdicts.push_back(judge(order, label, line));
    if (lines.empty()) verdicts.push_back({order.name, false, false, order.y + " against " + order.x + ": no run that counts was run"});
  }
  return verdicts;
}

}  // namespace suture::study
