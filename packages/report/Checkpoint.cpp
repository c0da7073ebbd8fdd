#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/hdf5/Hdf5Reader.hpp>
#include <suture/base/hdf5/Hdf5Writer.hpp>
#include <suture/report/Checkpoint.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {
constexpr const char* kGroup = "/SutureCheckpoint";
constexpr std::size_t kSliding = 5;     // components of a row of Sliding: direction, bound [force], friction
constexpr std::size_t kOldSliding = 4;  // earlier files lack friction
constexpr std::size_t kStep = 19;       // components of a row of Steps
constexpr std::size_t kPathPair = 9;    // components of a row of PathPairs: slip, slipped, dissipated, force, tangential
constexpr std::size_t kCarried = 4;     // components of a row of Carried: BodyForces
constexpr std::size_t kSafety = 12;     // components of a row of Safety: see forEachNumber()
constexpr std::size_t kReleased = 5;    // components of a row of Released: time of removal, node, force
constexpr std::size_t kFit = 2;         // components of a row of Fits: pair, gap
std::string at(const char* name) { return std::string(kGroup) + "/" + name; }

/// Members of a StepRow as numbers; one list for reading and writing.
template <typename Row, typename Each>
void forEachNumber(Row& row, const Each& each) {
  each(row.step), each(row.time), each(row.length), each(row.outer), each(row.pcg), each(row.givenUp), each(row.active), each(row.sticking);
  each(row.slipping), each(row.changed), each(row.residual), each(row.energy), each(row.work.external), each(row.work.stored);
  each(row.work.normal), each(row.work.tangential), each(row.work.dissipated), each(row.work.size), each(row.seconds);
}

/// Members of a LeastSafety as numbers, except a factor without load, which is infinite and belongs to no place.
template <typename Safety, typename Each>
void forEachSafety(Safety& one, const Each& each) {
  each(one.body), each(one.region), each(one.id), each(one.step), each(one.time), each(one.factor);
  for (auto& x : one.place) each(x);
  for (auto& s : one.stress) each(s);
}

/// Lists of all steps as a text; empty: there are none. \param of  list of a row \param fields  of an entry, as an array
template <typename Entry, typename Fields>
std::string listsText(const std::vector<StepRow>& rows, std::vector<Entry> StepRow::*of, const Fields& fields) {
  if (std::all_of(rows.begin(), rows.end(), [&](const StepRow& row) { return (row.*of).empty(); })) return "";
  nlohmann::json all = nlohmann::json::array();
  for (const StepRow& row : rows) {
    nlohmann::json& own = all.emplace_back(nlohmann::json::array());
    for (const Entry& one : row.*of) own.push_back(fields(one));
  }
  return all.dump();
}

/// \param entry  made of its fields \param what  for messages
template <typename Entry, typename Made>
void readLists(const std::string& text, const std::string& path, const std::string& what, std::vector<StepRow>& rows,
               std::vector<Entry> StepRow::*of, const Made& entry) {
  try {
    const nlohmann::json all = nlohmann::json::parse(text);
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const nlohmann::json& fields : all.at(i)) (rows[i].*of).push_back(entry(fields));
  } catch (const nlohmann::json::exception&) {
    throw InputError(path, "damaged: incomplete " + what + " of load steps");
  }
}

nlohmann::json fieldsOf(const StepRow::Frame& one) { return {one.body, one.displacement, one.rotation}; }
nlohmann::json fieldsOf(const StepRow::Group& one) { return {one.name, one.displacement, one.rotation, one.force, one.moment}; }

StepRow::Frame frameOf(const nlohmann::json& one) { return {one.at(0).get<int>(), one.at(1).get<Point>(), one.at(2).get<Point>()}; }
StepRow::Group groupOf(const nlohmann::json& one) {
  return {one.at(0).get<std::string>(), one.at(1).get<Point>(), one.at(2).get<Point>(), one.at(3).get<Point>(), one.at(4).get<Point>()};
}

/// Parts removed and placed so far, and what remains of them.
void writeChanges(Hdf5Writer& file, const Comm& comm, const PathState& steps) {
  if (steps.changes.empty()) return;
  file.write(at("Changes"), steps.changes);
  std::vector<double> released, fits;
  if (comm.getRank() == 0) {
    for (const PathState::Released& one : steps.released)
      released.insert(released.end(), {one.removal, static_cast<double>(one.node), one.force[0], one.force[1], one.force[2]});
    for (const PathState::Fit& one : steps.fits) fits.insert(fits.end(), {static_cast<double>(one.pair), one.gap});
  }
  file.write(at("Released"), released, static_cast<int>(kReleased));
  file.write(at("Fits"), fits, static_cast<int>(kFit));
}

