#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/mesh/Regions.hpp>
#include <suture/simulation/CutStage.hpp>
#include <suture/simulation/LoadControl.hpp>
#include <suture/simulation/Phases.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace suture {

namespace {

constexpr const char* kRemoved = "Removed";
constexpr const char* kPlaced = "Placed";
constexpr const char* kRelease = "Release";

/// True if a body has a region of this name.
bool hasRegion(const Parameters& bodies, const std::string& body, const std::string& region) {
  return bodies.sublist(body).isSublist("Regions") && bodies.sublist(body).sublist("Regions").isSublist(region);
}

/// Elements that exist without the absent bodies and regions.
std::vector<char> kept(const Mesh& mesh, const Parameters& bodies, const std::set<std::string>& absent) {
  std::vector<char> isRegionAbsent;
  for (const std::string& body : sublistNames(bodies))
    if (bodies.sublist(body).isSublist("Regions"))
      for (const std::string& region : sublistNames(bodies.sublist(body).sublist("Regions")))
        isRegionAbsent.push_back(absent.count(region) > 0 && !bodies.isSublist(region));
  std::vector<char> keeps(static_cast<std::size_t>(mesh.elements()), 1);
  for (std::size_t e = 0; e < keeps.size(); ++e) {
    const int region = mesh.regions.empty() ? -1 : mesh.regions[e];
    const bool isAbsent = absent.count(mesh.bodies[static_cast<std::size_t>(mesh.bodyOfElement[e])]) > 0 ||
                          (region >= 0 && isRegionAbsent[static_cast<std::size_t>(region)]);
    keeps[e] = !isAbsent;
  }
  return keeps;
}

/// Removes groups that have lost all their sides from the entries of a list, and entries that have no group left.
/// \param parameters  names of the parameters with groups
void dropLostGroups(Parameters& list, const std::vector<std::string>& parameters, const std::set<std::string>& lost) {
  for (const std::string& name : sublistNames(list))
    for (const std::string& parameter : parameters) {
      if (!list.isSublist(name) || !list.sublist(name).isParameter(parameter)) continue;
      std::vector<std::string> groups = groupNames(list.sublist(name), parameter);
      const std::size_t before = groups.size();
      groups.erase(std::remove_if(groups.begin(), groups.end(), [&](const std::string& group) { return lost.count(group) > 0; }),
                   groups.end());
      if (groups.size() == before) continue;
      if (groups.empty())
        list.remove(name);
      else
        list.sublist(name).set(parameter, Teuchos::Array<std::string>(groups));
    }
}

/// Removes entries of a list that name an absent body.
void dropOfBodies(Parameters& list, const std::set<std::string>& absent) {
  for (const std::string& name : sublistNames(list))
    if (list.sublist(name).isType<std::string>("Body") && absent.count(list.sublist(name).get<std::string>("Body"))) list.remove(name);
}

}  // namespace

Phases::Phases(const Scene& scene) {
  const Parameters& steps = scene.settings().sublist("Load Steps");
  const auto isEmpty = [&](const char* list) { return !steps.isSublist(list) || steps.sublist(list).numParams() == 0; };
  if (isEmpty(kRemoved) && isEmpty(kPlaced) && isEmpty(kRelease)) return;
  Problems problems;
  times_ = scene.steps.times();
  read(scene, kRemoved, removed_, problems);
  read(scene, kPlaced, placed_, problems);
  readReleases(steps.sublist(kRelease), problems);
  const Parameters& placed = steps.sublist(kPlaced);
  for (const auto& [name, time] : placed_) {
    if (!scene.settings().sublist("Bodies").isSublist(name))
      problems.add(pathOf(placed, name),
                   "a region cannot be placed: it shares nodes with its body, which deforms before. Make it a body "
                   "that is tied to the other one by a contact");
    const auto removal = removed_.find(name);
    if (removal != removed_.end() && removal->second <= time)
      problems.add(pathOf(placed, name), "placed at " + realText(time) + ", but removed at " + realText(removal->second) +
                                             "; expected a placement before the removal");
  }
  if (isCut(scene))
    problems.add("Partition/Type", "a partitioned mesh with bodies that are removed or placed; expected METIS or Named Groups");
  if (!scene.lines.empty())
    problems.add("Contact", "a softened contact (Pressure Overclosure) in a scene with bodies that are removed or placed is not supported");
  if (!scene.model.exact.empty()) problems.add("Exact Solution", "found in a scene with bodies that are removed or placed");
  if (hasControlledLoads(scene))
    problems.add("Boundary Conditions",
                 "a Mean Displacement or Preload in a scene with bodies that are removed or placed is not supported");
  const Parameters& conditions = scene.settings().sublist("Boundary Conditions");
  for (const std::string& name : sublistNames(conditions))
    if (conditions.sublist(name).get<std::string>("Type") == "Rigid Group")
      problems.add(pathOf(conditions.sublist(name)), "a Rigid Group in a scene with bodies that are removed or placed is not supported");
  problems.throwIfAny();

  std::set<double> begins{0.0};
  for (const auto* times : {&removed_, &placed_})
    for (const auto& entry : *times) begins.insert(entry.second);
  begins_.assign(begins.begin(), begins.end());
  last_ = times_.back();
  bodies_.insert(scene.model.bodies.begin(), scene.model.bodies.end());
  for (int phase = 0; phase < count(); ++phase) {
    const std::set<std::string> missing = absent(phase);
    if (std::all_of(bodies_.begin(), bodies_.end(), [&](const std::string& body) { return missing.count(body) > 0; }))
      problems.add(pathOf(steps, kRemoved), "no body exists after the time " + realText(begin(phase)));
  }
  problems.throwIfAny();
}

