// A contact group with its own search for closed pairs: the semismooth Newton method as an active set strategy (Hintermueller, Ito,
// Kunisch, SIAM J. Optim. 13, 2002). In each step all pairs in tension open and all penetrating pairs close, until no pair changes.
#include <Teuchos_ParameterList.hpp>
#include <suture/condensed/ContactGroup.hpp>

using namespace suture;

namespace {

class NewtonGroup : public ContactGroup {
 public:
  static Schema schema() {
    return Schema("semismooth Newton: all pairs in tension or penetration change at once")
        .integer("Maximum Iterations", 50, "Iterations after which the group stops with an error.", Range::atLeast(1));
  }
  NewtonGroup(const Parts& parts, const Parameters& own) : ContactGroup(parts), most_(own.get<int>("Maximum Iterations")) {}

 protected:
  ContactCompliance::State doSolve(LocalView v, const std::vector<ContactState>& start, const Vector& moved) const override {
    const Matrix load = v;
    ContactCompliance::State state;
    state.status = start;
    for (; state.steps < most_; ++state.steps) {
      auto closed = std::make_unique<ContactCompliance::Closed>(held(), state.status);
      if (closed->kernel().cols() > 0) {  // a body would float: close all pairs
        state.status = heldRows().pressed;
        closed = std::make_unique<ContactCompliance::Closed>(held(), state.status);
      }
      Matrix force;
      v = load;
      closed->solve(v, 1.0, &force, moved);
      Vector gap = heldRows().gap - heldRows().rows * v.col(0);
      if (moved.size() > 0) gap -= moved;
      state.force = force.col(0);
      const std::vector<ContactState> last = state.status;
      for (std::size_t i = 0; i < last.size(); ++i)
        state.status[i] = (last[i].closed() ? force(i, 0) > 0.0 : gap(i) < 0.0) ? heldRows().pressed[i] : ContactState();
      if (state.status == last) return state;
    }
    throw NumericalError("contact group " + std::to_string(id() + 1) + ": no set of closed pairs in " + std::to_string(most_) +
                         " Newton steps");
  }

 private:
  int most_;
};

const Registration<ContactGroup> registration("Newton", NewtonGroup::schema(),
                                              [](const auto& parts, const auto& own) { return std::make_unique<NewtonGroup>(parts, own); });

}  // namespace
