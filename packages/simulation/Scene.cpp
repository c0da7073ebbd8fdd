#include <suture/base/Collective.hpp>
#include <suture/base/Expression.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/constraints/ConditionForm.hpp>
#include <suture/elasticity/loads/LoadList.hpp>
#include <suture/reader/MeshReader.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/report/Units.hpp>
#include <suture/simulation/NestedLevels.hpp>
#include <suture/simulation/Scene.hpp>
#include <suture/simulation/SoftenedContacts.hpp>
#include <suture/simulation/accuracy/AdaptiveMeshes.hpp>
#include <suture/simulation/accuracy/ForceIntervals.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <set>

namespace suture {

namespace {

ContactScales scalesOf(const ElasticModel& model, const Parameters& settings) {
  const auto compliance = [model](const Mesh& mesh, int element) {
    return contactCompliance(model.materialOf(mesh, element, mesh.bodyOfElement[element]), model.plane);
  };
  return {compliance, unitsOf(settings).length};
}

/// Groups of contacts and of supports along which bodies slide.
std::vector<std::string> curvedGroups(const Parameters& settings) {
  std::vector<std::string> all;
  const auto add = [&](const Parameters& list, const char* parameter) {
    for (const std::string& name : groupNames(list, parameter)) all.push_back(name);
  };
  const Parameters &contacts = settings.sublist("Contact"), &conditions = settings.sublist("Boundary Conditions");
  for (const std::string& name : sublistNames(contacts))
    for (const char* side : {"Side A", "Side B"}) add(contacts.sublist(name), side);
  for (const std::string& name : sublistNames(conditions)) {
    const Parameters& condition = conditions.sublist(name);
    const bool isAlong = condition.isParameter("Direction") || condition.isParameter("Along");
    if (condition.get<std::string>("Type") == "Bilateral" || isAlong) add(condition, "Group");
  }
  return all;
}

std::vector<std::string> curvedGroups(const std::vector<Condition>& conditions, const std::vector<Contact>& contacts) {
  std::vector<std::string> all;
  for (const Contact& contact : contacts) {
    all.insert(all.end(), contact.groupsA.begin(), contact.groupsA.end());
    all.insert(all.end(), contact.groupsB.begin(), contact.groupsB.end());
  }
  for (const Condition& condition : conditions)
    if (condition.type == Condition::Type::Bilateral || condition.direction)
      all.insert(all.end(), condition.groups.begin(), condition.groups.end());
  return all;
}

/// Name of a load or an elastic support, or its index if unnamed. \param kind  of list, for the latter
template <typename Entry>
std::string nameOf(const Entry& entry, std::size_t place) {
  return entry.name.empty() ? std::to_string(place + 1) : entry.name;
}

/// A load as a condition: its location is checked as that of the others.
Condition conditionOf(const Load& load, const std::string& name) {
  Condition condition;
  condition.name = name;
  condition.path = "ElasticModel::loads/" + name;
  condition.type = load.control == Load::Control::MeanDisplacement ? Condition::Type::MeanDisplacement : formOf(load.kind).type;
  condition.groups = load.groups;
  condition.body = load.body;
  return condition;
}

Condition conditionOf(const ElasticSupport& support, const std::string& name) {
  Condition condition;
  condition.name = name;
  condition.path = "ElasticModel::supports/" + name;
  condition.type = Condition::Type::ElasticSupport;
  condition.groups = support.groups;
  condition.normal = support.normal;
  condition.tangential = support.tangential;
  return condition;
}

/// Refuses assignments to parameters that the objects of the scene define, because they would have no effect.
void refuseObjects(const std::vector<std::string>& settings, Problems& problems) {
  const std::set<std::string> objects{"Model",   "Mesh",      "Bodies",    "Materials",     "Boundary Conditions",
                                      "Contact", "Constants", "Functions", "Exact Solution"};
  for (const std::string& assignment : settings) {
    const std::string path = assignment.substr(0, assignment.find('='));
    const std::string list = path.substr(0, path.find('/'));
    if (objects.count(list)) problems.add(path, "a scene made in C++ defines it by its objects: model, mesh, conditions, contacts");
  }
}

/// \throws InputError  displacements since a time that is not the end of a load step
void checkSince(const Scene& scene) {
  const Parameters& output = scene.settings().sublist("Output");
  const double since = output.get<double>("Displacements Since");
  const std::vector<double>& times = scene.steps.times();
  if (since > 0.0 && std::find(times.begin(), times.end(), since) == times.end())
    throw InputError(pathOf(output, "Displacements Since"),
                     times.empty() ? "has no effect without Load Steps/Times" : realText(since) + " is not one of Load Steps/Times");
}

/// Names of the conditions that hold bodies.
std::vector<std::string> supportsAmong(const std::vector<LoadSteps::Named>& conditions) {
  static const std::set<std::string> holding{"Displacement", "Bilateral", "Elastic Support", "Mean Displacement"};
  std::vector<std::string> names;
  for (const auto& [name, type] : conditions)
    if (holding.count(type) > 0) names.push_back(name);
  return names;
}

/// \throws InputError  results of conditions or contacts that the scene does not have
void checkNames(const Scene& scene, const std::vector<LoadSteps::Named>& conditions) {
  std::vector<std::string> names;
  for (const LoadSteps::Named& condition : conditions) names.push_back(condition.first);
  checkStrictBars(scene.settings(), names, scene.entries());
}

/// Adds the contacts to the scene's parameters: later stages look them up by name, and the record of a run needs them.
void record(const std::vector<Contact>& contacts, Parameters& list, Problems& problems) {
  std::set<std::string> names;
  for (const Contact& contact : contacts) {
    if (!names.insert(contact.name).second) problems.add("Contact/" + contact.name, "two contacts have this name");
    Parameters& own = list.sublist(contact.name);
    own.set("Side A", Teuchos::Array<std::string>(contact.groupsA));
    if (!contact.groupsB.empty()) own.set("Side B", Teuchos::Array<std::string>(contact.groupsB));
    if (contact.initialGap) own.set("Initial Gap", contact.initialGap->text());
  }
}

/// The contacts between two faces of a list `Contact`, as far as their places on the mesh matter.
std::vector<Contact> facingContacts(const Parameters& list) {
  std::vector<Contact> all;
  for (const std::string& name : sublistNames(list)) {
    Contact contact;
    contact.name = name;
    contact.groupsA = groupNames(list.sublist(name), "Side A");
    contact.groupsB = groupNames(list.sublist(name), "Side B");
    if (!contact.groupsB.empty()) all.push_back(contact);
  }
  return all;
}

void setLines(Scene& scene, const std::vector<ContactLine>& lines) {
  for (const ContactLine& line : lines) scene.contacts.push_back(line.name);
  if (std::any_of(lines.begin(), lines.end(), [](const ContactLine& line) { return line.law.has_value(); })) scene.lines = lines;
}

}  // namespace

bool movesFar(const Scene& scene) { return scene.settings().get<std::string>("Motion") == "Moving"; }

bool movesFar(const Scene& scene, const std::string& body) {
  if (!movesFar(scene)) return false;
  const Parameters& bodies = scene.settings().sublist("Bodies");
  return !bodies.isSublist(body) || bodies.sublist(body).get<std::string>("Motion") == "Scene";  // bodies made in C++ have no list
}

std::vector<std::string> Scene::entries() const { return lines.empty() ? contacts : entryNames(lines); }

Scene makeScene(const ElasticModel& model, const std::function<Mesh()>& mesh, const std::vector<Condition>& conditions,
                const std::vector<Contact>& contacts, const std::vector<std::string>& settings) {
  Scene scene;
  scene.file = parseScene("<ParameterList name=\"Suture\"/>", "a scene made in C++", settingsSchema(), settings);
  Problems problems;
  refuseObjects(settings, problems);
  if (model.bodies.empty()) problems.add("ElasticModel::bodies", "the list is empty: add bodies with ElasticModel::addBody()");
  checkLoads(model, problems);
  record(contacts, scene.file.parameters->sublist("Contact"), problems);
  problems.throwIfAny();
  scene.file.parameters->set("Model", modelName(model));
  scene.model = model;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    scene.model.loads[i].name = nameOf(model.loads[i], i);
    scene.model.loads[i].path = "ElasticModel::loads/" + std::to_string(i + 1);
  }
  for (std::size_t i = 0; i < model.supports.size(); ++i) scene.model.supports[i].name = nameOf(model.supports[i], i);
  std::vector<std::string> names;
  std::vector<std::optional<Overclosure>> softened;
  for (const Contact& contact : contacts) names.push_back(contact.name), softened.push_back(contact.overclosure);
  setLines(scene, contactLines(names, softened));
  if (!scene.lines.empty()) scene.coat = [contacts](Mesh& whole) { addCoatings(whole, contacts); };
  scene.mesh = [mesh](const Comm& comm) { return onRoot(comm, "making the mesh", mesh); };
  std::vector<Condition> all = conditions;
  for (std::size_t i = 0; i < model.loads.size(); ++i) all.push_back(conditionOf(model.loads[i], scene.model.loads[i].name));
  for (std::size_t i = 0; i < model.supports.size(); ++i) all.push_back(conditionOf(model.supports[i], scene.model.supports[i].name));
  std::vector<LoadSteps::Named> named;
  for (const Condition& condition : all) named.emplace_back(condition.name, formOf(condition.type).name);
  scene.steps = LoadSteps(scene.settings().sublist("Load Steps"), named, {});
  checkNames(scene, named);
  scene.constraints = [all, contacts, scales = scalesOf(model, scene.settings()), steps = scene.steps](
                          const Mesh& whole, const ConditionChange& change, KeptChoices* choices) {
    return buildConstraints(whole, all, contacts, scales, steps, change, choices);
  };
  requestAccuracy(scene, contacts, supportsAmong(named), curvedGroups(all, contacts));
  return scene;
}