void Phases::read(const Scene& scene, const std::string& list, std::map<std::string, double>& times, Problems& problems) {
  const Parameters& own = scene.settings().sublist("Load Steps").sublist(list);
  const Parameters& bodies = scene.settings().sublist("Bodies");
  std::vector<std::string> names = sublistNames(bodies);
  for (const std::string& body : sublistNames(bodies))
    if (bodies.sublist(body).isSublist("Regions"))
      for (const std::string& region : sublistNames(bodies.sublist(body).sublist("Regions"))) names.push_back(region);
  const std::vector<double>& ends = scene.steps.times();
  for (auto entry = own.begin(); entry != own.end(); ++entry) {
    const std::string& name = own.name(entry);
    const double time = own.get<double>(name);
    if (std::find(names.begin(), names.end(), name) == names.end())
      problems.add(pathOf(own, name), unknownName("body or region", name, names));
    else if (ends.empty())
      problems.add(pathOf(own, name), "has no effect without Times");
    else if (time != 0.0 && std::find(ends.begin(), ends.end() - 1, time) == ends.end() - 1)
      problems.add(pathOf(own, name), realText(time) + " is not the end of a load step before the last one; expected 0 or one of Times");
    else
      times[name] = time;
  }
}

void Phases::readReleases(const Parameters& own, Problems& problems) {
  std::vector<std::string> names;
  for (const auto& entry : removed_) names.push_back(entry.first);
  for (auto entry = own.begin(); entry != own.end(); ++entry) {
    const std::string& name = own.name(entry);
    const std::string path = pathOf(own, name), text = trimmed(own.get<std::string>(name));
    const auto removal = removed_.find(name);
    if (removal == removed_.end()) {
      problems.add(path, unknownName("removed part", name, names));
      continue;
    }
    if (removal->second == 0.0) {
      problems.add(path, "'" + name + "' is removed at 0, before it carries anything; expected a removal at one of Times");
      continue;
    }
    std::vector<double> fractions;
    const auto entries = parseEntries(text);
    for (const std::string& one : entries ? *entries : std::vector<std::string>())
      if (const auto value = parseReal(one); value && *value >= (fractions.empty() ? 0.0 : fractions.back())) fractions.push_back(*value);
    const auto follow = times_.end() - std::upper_bound(times_.begin(), times_.end(), removal->second);
    if (!entries || entries->empty() || fractions.size() != entries->size() || fractions.back() != 1.0)
      problems.add(path, "'" + text + "'; expected fractions that ascend from 0 and end at 1, such as {0.4, 1}");
    else if (static_cast<std::ptrdiff_t>(fractions.size()) > follow)
      problems.add(path, std::to_string(fractions.size()) + " fractions, but the number of load steps after " + realText(removal->second) +
                             " is " + std::to_string(follow) + "; expected at most one for each step");
    else
      released_.try_emplace(removal->second, name, fractions);
  }
  for (const auto& [name, time] : removed_) {
    const auto found = released_.find(time);
    if (found == released_.end() || found->second.first == name) continue;
    if (!own.isParameter(name) || own.get<std::string>(name) != own.get<std::string>(found->second.first))
      problems.add(pathOf(own, name), "differs from '" + found->second.first +
                                          "', which is removed at the same time; expected the same "
                                          "fractions for both");
  }
}

