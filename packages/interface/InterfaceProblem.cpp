#include <suture/interface/InterfaceProblem.hpp>

#include <Tpetra_MultiVector.hpp>

namespace suture {

int InterfaceProblem::conform(InterfaceState&) const { return 0; }

void InterfaceProblem::update(InterfaceState& state, const MultiVector& step, double length, const Matrix*) const {
  state.trace->update(length, step, 1.0);
  state.memory.reset();
}

}  // namespace suture
