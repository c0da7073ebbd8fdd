#pragma once
#include <corpus/Builder.hpp>

namespace suture::corpus {

constexpr double pi = 3.14159265358979323846;

/// Each family fills a builder with a random scene of its kind.
using Family = void (*)(Builder&);

// Boxes.
void blocks(Builder& scene);  ///< a block on another, with distorted lines
void stack(Builder& scene);   ///< 2 to 6 blocks with gaps, held at the sides
void tray(Builder& scene);    ///< a peg in a U with clearance, held by contact only
void tilted(Builder& scene);  ///< a block that falls on its vertex
void layers(Builder& scene);  ///< a long layer that lifts off
void bumps(Builder& scene);   ///< a block on two bumps

// Round bodies.
void disc(Builder& scene);          ///< half a disc in half a ring, clearance or interference
void lug(Builder& scene);           ///< half a lug on half a pin
void pushedPin(Builder& scene);     ///< a pin displaced in a ring
void discOnSlopes(Builder& scene);  ///< a disc on two inclined obstacles, under a lid
void arch(Builder& scene);          ///< voussoirs under pressure

// Rigid obstacles.
void onHalfPlane(Builder& scene);
void onDisc(Builder& scene);
void onGraph(Builder& scene);

}  // namespace suture::corpus
