#include <Eigen/Geometry>
#include <suture/answer/bound/StarMesh.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Gather.hpp>
#include <suture/partition/SubdomainRanks.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cstring>
#include <set>
#include <unordered_map>

namespace suture {

namespace {

// Numbers of nodes per vertex of an element up to which a table of all of them is faster than sorting.
constexpr GlobalId kDense = 4;

/// Plain values with Eigen members, which are not trivially copyable for the compiler.
template <typename T>
void putBytes(Packer& packer, const T& value) {
  packer.put(std::string(reinterpret_cast<const char*>(&value), sizeof(T)));
}
template <typename T>
void getBytes(Unpacker& unpacker, T& value) {
  const std::string bytes = unpacker.get<std::string>();
  std::memcpy(static_cast<void*>(&value), bytes.data(), sizeof(T));
}

/// Elements, and ranks that hold one of their nodes: rank -> places in the list of all own elements.
std::map<int, std::vector<int>> elementsForRanks(const Comm& comm, const std::vector<SubdomainMesh>& meshes,
                                                 const std::vector<std::vector<int>>& ofMesh) {
  const std::unordered_map<int, int> rankOf = ranksOfSubdomains(comm, meshes);
  std::map<int, std::vector<int>> all;
  std::set<int> neighbours;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const SubdomainMesh& mesh = meshes[m];
    for (int node = 0; node < mesh.nodes(); ++node)
      for (const int other : mesh.others(node)) neighbours.insert(rankOf.at(other));
    for (int e = 0; e < mesh.elements(); ++e) {
      std::set<int> ranks;
      for (const int node : mesh.nodesOf(e))
        for (const int other : mesh.others(node)) ranks.insert(rankOf.at(other));
      for (const int rank : ranks)
        for (int t = ofMesh[m][e]; t < ofMesh[m][e + 1] && rank != comm.getRank(); ++t) all[rank].push_back(t);
    }
  }
  for (const int rank : neighbours)
    if (rank != comm.getRank()) all[rank];
  return all;
}

/// Number of each id among the different ids, in ascending order. \param different  how many
std::vector<int> ranksOf(const std::vector<GlobalId>& ids, int& different) {
  std::vector<int> numbers(ids.size());
  different = 0;
  if (ids.empty()) return numbers;
  const auto [least, most] = std::minmax_element(ids.begin(), ids.end());
  const GlobalId first = *least, range = *most - first + 1;
  if (range <= kDense * GlobalId(ids.size())) {
    std::vector<int> table(static_cast<std::size_t>(range), -1);
    for (const GlobalId id : ids) table[static_cast<std::size_t>(id - first)] = 0;
    for (int& entry : table)
      if (entry == 0) entry = different++;
    for (std::size_t i = 0; i < ids.size(); ++i) numbers[i] = table[static_cast<std::size_t>(ids[i] - first)];
    return numbers;
  }
  std::vector<GlobalId> sorted = ids;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  different = static_cast<int>(sorted.size());
  for (std::size_t i = 0; i < ids.size(); ++i) numbers[i] = int(std::lower_bound(sorted.begin(), sorted.end(), ids[i]) - sorted.begin());
  return numbers;
}

}  // namespace

template <int D>
StarMesh<D>::StarMesh(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const BoundKind& kind,
                      std::vector<BoundElement<D>> elements, const std::vector<std::vector<int>>& ofMesh,
                      std::vector<SideCondition<D>> boundary)
    : comm_(comm), kind_(kind), own_(static_cast<int>(elements.size())), elements_(std::move(elements)), boundary_(std::move(boundary)) {
  rankOf_.assign(elements_.size(), comm.getRank());
  sent_ = elementsForRanks(comm, meshes, ofMesh);
  std::map<int, std::string> messages;
  for (const auto& [rank, list] : sent_) {
    Packer packer;
    packer.put(static_cast<int>(list.size()));
    for (const int e : list) {
      putBytes(packer, elements_[e]);
      for (const int b : elements_[e].boundary)
        if (b >= 0) putBytes(packer, boundary_[b]);
    }
    messages[rank] = std::move(packer).bytes();
  }
  for (const auto& [rank, bytes] : swapWithNeighbours(comm, messages)) {
    Unpacker unpacker(bytes);
    for (int count = unpacker.template get<int>(); count > 0; --count) {
      BoundElement<D> element;
      getBytes(unpacker, element);
      for (int& b : element.boundary)
        if (b >= 0) {
          b = static_cast<int>(boundary_.size());
          boundary_.emplace_back();
          getBytes(unpacker, boundary_.back());
        }
      received_[rank].push_back(static_cast<int>(elements_.size()));
      elements_.push_back(element);
      rankOf_.push_back(rank);
    }
  }
  number();
  findSides();
  findStars();
  findOwners();
}

template <int D>
void StarMesh<D>::number() {
  std::vector<GlobalId> all;
  all.reserve(elements_.size() * (D + 1));
  for (const BoundElement<D>& element : elements_) all.insert(all.end(), element.vertices.begin(), element.vertices.end());
  const std::vector<int> numbers = ranksOf(all, vertexCount_);
  places_.resize(D, vertexCount_);
  vertices_.resize(elements_.size());
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (int i = 0; i <= D; ++i) {
      vertices_[e][i] = numbers[e * (D + 1) + i];
      places_.col(vertices_[e][i]) = elements_[e].places.col(i);
    }
}