void readChanges(const Hdf5Reader& file, const std::string& path, PathState& steps) {
  if (!file.has(at("Changes"))) return;
  steps.changes = file.readText(at("Changes"));
  const std::vector<double> released = file.readReals(at("Released")), fits = file.readReals(at("Fits"));
  const auto finite = [](double value) { return std::isfinite(value); };
  if (released.size() % kReleased != 0 || fits.size() % kFit != 0 || !std::all_of(released.begin(), released.end(), finite) ||
      !std::all_of(fits.begin(), fits.end(), finite))
    throw InputError(path, "damaged: incomplete forces of removed parts, or gaps of placed bodies");
  std::vector<GlobalId> nodes = file.readGlobalIds(at("Nodes"));
  std::sort(nodes.begin(), nodes.end());
  for (auto row = released.begin(); row != released.end(); row += kReleased) {
    steps.released.push_back({row[0], static_cast<GlobalId>(row[1]), {row[2], row[3], row[4]}});
    if (!std::binary_search(nodes.begin(), nodes.end(), steps.released.back().node))
      throw InputError(path, "damaged: a force of removed parts on the unknown node " + std::to_string(steps.released.back().node));
  }
  for (auto row = fits.begin(); row != fits.end(); row += kFit) steps.fits.push_back({static_cast<int>(row[0]), row[1]});
}

void writePath(Hdf5Writer& file, const Comm& comm, const PathState& steps) {
  std::vector<double> rows, pairs;
  std::vector<double> forces;
  if (comm.getRank() == 0)
    for (const StepRow& row : steps.rows) {
      forEachNumber(row, [&](const auto& value) { rows.push_back(static_cast<double>(value)); });
      for (const Point& force : row.forceOnB) forces.insert(forces.end(), force.begin(), force.end());
    }
  for (const PathState::Pair& pair : steps.pairs) {
    pairs.insert(pairs.end(), pair.past.slip.begin(), pair.past.slip.end());
    pairs.insert(pairs.end(), {pair.past.slipped ? 1.0 : 0.0, pair.past.dissipated, pair.force});
    pairs.insert(pairs.end(), pair.tangential.begin(), pair.tangential.end());
  }
  file.write(at("Steps"), rows, static_cast<int>(kStep));
  file.write(at("StepForces"), forces, 3);
  const auto writeLists = [&](const char* name, auto of) {
    std::string text;
    if (comm.getRank() == 0) text = listsText(steps.rows, of, [](const auto& one) { return fieldsOf(one); });
    text = broadcast(comm, text);
    if (!text.empty()) file.write(at(name), text);
  };
  writeLists("StepGroups", &StepRow::groups);
  writeLists("StepFrames", &StepRow::frames);
  if (steps.moved) writeMovedBodies(file, comm, kGroup, *steps.moved);
  file.write(at("NextStep"), comm.getRank() == 0 ? std::vector<double>{steps.length} : std::vector<double>());
  file.write(at("PathPairs"), pairs, static_cast<int>(kPathPair));
  std::vector<double> carried;
  if (comm.getRank() == 0)
    for (const BodyForces& body : steps.carried) carried.insert(carried.end(), {body.loads, body.prescribed, body.force, body.deformation});
  file.write(at("Carried"), carried, static_cast<int>(kCarried));
  writeChanges(file, comm, steps);
  if (steps.safety.empty()) return;
  std::vector<double> safety;
  if (comm.getRank() == 0)
    for (LeastSafety one : steps.safety) {
      if (!one.exists()) one.factor = 0.0;
      forEachSafety(one, [&](auto value) { safety.push_back(static_cast<double>(value)); });
    }
  file.write(at("Safety"), safety, static_cast<int>(kSafety));
}

