#include <Teuchos_UnitTestHarness.hpp>
#include <suture/partition/cut/Glob.hpp>

using suture::matchesPattern;

TEUCHOS_UNIT_TEST(Glob, KnowsStarAndQuestionMark) {
  TEST_ASSERT(matchesPattern("subdomain_01", "subdomain_*"));
  TEST_ASSERT(matchesPattern("subdomain_", "subdomain_*"));
  TEST_ASSERT(!matchesPattern("subdomain", "subdomain_*"));
  TEST_ASSERT(matchesPattern("subdomain_1", "subdomain_?"));
  TEST_ASSERT(!matchesPattern("subdomain_12", "subdomain_?"));
  TEST_ASSERT(!matchesPattern("subdomain_", "subdomain_?"));
  TEST_ASSERT(matchesPattern("anything", "*"));
  TEST_ASSERT(matchesPattern("", "*"));
  TEST_ASSERT(matchesPattern("", ""));
  TEST_ASSERT(!matchesPattern("x", ""));
}

TEUCHOS_UNIT_TEST(Glob, GoesBackToTheLastStar) {
  TEST_ASSERT(matchesPattern("a_left_left_end", "a_*left_end"));
  TEST_ASSERT(matchesPattern("abcabcabd", "*abc*abd"));
  TEST_ASSERT(!matchesPattern("abcabcabc", "*abd"));
  TEST_ASSERT(matchesPattern("left_12_upper", "l*_??_u*"));
}

TEUCHOS_UNIT_TEST(Glob, TakesOtherCharactersAsTheyAre) {
  TEST_ASSERT(matchesPattern("a.b[c]", "a.b[c]"));
  TEST_ASSERT(!matchesPattern("axb", "a.b"));
  TEST_ASSERT(!matchesPattern("Rock", "rock"));
}
