#include <suture/base/Numbers.hpp>
#include <suture/report/AccuracyRequest.hpp>

#include <Teuchos_ParameterList.hpp>

#include <cmath>
#include <cstdio>
#include <map>

namespace suture {

namespace {

const char* const kList = "Accuracy";
const char* const kNone = "None";
const char* const kStraight = "Straight";
const char* const kCurved = "Curved";

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
      .oneOf("Quantity", kEnergy, {kEnergy}, "Quantity of which the error is meant. Energy: the energy norm.")
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
  request.order = parseInteger(list.get<std::string>("Order")).value_or(0);
  request.keepsCurves = list.get<std::string>("Sides") == kCurved;
  request.mostUnknowns = list.get<int>("Most Unknowns");
  request.mostSeconds = list.get<double>("Most Seconds");
  request.mostLevels = list.get<int>("Most Levels");
  return request;
}

double AccuracyReached::total() const { return std::hypot(reached, geometry.value_or(0.0)); }

std::string AccuracyReached::failure() const {
  static const std::map<std::string, std::string> limits{{"unknowns", "Accuracy/Most Unknowns"},
                                                         {"memory", "the memory"},
                                                         {"time", "Accuracy/Most Seconds"},
                                                         {"levels", "Accuracy/Most Levels"},
                                                         {"solution", "the solver, which finds no valid solution on the next mesh"},
                                                         {"mesh", "the mesher, which cannot make the next mesh"}};
  if (isMet()) return "";
  const auto name = limits.find(limit);
  return "the error of " + (quantity == AccuracyRequest::kEnergy ? "the energy norm" : quantity) + " is " + percent(total()) +
         ", requested " + percent(requested) + "; the limit is " + (name == limits.end() ? limit : name->second);
}

}  // namespace suture
