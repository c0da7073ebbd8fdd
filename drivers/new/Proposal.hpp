#pragma once
#include <suture/mesh/Mesh.hpp>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace suture::proposal {

/// Bodies of a mesh, proposed from its element groups: the smallest that hold whole connected parts of the mesh and do not overlap.
struct Bodies {
  std::vector<std::string> names;
  std::vector<std::pair<std::string, std::string>> parts;  ///< other element groups within one body, with its name
  std::vector<std::string> notes;                          ///< elements without a body, and why they have none
};
/// Local (rank 0).
Bodies proposeBodies(const Mesh& mesh);

/// A side group and where it lies.
struct Group {
  std::string name;
  int body = -1;                ///< number in Mesh::bodies; -1: on several
  std::set<int> bodies, nodes;  ///< numbers of all that it has sides of
  int sides = 0;
  double size = 0.0;                  ///< [length or area]
  Point low{0, 0, 0}, high{0, 0, 0};  ///< the box around it [length]
  Point centre{0, 0, 0};              ///< mean of its nodes
  std::vector<Side> all;
};
/// All side groups with sides, by name. `mesh` has its bodies. Local (rank 0).
std::vector<Group> groupsOf(const Mesh& mesh);

/// Sides of different bodies that face each other.
struct Contact {
  std::vector<std::string> sideA;     ///< side groups of one body
  std::vector<std::string> sideB;     ///< side groups of other bodies
  double gap = 0.0;                   ///< least distance between nodes of the two, along their normals; < 0: drawn to overlap [length]
  Point normal{0, 0, 0};              ///< mean outward normal of Side A where it faces Side B; of a side that faces all around, at the gap
  std::vector<std::string> problems;  ///< by which suture_solve would refuse it
};
/// The name of a contact in the scene.
std::string nameOf(const Contact& contact);
struct Contacts {
  std::vector<Contact> all;
  std::vector<std::string> notes;  ///< sides that face another body and belong to no group
};
/// Nodes face each other when their normals are opposite and their distance is below the spacing of nodes or a twentieth of the smaller
/// body. Local (rank 0).
Contacts proposeContacts(const Mesh& mesh, const std::vector<Group>& groups);

/// Conditions by which any scene runs: one body held, one pushed, soft springs on all others.
///
/// The rule: 1. The lowest body in contact is held at its lowest side, one that no contact reaches if there is one. Where every group is a
/// side of a contact or reaches both sides of one, none is held. 2. The body that most contacts separate from it is pushed towards it,
/// across the nearest of them, by a given displacement of the side farthest back; nodes of both sides of one contact are never prescribed.
/// Without such a side a force on the body pushes. A geometry without contact is pressed together. 3. All other bodies stand on elastic
/// supports, far softer than they are, at all of their sides: no contact holds a body in every direction. Such a problem has exactly one
/// solution.
struct Supports {
  std::string held, heldBody;                 ///< side group and its body; empty: none can be held
  std::string pushed, pushedBody;             ///< empty: nothing to push
  bool byForce = false;                       ///< a force instead of a displacement
  Point push{0, 0, 0};                        ///< displacement [length] or total force
  std::vector<std::string> soft, softBodies;  ///< side groups with elastic supports, bodies that these keep
  double stiffness = 0.0;                     ///< normal and tangential, of the elastic supports [stress / length]
  std::vector<std::string> loose;             ///< bodies with no side group at all: nothing can hold them
};
/// `groups`, `contacts` as proposed. Local. \param youngModulus  of the example material [stress]
Supports proposeSupports(const Mesh& mesh, const std::vector<Group>& groups, const Contacts& contacts, double youngModulus);

/// Lowest and highest coordinates of each body. Local.
std::vector<std::pair<Point, Point>> boxesOf(const Mesh& mesh);

}  // namespace suture::proposal
