#pragma once
#include <suture/base/Errors.hpp>

#include <string>
#include <type_traits>

namespace suture {

/// Calls call(n) with the number of an element's nodes as a compile-time constant, so that the compiler knows the loop lengths. \tparam D
/// dimension of the cells \throws InternalError  if no cell has this number of nodes
template <int D, typename Call>
void forNodes(int nodes, const Call& call) {
  const auto with = [&](auto count) {
    if (nodes != count()) return false;
    call(count);
    return true;
  };
  bool found;
  if constexpr (D == 2)
    found = with(std::integral_constant<int, 3>()) || with(std::integral_constant<int, 4>()) || with(std::integral_constant<int, 6>()) ||
            with(std::integral_constant<int, 8>()) || with(std::integral_constant<int, 9>());
  else
    found = with(std::integral_constant<int, 4>()) || with(std::integral_constant<int, 8>()) || with(std::integral_constant<int, 10>()) ||
            with(std::integral_constant<int, 5>()) || with(std::integral_constant<int, 6>()) || with(std::integral_constant<int, 20>()) ||
            with(std::integral_constant<int, 27>());
  if (!found) throw InternalError("an element of " + std::to_string(nodes) + " nodes in " + std::to_string(D) + " dimensions");
}

}  // namespace suture
