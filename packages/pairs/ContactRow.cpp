#include <suture/pairs/ContactRow.hpp>
#include <suture/pairs/PairFrame.hpp>

namespace suture {

std::vector<Point> rowDirections(const ContactPair& pair, int dimension) {
  std::vector<Point> directions = pairFrame(pair, dimension);
  for (int t = 1; t < dimension && !pair.still.empty(); ++t) directions[t] = slidingPart(pair, directions[t]);
  return directions;
}

ContactState pressedState(const ContactRow& row, const ContactLaw& law) {
  if (!law.separates()) return law.pressed();
  if (!row.canChange()) return {};
  return row.restrictsSliding() ? ContactState(PairStatus::Slip) : law.pressed();
}

}  // namespace suture
