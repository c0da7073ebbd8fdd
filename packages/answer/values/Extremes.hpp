#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <map>
#include <vector>

namespace suture {

/// A value and its location. Trivially copyable: sent as bytes.
struct Extreme {
  double value = 0.0;
  GlobalId id = -1;  ///< node or element of the mesh
  Point place{0, 0, 0};
  int body = -1;
  int unused = 0;  ///< padding, so that no undefined bytes are sent

  bool exists() const { return body >= 0; }
};

/// The largest of many values. Values that differ from it by less than a millionth count as equal, and the location is that of the lowest
/// body and number among them: neither round-off nor the number of ranks changes it.
class Largest {
 public:
  /// Local. \param place  called only if the value may be the largest
  template <typename Place>
  void take(double value, int body, GlobalId id, const Place& place) {
    if (mayTake(value)) insert({value, id, place(), body, 0});
  }
  /// False for values that take() would ignore.
  bool mayTake(double value) const { return value >= least_ || front_.empty(); }
  /// Merges the values kept by another object. Local.
  void take(const Largest& other) {
    for (const Extreme& one : other.front_) insert(one);
  }
  Extreme found() const;

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.front_), each(self.least_);
  }

 private:
  void insert(const Extreme& one);

  std::vector<Extreme> front_;  // nearly the largest, by body and number; each larger than those before it
  double least_ = 0.0;          // values below it are not kept
};

/// Extremes of a solution over all bodies. A principal stress that is only round-off of others (uniaxial stress) is zero, without location.
/// The 3D tensor counts: in 2D scenes the out-of-plane stress is one of the principal ones.
struct Extremes {
  Extreme vonMises;             ///< [stress]
  Extreme tension;              ///< largest principal stress [stress]
  Extreme compression;          ///< smallest principal stress [stress]
  Extreme displacement;         ///< largest norm of u [length]
  Extreme displacementSince{};  ///< largest norm of u since the requested time; not there if none was requested [length]
  bool recovered = false;  ///< stresses are recovered ones at nodes, else those at centroids; Extreme::id is the node or element number
};

/// Displacements and stresses in which extremes are sought; references must outlive the call.
struct SearchedFields {
  const std::vector<SubdomainMesh>& meshes;  ///< subdomains of this rank
  const ElasticModel& model;
  const std::vector<Vector>& displacement;  ///< by mesh, without its lift
  const std::map<int, Matrix>& own;         ///< centroid stresses of meshes with their own physics, by mesh index
  const std::vector<Matrix>& nodal;         ///< recovered stresses of each mesh; empty: centroids are used
};

/// Largest norm of a displacement relative to an earlier one. Collective. \param displacement  by mesh, node-major, Cartesian [length]
Extreme largestVector(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& displacement);

/// The same on all ranks. Collective.
Extremes findExtremes(const Comm& comm, const SearchedFields& fields);

}  // namespace suture
