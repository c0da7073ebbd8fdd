#pragma once
#include <suture/base/Types.hpp>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Sides on which displacements are prescribed.
struct HeldSides {
  std::vector<std::string> groups;
  std::array<bool, 3> components{{false, false, false}};  ///< prescribed Cartesian components
  bool alongNormal = false;                               ///< the normal component is prescribed
  bool alongOther = false;                                ///< the component along another direction is prescribed (SupportDirection)
  bool isPolynomial = true;                               ///< the shape functions of the sides represent the prescribed values

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.groups), each(self.components), each(self.alongNormal), each(self.alongOther), each(self.isPolynomial);
  }
};

/// Sides of a contact.
struct TouchingSides {
  std::string contact;                        ///< name
  int line = -1;                              ///< ContactPair::line
  std::vector<std::string> groupsA, groupsB;  ///< the second empty: a rigid obstacle
  bool isSoft = false;
  bool isInterpolated = false;  ///< the gap is not a polynomial of the sides' order
  std::map<GlobalId, double>
      gaps{};  ///< initial gaps at the nodes of side A if the scene gives them and they are such a polynomial [length]

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.contact), each(self.line), each(self.groupsA), each(self.groupsB), each(self.isSoft), each(self.isInterpolated);
    each(self.gaps);
  }
};

/// Conditions of a scene by groups of sides, for results that depend on the boundary between nodes: error bounds. On rank 0.
struct BoundaryParts {
  std::vector<HeldSides> held;
  std::vector<TouchingSides> touching;
  std::vector<std::string> rigid;   ///< groups that move as rigid bodies
  std::vector<std::string> onMean;  ///< groups whose mean displacement is prescribed
  bool isKnown = false;             ///< false: a mesh that was partitioned by another program run

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.held), each(self.touching), each(self.rigid), each(self.onMean), each(self.isKnown);
  }
};

struct Mesh;
struct Condition;
struct ContactSurface;

/// The parts of a scene's boundary with these conditions and contacts. Local (rank 0).
BoundaryParts boundaryParts(const Mesh& mesh, const std::vector<Condition>& conditions, const std::vector<ContactSurface>& contacts);

}  // namespace suture
