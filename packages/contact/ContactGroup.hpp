#pragma once
#include <suture/algebra/GeneralisedInverse.hpp>
#include <suture/base/Registry.hpp>
#include <suture/constraints/ContactLaw.hpp>
#include <suture/contact/ContactCompliance.hpp>
#include <suture/contact/ContactRows.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace suture {

/// All subdomains that touch a contact piece (or pieces that share a subdomain), together, whole on one rank: seams inside are eliminated
/// with the interior, the group's boundary are the unknowns shared with other subdomains. Given the trace U there, it solves its own small
/// contact problem (8), and answers with the flux S_*j(U) of (15). Local.
///
/// How the contact problem is solved is a strategy, `Condensed Groups/Contact Group`: Exact; a user's own derives, and writes doSolve().
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
    Vector flux;                       ///< gradient of the least energy with respect to the trace, loads included [force]
    double energy = 0.0;               ///< least energy, prescribed displacements' part included
    std::vector<ContactState> status;  ///< status of each pair
    Vector force;                      ///< force of each row [force]
    Vector displacement;               ///< all unknowns of the group
  };
  /// Solves the group's contact problem for a trace, from a status to start with.
  /// \param moved  addition of the bodies' rigid motions, beside the trace, to the rows; empty: none [length]
  Response respond(const Vector& trace, const std::vector<ContactState>& start, const Vector& moved = {}) const;

  /// Response with some pairs glued in the normal direction (at their gaps), those that stick along the tangents too, the others free but
  /// for the forces of those that slip: the linear problem (11).
  /// \param closed  pairs, made by held()
  Response respondLinear(const Vector& trace, const ContactCompliance::Closed& closed, const Vector& moved = {}) const;
  /// Its change with the trace and with forces of pairs, > 0 compressive, that act beside those of the closed ones: without loads and gaps.
  Response changeLinear(const Vector& trace, const ContactCompliance::Closed& closed, const Vector& pairForces) const;

  int id() const { return id_; }
  const std::vector<Member>& members() const { return members_; }
  const ContactRows& rows() const { return rows_; }
  const std::vector<ContactPair>& pairs() const { return pairs_; }  ///< pair of each row
  /// Pairs both of whose nodes are held in the normal direction: never part of the local problem.
  const std::vector<ContactPair>& idlePairs() const { return idlePairs_; }
  const std::vector<GlobalId>& boundary() const { return boundary_; }
  const std::vector<int>& boundaryPositions() const { return boundaryPositions_; }
  int dofs() const { return static_cast<int>(globalDofs_.size()); }
  const SparseMatrix& stiffness() const { return stiffness_; }
  /// Unknowns of a member within the group: position of each of its free unknowns.
  const std::vector<int>& positionsOf(int member) const { return positions_[member]; }

  /// The group with its boundary held (respond) and free (local Neumann problems; factored when first asked for).
  const ContactCompliance& held() const { return *held_; }
  const ContactCompliance& floating() const;

  /// flux <- K_BB trace + K_BI v: flux of the boundary for unknowns v of the interior.
  void flux(ConstLocalView trace, ConstLocalView interior, LocalView flux) const;
  /// load <- -K_IB trace
  void interiorLoad(ConstLocalView trace, LocalView load) const;
  const std::vector<int>& interiorPositions() const { return interiorPositions_; }

  /// Rigid modes of the whole group, unknowns x k: combinations of members' modes that agree where members meet and vanish where
  /// prescribed, and on the boundary if it is held. (A hinge between two members is found, too.)
  Matrix rigidKernel(bool boundaryHeld) const;

 protected:
  /// The unilateral problem with the boundary held: forces and gaps >= 0, their product zero. Not asked for where a law of the scene
  /// restricts sliding or never opens a pair: states of pairs are given then (respondLinear).
  /// \param v  in: loads of the interior, one column; out: its displacements
  /// \param start  a status to start with
  /// \param moved  addition to the rows, which makes their gaps smaller; empty: none [length]
  /// \throws NumericalError  there is no equilibrium, or none was found
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
  std::vector<std::vector<int>> positions_;  // member -> its unknowns' places
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
