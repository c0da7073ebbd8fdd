#include <suture/algebra/WorkSpace.hpp>
#include <suture/condensed/LinearisedGroup.hpp>

#include <algorithm>
#include <sstream>

namespace suture {

namespace {

class NeumannInverse : public LocalInverse {
 public:
  NeumannInverse(const ContactCompliance::Closed& closed, const std::vector<int>& positions, int unknowns)
      : closed_(closed), positions_(positions), unknowns_(unknowns) {}

  void apply(ConstLocalView flux, LocalView trace) const override {
    thread_local std::vector<double> kept;
    WorkSpace space(unknowns_, flux.cols(), kept);
    LocalView v = space.values;
    v.setZero();
    for (std::size_t i = 0; i < positions_.size(); ++i) v.row(positions_[i]) = flux.row(i);
    closed_.solve(v, 0.0);
    for (std::size_t i = 0; i < positions_.size(); ++i) trace.row(i) = v.row(positions_[i]);
  }

 private:
  const ContactCompliance::Closed& closed_;
  const std::vector<int>& positions_;
  int unknowns_;
};

}  // namespace

LinearisedGroup::LinearisedGroup(int id, const ContactGroup& group, const std::vector<ContactState>& status)
    : LocalProblem(id, "contact group " + std::to_string(group.id() + 1), group.boundary()),
      group_(group),
      status_(status),
      held_(group.held(), status),
      diagonal_(size()) {
  if (held_.kernel().cols() > 0) {
    std::ostringstream text;
    const bool isOne = held_.kernel().cols() == 1;
    text << name() << ": " << held_.kernel().cols() << (isOne ? " rigid-body mode is" : " rigid-body modes are")
         << " held neither by the group's boundary nor by its closed pairs";
    throw NumericalError(text.str());
  }
  atRest_ = group.respondLinear(Vector::Zero(size()), held_);
  const std::vector<int>& positions = group.boundaryPositions();
  for (int i = 0; i < size(); ++i) diagonal_(i) = group.stiffness().coeff(positions[i], positions[i]);
}

void LinearisedGroup::applySchur(ConstLocalView trace, LocalView flux) const {
  thread_local std::vector<double> kept;
  WorkSpace space(static_cast<int>(group_.interiorPositions().size()), trace.cols(), kept);
  LocalView v = space.values;
  group_.interiorLoad(trace, v);
  held_.solve(v, 0.0);
  group_.flux(trace, v, flux);
}

const ContactCompliance::Closed& LinearisedGroup::floating() const {
  if (!floating_) floating_ = std::make_unique<ContactCompliance::Closed>(group_.floating(), status_);
  return *floating_;
}

const Matrix& LinearisedGroup::kernel() const {
  if (!kernel_) kernel_ = rowsAt(floating().kernel(), group_.boundaryPositions());
  return *kernel_;
}

Matrix LinearisedGroup::doHint(const std::string& name) const {
  std::vector<int> boundaryOf(group_.dofs(), -1);
  for (int i = 0; i < size(); ++i) boundaryOf[group_.boundaryPositions()[i]] = i;
  Matrix joined(size(), 0);
  for (std::size_t m = 0; m < group_.members().size(); ++m) {
    const Hint hint = group_.members()[m].subdomain->hint(name);
    if (hint.empty()) continue;
    const Eigen::Index columns = hint.values.cols(), before = hint.join == Hint::Join::Columns ? joined.cols() : 0;
    if (joined.cols() < before + columns) {
      const Eigen::Index had = joined.cols();
      joined.conservativeResize(Eigen::NoChange, before + columns);
      joined.rightCols(before + columns - had).setZero();
    }
    const std::vector<int>& at = group_.positionsOf(static_cast<int>(m));
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (boundaryOf[at[i]] < 0) continue;
      auto row = joined.row(boundaryOf[at[i]]).segment(before, columns);
      const auto values = hint.values.row(static_cast<Eigen::Index>(i));
      row = hint.join == Hint::Join::Largest ? row.cwiseMax(values).eval() : (row + values).eval();
    }
  }
  if (name != Hint::kCoarseModes) return joined;
  Matrix modes(size(), joined.cols() + kernel().cols());
  modes << joined, kernel();
  return modes;
}

std::unique_ptr<LocalInverse> LinearisedGroup::inverse() const {
  return std::make_unique<NeumannInverse>(floating(), group_.boundaryPositions(), group_.dofs());
}

}  // namespace suture