template <int D>
void StarMesh<D>::findSides() {
  // Lists of the sides whose lowest vertex is v: few, and searched one by one.
  std::vector<int> firstOf(std::size_t(vertexCount_), -1), next;
  const std::size_t expected = elements_.size() * (D + 1) / 2 + elements_.size() / 8;
  next.reserve(expected), verticesOfSide_.reserve(expected), elementsOfSide_.reserve(expected), boundaryOfSide_.reserve(expected);
  sizes_.reserve(expected), normals_.reserve(expected);
  sides_.resize(elements_.size());
  signs_.resize(elements_.size());
  for (int e = 0; e < elements(); ++e)
    for (int a = 0; a <= D; ++a) {
      std::array<int, D> key;
      for (int i = 0, j = 0; i <= D; ++i)
        if (i != a) key[j++] = vertices_[e][i];
      int found = firstOf[key[0]];
      while (found >= 0 && verticesOfSide_[found] != key) found = next[found];
      if (found < 0) {
        found = sides();
        next.push_back(firstOf[key[0]]);
        firstOf[key[0]] = found;
        verticesOfSide_.push_back(key);
        elementsOfSide_.push_back({e, -1});
        boundaryOfSide_.push_back(elements_[e].boundary[a]);
        Eigen::Matrix<double, D, 1> normal;
        const Eigen::Matrix<double, D, 1> first = place(key[1]) - place(key[0]);
        if constexpr (D == 2) {
          normal << first[1], -first[0];
          sizes_.push_back(normal.norm());
        } else {
          normal = first.cross(place(key[2]) - place(key[0]));
          sizes_.push_back(normal.norm() / 2);
        }
        normals_.push_back(normal.normalized());
      } else {
        elementsOfSide_[found][1] = e;
      }
      sides_[e][a] = found;
      signs_[e][a] = normals_[found].dot(place(key[0]) - place(vertices_[e][a])) > 0 ? 1.0 : -1.0;
    }
}

template <int D>
void StarMesh<D>::findStars() {
  starBegin_.assign(std::size_t(vertexCount_) + 1, 0);
  for (const auto& element : vertices_)
    for (const int v : element) ++starBegin_[v + 1];
  for (int v = 0; v < vertexCount_; ++v) starBegin_[v + 1] += starBegin_[v];
  starElements_.resize(starBegin_.back());
  std::vector<int> at(starBegin_.begin(), starBegin_.end() - 1);
  for (int e = 0; e < elements(); ++e)
    for (const int v : vertices_[e]) starElements_[at[v]++] = e;
  complete_.assign(std::size_t(vertexCount_), 0);
  for (int e = 0; e < own_; ++e)
    for (const int v : vertices_[e]) complete_[v] = 1;
}

template <int D>
void StarMesh<D>::findOwners() {
  counts_.assign(std::size_t(vertexCount_), 0);
  countsSide_.assign(elementsOfSide_.size(), 0);
  const int me = comm_.getRank();
  for (int v = 0; v < vertices(); ++v) {
    if (!isComplete(v)) continue;
    const Span<const int> all = star(v);
    counts_[v] = std::all_of(all.begin(), all.end(), [&](int e) { return rankOf_[e] >= me; });
  }
  for (int s = 0; s < sides(); ++s) {
    const auto& [first, second] = elementsOfSide_[s];
    if (first >= own_ && (second < 0 || second >= own_)) continue;
    countsSide_[s] = rankOf_[first] >= me && (second < 0 || rankOf_[second] >= me);
  }
}

template <int D>
void StarMesh<D>::exchange(Matrix& values, bool ofVertices) const {
  const auto places = [&](int e) -> const std::array<int, D + 1>& { return ofVertices ? vertices_[e] : sides_[e]; };
  std::map<int, std::string> messages;
  for (const auto& [rank, list] : sent_) {
    Packer packer;
    std::vector<double> all;
    all.reserve(list.size() * (D + 1) * values.rows());
    for (const int e : list)
      for (const int i : places(e)) all.insert(all.end(), values.col(i).data(), values.col(i).data() + values.rows());
    packer.put(all);
    messages[rank] = std::move(packer).bytes();
  }
  for (const auto& [rank, bytes] : swapWithNeighbours(comm_, messages)) {
    const std::vector<double> all = Unpacker(bytes).get<std::vector<double>>();
    const auto list = received_.find(rank);
    if (list == received_.end()) continue;
    const double* next = all.data();
    for (const int e : list->second)
      for (const int i : places(e)) {
        const bool isOwn = ofVertices ? isComplete(i) : elementsOfSide_[i][0] < own_;
        if (!isOwn) values.col(i) = Eigen::Map<const Vector>(next, values.rows());
        next += values.rows();
      }
  }
}

template <int D>
void StarMesh<D>::exchangeSides(Matrix& values) const {
  exchange(values, false);
}

template <int D>
void StarMesh<D>::exchangeVertices(Matrix& values) const {
  exchange(values, true);
}

template class StarMesh<2>;
template class StarMesh<3>;

}  // namespace suture
