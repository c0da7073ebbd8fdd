#pragma once
#include <suture/base/ForceScale.hpp>
#include <suture/base/Types.hpp>
#include <suture/motion/RigidMotion.hpp>
#include <suture/pairs/ContactLaw.hpp>
#include <suture/search/RigidBodyModel.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Rigid motions of a part that only elastic supports hold. Plain.
struct SupportedMotions {
  Matrix motions;    ///< amplitudes x motions
  Vector stiffness;  ///< stiffness of the supports in each motion [force / length]
};

/// The rigid motions of the connected parts of all bodies and their effect on contact pairs: the rigid model of a distributed scene.
/// Replicated: all ranks know all parts and pairs.
class ContactBodies {
 public:
  /// \param subdomains     of this rank, assembled
  /// \param pairStiffness  by pair id, of the pairs that this rank owns: 1 / sum n^2 / K_nn [force / length]
  /// \param laws  of the contacts: bodies whose pairs never open move together
  /// Collective.
  ContactBodies(const Comm& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains, const std::map<int, double>& pairStiffness,
                const ContactLaws& laws = {});
  /// Geometry only: no loads, pads of stiffness one, penetrations from the initial gaps minus what prescribed displacements close.
  /// Collective.
  ContactBodies(const Comm& comm, const std::vector<const SubdomainMesh*>& meshes, const ContactLaws& laws = {});

  const RigidBodyModel& rigid() const { return *rigid_; }
  RigidBodyModel& rigid() { return *rigid_; }
  int dimension() const { return dimension_; }
  const std::vector<RigidPart>& parts() const { return parts_; }
  /// Part of a subdomain of this rank, identified by its place.
  int partOf(int subdomain) const { return partOf_[subdomain]; }
  /// Extracts one part's motion from that of all parts, as amplitudes of the part.
  Vector amplitudes(int part, const Vector& motion) const;
  /// Column of a part's first motion; only for bodies that no pair binds together.
  int firstMotion(int part) const { return free_.first[part]; }
  /// True if motions are those of bodies bound together by pairs, not of separate parts.
  bool areBound() const { return areBound_; }
  /// Pairs of parts that are in contact.
  const std::vector<std::pair<int, int>>& neighbours() const { return neighbours_; }
  /// Parts on which only contact forces act (idleBodies).
  const std::vector<char>& idle() const { return idle_; }
  /// Sets the largest forces on each body on the path of load steps so far, from which round-off is estimated. \param carried  empty: none
  void remember(const std::vector<BodyForces>& carried);
  /// Motions of each part that only elastic supports hold, along the principal axes of the supports. Empty if there are none, or if pairs
  /// bind bodies together.
  const std::vector<SupportedMotions>& supported() const { return supported_; }
  /// Twice the largest energy that each part has had on that path; zero if unknown. [force length]
  const Vector& carriedEnergy() const { return carriedEnergy_; }
  /// Adds rigid motions (empty: none) to the free values of a subdomain of this rank.
  /// \param place  of the subdomain
  void addMotion(int place, const Subdomain& subdomain, const Vector& motion, Vector& values) const;

 private:
  using Meshes = std::vector<const SubdomainMesh*>;
  /// Motions of all parts, numbered part by part.
  struct Basis {
    std::vector<Matrix> motions;  // by part: amplitudes x motions
    std::vector<int> first;       // by part: number of its first motion
    int count = 0;

    void add(Matrix ofPart);
  };
  void findParts(const Comm& comm, const Meshes& meshes);
  RigidBodyModel::Pairs gatherPairs(const Comm& comm, const Meshes& meshes, const std::map<int, double>& pairStiffness,
                                    const ContactLaws& laws, const Basis& basis) const;
  void bind(RigidBodyModel::Pairs& pairs);
  void findSoftMotions(const Comm& comm, const Meshes& meshes, const std::vector<std::unique_ptr<Subdomain>>& subdomains,
                       const std::map<int, double>& pairStiffness, const ContactLaws& laws);
  Vector work(const Comm& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains, const Basis& basis) const;
  void findSupportedMotions(const Comm& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains);
  void findLoads(const Comm& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains);

  int dimension_ = 2;
  std::vector<RigidPart> parts_;
  std::vector<Vector> lift_;  // per part: amplitudes required by prescribed displacements
  Basis free_;                // RigidPart::free of all parts
  bool areBound_ = false;
  Matrix together_;  // if areBound_: motions (columns) of the parts that leave bound pairs unchanged
  std::vector<int> partOf_;
  std::unique_ptr<RigidBodyModel> rigid_;
  std::vector<double> loads_;  // per part: sum of the magnitudes of the forces on its free unknowns
  std::vector<char> idle_;
  std::vector<std::pair<int, int>> neighbours_;
  Vector carriedEnergy_;
  std::vector<SupportedMotions> supported_;
};

}  // namespace suture
