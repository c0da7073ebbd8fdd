#include <Teuchos_UnitTestHarness.hpp>
#include <suture/answer/error/PressureOscillation.hpp>

#include <cmath>
#include <functional>

namespace suture {
namespace {

/// Closed pairs with these pressures, open where they are not positive.
std::vector<PairResult> pairsWith(int count, const std::function<double(int)>& pressure) {
  std::vector<PairResult> pairs(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    PairResult& pair = pairs[std::size_t(i)];
    pair.id = i;
    pair.pressure = std::max(0.0, pressure(i));
    pair.state = pair.pressure > 0 ? PairStatus::Slip : PairStatus::Open;
  }
  return pairs;
}

/// A line of pairs, or a ring.
ContactPiece line(int first, int count, bool closed = false) {
  ContactPiece piece;
  for (int i = first; i < first + count; ++i) {
    piece.pairs.push_back(i);
    if (i > first) piece.cells.push_back({i - 1, i});
  }
  if (closed) piece.cells.push_back({first, first + count - 1});
  return piece;
}

double onLine(int count, const std::function<double(int)>& pressure) {
  return pressureOscillations(pairsWith(count, pressure), {line(0, count)})[0];
}

double sign(int i) { return i % 2 == 0 ? 1.0 : -1.0; }

TEUCHOS_UNIT_TEST(PressureOscillation, IsTheAmplitudeOfWhatAlternates) {
  TEST_FLOATING_EQUALITY(onLine(6, [](int i) { return 5.0 + 0.7 * sign(i); }), 0.7, 1e-14);
  // Also on a straight slope, with any values before or behind it.
  TEST_FLOATING_EQUALITY(onLine(9, [](int i) { return 5.0 + i + 0.7 * sign(i); }), 0.7, 1e-14);
  TEST_FLOATING_EQUALITY(onLine(30, [](int i) { return i < 10 || i > 20 ? 5.0 : 5.0 + 0.7 * sign(i); }), 0.7, 1e-14);
}

TEUCHOS_UNIT_TEST(PressureOscillation, IsNoneOfSmoothPressuresPeaksAndJumps) {
  const std::vector<std::function<double(int)>> smooth{
      [](int) { return 3.0; },
      [](int i) { return std::sqrt(std::max(0.0, 100.0 - (i - 10.0) * (i - 10.0))); },  // Hertz
      [](int i) { return 1.0 / std::sqrt((i + 0.5) * (20.5 - i)); },                    // a flat punch
      [](int i) { return 3.0 + std::sin(0.9 * i); },                                    // seven pairs per wave
      [](int i) { return i == 10 ? 50.0 : 1.0; },
      [](int i) { return i < 10 ? 1.0 : 9.0; },
      [](int i) { return i == 10 || i == 13 ? 50.0 : 1.0; }};
  for (std::size_t k = 0; k < smooth.size(); ++k) {
    out << "profile " << k << "\n";
    TEST_COMPARE(onLine(21, smooth[k]), <, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(PressureOscillation, IsOfClosedNeighboursInOnePiece) {
  // Every other pair closed: that is a status, not a pressure.
  TEST_EQUALITY(onLine(12, [](int i) { return sign(i); }), 0.0);
  const std::vector<PairResult> pairs = pairsWith(12, [](int i) { return 5.0 + sign(i); });
  const std::vector<double> found = pressureOscillations(pairs, {{}, {}, line(0, 12), {}});
  TEST_EQUALITY(found.size(), 4u);
  TEST_FLOATING_EQUALITY(found[2], 1.0, 1e-14);
  TEST_EQUALITY(found[0] + found[1] + found[3], 0.0);
  TEST_EQUALITY(pressureOscillations(pairs, {line(0, 4), line(4, 4), line(8, 4)})[1], 0.0);  // four pairs are too few to decide
  // A line has second differences at all but its ends, a ring everywhere.
  TEST_EQUALITY(pressureOscillations(pairs, {line(0, 5)})[0], 0.0);
  TEST_FLOATING_EQUALITY(pressureOscillations(pairs, {line(0, 4, true)})[0], 1.0, 1e-14);
}

TEUCHOS_UNIT_TEST(PressureOscillation, SeesAChessBoardOnASurface) {
  // 6 x 6 pairs in quadrilaterals; p = mean + a at even places, mean - a at odd ones.
  ContactPiece piece;
  for (int i = 0; i < 36; ++i) piece.pairs.push_back(i);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) piece.cells.push_back({6 * j + i, 6 * j + i + 1, 6 * j + i + 7, 6 * j + i + 6});
  const auto at = [&](const std::function<double(int, int)>& pressure) {
    return pressureOscillations(pairsWith(36, [&](int k) { return pressure(k % 6, k / 6); }), {piece})[0];
  };
  const double inside = at([](int i, int j) { return 5.0 + 0.7 * sign(i + j) * (i > 0 && i < 5 && j > 0 && j < 5); });
  TEST_FLOATING_EQUALITY(at([](int i, int j) { return 5.0 + 0.7 * sign(i + j); }), 0.7, 1e-14);
  TEST_FLOATING_EQUALITY(inside, 0.7, 1e-14);
  TEST_COMPARE(at([](int i, int j) { return 5.0 + i + 2.0 * j; }), <, 1e-14);
}

}  // namespace
}  // namespace suture
