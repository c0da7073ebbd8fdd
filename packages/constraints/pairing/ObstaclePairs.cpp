#include <suture/base/Point.hpp>
#include <suture/constraints/pairing/ObstaclePairs.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SurfaceOrder.hpp>

namespace suture {

namespace {
const double averted = 3.14159265358979323846 / 3;  // between the side's normal and the obstacle's
}

PairedSurface obstaclePairs(const ContactSurface& contact, Problems& problems, std::vector<std::string>& notes) {
  const Surface& own = *contact.a.surface;
  std::map<int, Obstacle::Foot> feet;
  int aside = 0, wrong = 0;
  Point where{0, 0, 0};
  const auto gapAt = [&](int node) { return contact.initialGap ? contact.initialGap->at(own.at(node).position) : feet.at(node).gap; };
  const auto faces = [&](int node) { return angleBetween(own.normal(node), feet.at(node).normal) <= averted; };
  for (const OrderedNode& at : inOrder(own, [](int) { return true; })) {
    feet[at.node] = contact.obstacle->from(own.at(at.node).position);
    const double gap = gapAt(at.node);
    if (faces(at.node)) continue;
    if (aside++ == 0) where = own.at(at.node).position;
    wrong += gap <= 0.0;
  }
  PairedSurface result;
  for (const OrderedNode& at : inOrder(own, faces)) {
    const Surface::Node& node = own.at(at.node);
    ContactPair pair;
    pair.id = static_cast<int>(result.pairs.size());
    pair.line = contact.number;
    pair.ends = {{at.node, 1.0}};
    pair.position = node.position;
    pair.normal = feet.at(at.node).normal;
    pair.gap = gapAt(at.node);
    pair.length = node.tributary;
    pair.arc = at.arc;
    result.pairs.push_back(std::move(pair));
  }
  result.cells = cellsOf(own, result.pairs);
  if (wrong > 0 || result.pairs.empty())
    problems.add(contact.path, contact.a.name() +
                                   " does not face the obstacle: its outward normal and the way into the obstacle differ by more "
                                   "than 60 degrees at " +
                                   countAt(std::size_t(aside), "node", placeText(where)));
  else if (aside > 0)
    notes.push_back("contact '" + contact.name + "': " + std::to_string(aside) + " of the " + std::to_string(own.nodes().size()) +
                    " nodes of " + contact.a.name() + " see the obstacle more than 60 degrees aside and make no pair (the first at " +
                    placeText(where) + ")");
  return result;
}

}  // namespace suture
