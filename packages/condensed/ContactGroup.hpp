#pragma once
#include <suture/algebra/GeneralisedInverse.hpp>
#include <suture/base/Registry.hpp>
#include <suture/condensed/ContactCompliance.hpp>
#include <suture/condensed/ContactRows.hpp>
#include <suture/pairs/ContactLaw.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace suture {

/// All subdomains that touch a contact piece (or pieces that share a subdomain), on one rank. Seams inside the group are eliminated with
/// the interior; the group's boundary consists of the unknowns shared with other subdomains. For a trace U on this boundary, the group
/// solves its own small contact problem (8) and returns the flux S_*j(U) of (15). Local.
///
/// The solution method of the contact problem is a strategy, `Condensed Groups/Contact Group`: Exact is built in. To add your own, derive
/// from this class and implement doSolve().
class ContactGroup {
 public:
  static const char* kind() { return "contact group"; }
  struct Member {
    const Subdomain* subdomain;
  };
  /// Input of a group. Members must be assembled and outlive the group.
  struct Parts {
    int id = 0;
    std::vector<Member> members;
    std::vector<GlobalId> boundary;  ///< global numbers of the unknowns on the interface, ascending
    LocalSolverMaker solver;
    ContactLaws laws{};
  };
  using Maker = std::function<std::unique_ptr<ContactGroup>(const Parts& parts, const Parameters& own)>;

  /// \throws NumericalError
  explicit ContactGroup(const Parts& parts);
  virtual ~ContactGroup() = default;
  ContactGroup(const ContactGroup&) = delete;
  ContactGroup& operator=(const ContactGroup&) = delete;

  struct Response {
    Vector flux;                       ///< gradient of the minimal energy with respect to the trace, loads included [force]
    double energy = 0.0;               ///< minimal energy, including the part of prescribed displacements
    std::vector<ContactState> status;  ///< status of each pair
    Vector force;                      ///< force of each row [force]
    Vector displacement;               ///< all unknowns of the group
  };
  /// Solves the group's contact problem for a trace.
  /// \param start  initial status
  /// \param moved  contribution of the bodies' rigid motions, which the trace does not contain, to the rows; empty: none [length]
  Response respond(const Vector& trace, const std::vector<ContactState>& start, const Vector& moved = {}) const;

  /// Response with given pair states, the linear problem (11): closed pairs are tied in the normal direction (at their gaps), sticking
  /// pairs along the tangents too, slipping pairs carry a given tangential force, open pairs none.
  /// \param closed  pairs, made by held()
  Response respondLinear(const Vector& trace, const ContactCompliance::Closed& closed, const Vector& moved = {}) const;

  int id() const { return id_; }
  const std::vector<Member>& members() const { return members_; }
  const ContactRows& rows() const { return rows_; }
  const std::vector<ContactPair>& pairs() const { return pairs_; }  ///< pair of each row
  /// Pairs with both nodes held in the normal direction; they never enter the local problem.
  const std::vector<ContactPair>& idlePairs() const { return idlePairs_; }
  const std::vector<GlobalId>& boundary() const { return boundary_; }
  const std::vector<int>& boundaryPositions() const { return boundaryPositions_; }
  int dofs() const { return static_cast<int>(globalDofs_.size()); }
  const SparseMatrix& stiffness() const { return stiffness_; }
  /// Unknowns of a member within the group: position of each of its free unknowns.
  const std::vector<int>& positionsOf(int member) const { return positions_[member]; }

  /// The group with its boundary held (for respond) and free (local Neumann problems; factored on first use).
  const ContactCompliance& held() const { return *held_; }
  const ContactCompliance& floating() const;

  /// flux <- K_BB trace + K_BI v: flux on the boundary for interior unknowns v.
  void flux(ConstLocalView trace, ConstLocalView interior, LocalView flux) const;
  /// load <- -K_IB trace
  void interiorLoad(ConstLocalView trace, LocalView load) const;
  const std::vector<int>& interiorPositions() const { return interiorPositions_; }

  /// Rigid modes of the whole group, unknowns x k: combinations of the members' modes that agree where members meet and vanish where
  /// displacements are prescribed, and on the boundary if it is held. A hinge between two members is found as well.
  Matrix rigidKernel(bool boundaryHeld) const;

 protected:
  /// Solves the unilateral problem with the boundary held: forces and gaps >= 0, their product zero. Not called if a law of the scene
  /// restricts sliding or never lets a pair open: pair states are given then (respondLinear).
  /// \param v  in: loads of the interior, one column; out: displacements of the interior
  /// \param start  initial status
  /// \param moved  contribution to the rows that reduces their gaps; empty: none [length]
  /// \throws NumericalError  no equilibrium exists, or none was found
  virtual ContactCompliance::State doSolve(LocalView v, const std::vector<ContactState>& start, const Vector& moved) const = 0;
  /// The rows in the unknowns of the interior.
  const ContactRows& heldRows() const { return interiorRows_; }

 private:
  int placeOf(GlobalId dof) const;
  void number(const std::vector<GlobalId>& boundary);
  void assemble();
  void collectRows(const ContactLaws& laws);
  Matrix heldLoad(const Vector& trace) const;  // load of the interior, one column
  void place(const Vector& trace, const Vector& interior, Response& response) const;
  Response finish(const Vector& trace, const Vector& interior, Response response) const;

  int id_;
  std::vector<Member> members_;
  LocalSolverMaker solver_;
  std::vector<GlobalId> globalDofs_;         // ascending
  std::vector<std::vector<int>> positions_;  // member -> places of its unknowns
  std::vector<GlobalId> boundary_;
  std::vector<int> boundaryPositions_, interiorPositions_, nodeOf_;
  SparseMatrix stiffness_, ib_, bb_;
  Vector load_;
  double constantEnergy_ = 0.0;
  ContactRows rows_;
  ContactRows interiorRows_;
  std::vector<ContactPair> pairs_, idlePairs_;
  std::unique_ptr<GeneralisedInverse> heldInverse_;
  std::unique_ptr<ContactCompliance> held_;
  mutable std::unique_ptr<GeneralisedInverse> floatingInverse_;
  mutable std::unique_ptr<ContactCompliance> floating_;
};

void registerBuiltIns(Registry<ContactGroup>& registry);

}  // namespace suture
