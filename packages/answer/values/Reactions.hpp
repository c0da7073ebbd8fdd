#pragma once
#include <suture/answer/PairResult.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Forces and their moment about the origin. Per unit thickness in 2D. Axisymmetric: of the whole circle; x is the sum of radial
/// magnitudes, and there is no moment.
struct Resultant {
  Point force{0, 0, 0};   ///< [force]
  Point moment{0, 0, 0};  ///< [force x length]

  void add(const Point& place, const Point& more);
  void add(const Resultant& other, double factor = 1.0);
};

/// Resultants of every condition of a scene, acting on the bodies.
struct Reactions {
  std::vector<Resultant> supports;  ///< forces of prescribed displacements, by Support::condition; zero for conditions that are loads
  std::vector<Resultant> loads;     ///< in the order of ElasticModel::loads; zero for initial strains and stresses, which are not forces
  std::vector<Resultant> springs;   ///< forces of elastic supports, in the order of ElasticModel::supports
  Resultant own;                    ///< loads of subdomains with their own physics

  /// Adds the support forces at the nodes that this mesh counts. Local. \param force  internal minus external and contact forces at a node
  template <typename Force>
  void addSupports(const SubdomainMesh& mesh, const Force& force) {
    for (const Support& support : mesh.supports)
      if (counts(mesh, support.node)) addSupport(mesh, support, force(support.node));
  }
  /// Adds the forces of a load. Local. \param forces  node-major, Cartesian
  void addLoad(const SubdomainMesh& mesh, int number, const Vector& forces);
  /// Adds the forces of an elastic support. Local. \param forces  node-major, Cartesian
  void addSpring(const SubdomainMesh& mesh, int number, const Vector& forces);
  /// Adds other loads. Local.
  void addOwn(const SubdomainMesh& mesh, const Vector& forces);
  /// Sums over ranks. Collective.
  void finish(const Comm& comm, bool axisymmetric);

 private:
  void addSupport(const SubdomainMesh& mesh, const Support& support, const Point& force);
};

/// Resultant of a contact line.
struct ContactResultant {
  std::array<std::vector<int>, 2> bodies;  ///< bodies of sides A and B, ascending; none for a rigid obstacle
  Resultant onB;                           ///< forces on side B
  Point centre{0, 0, 0};                   ///< mean of the pair positions weighted by force; undefined where `pressing` is zero
  double pressing = 0.0;                   ///< sum of the pair forces [force]
  double closed = 0.0;                     ///< length or, axisymmetric, area of the closed pairs
  double whole = 0.0;                      ///< the same for all pairs
  int pairs = 0, active = 0;
  std::vector<ContactResultant> ofBodies{};  ///< the same for each pair of bodies, if there are several; one body on each side at most

  /// The centre is defined. Axisymmetric: it is a circle whose distance from the axis is a mean radius.
  bool presses() const { return pressing > 0.0; }
};

/// One resultant for each contact line of the scene, in its order. Pair forces act at the positions of the pairs. Local. \param lines
/// number of lines
std::vector<ContactResultant> contactResultants(const std::vector<PairResult>& pairs, int lines, bool axisymmetric);

}  // namespace suture
