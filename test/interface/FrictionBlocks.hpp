#pragma once
#include <support/Blocks.hpp>
#include <suture/pairs/FrictionLaws.hpp>

namespace suture::blocks {

/// Sides of a contact with friction.
enum class Sides { Matching, Mortar, Obstacle };

/// A block of 2 x 1 (in 3D 2 x 1 x 1) on another one or on a rigid plane, each cut into two named subdomains along x. The lower one is held
/// below; the top is moved down, tilted and sideways so that the contact sticks on one side and slips on the other.
/// \param cells  along the height;  \param open  lifts one end: some pairs open;  \param angle  of rotation of the whole scene, x upwards:
/// nodes in several pairs keep Cartesian axes
Scene rubbedBlocks(int dimension, Sides sides, const std::shared_ptr<const ContactLaw>& law, int cells = 2, bool open = false,
                   double angle = 0.0);

}  // namespace suture::blocks
