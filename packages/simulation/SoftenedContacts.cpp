#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/simulation/SoftenedContacts.hpp>

#include <algorithm>
#include <cstdio>

namespace suture {

namespace {

constexpr double kBeyond = 1e-6;  // fraction by which a pressure may exceed the range of its law

std::vector<PairResult> joined(const std::vector<ContactLine>& lines, const std::vector<PairResult>& pairs) {
  std::vector<int> firstOfLine(lines.size(), -1);
  for (const PairResult& pair : pairs)
    if (int& first = firstOfLine.at(static_cast<std::size_t>(pair.line)); first < 0) first = pair.id;
  std::vector<PairResult> all;
  for (const PairResult& pair : pairs) {
    const ContactLine& line = lines.at(static_cast<std::size_t>(pair.line));
    if (line.spring == 0) {
      PairResult& own = all.emplace_back(pair);
      if (!line.law) continue;
      own.initialGap -= line.begin();
      own.gap -= line.begin() + pair.shortening;
      continue;
    }
    const int first = firstOfLine.at(static_cast<std::size_t>(line.entry));
    PairResult& own = all.at(static_cast<std::size_t>(first + pair.id - firstOfLine.at(static_cast<std::size_t>(pair.line))));
    if (own.line != line.entry || own.node != pair.node) throw InternalError("the springs of a softened contact have different pairs");
    own.force += pair.force;
    own.pressure += pair.pressure;
    own.tangential = plus(own.tangential, pair.tangential);
    own.bound += pair.bound;
    own.dissipated += pair.dissipated;
    own.past.dissipated += pair.past.dissipated;
  }
  return all;
}

/// The pieces without pairs that are not results. \param count  of results
std::vector<ContactPiece> joinedPieces(std::vector<ContactPiece> pieces, int count) {
  const auto isFurther = [&](int id) { return id >= count; };
  const auto drop = [&](std::vector<int>& ids) { ids.erase(std::remove_if(ids.begin(), ids.end(), isFurther), ids.end()); };
  for (ContactPiece& piece : pieces) {
    drop(piece.pairs);
    drop(piece.openEnds);
    piece.cells.erase(std::remove_if(piece.cells.begin(), piece.cells.end(),
                                     [&](const std::vector<int>& cell) { return std::any_of(cell.begin(), cell.end(), isFurther); }),
                      piece.cells.end());
    piece.onAxis.erase(
        std::remove_if(piece.onAxis.begin(), piece.onAxis.end(), [&](const AxisPoint& point) { return isFurther(point.pairs[0]); }),
        piece.onAxis.end());
  }
  return pieces;
}

}  // namespace

EntryResults resultsOfEntries(const std::vector<ContactLine>& lines, const Solution& solution, const std::vector<ContactPiece>& pieces,
                              const ProblemSize& size) {
  EntryResults results{solution, pieces, size};
  if (solution.pairs.empty()) return results;  // another rank
  results.solution.pairs = joined(lines, solution.pairs);
  std::vector<ContactPiece> kept = joinedPieces(pieces, static_cast<int>(results.solution.pairs.size()));
  std::vector<int> numberOf;
  results.pieces.clear();
  for (ContactPiece& piece : kept) {
    numberOf.push_back(piece.pairs.empty() ? -1 : static_cast<int>(results.pieces.size()));
    if (!piece.pairs.empty()) results.pieces.push_back(std::move(piece));
  }
  for (PairResult& pair : results.solution.pairs) pair.piece = numberOf.at(static_cast<std::size_t>(pair.piece));
  results.size.pairs = static_cast<decltype(results.size.pairs)>(results.solution.pairs.size());
  results.size.pieces = static_cast<decltype(results.size.pieces)>(results.pieces.size());
  results.solution.onAxis = axisResults(results.pieces, results.solution.pairs);
  return results;
}

std::vector<std::string> entryNames(const std::vector<ContactLine>& lines) {
  std::vector<std::string> names;
  for (const ContactLine& line : lines)
    if (line.spring == 0) names.push_back(line.name);
  return names;
}

std::vector<std::string> overclosureNotes(const std::vector<ContactLine>& lines, const Solution& solution, int dimension) {
  std::vector<const PairResult*> worst(lines.size(), nullptr);
  for (const PairResult& pair : solution.pairs) {
    const PairResult*& most = worst[static_cast<std::size_t>(pair.line)];
    if (!most || pair.pressure > most->pressure) most = &pair;
  }
  std::vector<std::string> notes;
  for (std::size_t line = 0; line < lines.size(); ++line) {
    if (!worst[line] || !lines[line].law) continue;
    const double limit = lines[line].law->largestPressure();
    if (!(worst[line]->pressure > (1.0 + kBeyond) * limit)) continue;
    char text[120];
    std::snprintf(text, sizeof text, "the pressure %.4g at ", worst[line]->pressure);
    char range[120];
    std::snprintf(range, sizeof range, " is beyond the range of its Pressure Overclosure, up to %.4g; the last slope continues there",
                  limit);
    notes.push_back("warning: contact '" + lines[line].name + "': " + text + placeText(worst[line]->position, dimension) + range);
  }
  return notes;
}

}  // namespace suture
