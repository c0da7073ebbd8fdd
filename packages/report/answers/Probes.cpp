#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/report/answers/Probes.hpp>
#include <suture/report/answers/Tables.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace suture {

namespace {

/// Parameters of each type; a probe may only have those of its type.
const std::map<std::string, std::vector<std::string>>& parametersOf() {
  static const std::map<std::string, std::vector<std::string>> all{{"Point", {"Place"}}, {"Line", {"From", "To"}}, {"Group", {"Group"}}};
  return all;
}

class Entry {
 public:
  Entry(const Parameters& list, int dimension, const std::vector<std::string>& bodies, Problems& problems)
      : list_(list), bodies_(bodies), problems_(problems), type_(list.get<std::string>("Type")) {
    probe_.dimension = dimension;
  }

  Probe read(const std::string& name) {
    probe_.name = name;
    probe_.path = pathOf(list_);
    checkParameters();
    const int body = bodyOf();
    if (type_ == "Group" && list_.isParameter("Group")) probe_.group = list_.get<std::string>("Group");
    if (type_ == "Point") probe_.points = {{place("Place"), body}};
    if (type_ == "Line") addLine(place("From"), place("To"), body);
    return probe_;
  }

 private:
  void checkParameters() {
    for (const auto& [type, names] : parametersOf())
      for (const std::string& name : names) {
        if (type == type_ && !list_.isParameter(name)) problems_.add(probe_.path + "/" + name, "is missing: a " + type + " needs it");
        if (type != type_ && list_.isParameter(name))
          problems_.add(probe_.path + "/" + name, "a " + type_ + " does not have this parameter; a " + type + " does");
      }
    if (type_ != "Line" && list_.isParameter("Points"))
      problems_.add(probe_.path + "/Points", "only a Line has this parameter; found in a " + type_);
    if (type_ == "Group" && list_.isParameter("Body"))
      problems_.add(probe_.path + "/Body", "not allowed for a Group: its sides determine the body");
  }

  int bodyOf() {
    if (!list_.isParameter("Body") || type_ == "Group") return -1;
    const std::string name = list_.get<std::string>("Body");
    const auto found = std::find(bodies_.begin(), bodies_.end(), name);
    if (found == bodies_.end()) problems_.add(probe_.path + "/Body", unknownName("body", name, bodies_));
    return found == bodies_.end() ? -1 : static_cast<int>(found - bodies_.begin());
  }

  Point place(const char* name) {
    Point point{0, 0, 0};
    if (!list_.isParameter(name)) return point;
    const auto given = list_.get<Teuchos::Array<double>>(name);
    const auto expected = static_cast<std::size_t>(probe_.dimension);
    if (static_cast<std::size_t>(given.size()) != expected)
      problems_.add(probe_.path + "/" + name,
                    std::to_string(given.size()) + " coordinates; expected " + (expected == 2 ? "two, x and y" : "three, x, y and z"));
    std::copy_n(given.begin(), std::min<std::size_t>(expected, given.size()), point.begin());
    return point;
  }

  void addLine(const Point& from, const Point& to, int body) {
    const int count = list_.isParameter("Points") ? list_.get<int>("Points") : 101;
    for (int i = 0; i < count; ++i) {
      const double t = double(i) / (count - 1);
      probe_.points.push_back({i == count - 1 ? to : plus(from, scaled(t, minus(to, from))), body});
    }
  }

  const Parameters& list_;
  const std::vector<std::string>& bodies_;
  Problems& problems_;
  const std::string type_;
  Probe probe_;
};

std::vector<std::string> allGroups(const Comm& comm, const std::vector<SubdomainMesh>& meshes) {
  std::vector<std::string> mine;
  for (const SubdomainMesh& mesh : meshes)
    for (const auto& group : mesh.sideGroups) mine.push_back(group.first);
  Packer packer;
  packer.put(mine);
  std::set<std::string> all;
  for (const std::string& bytes : allGather(comm, packer.bytes()))
    for (const std::string& name : Unpacker(bytes).get<std::vector<std::string>>()) all.insert(name);
  return {all.begin(), all.end()};
}

}  // namespace

std::string Probe::fileName() const { return tableName("probe", name); }

Schema probeSchema() {
  return Schema("Table probe_<name>.csv: displacement and stress; on contact sides also gap and pressure.")
      .oneOf("Type", std::nullopt, {"Point", "Line", "Group"},
             "Point: one point; Line: equidistant points between two end points; Group: all nodes of a side group, in 2D ordered along it")
      .reals("Place", std::nullopt, "Point: its coordinates on the undeformed body [length]", "length")
      .optional()
      .reals("From", std::nullopt, "Line: first end point [length]", "length")
      .optional()
      .reals("To", std::nullopt, "Line: second end point [length]", "length")
      .optional()
      .integer("Points", std::nullopt, "Line: number of points, including both ends; default 101", Range::atLeast(2))
      .optional()
      .text("Group", std::nullopt, "Group: a side group of the mesh")
      .optional()
      .text("Body", std::nullopt, "Point, Line: the body; default: the first body that contains the point")
      .optional();
}

std::vector<Probe> readProbes(const Parameters& scene, const std::vector<std::string>& bodies) {
  std::vector<Probe> probes;
  if (!scene.isSublist("Output") || !scene.sublist("Output").isSublist("Probes")) return probes;
  const Parameters& list = scene.sublist("Output").sublist("Probes");
  Problems problems;
  std::map<std::string, std::string> files;
  for (const std::string& name : sublistNames(list)) {
    probes.push_back(Entry(list.sublist(name), sceneDimension(scene), bodies, problems).read(name));
    const auto [at, isNew] = files.emplace(probes.back().fileName(), name);
    if (!isNew)
      problems.add(probes.back().path, "writes the same file " + at->first + " as the probe '" + at->second + "'; rename one of them");
  }
  problems.throwIfAny();
  return probes;
}

std::vector<FoundPoints> locateProbes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<std::string>& bodies,
                                      const std::vector<Probe>& probes) {
  std::vector<FoundPoints> all;
  if (probes.empty()) return all;
  const std::vector<std::string> groups = allGroups(comm, meshes);
  Problems problems;
  for (const Probe& probe : probes) {
    if (!probe.group.empty() && !std::count(groups.begin(), groups.end(), probe.group))
      problems.add(probe.path + "/Group", unknownName(probe.dimension == 2 ? "curve group" : "surface group", probe.group, groups));
    all.push_back(findPoints(comm, meshes, bodies, probe.points));
    const FoundPoints& found = all.back();
    if (found.outside.empty()) continue;
    const std::size_t others = found.outside.size() - 1;
    const SoughtPoint& first = probe.points[found.outside.front()];
    problems.add(
        probe.path,
        "the point " + placeText(first.place, probe.dimension) + " is outside " +
            (first.body < 0 ? "all bodies" : "the body '" + bodies[first.body] + "'") + "; " + found.nearest.front() +
            (others > 0 ? " (as are " + std::to_string(others) + " more of " + std::to_string(probe.points.size()) + " points)" : ""));
  }
  problems.throwIfAny();
  return all;
}

}  // namespace suture
