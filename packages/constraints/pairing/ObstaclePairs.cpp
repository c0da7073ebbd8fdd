#include <suture/constraints/BoundaryLine.hpp>
#include <suture/constraints/pairing/ObstaclePairs.hpp>
#include <suture/mesh/CellGeometry.hpp>

namespace suture {

namespace {
const double averted = 3.14159265358979323846 / 3;  // between the side's normal and the obstacle's
}

PairedLine obstacleLine(const Mesh& mesh, const ContactLine& line, Problems& problems, std::vector<std::string>& notes) {
  const BoundaryLine own(mesh, mesh.sideGroups.at(line.groupA));
  PairedLine result;
  int nodes = 0, aside = 0, wrong = 0;
  Point where{0, 0, 0};
  for (const BoundaryLine::Chain& chain : own.chains()) {
    bool begins = true, whole = true;
    for (std::size_t i = 0; i < chain.nodes.size(); ++i) {
      const int node = chain.nodes[i];
      ContactPair pair;
      pair.id = static_cast<int>(result.pairs.size());
      pair.line = line.number;
      pair.ends = {{node, 1.0}};
      pair.position = mesh.point(node);
      const Obstacle::Foot foot = line.obstacle->from(pair.position);
      pair.normal = foot.normal;
      pair.gap = line.initialGap ? line.initialGap->at(pair.position) : foot.gap;
      pair.length = own.at(node).tributary;
      pair.arc = chain.arc[i];
      ++nodes;
      if (angleBetween(own.normal(node), foot.normal) > averted) {
        if (aside++ == 0) where = pair.position;
        wrong += pair.gap <= 0.0;
        begins = true;
        whole = false;
        continue;
      }
      if (begins) result.chains.push_back({pair.id, 0, false});
      begins = false;
      ++result.chains.back().count;
      result.pairs.push_back(std::move(pair));
    }
    if (whole && !chain.nodes.empty()) result.chains.back().closed = chain.closed;
  }
  if (wrong > 0 || result.pairs.empty())
    problems.add(line.path, "'" + line.groupA +
                                "' does not face the obstacle: its outward normal and the way into the obstacle differ by more "
                                "than 60 degrees at " +
                                countAt(std::size_t(aside), "node", placeText(where)));
  else if (aside > 0)
    notes.push_back("contact '" + line.name + "': " + std::to_string(aside) + " of the " + std::to_string(nodes) + " nodes of '" +
                    line.groupA + "' see the obstacle more than 60 degrees aside and make no pair (the first at " + placeText(where) + ")");
  return result;
}

}  // namespace suture
