#include <suture/mesh/CellGeometry.hpp>
#include <suture/quality/Findings.hpp>

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
    "The iteration of friction ended in a wrong state: try a smaller Outer Solver/Tolerance, or Outer Solver/Type = Monolithic";
constexpr const char* kOther = "Try the default Outer Solver/Type, with a Tolerance below 1e-8: Monolithic has failed";
constexpr const char* kDefect = "The fields contradict the scene's conditions: report this as a defect of the program";

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
     "Double precision cannot hold the answer: the body's own forces drown in the rounding of its displacements. Take the large rigid "
     "motion "
     "or gap out of the scene, or bring the stiffnesses closer together"},
    {"rotation",
     "The body turns, and nothing but the shape of a contact holds it: rotations are taken for small ones, so its place means nothing. "
     "Hold "
     "it by a condition on one component (Boundary Conditions/<name>/Components)"},
    {"friction", kFriction},
    {"slip", kFriction},
    {"dissipation", kFriction},
    {"slide",
     "The sides slide, or roll, by that many elements, and their forces stay between the nodes that face each other in the mesh: place the "
     "body in the mesh where it comes to lie, or move it less"},
    {"offset",
     "The contact holds its sides across a gap: its forces act at two places, and their moment is missing. Let the sides meet in the mesh, "
     "or model what lies between them as a body"},
};

}  // namespace

std::string nameOf(Quantity quantity) { return kNames[std::size_t(quantity)].name; }

std::string adviceOf(Quantity quantity, bool byMonolithic) {
  const char* advice = kNames[std::size_t(quantity)].advice;
  return byMonolithic && (advice == kTighter || advice == kContact || advice == kFriction) ? kOther : advice;
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
