#pragma once
#include <suture/mesh/Mesh.hpp>

#include <string>
#include <utility>
#include <vector>

namespace suture::proposal {

/// Bodies of a mesh, proposed from its surface groups: the smallest that hold whole connected parts of the mesh and do not overlap.
struct Bodies {
  std::vector<std::string> names;
  std::vector<std::pair<std::string, std::string>> parts;  ///< other surface groups within one body, with its name
  std::vector<std::string> notes;                          ///< elements without a body, and why they have none
};
/// Local (rank 0).
Bodies proposeBodies(const Mesh& mesh);

/// A curve group and where it lies.
struct Group {
  std::string name;
  int body = -1;  ///< number in Mesh::bodies; -1: on several
  int sides = 0;
  double size = 0.0;                  ///< [length]
  Point low{0, 0, 0}, high{0, 0, 0};  ///< the box around it [length]
  Point centre{0, 0, 0};              ///< mean of its nodes
  std::vector<Side> all;
};
/// All curve groups with sides, by name. `mesh` has its bodies. Local (rank 0).
std::vector<Group> groupsOf(const Mesh& mesh);

/// Sides of different bodies that face each other.
struct Contact {
  std::string sideA;               ///< a curve group
  std::vector<std::string> sideB;  ///< curve groups of other bodies
  double gap = 0.0;                ///< least distance between nodes of the two, along the normal [length]
  Point normal{0, 0, 0};           ///< mean outward normal of Side A where it faces Side B
};
struct Contacts {
  std::vector<Contact> all;
  std::vector<std::string> notes;  ///< sides that face another body and belong to no group
};
/// Nodes face each other when their normals are opposite and their distance is below the spacing of nodes or a twentieth of the smaller
/// body. Local (rank 0).
Contacts proposeContacts(const Mesh& mesh, const std::vector<Group>& groups);

/// A condition that makes the scene run: the lowest body held, the others pressed against what they face.
struct Support {
  std::string body, group;
  Point displacement{0, 0, 0};  ///< [length]
};
/// One a body; a body without a curve group that is in no contact has none. Local.
std::vector<Support> proposeSupports(const Mesh& mesh, const std::vector<Group>& groups, const Contacts& contacts);

/// Lowest and highest coordinates of each body. Local.
std::vector<std::pair<Point, Point>> boxesOf(const Mesh& mesh);

}  // namespace suture::proposal
