#include <suture/algebra/WorkSpace.hpp>
#include <suture/contact/LinearisedGroup.hpp>

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
      diagonal_(size()),
      young_(Vector::Zero(size())) {
  if (held_.kernel().cols() > 0) {
    std::ostringstream text;
    text << name() << ": " << held_.kernel().cols() << " rigid motion(s) are held neither by the group's boundary nor by its closed pairs";
    throw NumericalError(text.str());
  }
  atRest_ = group.respondLinear(Vector::Zero(size()), held_);
  const std::vector<int>& positions = group.boundaryPositions();
  for (int i = 0; i < size(); ++i) diagonal_(i) = group.stiffness().coeff(positions[i], positions[i]);
  std::vector<int> boundaryOf(group.dofs(), -1);
  for (int i = 0; i < size(); ++i) boundaryOf[positions[i]] = i;
  for (std::size_t m = 0; m < group.members().size(); ++m) {
    const std::vector<int>& at = group.positionsOf(static_cast<int>(m));
    const Vector young = group.members()[m].subdomain->youngModulus();
    for (std::size_t i = 0; i < at.size(); ++i)
      if (boundaryOf[at[i]] >= 0) young_(boundaryOf[at[i]]) = std::max(young_(boundaryOf[at[i]]), young(i));
    const Vector& shear = group.members()[m].subdomain->shearDiagonal();
    if (shear.size() == 0) continue;
    if (shear_.size() == 0) shear_ = Vector::Zero(size());
    for (std::size_t i = 0; i < at.size(); ++i)
      if (boundaryOf[at[i]] >= 0) shear_(boundaryOf[at[i]]) += shear(i);
  }
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
  coarseModes();
  return kernel_;
}

const Matrix& LinearisedGroup::coarseModes() const {
  if (modesMade_) return coarseModes_;
  modesMade_ = true;
  const std::vector<int>& positions = group_.boundaryPositions();
  kernel_ = rowsAt(floating().kernel(), positions);
  std::vector<int> boundaryOf(group_.dofs(), -1);
  for (int i = 0; i < size(); ++i) boundaryOf[positions[i]] = i;
  std::vector<Matrix> modesOf;
  int columns = 0;
  for (const ContactGroup::Member& member : group_.members()) {
    modesOf.push_back(member.subdomain->coarseModes());
    columns += static_cast<int>(modesOf.back().cols());
  }
  coarseModes_ = Matrix::Zero(size(), columns + kernel_.cols());
  int column = 0;
  for (std::size_t m = 0; m < group_.members().size(); ++m) {
    const Matrix& modes = modesOf[m];
    const std::vector<int>& at = group_.positionsOf(static_cast<int>(m));
    for (std::size_t i = 0; i < at.size(); ++i)
      if (boundaryOf[at[i]] >= 0) coarseModes_.row(boundaryOf[at[i]]).segment(column, modes.cols()) = modes.row(i);
    column += static_cast<int>(modes.cols());
  }
  coarseModes_.rightCols(kernel_.cols()) = kernel_;
  return coarseModes_;
}

std::unique_ptr<LocalInverse> LinearisedGroup::inverse() const {
  return std::make_unique<NeumannInverse>(floating(), group_.boundaryPositions(), group_.dofs());
}

}  // namespace suture
