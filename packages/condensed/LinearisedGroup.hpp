#pragma once
#include <suture/condensed/ContactGroup.hpp>
#include <suture/subdomain/LocalProblem.hpp>

#include <optional>

namespace suture {

/// A contact group with given pair states: S^0_*j of (11) if all pairs are closed, otherwise the tangent S_*j' at a state. Open pairs carry
/// no force, closed ones are tied in the normal direction.
class LinearisedGroup : public LocalProblem {
 public:
  /// `group` must outlive it.
  /// \throws NumericalError  neither the boundary nor contact holds a body of the group with these pairs closed
  LinearisedGroup(int id, const ContactGroup& group, const std::vector<ContactState>& status);

  void applySchur(ConstLocalView trace, LocalView flux) const override;
  Vector condensedLoad() const override { return -atRest_.flux; }
  double constantEnergy() const override { return atRest_.energy; }
  const Vector& stiffnessDiagonal() const override { return diagonal_; }
  const Matrix& kernel() const override;
  using LocalProblem::inverse;
  std::unique_ptr<LocalInverse> inverse() const override;

  const std::vector<ContactState>& status() const { return status_; }
  const ContactGroup& group() const { return group_; }
  /// The closed pairs, with the group's boundary held.
  const ContactCompliance::Closed& held() const { return held_; }

 protected:
  /// Assembled from the members' hints.
  Matrix doHint(const std::string& name) const override;

 private:
  const ContactCompliance::Closed& floating() const;

  const ContactGroup& group_;
  std::vector<ContactState> status_;
  ContactCompliance::Closed held_;
  ContactGroup::Response atRest_;  // zero trace
  Vector diagonal_;
  mutable std::unique_ptr<ContactCompliance::Closed> floating_;
  mutable std::optional<Matrix> kernel_;
};

}  // namespace suture