/// \param ids  of the pairs, in file order
PathState readPath(const Hdf5Reader& file, const std::string& path, const std::vector<int>& ids) {
  PathState steps;
  if (!file.has(at("Steps"))) return steps;
  const std::vector<double> rows = file.readReals(at("Steps")), next = file.readReals(at("NextStep")),
                            pairs = file.readReals(at("PathPairs"));
  const auto finite = [](double value) { return std::isfinite(value); };
  if (rows.size() % kStep != 0 || next.size() != 1 || pairs.size() != kPathPair * ids.size() ||
      !std::all_of(rows.begin(), rows.end(), finite) || !std::all_of(pairs.begin(), pairs.end(), finite))
    throw InputError(path, "damaged: incomplete load steps");
  for (auto at = rows.begin(); at != rows.end();)
    forEachNumber(steps.rows.emplace_back(), [&](auto& value) { value = static_cast<std::decay_t<decltype(value)>>(*at++); });
  const std::vector<double> forces = file.readReals(at("StepForces"));
  const std::size_t lines = forces.size() / (3 * std::max<std::size_t>(steps.rows.size(), 1));
  for (std::size_t i = 0; i < lines * steps.rows.size(); ++i)
    steps.rows[i / lines].forceOnB.push_back({forces[3 * i], forces[3 * i + 1], forces[3 * i + 2]});
  if (file.has(at("StepGroups"))) readLists(file.readText(at("StepGroups")), path, "rigid groups", steps.rows, &StepRow::groups, groupOf);
  if (file.has(at("StepFrames"))) readLists(file.readText(at("StepFrames")), path, "frames", steps.rows, &StepRow::frames, frameOf);
  if (MovedBodies moved = readMovedBodies(file, kGroup, path); !moved.empty())
    steps.moved = std::make_shared<const MovedBodies>(std::move(moved));
  steps.length = next.front();
  readChanges(file, path, steps);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const double* row = pairs.data() + kPathPair * i;
    steps.pairs.push_back({ids[i], {{row[0], row[1], row[2]}, row[3] != 0.0, row[4]}, row[5], {row[6], row[7], row[8]}});
  }
  if (file.has(at("Safety"))) {
    const std::vector<double> safety = file.readReals(at("Safety"));
    if (safety.size() % kSafety != 0 || !std::all_of(safety.begin(), safety.end(), finite))
      throw InputError(path, "damaged: incomplete load steps");
    for (auto at = safety.begin(); at != safety.end();) {
      LeastSafety& one = steps.safety.emplace_back();
      forEachSafety(one, [&](auto& value) { value = static_cast<std::decay_t<decltype(value)>>(*at++); });
      if (!one.exists()) one.factor = LeastSafety().factor;
    }
  }
  if (!file.has(at("Carried"))) return steps;
  const std::vector<double> carried = file.readReals(at("Carried"));
  if (carried.size() % kCarried != 0 || !std::all_of(carried.begin(), carried.end(), finite))
    throw InputError(path, "damaged: incomplete load steps");
  for (auto row = carried.begin(); row != carried.end(); row += kCarried) steps.carried.push_back({row[0], row[1], row[2], row[3]});
  return steps;
}

/// Reader of an existing checkpoint. \throws InputError  another file
Hdf5Reader openCheckpoint(const Comm& comm, const std::string& path) {
  Hdf5Reader file(comm, path);
  if (!file.has(kGroup)) throw InputError(path, "not a checkpoint of Suture: missing group " + std::string(kGroup));
  return file;
}

/// Rows of a nodal dataset for the nodes of subdomains, node-major. Local.
class NodalRows {
 public:
  NodalRows(const std::vector<GlobalId>& nodes, std::string path) : path_(std::move(path)) {
    for (std::size_t i = 0; i < nodes.size(); ++i) rowOf_.emplace(nodes[i], i);
  }

  /// \param values  one row per node of the file \param what  for messages
  Vector of(const SubdomainMesh& mesh, const std::vector<double>& values, const std::string& what) const {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    Vector own(Eigen::Index(mesh.nodes()) * mesh.dimension);
    for (int node = 0; node < mesh.nodes(); ++node) {
      const GlobalId global = mesh.globalNodes[static_cast<std::size_t>(node)];
      const auto row = rowOf_.find(global);
      if (row == rowOf_.end() || (row->second + 1) * d > values.size())
        throw InputError(path_, "damaged: no " + what + " of node " + std::to_string(global));
      for (std::size_t k = 0; k < d; ++k) {
        const double value = values[row->second * d + k];
        if (!std::isfinite(value))
          throw InputError(path_, "damaged: the " + what + " of node " + std::to_string(global) + " is not finite");
        own[Eigen::Index(node) * mesh.dimension + Eigen::Index(k)] = value;
      }
    }
    return own;
  }

 private:
  std::string path_;
  std::map<GlobalId, std::size_t> rowOf_;
};

}  // namespace

