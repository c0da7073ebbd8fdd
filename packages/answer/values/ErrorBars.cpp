#include <algorithm>
#include <cmath>
#include <iterator>
#include <suture/answer/values/ErrorBars.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Point.hpp>
#include <suture/partition/SubdomainMesh.hpp>

namespace suture {
namespace {

constexpr double kPerpendicular =
    0.05;  // cosine of the angle between directions that count as perpendicular, as normals of straight sides on a symmetry plane

bool haveCommonPart(const Point& a, const Point& b) { return std::abs(dot(a, b)) > kPerpendicular * norm(a) * norm(b); }

/// Supports of a mesh by node of the whole mesh.
std::multimap<GlobalId, const Support*> supportsByNode(const SubdomainMesh& mesh) {
  std::multimap<GlobalId, const Support*> all;
  for (const Support& support : mesh.supports) all.emplace(mesh.globalNodes[static_cast<std::size_t>(support.node)], &support);
  return all;
}

bool isAmong(const std::vector<int>& numbers, int number) { return std::binary_search(numbers.begin(), numbers.end(), number); }

}  // namespace

double ErrorBars::bar(bool shares, double largest) const {
  const double order = shares ? kLinear * discretisation : kSquare * discretisation * discretisation;
  return (order + algebraic + kTurning * turning) * largest;
}

double ErrorBars::ofCondition(int condition, double largest) const { return bar(isAmong(sharedConditions, condition), largest); }

double ErrorBars::ofContact(int contact, double largest) const { return bar(isAmong(sharedContacts, contact), largest); }

bool ErrorBars::isLinear(bool isContact, int number) const {
  const bool shares = isAmong(isContact ? sharedContacts : sharedConditions, number);
  return shares || kTurning * turning > kSquare * discretisation * discretisation;
}

double largestTurning(const std::vector<ContactPiece>& pieces, const std::vector<PairResult>& pairs) {
  std::map<int, const PairResult*> byId;
  for (const PairResult& pair : pairs) byId[pair.id] = &pair;
  double largest = 0;
  for (const ContactPiece& piece : pieces)
    for (const std::vector<int>& cell : piece.cells) {
      std::vector<const PairResult*> known;
      for (const int id : cell)
        if (const auto pair = byId.find(id); pair != byId.end()) known.push_back(pair->second);
      if (std::none_of(known.begin(), known.end(), [](const PairResult* pair) { return pair->state.closed(); })) continue;
      for (const PairResult* a : known)
        for (const PairResult* b : known) largest = std::max(largest, angleBetween(a->normal, b->normal));
    }
  return largest;
}

void findSharedNodes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, ErrorBars& bars) {
  std::vector<int> conditions, contacts;
  for (const SubdomainMesh& mesh : meshes) {
    const auto supports = supportsByNode(mesh);
    for (auto one = supports.begin(); one != supports.end(); ++one)
      for (auto other = std::next(one); other != supports.end() && other->first == one->first; ++other)
        if (one->second->condition != other->second->condition && haveCommonPart(one->second->direction, other->second->direction))
          conditions.insert(conditions.end(), {one->second->condition, other->second->condition});
    for (const ContactRow& row : mesh.contactRows)
      for (const PairEnd& end : row.pair.ends) {
        const auto [first, last] = supports.equal_range(end.node);
        for (auto one = first; one != last; ++one)
          if (haveCommonPart(one->second->direction, row.pair.normal)) {
            conditions.push_back(one->second->condition);
            contacts.push_back(row.pair.line);
          }
      }
  }
  bars.sharedConditions = unionOverRanks(comm, conditions);
  bars.sharedContacts = unionOverRanks(comm, contacts);
}

}  // namespace suture
