#include <suture/answer/values/ControlledLoads.hpp>
#include <suture/answer/values/SingularPlaces.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/report/answers/Answers.hpp>
#include <suture/simulation/accuracy/QuantityError.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace suture {

namespace {

constexpr double kSmallestShare = 1e-12;  // share of the largest force or displacement that is round-off

int placeOf(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// A value on rank 0 with its error, to be sent. Trivially copyable.
struct ValueOnRoot {
  double value = 0.0, error = 0.0, largest = 0.0;
  int isLinear = 0;
};

QuantityError sent(const Comm& comm, ValueOnRoot found) {
  broadcastBytes(comm, &found, sizeof found);
  QuantityError result{found.value, found.error, found.isLinear != 0 ? 1.0 : 2.0};
  if (!(found.value > kSmallestShare * found.largest)) result.why = "its value is zero";
  return result;
}

/// Force of a contact or support. On rank 0.
ValueOnRoot forceOf(const Run& run, const AccuracyRequest& request) {
  const std::vector<ConditionResultant> conditions = conditionResultants(run);
  const std::vector<ContactResultant> contacts = contactResultants(run);
  const ForceErrors errors(run, conditions, contacts);
  ValueOnRoot found;
  for (const ConditionResultant& one : conditions) found.largest = std::max(found.largest, norm(one.sum.force));
  for (const ContactResultant& one : contacts) found.largest = std::max(found.largest, norm(one.onB.force));
  const ErrorBars& bars = *run.solution.errorBars;
  if (request.quantity == AccuracyRequest::kContactForce) {
    const int line = placeOf(run.contacts, request.object);
    found.value = norm(contacts.at(static_cast<std::size_t>(line)).onB.force);
    found.error = errors.ofContact(line).value();
    found.isLinear = bars.isLinear(true, line);
    return found;
  }
  for (const ConditionResultant& one : conditions) {
    if (one.name != request.object || one.kind != "support") continue;
    found.value = norm(one.sum.force);
    found.error = errors.of(one).value();
    found.isLinear = bars.isLinear(false, placeOf(run.conditions, one.name));
  }
  return found;
}

QuantityError displacementOf(const SceneParts& parts, const Solution& solution, const AccuracyRequest& request) {
  const Comm& comm = parts.run.comm();
  Load mean;
  mean.control = Load::Control::MeanDisplacement;
  mean.groups = {request.object};
  mean.axis = unit(request.direction);
  const double value = controlledValue(comm, parts.cut.meshes, parts.scene.model, solution.displacement, mean);
  const double largest = solution.extremes.displacement.value;
  return sent(comm, {std::abs(value), solution.errorBars->ofDisplacement(largest), largest, solution.errorBars->isLinear(true, -1)});
}

/// The pair with the largest pressure of a contact, or of all, and its closed pairs. The same on all ranks.
struct PressedPlace {
  int pair = -1;
  double pressure = 0.0;
  std::vector<int> closed{};
};

PressedPlace mostPressed(const Comm& comm, const std::vector<std::string>& lines, const Solution& solution, const std::string& contact) {
  PressedPlace place;
  for (const PairResult& pair : solution.pairs) {
    if (!contact.empty() && lines.at(static_cast<std::size_t>(pair.line)) != contact) continue;
    if (pair.state.closed()) place.closed.push_back(pair.id);
    if (pair.pressure > place.pressure) place.pair = pair.id, place.pressure = pair.pressure;
  }
  std::sort(place.closed.begin(), place.closed.end());
  broadcastBytes(comm, &place.pair, sizeof place.pair);
  broadcastBytes(comm, &place.pressure, sizeof place.pressure);
  broadcast(comm, place.closed);
  return place;
}

/// Why the exact pressure is infinite at a closed pair; empty: it is finite.
std::string whyInfinite(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const PressedPlace& place) {
  std::vector<PlaceInQuestion> places;
  for (const int pair : place.closed) places.push_back({{}, pair});
  for (const std::string& reason : singularities(comm, meshes, places, place.closed))
    if (!reason.empty()) return reason;
  return "";
}

std::vector<int> nodesOfPair(const Comm& comm, const std::vector<SubdomainMesh>& meshes, int pair) {
  std::vector<int> mine;
  for (const SubdomainMesh& mesh : meshes)
    for (const ContactRow& row : mesh.contactRows)
      if (row.pair.id == pair)
        for (const PairEnd& end : row.pair.ends) mine.push_back(end.node);
  return unionOverRanks(comm, mine);
}

/// Root mean square of the estimated stress error in the elements at these nodes: sqrt(E sum eta_K^2 / sum |K|). [stress]
double stressErrorAt(const Comm& comm, const SceneParts& parts, const std::vector<Vector>& ofElements, const std::vector<int>& nodes) {
  double sums[2] = {0, 0}, all[2];  // squared errors times modulus, sizes
  for (std::size_t m = 0; m < parts.cut.meshes.size(); ++m) {
    const SubdomainMesh& mesh = parts.cut.meshes[m];
    for (int e = 0; e < mesh.elements(); ++e) {
      const Span<const int> own = mesh.nodesOf(e);
      const bool isThere = std::any_of(own.begin(), own.end(), [&](int node) {
        return std::binary_search(nodes.begin(), nodes.end(), static_cast<int>(mesh.globalNodes[static_cast<std::size_t>(node)]));
      });
      if (!isThere) continue;
      sums[0] += parts.scene.model.materialOf(mesh, e, mesh.body).young * ofElements[m][e] * ofElements[m][e];
      sums[1] += std::abs(signedSize(mesh, e));
    }
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 2, sums, all);
  return all[1] > 0.0 ? std::sqrt(all[0] / all[1]) : 0.0;
}

QuantityError pressureOf(const SceneParts& parts, const Solution& solution, const AccuracyRequest& request,
                         const std::optional<double>& before) {
  const Comm& comm = parts.run.comm();
  const PressedPlace place = mostPressed(comm, parts.scene.contacts, solution, request.object);
  QuantityError result{place.pressure, 0.0, 1.0, before.has_value()};
  if (place.pair < 0) {
    result.why = "nothing presses";
    return result;
  }
  if (const std::string infinite = whyInfinite(comm, parts.cut.meshes, place); !infinite.empty()) {
    result.why = "the exact value is infinite, at " + infinite;
    return result;
  }
  const std::vector<int> nodes = nodesOfPair(comm, parts.cut.meshes, place.pair);
  result.error = stressErrorAt(comm, parts, solution.discretisation->ofElements, nodes);
  if (before) result.error += std::abs(place.pressure - *before);
  return result;
}

}  // namespace

double QuantityError::relative() const { return why.empty() ? error / value : std::numeric_limits<double>::quiet_NaN(); }

QuantityError quantityError(const SceneParts& parts, const Solution& solution, const AccuracyRequest& request,
                            const std::optional<double>& before) {
  if (!solution.errorBars) return {0.0, 0.0, 1.0, true, "the solution has no estimate of its error"};
  if (request.quantity == AccuracyRequest::kMeanDisplacement) return displacementOf(parts, solution, request);
  if (request.quantity == AccuracyRequest::kLargestPressure) return pressureOf(parts, solution, request, before);
  const Comm& comm = parts.run.comm();
  const Run run = runOf(parts, solution);
  ValueOnRoot found;
  collectivelyOnRoot(comm, "measuring a force", [&] { found = forceOf(run, request); });
  return sent(comm, found);
}

void checkQuantity(AccuracyRequest& request, const std::vector<std::string>& conditions, const std::vector<std::string>& contacts) {
  const std::string path = "Accuracy/" + request.quantity;
  const bool isForce = request.quantity == AccuracyRequest::kContactForce;
  if (request.quantity == AccuracyRequest::kReaction) {
    if (std::find(conditions.begin(), conditions.end(), request.object) == conditions.end())
      throw InputError(path + "/Condition", unknownName("boundary condition that holds a body", request.object, conditions));
  } else if (isForce || request.quantity == AccuracyRequest::kLargestPressure) {
    if (contacts.empty()) throw InputError("Accuracy/Quantity", request.quantity + " needs a contact, and the scene has none");
    if (isForce && request.object.empty()) {
      if (contacts.size() > 1) throw InputError(path + "/Contact", unknownName("contact", "", contacts));
      request.object = contacts.front();
    }
    if (!request.object.empty() && std::find(contacts.begin(), contacts.end(), request.object) == contacts.end())
      throw InputError(path + "/Contact", unknownName("contact", request.object, contacts));
  }
}

void checkQuantity(const Comm& comm, const AccuracyRequest& request, const std::vector<SubdomainMesh>& meshes) {
  if (request.quantity != AccuracyRequest::kMeanDisplacement) return;
  std::vector<std::string> mine;
  for (const SubdomainMesh& mesh : meshes)
    for (const auto& group : mesh.sideGroups) mine.push_back(group.first);
  const std::vector<std::string> gathered = joinEverywhere(comm, mine);
  const std::set<std::string> all(gathered.begin(), gathered.end());
  if (all.count(request.object) == 0)
    throw InputError("Accuracy/Mean Displacement/Group", unknownName("side group", request.object, {all.begin(), all.end()}));
}

}  // namespace suture
