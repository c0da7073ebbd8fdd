#pragma once
#include <Teuchos_Comm.hpp>
#include <Teuchos_DefaultComm.hpp>

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <vector>

namespace suture::blocks {

/// Cases of a test, the hardest first: all of them on one rank and with SUTURE_ALL_CASES in the environment, as <package>.<Class>.all.np4
/// with the label long has it; otherwise `onSeveral` of them. Two ranks occupy both cores as long as one rank occupies one, four ten times
/// as long.
template <typename Case>
std::vector<Case> casesOf(std::initializer_list<Case> all, std::size_t onSeveral = 1) {
  const bool whole = Teuchos::DefaultComm<int>::getComm()->getSize() == 1 || std::getenv("SUTURE_ALL_CASES");
  return {all.begin(), all.begin() + (whole ? all.size() : std::min(onSeveral, all.size()))};
}

}  // namespace suture::blocks
