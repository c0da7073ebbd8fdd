#pragma once
#include <Teuchos_Comm.hpp>
#include <Teuchos_DefaultComm.hpp>

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <vector>

namespace suture::blocks {

/// Cases of a test, the hardest first: all of them on one and two ranks and with SUTURE_ALL_CASES in the environment, as
/// <package>.<Class>.all.np4 with the label long has it; `onFour` of them else. Four ranks on two cores take ten times as long as one.
template <typename Case>
std::vector<Case> casesOf(std::initializer_list<Case> all, std::size_t onFour = 1) {
  const bool whole = Teuchos::DefaultComm<int>::getComm()->getSize() <= 2 || std::getenv("SUTURE_ALL_CASES");
  return {all.begin(), all.begin() + (whole ? all.size() : std::min(onFour, all.size()))};
}

}  // namespace suture::blocks
