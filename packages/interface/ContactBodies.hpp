#pragma once
#include <suture/base/ForceScale.hpp>
#include <suture/base/Types.hpp>
#include <suture/constraints/ContactLaw.hpp>
#include <suture/constraints/RigidMotion.hpp>
#include <suture/contact/RigidContact.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <memory>
#include <vector>

namespace suture {

/// The rigid motions of the connected parts of all bodies, and what contact pairs feel of them: the rigid model of a distributed scene.
/// Replicated: all ranks know all parts and pairs.
class ContactBodies {
 public:
  /// \param subdomains     of this rank, assembled
  /// \param pairStiffness  by pair id, of those that this rank answers for: 1 / sum n^2 / K_nn [force / length]
  /// \param laws  of the contacts: bodies whose pairs never open move together
  /// Collective.
  ContactBodies(const Comm& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains, const std::map<int, double>& pairStiffness,
                const ContactLaws& laws = {});
  /// Geometry alone: no loads, pads of stiffness one, penetrations of the initial gaps less what supports close. Collective.
  ContactBodies(const Comm& comm, const std::vector<const SubdomainMesh*>& meshes, const ContactLaws& laws = {});

  const RigidContact& rigid() const { return *rigid_; }
  RigidContact& rigid() { return *rigid_; }
  int dimension() const { return dimension_; }
  const std::vector<RigidPart>& parts() const { return parts_; }
  /// Part of a subdomain of this rank, by its place.
  int partOf(int subdomain) const { return partOf_[subdomain]; }
  /// The motions of one part among those of all, as amplitudes of the part.
  Vector amplitudes(int part, const Vector& motion) const;
  /// Column of a part's first motion among those of all; only of bodies that nothing binds together.
  int firstMotion(int part) const { return first_[part]; }
  /// True if motions are those of bodies that pairs bind together, not of each part alone.
  bool areBound() const { return areBound_; }
  /// Parts that contact pairs join.
  const std::vector<std::pair<int, int>>& neighbours() const { return neighbours_; }
  /// Parts on which nothing acts but contact (idleBodies).
  const std::vector<char>& idle() const { return idle_; }
  /// Takes the largest forces on each body on the path of load steps so far: part of them is rounding. \param carried  empty: none
  void remember(const std::vector<BodyForces>& carried);
  /// Twice the energy that each part has had on that path, at most; zero if there is none. [force length]
  const Vector& carriedEnergy() const { return carriedEnergy_; }
  /// Adds motions (empty: none) to the free values of a subdomain of this rank.
  /// \param place  of the subdomain
  void addMotion(int place, const Subdomain& subdomain, const Vector& motion, Vector& values) const;

 private:
  using Meshes = std::vector<const SubdomainMesh*>;
  void findParts(const Comm& comm, const Meshes& meshes);
  RigidContact::Pairs gatherPairs(const Comm& comm, const Meshes& meshes, const std::map<int, double>& pairStiffness,
                                  const ContactLaws& laws) const;
  void bind(RigidContact::Pairs& pairs);
  Vector work(const Comm& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains) const;
  void findLoads(const Comm& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains);

  int dimension_ = 2;
  std::vector<RigidPart> parts_;
  std::vector<Vector> lift_;  // of each part: amplitudes that prescribed displacements ask for
  std::vector<int> first_;    // of each part: column of its first motion
  int motions_ = 0;           // their number, for all parts
  bool areBound_ = false;
  Matrix together_;  // if they are: columns, motions of parts that leave bound pairs as they are
  std::vector<int> partOf_;
  std::unique_ptr<RigidContact> rigid_;
  std::vector<double> loads_;  // of each part: sum of the magnitudes of what acts on its free unknowns
  std::vector<char> idle_;
  std::vector<std::pair<int, int>> neighbours_;
  Vector carriedEnergy_;
};

}  // namespace suture
