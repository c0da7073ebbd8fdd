#pragma once
#include <suture/base/hdf5/Hdf5Reader.hpp>
#include <suture/base/hdf5/Hdf5Writer.hpp>
#include <suture/motion/BodyFrame.hpp>
#include <suture/motion/MovingBodies.hpp>
#include <suture/pairs/ContactPair.hpp>
#include <suture/pairs/ContactState.hpp>

#include <string>
#include <vector>

namespace suture {

/// Bodies that move far (Motion = Moving) at the end of a load step: what the next step needs of it, for a checkpoint.
struct MovedBodies {
  /// A connected part of a body.
  struct Part {
    BodyFrame frame;
    Point moment{0, 0, 0};            ///< moment of its forces about the displacements of their nodes [force x length]
    MovingBodies::Motion lastMotion;  ///< in the step
  };
  /// A contact pair, by its contact and the node that carries it: pairs have other numbers in the next step.
  struct Pair {
    int line, node;
    ContactState state;
    bool slipped;       ///< it has slid under a friction bound
    double dissipated;  ///< work of its tangential force [energy]
    double force;       ///< along the normal, on side B [force]
    Point tangential;   ///< on side B [force]
  };
  std::vector<Part> parts;
  std::vector<double> beside;  ///< displacements of all nodes from the bodies at their frames, node-major [length]
  std::vector<Pair> pairs;

  bool empty() const { return parts.empty(); }
};

/// Writes them to an open file. Collective. \param group  name of an existing group \param bodies  on rank 0
void writeMovedBodies(Hdf5Writer& file, const Comm& comm, const std::string& group, const MovedBodies& bodies);

/// Reads them on all ranks; empty if the group has none. Collective. \param path  of the file, for messages \throws InputError  damaged
MovedBodies readMovedBodies(const Hdf5Reader& file, const std::string& group, const std::string& path);

}  // namespace suture
