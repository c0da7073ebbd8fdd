#include <suture/answer/bound/ContactSides.hpp>
#include <suture/base/Point.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>

namespace suture {

template <int D>
std::vector<TouchingSide> touchingSides(const Comm& comm, const BoundedSolution& solution, const BoundaryParts& contacts,
                                        const BoundParts<D>& parts) {
  using Nodes = SimplexNodes<D>;
  std::vector<TouchingSide> all;
  const auto add = [&](int contact, int number, bool onA) {
    TouchingSide side{contact, comm.getRank(), number, int(onA)};
    const PlaceOfSide& place = parts.places[number];
    const SubdomainMesh& mesh = solution.meshes[place.mesh];
    const BoundElement<D>& element = parts.elements[place.simplex];
    const auto nodes = nodesOfSimplex(parts, mesh, place);
    for (int j = 0; j < Nodes::sideNodes(parts.kind.order); ++j) {
      const int at = nodes[Nodes::ofSide(place.opposite, j)];
      if (at < 0) continue;
      side.nodes[j] = mesh.globalNodes[at];
      side.places[j] = mesh.point(at);
      for (int k = 0; k < D; ++k) side.moved[j][k] = mesh.total(solution.displacement[place.mesh], D * Eigen::Index(at) + k);
    }
    const Point first = minus(side.places[1], side.places[0]);
    Point normal = D == 2 ? Point{first[1], -first[0], 0} : cross(first, minus(side.places[2], side.places[0]));
    side.size = D == 2 ? norm(normal) : norm(normal) / 2;
    Point opposite{0, 0, 0};
    for (int k = 0; k < D; ++k) opposite[k] = element.places(k, place.opposite);
    if (dot(normal, minus(side.places[0], opposite)) < 0) normal = scaled(-1.0, normal);
    side.normal = unit(normal);
    side.young = 1.0 / element.compliance.diagonal().minCoeff();
    if constexpr (D == 3) side.whole = wholeSide(mesh, parts, place);
    for (const Coating& coating : mesh.coatings) {
      if (!onA || coating.contact != contacts.touching[contact].line || coating.element != place.element) continue;
      const std::vector<int> inner = mesh.innerNodes(coating);
      bool covers = true;
      for (int j = 0; j < D; ++j) covers = covers && std::count(inner.begin(), inner.end(), nodes[Nodes::ofSide(place.opposite, j)]) > 0;
      if (covers) side.stiffness = coating.normal;
    }
    all.push_back(side);
  };
  for (std::size_t i = 0; i < parts.onA.size(); ++i) {
    for (const int number : parts.onA[i]) add(int(i), number, true);
    for (const int number : parts.onB[i]) add(int(i), number, false);
  }
  return all;
}

template std::vector<TouchingSide> touchingSides(const Comm&, const BoundedSolution&, const BoundaryParts&, const BoundParts<2>&);
template std::vector<TouchingSide> touchingSides(const Comm&, const BoundedSolution&, const BoundaryParts&, const BoundParts<3>&);

}  // namespace suture
