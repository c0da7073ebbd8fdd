#include <suture/base/Errors.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/report/AccuracyRequest.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace suture {

namespace {

const char* const kList = "Accuracy";
const char* const kNone = "None";
const char* const kStraight = "Straight";
const char* const kCurved = "Curved";

std::map<std::string, Schema> quantities() {
  const char* const contact = "Name of the contact; may be omitted if there is only one.";
  return {{AccuracyRequest::kEnergy, Schema("Energy norm.")},
          {AccuracyRequest::kContactForce, Schema("Norm of the force of a contact.").text("Contact", "", contact)},
          {AccuracyRequest::kReaction,
           Schema("Norm of the force of a support.").text("Condition", std::nullopt, "Name of the boundary condition that holds a body.")},
          {AccuracyRequest::kMeanDisplacement, Schema("Mean displacement of a side group along a direction.")
                                                   .text("Group", std::nullopt, "Side group of the mesh.")
                                                   .reals("Direction", std::nullopt, "A vector of any length, one entry per dimension.")},
          {AccuracyRequest::kLargestPressure,
           Schema("Largest pressure of a contact. The run ends where the exact pressure is infinite, as at the end of a flat punch.")
               .text("Contact", "", "Name of the contact; empty: the largest pressure of all contacts.")}};
}

/// Name of the contact, condition or group in the list of a quantity.
std::string objectOf(const std::string& quantity, const Parameters& list) {
  if (quantity == AccuracyRequest::kEnergy) return "";
  const Parameters& own = list.sublist(quantity);
  const char* parameter = quantity == AccuracyRequest::kReaction           ? "Condition"
                          : quantity == AccuracyRequest::kMeanDisplacement ? "Group"
                                                                           : "Contact";
  return own.get<std::string>(parameter);
}

Point directionOf(const Parameters& settings, const Parameters& own) {
  const auto given = own.get<Teuchos::Array<double>>("Direction");
  const int dimension = sceneDimension(settings);
  if (given.size() != dimension)
    throw InputError("Accuracy/Mean Displacement/Direction",
                     std::to_string(given.size()) + " components; expected " + std::to_string(dimension));
  Point direction{0, 0, 0};
  std::copy(given.begin(), given.end(), direction.begin());
  if (!(norm(direction) > 0.0)) throw InputError("Accuracy/Mean Displacement/Direction", "is zero; expected a vector of any length");
  return direction;
}

std::string percent(double share) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g %%", 100 * share);
  return text;
}

}  // namespace

Schema AccuracyRequest::schema() {
  return Schema(
             "Accuracy of the answer: with Error, the program solves the scene on a sequence of meshes, each refined where the error of "
             "the "
             "previous one is large, until the error is small enough or a limit is reached. The files are those of the last mesh.")
      .wordOrNumber(
          "Error", kNone, {kNone}, {0.0, 1.0, true, true, {}},
          "Largest relative error of the quantity, 0.01 for 1 %; the error of Energy is the energy norm of the error over that of "
          "the solution. None: the scene is solved on its own mesh.")
      .choice("Quantity", kEnergy, quantities(),
              "Quantity of which the error is meant. All but Energy have estimated errors; meshes are refined by the energy norm.", "",
              {kEnergy})
      .oneOf("Order", "Automatic", {"Automatic", "1", "2"}, "Order of the elements. Automatic: Mesh/Order, or 2 without it.")
      .oneOf("Sides", kStraight, {kStraight, kCurved},
             "Sides of second-order elements on curves. Straight: the bound of the error is strict for the polygon of the mesh, and the "
             "effect of its straight sides is estimated and kept small by short sides; contacts and sliding supports stay curved. "
             "Curved: sides follow the curves, and the bound is an estimate.")
      .integer("Most Unknowns", 2000000, "Largest number of unknowns of a mesh, predicted before it is made.", Range::atLeast(1))
      .real("Most Seconds", 0.0, "Time limit for all meshes; a mesh that would exceed it is not made. 0: none.", Range::atLeast(0), "s")
      .integer("Most Levels", 12, "Largest number of meshes.", Range::atLeast(1));
}

std::optional<AccuracyRequest> AccuracyRequest::of(const Parameters& settings) {
  if (!settings.isSublist(kList)) return std::nullopt;
  const Parameters& list = settings.sublist(kList);
  const std::optional<double> error = parseReal(list.get<std::string>("Error"));
  if (!error) return std::nullopt;
  AccuracyRequest request;
  request.error = *error;
  request.quantity = list.get<std::string>("Quantity");
  request.object = objectOf(request.quantity, list);
  if (request.quantity == kMeanDisplacement) request.direction = directionOf(settings, list.sublist(kMeanDisplacement));
  request.order = parseInteger(list.get<std::string>("Order")).value_or(0);
  request.keepsCurves = list.get<std::string>("Sides") == kCurved;
  request.mostUnknowns = list.get<int>("Most Unknowns");
  request.mostSeconds = list.get<double>("Most Seconds");
  request.mostLevels = list.get<int>("Most Levels");
  return request;
}

std::string AccuracyRequest::name() const {
  if (quantity == kContactForce) return "the force of contact '" + object + "'";
  if (quantity == kReaction) return "the reaction of '" + object + "'";
  if (quantity == kMeanDisplacement) return "the mean displacement of '" + object + "'";
  if (quantity == kLargestPressure)
    return object.empty() ? "the largest contact pressure" : "the largest pressure of contact '" + object + "'";
  return "the energy norm";
}
double AccuracyReached::total() const { return std::hypot(reached, geometry.value_or(0.0)); }

std::string AccuracyReached::failure() const {
  static const std::map<std::string, std::string> limits{{"unknowns", "Accuracy/Most Unknowns"},
                                                         {"memory", "the memory"},
                                                         {"time", "Accuracy/Most Seconds"},
                                                         {"levels", "Accuracy/Most Levels"},
                                                         {"solution", "the solver, which finds no valid solution on the next mesh"},
                                                         {"mesh", "the mesher, which cannot make a better mesh"}};
  if (isMet()) return "";
  const std::string subject = quantity == AccuracyRequest::kEnergy ? "the energy norm" : quantity;
  if (limit == "quantity") return subject + " has no relative error: " + why;
  const auto name = limits.find(limit);
  return "the error of " + subject + " is " + percent(total()) + ", requested " + percent(requested) + "; the limit is " +
         (name == limits.end() ? limit : name->second);
}

}  // namespace suture
