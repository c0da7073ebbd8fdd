#pragma once
#include <suture/mesh/Mesh.hpp>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace suture::proposal {

/// Bodies proposed from the element groups of a mesh: the smallest groups that contain whole connected parts of the mesh without overlap.
struct Bodies {
  std::vector<std::string> names;
  std::vector<std::pair<std::string, std::string>> parts;  ///< other element groups within one body, with the name of the body
  std::vector<std::string> notes;                          ///< elements without a body, and the reason
};
/// Local (rank 0).
Bodies proposeBodies(const Mesh& mesh);

/// A side group and its location.
struct Group {
  std::string name;
  int body = -1;                ///< number in Mesh::bodies; -1: on several
  std::set<int> bodies, nodes;  ///< numbers of all its bodies and nodes
  int sides = 0;
  double size = 0.0;                  ///< [length or area]
  Point low{0, 0, 0}, high{0, 0, 0};  ///< its bounding box [length]
  Point centre{0, 0, 0};              ///< mean of its nodes
  std::vector<Side> all;
};
/// All side groups that are not empty, by name. The bodies of `mesh` are assigned. Local (rank 0).
std::vector<Group> groupsOf(const Mesh& mesh);

/// Sides of different bodies that face each other.
struct Contact {
  std::vector<std::string> sideA;     ///< side groups of one body
  std::vector<std::string> sideB;     ///< side groups of other bodies
  double gap = 0.0;                   ///< smallest distance between nodes of both sides along their normals; < 0: overlap [length]
  Point normal{0, 0, 0};              ///< mean outward normal of Side A where it faces Side B; at the gap if the side faces all around
  std::vector<std::string> problems;  ///< for which suture_solve would refuse it
};
/// The name of a contact in the scene.
std::string nameOf(const Contact& contact);
struct Contacts {
  std::vector<Contact> all;
  std::vector<std::string> notes;  ///< sides that face another body but belong to no group
  double reach = 0.0;              ///< largest distance that was searched, over all pairs of bodies [length]
};
/// Nodes face each other if their normals are opposite and their distance is below the node spacing or a twentieth of the smaller
/// body. Local (rank 0).
Contacts proposeContacts(const Mesh& mesh, const std::vector<Group>& groups);

/// Conditions with which any scene runs: one body held, one pushed, soft springs on all others.
///
/// Rules: 1. The lowest body in contact is held at its lowest side, preferably one outside all contacts. If every group is a side of a
/// contact or reaches both sides of one, none is held. 2. The body separated from the held one by the most contacts is pushed towards it,
/// through the nearest contact, by prescribing the displacement of its rearmost side; nodes of both sides of one contact are never
/// prescribed. If there is no such side, a force on the body pushes. A geometry without contact is compressed. 3. All other bodies have
/// elastic supports on all their sides, far softer than the bodies, because contact does not hold a body in every direction. Such a
/// problem has exactly one solution.
struct Supports {
  std::string held, heldBody;                 ///< side group and its body; empty: none can be held
  std::string pushed, pushedBody;             ///< empty: nothing to push
  bool byForce = false;                       ///< a force instead of a displacement
  Point push{0, 0, 0};                        ///< displacement [length] or total force
  std::vector<std::string> soft, softBodies;  ///< side groups with elastic supports, and their bodies
  double stiffness = 0.0;                     ///< stiffness of the elastic supports, normal and tangential [stress / length]
  std::vector<std::string> loose;             ///< bodies without any side group, which cannot be held
};
/// `groups`, `contacts` as proposed. Local. \param youngModulus  of the example material [stress]
Supports proposeSupports(const Mesh& mesh, const std::vector<Group>& groups, const Contacts& contacts, double youngModulus);

/// Lowest and highest coordinates of each body. Local.
std::vector<std::pair<Point, Point>> boxesOf(const Mesh& mesh);

}  // namespace suture::proposal
