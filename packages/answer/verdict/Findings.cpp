#include <suture/answer/verdict/Findings.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <algorithm>
#include <sstream>

namespace suture {

namespace {

struct Name {
  const char *name, *advice;
};

constexpr const char* kTighter = "Try a smaller Outer Solver/Tolerance, or another Outer Solver/Type (Monolithic is the reference)";
constexpr const char* kContact =
    "The contact iteration ended in a wrong state: try a smaller Outer Solver/Tolerance, another Formulation, or Outer Solver/Type = "
    "Monolithic";
constexpr const char* kFriction =
    "The friction iteration ended in a wrong state: try a smaller Outer Solver/Tolerance, or Outer Solver/Type = Monolithic";
constexpr const char* kOther = "Monolithic has failed: try the default Outer Solver/Type with a Tolerance below 1e-8";
constexpr const char* kDefect = "The fields contradict the scene's conditions: please report this as a bug";

constexpr Name kNames[kQuantities] = {
    {"forces", kTighter},
    {"moments", kTighter},
    {"residual", kTighter},
    {"nodes", kTighter},
    {"contact", kTighter},
    {"prescribed", kDefect},
    {"seams", kDefect},
    {"penetration", kContact},
    {"tension", kContact},
    {"complementarity", kContact},
    {"status", kContact},
    {"digits",
     "Double precision is not sufficient: round-off of the body's displacements is too large for its forces. Remove the large rigid motion "
     "or gap from the scene, or reduce the ratio of the stiffnesses"},
    {"rotation",
     "The body rotates, and only the shape of a contact constrains it. Small rotations are assumed, so its position is meaningless. "
     "Constrain one component of its displacement (Boundary Conditions/<name>/Components)"},
    {"friction", kFriction},
    {"slip", kFriction},
    {"dissipation", kFriction},
    {"slide",
     "The sides slide or roll by this number of elements, but contact forces stay at the nodes that are opposite in the mesh: set "
     "Motion = Moving (with Load Steps), or place the body at its final position in the mesh"},
    {"offset",
     "The contact acts across a gap: its forces act on two different lines, and their moment is missing. Let the sides touch in the mesh, "
     "or model the layer between them as a body"},
};

}  // namespace

std::string nameOf(Quantity quantity) { return kNames[std::size_t(quantity)].name; }

std::string adviceOf(Quantity quantity, bool byMonolithic, bool converged) {
  const char* advice = kNames[std::size_t(quantity)].advice;
  const bool isOnSolver = advice == kTighter || advice == kContact || advice == kFriction;
  if (isOnSolver && !converged) return "";
  return isOnSolver && byMonolithic ? kOther : advice;
}

double doubtOf(Quantity quantity) {
  if (quantity == Quantity::Slide) return 0.5 * Bounds::slide;
  if (quantity == Quantity::Offset) return 0.2 * Bounds::offset;
  return std::numeric_limits<double>::infinity();
}

std::string whereText(const Finding& finding, const std::vector<std::string>& bodies, const std::vector<ContactPiece>& pieces,
                      int dimension) {
  if (!finding.made) return "";
  std::ostringstream text;
  const auto body = [&](int b) { return b < 0 || b >= int(bodies.size()) ? std::string("no body") : "'" + bodies[b] + "'"; };
  const std::string place = placeText(finding.place, dimension);
  if (finding.pair >= 0) {
    text << "pair " << finding.pair;
    for (const ContactPiece& piece : pieces)
      if (std::find(piece.pairs.begin(), piece.pairs.end(), finding.pair) != piece.pairs.end()) text << " of '" << piece.name << "'";
    text << ", " << place
         << (finding.other == finding.body ? ", body " + body(finding.body)
                                           : ", bodies " + body(finding.body) + " and " + body(finding.other));
  } else if (finding.body < 0) {
    text << "a contact force without a pair";
  } else {
    text << "body " << body(finding.body) << ", " << place;
  }
  return text.str();
}

}  // namespace suture
