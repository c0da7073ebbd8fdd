#include <suture/adapt/ContactTwins.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/BoxTree.hpp>
#include <suture/mesh/Surface.hpp>
#include <suture/pairs/MatchingPairs.hpp>

namespace suture {

namespace {

constexpr double kCoincident = 1e-6;  // distance over the distance to the nearest adjacent node

NodePairs coincidentNodes(const Surface& a, const Surface& b) {
  std::vector<int> nodes;
  std::vector<BoundingBox> places;
  for (const auto& [node, data] : b.nodes()) {
    nodes.push_back(node);
    places.emplace_back();
    places.back().include(data.position);
  }
  NodePairs pairs;
  if (nodes.empty()) return pairs;
  const BoxTree tree(places);
  for (const auto& [node, data] : a.nodes()) {
    const Point& at = data.position;
    const auto distance = [&](int i) { return norm(minus(places[static_cast<std::size_t>(i)].low, at)); };
    const int nearest = tree.nearest(at, distance);
    const int other = nodes[static_cast<std::size_t>(nearest)];
    if (other != node && distance(nearest) <= kCoincident * data.spacing) pairs.emplace_back(node, other);
  }
  return pairs;
}

NodePairs twinsOf(const Mesh& mesh, Contact contact) {
  if (contact.obstacle) return {};
  contact.overclosure.reset();  // its springs are not part of the mesh here
  Problems problems;
  const std::vector<ContactSurface> surfaces = contactsOn(mesh, {contact}, problems);
  if (surfaces.empty() || !surfaces.front().a.surface || !surfaces.front().b.surface) return {};
  const ContactSurface& surface = surfaces.front();
  const std::optional<PairedSurface> matched = matchingPairs(mesh, surface, nullptr);
  if (!matched) return coincidentNodes(*surface.a.surface, *surface.b.surface);
  NodePairs pairs;
  for (const ContactPair& pair : matched->pairs) pairs.emplace_back(pair.ends[0].node, pair.ends[1].node);
  return pairs;
}

}  // namespace

std::vector<NodePairs> contactTwins(const Mesh& mesh, const std::vector<Contact>& contacts) {
  if (!mesh.coatings.empty()) throw InternalError("contactTwins() needs a mesh without coatings");
  std::vector<NodePairs> twins;
  for (const Contact& contact : contacts) twins.push_back(twinsOf(mesh, contact));
  return twins;
}

}  // namespace suture
