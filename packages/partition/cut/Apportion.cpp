#include <algorithm>
#include <cmath>
#include <numeric>
#include <suture/base/Errors.hpp>
#include <suture/partition/cut/Apportion.hpp>

namespace suture {

std::vector<int> apportion(const std::vector<int>& sizes, int total) {
  const long long sum = std::accumulate(sizes.begin(), sizes.end(), 0LL);
  const int parties = static_cast<int>(sizes.size());
  if (total < parties || total > sum) throw InternalError("cannot share " + std::to_string(total) + " among " + std::to_string(parties));

  std::vector<int> seats(parties);
  const auto surplus = [&](int i) { return double(sizes[i]) * total / double(sum) - seats[i]; };  // exact share minus seats
  for (int i = 0; i < parties; ++i) seats[i] = std::max(1, static_cast<int>((long long)sizes[i] * total / sum));
  int given = std::accumulate(seats.begin(), seats.end(), 0);
  for (; given < total; ++given) {
    int best = -1;
    for (int i = 0; i < parties; ++i)
      if (seats[i] < sizes[i] && (best < 0 || surplus(i) > surplus(best))) best = i;
    ++seats[best];
  }
  // Small parties may have taken more than their share.
  for (; given > total; --given) {
    int worst = -1;
    for (int i = 0; i < parties; ++i)
      if (seats[i] > 1 && (worst < 0 || surplus(i) < surplus(worst))) worst = i;
    --seats[worst];
  }
  return seats;
}

}  // namespace suture