void writeCheckpoint(const Comm& comm, const std::string& path, const std::string& meshHash, const std::vector<SubdomainMesh>& meshes,
                     const Solution& solution, const PathState& steps) {
  int dimension = 1;
  const int mine = meshes.empty() ? 1 : meshes.front().dimension;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(dimension));
  std::vector<GlobalId> nodes;
  std::vector<double> values, rests;  // rests: digits of the displacement lost to round-off in its sum with the lift
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    nodes.insert(nodes.end(), meshes[s].globalNodes.begin(), meshes[s].globalNodes.end());
    const Vector& u = solution.displacement[s];
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      values.push_back(meshes[s].total(u, i));
      if (meshes[s].lift.motion.size() > 0) rests.push_back(u[i] - (values.back() - meshes[s].lift.motion[i]));
    }
  }
  std::vector<int> pairs, status;
  std::vector<double> sliding;  // kSliding numbers per pair
  int slides = 0, anySlides = 0;
  for (const PairResult& pair : solution.pairs) {
    pairs.push_back(pair.id);
    status.push_back(static_cast<int>(pair.state.status));
    sliding.insert(sliding.end(), pair.state.direction.begin(), pair.state.direction.end());
    sliding.insert(sliding.end(), {pair.state.bound, pair.state.friction});
    if (pair.state != ContactState(pair.state.status)) slides = 1;
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, slides, Teuchos::outArg(anySlides));
  Hdf5Writer file(comm, path);
  file.addChecksums();
  file.group(kGroup);
  file.attribute(kGroup, "MeshHash", broadcast(comm, meshHash));
  file.write(at("Nodes"), nodes);
  file.write(at("Displacement"), values, dimension);
  const int own = !rests.empty();
  int any = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, own, Teuchos::outArg(any));
  if (any) file.write(at("Rest"), rests, dimension);
  file.write(at("Pairs"), pairs);
  file.write(at("Status"), status);
  if (anySlides) file.write(at("Sliding"), sliding, static_cast<int>(kSliding));  // absent without friction
  if (!steps.empty()) writePath(file, comm, steps);
  if (!steps.empty() && steps.since > 0.0) {
    std::vector<double> reference;
    for (const Vector& u : steps.reference) reference.insert(reference.end(), u.begin(), u.end());
    file.write(at("Since"), comm.getRank() == 0 ? std::vector<double>{steps.since} : std::vector<double>());
    file.write(at("Reference"), reference, dimension);
  }
  file.close();
}

PathState readPath(const Comm& comm, const std::string& path) {
  const Hdf5Reader file = openCheckpoint(comm, path);
  PathState steps = readPath(file, path, file.readInts(at("Pairs")));
  if (steps.empty()) throw InputError(path, "a checkpoint without load steps; expected one of a scene with load steps");
  return steps;
}

Start readCheckpoint(const Comm& comm, const std::string& path, const std::string& meshHash, const std::vector<SubdomainMesh>& meshes,
                     PathState* steps) {
  const Hdf5Reader file = openCheckpoint(comm, path);
  const std::string expected = broadcast(comm, meshHash), found = file.readTextAttribute(kGroup, "MeshHash");
  if (found != expected) throw InputError(path, "a checkpoint of another mesh (hash " + found + ", this mesh has " + expected + ")");
  const std::vector<GlobalId> nodes = file.readGlobalIds(at("Nodes"));
  const std::vector<double> values = file.readReals(at("Displacement"));
  const std::vector<double> rests = file.has(at("Rest")) ? file.readReals(at("Rest")) : std::vector<double>(values.size(), 0.0);
  const std::vector<int> pairs = file.readInts(at("Pairs")), status = file.readInts(at("Status"));
  const std::vector<double> sliding =
      file.has(at("Sliding")) ? file.readReals(at("Sliding")) : std::vector<double>(kSliding * status.size(), 0.0);

  Start start;
  if (steps) *steps = readPath(file, path, pairs);
  std::vector<double> reference;
  if (steps && !steps->empty() && file.has(at("Since"))) {
    const std::vector<double> since = file.readReals(at("Since"));
    if (since.size() != 1 || !std::isfinite(since.front())) throw InputError(path, "damaged: incomplete load steps");
    steps->since = since.front();
    reference = file.readReals(at("Reference"));
  }
  collectively(comm, "reading a checkpoint", [&] {
    const NodalRows rows(nodes, path);
    for (const SubdomainMesh& mesh : meshes) {
      Vector own = rows.of(mesh, values, "displacement");
      if (mesh.lift.motion.size() > 0) own -= mesh.lift.motion;
      start.displacement.push_back(own + rows.of(mesh, rests, "displacement"));
      if (steps && steps->since > 0.0) steps->reference.push_back(rows.of(mesh, reference, "reference displacement"));
    }
    if (pairs.size() != status.size())
      throw InputError(path, "damaged: " + std::to_string(pairs.size()) + " pairs, " + std::to_string(status.size()) + " states");
    const std::size_t columns = sliding.size() == kOldSliding * status.size() ? kOldSliding : kSliding;
    if (sliding.size() != columns * status.size())
      throw InputError(path,
                       "damaged: " + std::to_string(sliding.size()) + " values in Sliding for " + std::to_string(pairs.size()) + " pairs");
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (status[i] < 0 || status[i] > static_cast<int>(PairStatus::Stick))
        throw InputError(path, "damaged: pair " + std::to_string(pairs[i]) + " has the unknown status " + std::to_string(status[i]));
      const double* row = sliding.data() + columns * i;
      if (!std::all_of(row, row + columns, [](double value) { return std::isfinite(value); }))
        throw InputError(path, "damaged: direction, bound or friction of pair " + std::to_string(pairs[i]) + " is not finite");
      start.status[pairs[i]] = {static_cast<PairStatus>(status[i]), {row[0], row[1], row[2]}, row[3], columns > kOldSliding ? row[4] : 0.0};
    }
  });
  return start;
}

}  // namespace suture
