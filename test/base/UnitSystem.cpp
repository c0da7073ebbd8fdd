// Units: conversions of known values, and refused names.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/UnitSystem.hpp>

namespace suture {
namespace {

std::string refusal(const std::string& names) {
  try {
    UnitSystem::named(names);
  } catch (const InputError& error) {
    return error.problems().front().path + ": " + error.problems().front().message;
  }
  return "";
}

TEUCHOS_UNIT_TEST(UnitSystem, ConvertsValuesOfSteel) {
  const UnitSystem si = UnitSystem::named("m, N, Pa"), mm = UnitSystem::named("mm,N,MPa"), inch = UnitSystem::named("in, lbf, psi");
  TEST_EQUALITY(converted(2.1e11, "stress", si, mm), 2.1e5);
  TEST_EQUALITY(converted(7850.0, "mass / volume", si, mm), 7.85e-9);  // t / mm^3
  TEST_EQUALITY(converted(1.2e-5, "1 / temperature", si, inch), 1.2e-5);
  TEST_FLOATING_EQUALITY(converted(2.1e11, "stress", si, inch), 30457924.9, 1e-8);       // 1 psi = 6894.757293 Pa (NIST SP 811)
  TEST_FLOATING_EQUALITY(converted(7850.0, "mass / volume", si, inch), 7.345e-4, 1e-3);  // steel: 0.2836 lb / in^3 over 386.1 in / s^2
  TEST_FLOATING_EQUALITY(converted(converted(7850.0, "mass / volume", si, inch), "mass / volume", inch, si), 7850.0, 1e-13);
  TEST_EQUALITY(converted(3.0, "stress", UnitSystem::named("m, kN, kPa"), UnitSystem::named("m, kN, kN/m^2")), 3.0);
  TEST_EQUALITY(converted(1.0, "length", UnitSystem::named("ft, lbf, psf"), UnitSystem::named("in, lbf, psi")), 12.0);
}

TEUCHOS_UNIT_TEST(UnitSystem, RefusesNamesThatItCannotConvert) {
  TEST_ASSERT(refusal("mmm, N, MPa").find("Units: no such unit of length 'mmm'. Did you mean 'mm'?") == 0);
  TEST_ASSERT(refusal("mm, N").find("the unit of stress is missing") != std::string::npos);
  TEST_ASSERT(refusal("mm, N, MPa, s").find("more than three names") != std::string::npos);
  // The classical mistake: millimetres with pascals.
  TEST_ASSERT(refusal("mm, N, Pa").find("is not consistent: one N / mm^2 is 1e+06 Pa") != std::string::npos);
  TEST_ASSERT(refusal("mm, kN, MPa").find("is not consistent: one kN / mm^2 is 1000 MPa") != std::string::npos);
  TEST_THROW(converted(1.0, "candela", UnitSystem(), UnitSystem()), InputError);
}

}  // namespace
}  // namespace suture
