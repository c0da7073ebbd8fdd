#pragma once
#include <map>
#include <string>

#include "ExampleUnits.hpp"
#include "Proposal.hpp"

namespace suture::proposal {

/// The parts of a new scene.
struct NewScene {
  std::string title, model;
  std::string file;                    ///< geometry or mesh, relative to the scene
  std::vector<std::string> constants;  ///< NAME=VALUE of the .geo file
  Bodies bodies;
  std::vector<std::pair<Point, Point>> boxes;
  std::vector<Group> groups;
  Contacts contacts;
  std::vector<std::string> meshNotes;
  Supports supports;
  std::map<std::string, std::string> descriptions;  ///< shapes of the side groups of a CAD file
  ExampleUnits units{"m, N, Pa"};
  int dimension = 2;
  bool isConverted = false;  ///< the file carries a unit of length: STEP or IGES
};

/// Text for the distance between the sides of a contact.
std::string distanceText(const Contact& contact);

/// Which distances count as a contact.
std::string searchText(const Contacts& contacts);

/// Text of the scene file. It runs as it is, unless Supports::loose names bodies; placeholders are marked FILL IN. Local.
std::string sceneText(const NewScene& scene);

}  // namespace suture::proposal
