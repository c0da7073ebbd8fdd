#include <Teuchos_UnitTestHarness.hpp>
#include <suture/quality/PressureOscillation.hpp>

#include <cmath>
#include <functional>

namespace suture {
namespace {

/// A piece of closed pairs with these pressures, listed from its last one, open where it is not positive.
std::vector<PairResult> piece(int count, const std::function<double(int)>& pressure) {
  std::vector<PairResult> pairs(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    PairResult& pair = pairs[std::size_t(count - 1 - i)];
    pair.piece = 0;
    pair.arc = 0.1 * i;
    pair.pressure = std::max(0.0, pressure(i));
    pair.state = pair.pressure > 0 ? PairStatus::Slip : PairStatus::Open;
  }
  return pairs;
}

double sign(int i) { return i % 2 == 0 ? 1.0 : -1.0; }

TEUCHOS_UNIT_TEST(PressureOscillation, IsTheAmplitudeOfWhatAlternates) {
  TEST_FLOATING_EQUALITY(pressureOscillations(piece(6, [](int i) { return 5.0 + 0.7 * sign(i); }), 1)[0], 0.7, 1e-14);
  // On a straight slope, too, and whatever lies before or behind it.
  TEST_FLOATING_EQUALITY(pressureOscillations(piece(9, [](int i) { return 5.0 + i + 0.7 * sign(i); }), 1)[0], 0.7, 1e-14);
  TEST_FLOATING_EQUALITY(pressureOscillations(piece(30, [](int i) { return i < 10 || i > 20 ? 5.0 : 5.0 + 0.7 * sign(i); }), 1)[0], 0.7,
                         1e-14);
}

TEUCHOS_UNIT_TEST(PressureOscillation, IsNoneOfSmoothPressuresPeaksAndJumps) {
  const std::vector<std::function<double(int)>> smooth{
      [](int) { return 3.0; },
      [](int i) { return std::sqrt(std::max(0.0, 100.0 - (i - 10.0) * (i - 10.0))); },  // Hertz
      [](int i) { return 1.0 / std::sqrt((i + 0.5) * (20.5 - i)); },                    // a flat punch
      [](int i) { return 3.0 + std::sin(0.9 * i); },                                    // seven pairs a wave
      [](int i) { return i == 10 ? 50.0 : 1.0; },
      [](int i) { return i < 10 ? 1.0 : 9.0; },
      [](int i) { return i == 10 || i == 13 ? 50.0 : 1.0; }};
  for (std::size_t k = 0; k < smooth.size(); ++k) {
    out << "profile " << k << "\n";
    TEST_COMPARE(pressureOscillations(piece(21, smooth[k]), 1)[0], <, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(PressureOscillation, IsOfClosedNeighboursInOnePiece) {
  // Every other pair closed: that is a status, not a pressure.
  TEST_EQUALITY(pressureOscillations(piece(12, [](int i) { return sign(i); }), 1)[0], 0.0);
  std::vector<PairResult> pairs = piece(12, [](int i) { return 5.0 + sign(i); });
  for (PairResult& pair : pairs) pair.piece = 2;
  const std::vector<double> found = pressureOscillations(pairs, 4);
  TEST_EQUALITY(found.size(), 4u);
  TEST_FLOATING_EQUALITY(found[2], 1.0, 1e-14);
  TEST_EQUALITY(found[0] + found[1] + found[3], 0.0);
  for (PairResult& pair : pairs) pair.piece = int(pair.arc * 10.0 + 0.5) / 4;  // four pairs are too few to tell
  TEST_EQUALITY(pressureOscillations(pairs, 3)[1], 0.0);
}

}  // namespace
}  // namespace suture
