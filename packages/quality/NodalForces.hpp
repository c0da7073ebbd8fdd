#pragma once
#include <suture/quality/SeamExchange.hpp>
#include <suture/quality/Verify.hpp>

namespace suture {

/// Rows of the sums at the nodes of a mesh: K u, loads, contact forces (a row a component) [force]; ElementForces::rounding and stiffness.
namespace nodal {
enum Row { Internal = 0, Applied = 2, Contact = 4, Rounding = 6, Stiffness = 7, kRows = 8 };
}

/// Forces at the nodes of a scene, and the first of their resultants.
struct NodalForces {
  std::vector<Matrix> nodes;  ///< by mesh: kRows x nodes, summed over subdomains
  Balance balance;            ///< rigid obstacles, on the rank that counts a pair, elastic supports, and initial states, which are no loads
  Reactions reactions;        ///< sums over this rank
};

/// Loops over elements, loads and pairs. Collective. \throws InputError  an element is folded
NodalForces nodalForces(const Comm& comm, const Answer& answer, const SeamExchange& seams);

}  // namespace suture
