#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SurfaceOrder.hpp>
#include <suture/pairs/ObstaclePairs.hpp>
#include <suture/pairs/mortar/MortarPairs.hpp>
#include <suture/pairs/mortar/ObstacleSampling.hpp>

namespace suture {

namespace {

const double averted = 3.14159265358979323846 / 3;  // between the side's normal and the obstacle's

/// How a point of a face sees the obstacle.
struct View {
  Obstacle::Foot foot;  // in the direction chosen by the contact
  bool faces = false;   // along a normal at most 60 degrees from that of the face
};

View viewOf(const ContactSurface& contact, const Point& place, const Point& outward) {
  View view{contact.obstacle->from(place), false};
  Point normal = view.foot.normal;
  if (contact.direction == Contact::Direction::Side) {
    const std::optional<double> way = contact.obstacle->way(place, outward);
    if (!way) return view;
    normal = contact.obstacle->from(plus(place, scaled(*way, outward))).normal;
    view.foot = {outward, *way};
  }
  if (contact.initialGap) view.foot.gap = contact.initialGap->at(place);
  view.faces = angleBetween(outward, normal) <= averted;
  return view;
}

ContactPair pairOf(const ContactSurface& contact, const OrderedNode& at, const Surface::Node& node, const Obstacle::Foot& foot) {
  ContactPair pair;
  pair.line = contact.number;
  pair.ends = {{at.node, 1.0}};
  pair.position = node.position;
  pair.normal = foot.normal;
  pair.gap = foot.gap;
  pair.length = node.tributary;
  pair.arc = at.arc;
  return pair;
}

}  // namespace

PairedSurface obstaclePairs(const ContactSurface& contact, Problems& problems, std::vector<std::string>& notes) {
  const Surface& own = *contact.a.surface;
  const auto placed = [&](const Point& place) { return placeText(place, own.dimension()); };
  const bool nodal = contact.a.nodesCarryPressure();
  std::vector<ContactPair> candidates;
  if (!nodal) candidates = mortarPairs(contact, std::make_unique<ObstacleSampling>(contact)).pairs;
  std::map<int, View> views;
  std::vector<OrderedNode> carriers;
  if (nodal)
    carriers = inOrder(own, [](int) { return true; });
  else
    for (const ContactPair& pair : candidates) carriers.push_back({pair.node(), pair.arc});
  int aside = 0, wrong = 0;
  Point where{0, 0, 0};
  for (const OrderedNode& at : carriers) {
    const Point& place = own.at(at.node).position;
    const View& view = views[at.node] = viewOf(contact, place, own.normal(at.node));
    if (view.faces) continue;
    if (aside++ == 0) where = place;
    wrong += view.foot.gap <= 0.0;
  }
  PairedSurface result;
  const auto faces = [&](int node) { return views.at(node).faces; };
  if (nodal)
    for (const OrderedNode& at : inOrder(own, faces)) result.pairs.push_back(pairOf(contact, at, own.at(at.node), views.at(at.node).foot));
  else
    for (const ContactPair& pair : candidates)
      if (faces(pair.node())) result.pairs.push_back(pair);
  for (std::size_t i = 0; i < result.pairs.size(); ++i) result.pairs[i].id = static_cast<int>(i);
  result.cells = cellsOf(own, result.pairs);
  if (wrong > 0 || result.pairs.empty())
    problems.add(
        contact.path,
        contact.a.name() +
            " does not face the obstacle: its outward normal and the direction into the obstacle differ by more than 60 degrees at " +
            countAt(std::size_t(aside), "node", placed(where)));
  else if (aside > 0)
    notes.push_back("contact '" + contact.name + "': " + std::to_string(aside) + " of the " + std::to_string(carriers.size()) +
                    " nodes of " + contact.a.name() +
                    " see the obstacle more than 60 degrees off their normal and have no pair (the first at " + placed(where) + ")");
  return result;
}

}  // namespace suture