Release Phases::release(double removal) const {
  const auto found = released_.find(removal);
  std::vector<double> fractions = found == released_.end() ? std::vector<double>{1.0} : found->second.second;
  const auto first = std::upper_bound(times_.begin(), times_.end(), removal);
  std::vector<double> ends(first, first + static_cast<std::ptrdiff_t>(fractions.size()));
  return {removal, std::move(ends), std::move(fractions)};
}

double Phases::end(int phase) const { return phase + 1 < count() ? begin(phase + 1) : last_; }

std::set<std::string> Phases::absent(int phase) const {
  std::set<std::string> all;
  for (const auto& [name, time] : removed_)
    if (time <= begin(phase)) all.insert(name);
  for (const auto& [name, time] : placed_)
    if (time > begin(phase)) all.insert(name);
  return all;
}

std::string Phases::changes(int phase) const {
  std::string text;
  for (const auto& [times, what] : {std::make_pair(&removed_, " removed"), std::make_pair(&placed_, " placed")})
    for (const auto& [name, time] : *times)
      if (time == begin(phase)) text += (text.empty() ? "'" : ", '") + name + "'" + what;
  if (released_.count(begin(phase)) > 0) text += ", " + release(begin(phase)).text();
  return text;
}

int Phases::phaseAt(double time) const {
  return std::max(0, static_cast<int>(std::lower_bound(begins_.begin(), begins_.end(), time) - begins_.begin()) - 1);
}

std::string Phases::changesBefore(double time) const {
  std::string text;
  for (int phase = 0; phase < count() && begin(phase) < time; ++phase)
    if (const std::string now = changes(phase); !now.empty())
      text += (text.empty() ? "t = " : "; t = ") + realText(begin(phase)) + ": " + now;
  return text.empty() ? kNoChange : text;
}

PhaseScene::PhaseScene(const Comm& comm, const Scene& whole, const Phases& phases, int phase, std::shared_ptr<const Mesh> mesh)
    : nodeOfWhole_(std::make_shared<std::vector<int>>()) {
  const std::set<std::string> absent = phases.absent(phase);
  const Parameters& bodies = whole.settings().sublist("Bodies");
  // The scene makes its mesh later, but the names of groups without sides are needed before.
  auto part = std::make_shared<Mesh>();
  Packer packer;
  packer.put(onRoot(comm, "finding the parts of a phase", [&] {
    MeshPart found = partOf(*mesh, kept(*mesh, bodies, absent));
    std::vector<std::string> lost;
    for (const auto& [name, sides] : found.mesh.sideGroups)
      if (sides.empty() && !mesh->sideGroups.at(name).empty()) lost.push_back(name);
    *part = std::move(found.mesh);
    *nodeOfWhole_ = std::move(found.nodeOfWhole);
    return lost;
  }));
  const auto names = Unpacker(broadcast(comm, packer.bytes())).get<std::vector<std::string>>();
  const std::set<std::string> lost(names.begin(), names.end());

  SceneFile file = whole.file;
  file.parameters = Teuchos::rcp(new Parameters(*whole.file.parameters));
  Parameters& all = *file.parameters;
  Parameters& ofPhase = all.sublist("Bodies");
  for (const std::string& name : absent) {
    if (bodies.isSublist(name)) {
      ofPhase.remove(name);
      continue;
    }
    for (const std::string& body : sublistNames(ofPhase))
      if (hasRegion(ofPhase, body, name)) ofPhase.sublist(body).sublist("Regions").remove(name);
  }
  Parameters& conditions = all.sublist("Boundary Conditions");
  dropLostGroups(conditions, {"Group"}, lost);
  dropLostGroups(all.sublist("Contact"), {"Side A", "Side B"}, lost);
  dropOfBodies(conditions, absent);
  Parameters& steps = all.sublist("Load Steps");
  for (const char* list : {kRemoved, kPlaced, kRelease}) steps.remove(list, false);
  std::vector<std::string> unused;
  for (auto entry = steps.sublist("Factors").begin(); entry != steps.sublist("Factors").end(); ++entry)
    if (!conditions.isSublist(steps.sublist("Factors").name(entry))) unused.push_back(steps.sublist("Factors").name(entry));
  for (const std::string& name : unused) steps.sublist("Factors").remove(name);
  if (phase + 1 < phases.count()) {  // probes are written at the end
    all.sublist("Output").remove("Probes", false);
    all.sublist("Output").sublist("Probes");
  }

  scene_ = sceneOf(comm, file);
  scene_.levels.clear();
  scene_.mesh = [part](const Comm&) { return *part; };
}

}  // namespace suture