Scene sceneOf(const SceneFile& file) {
  Scene scene;
  scene.file = file;
  const Teuchos::RCP<const Parameters> all = file.parameters;
  scene.model = makeElasticModel(*all);
  scene.kinds = subdomainKinds(all->sublist("Bodies"));
  setLines(scene, contactLines(all->sublist("Contact")));
  scene.laws = ContactLaws(all->sublist("Contact"), sceneConstants(*all));
  std::vector<LoadSteps::Named> named;
  for (const std::string& name : sublistNames(all->sublist("Boundary Conditions")))
    named.emplace_back(name, all->sublist("Boundary Conditions").sublist(name).get<std::string>("Type"));
  scene.steps = LoadSteps(all->sublist("Load Steps"), named, sceneConstants(*all));
  checkSince(scene);
  checkNames(scene, named);
  if (!scene.lines.empty()) scene.coat = [all](Mesh& mesh) { addCoatings(mesh, all->sublist("Contact")); };
  scene.mesh = [all, folder = file.folder](const Comm& comm) { return readMesh(comm, all->sublist("Mesh"), folder); };
  scene.constraints = [all, scales = scalesOf(scene.model, *all), steps = scene.steps](const Mesh& mesh, const ConditionChange& change,
                                                                                       KeptChoices* choices) {
    return buildConstraints(mesh, all->sublist("Boundary Conditions"), all->sublist("Contact"), sceneConstants(*all), scales, steps, change,
                            choices);
  };
  for (const SceneFile& level : nestedLevels(file)) {
    scene.levels.push_back(sceneOf(level));
    scene.levels.back().isOneStep = true;
  }
  requestAccuracy(scene, facingContacts(all->sublist("Contact")), supportsAmong(named), curvedGroups(*all));
  return scene;
}

Scene sceneOf(const Comm& comm, const SceneFile& file) {
  Scene scene;
  collectively(comm, "making the scene", [&] { scene = sceneOf(file); });
  return scene;
}

}  // namespace suture
