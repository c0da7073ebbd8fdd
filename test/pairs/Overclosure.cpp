#include <Teuchos_UnitTestHarness.hpp>
#include <support/CheckSays.hpp>
#include <suture/base/Errors.hpp>
#include <suture/pairs/Overclosure.hpp>

#include <cmath>

namespace {

using namespace suture;

/// Pressure of the exponential law as the manuals of Abaqus and CalculiX define it. \param c  overclosure
double exponentialPressure(double p0, double c0, double c) {
  const double x = c / c0 + 1.0;
  return x > 0.0 ? p0 / (std::exp(1.0) - 1.0) * x * (std::exp(x) - 1.0) : 0.0;
}

TEUCHOS_UNIT_TEST(Overclosure, FollowsTheExponentialLawWithinItsAccuracy) {
  for (const double accuracy : {0.05, 0.01, 0.002}) {
    const Overclosure law = Overclosure::exponential(3.0, 0.02, accuracy, 60.0);
    double worst = 0.0, largest = 0.0;
    for (int i = -1000; largest < 60.0; ++i) {
      const double c = 1e-5 * 3 * i, p = exponentialPressure(3.0, 0.02, c);
      worst = std::max(worst, std::abs(law.pressure(c) - p) / std::max(p, 3.0));
      largest = p;
    }
    TEST_COMPARE(worst, <=, accuracy * 1.001);
    TEST_COMPARE(worst, >=, accuracy * 0.9);  // no more lines than needed
    out << accuracy << ": " << law.springs().size() << " lines\n";
    TEST_COMPARE(law.springs().size(), <=, 20 * std::sqrt(0.01 / accuracy));
  }
}

TEUCHOS_UNIT_TEST(Overclosure, RunsThroughTheRowsOfATable) {
  const std::vector<double> pressures{0, 0, 2, 8, 11, 20}, overclosures{-0.003, -0.002, 0.002, 0.008, 0.011, 0.012};
  const Overclosure law = Overclosure::table(pressures, overclosures);
  for (std::size_t i = 0; i < pressures.size(); ++i) TEST_FLOATING_EQUALITY(law.pressure(overclosures[i]) + 1, pressures[i] + 1, 1e-12);
  TEST_EQUALITY_CONST(law.springs().size(), 3u);  // two rows are on a line, or before the contact
  TEST_FLOATING_EQUALITY(law.pressure(0.013), 29.0, 1e-12);
  TEST_FLOATING_EQUALITY(Overclosure::linear(7.0).pressure(0.5), 3.5, 1e-15);
}

TEUCHOS_UNIT_TEST(Overclosure, RefusesTablesThatAreNoLaw) {
  const auto refuses = [&](const std::vector<double>& pressures, const std::vector<double>& overclosures, const std::string& what) {
    try {
      Overclosure::table(pressures, overclosures);
      out << "accepted: " << what << "\n";
      success = false;
    } catch (const InputError& error) {
      out << error.what() << "\n";
      success = success && std::string(error.what()).find(what) != std::string::npos;
    }
  };
  refuses({0, 1}, {0, 1, 2}, "2 Pressures and 3 Overclosures");
  refuses({0}, {0}, "fewer than two rows");
  refuses({1, 2}, {0, 1}, "the first pressure is 1");
  refuses({0, 1, 2}, {0, 1, 1}, "row 3: the overclosure 1 is not above");
  refuses({0, 2, 1}, {0, 1, 2}, "row 3: the pressure 1 is below");
  refuses({0, 2, 3}, {0, 1, 2}, "the law softens, from the slope 2 to 1");
  refuses({0, 0}, {0, 1}, "all pressures are zero");
}

}  // namespace
