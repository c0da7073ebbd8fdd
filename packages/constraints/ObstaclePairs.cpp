#include <suture/constraints/BoundaryLine.hpp>
#include <suture/constraints/ObstaclePairs.hpp>
#include <suture/mesh/CellGeometry.hpp>

namespace suture {

namespace {
const double averted = 3.14159265358979323846 / 3;  // between the side's normal and the obstacle's
}

PairedLine obstacleLine(const Mesh& mesh, const ContactLine& line, Problems& problems) {
  const BoundaryLine own(mesh, mesh.sideGroups.at(line.groupA));
  PairedLine result;
  int wrong = 0;
  Point where{0, 0, 0};
  for (const BoundaryLine::Chain& chain : own.chains()) {
    result.chains.push_back({static_cast<int>(result.pairs.size()), static_cast<int>(chain.nodes.size()), chain.closed});
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
      if (angleBetween(own.normal(node), foot.normal) > averted && wrong++ == 0) where = pair.position;
      result.pairs.push_back(std::move(pair));
    }
  }
  if (wrong > 0)
    problems.add(line.path, "'" + line.groupA +
                                "' does not face the obstacle: its outward normal and the way into the obstacle differ by more "
                                "than 60 degrees at " +
                                countAt(std::size_t(wrong), "node", placeText(where)));
  return result;
}

}  // namespace suture
