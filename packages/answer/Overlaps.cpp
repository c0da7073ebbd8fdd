#include <suture/answer/BodyOutline.hpp>
#include <suture/answer/Overlaps.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/Outline.hpp>
#include <suture/mesh/SideGeometry.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

namespace suture {

namespace {

constexpr double kSameDepth = 1e-9;  // difference of depths and of boxes that is round-off, relative to them
constexpr double kInside = 0.01;     // smallest depth, as a fraction of a side
constexpr double kPassed = 0.5;      // fraction of a side by which sides of a contact have passed through each other
constexpr double kSmooth = 0.8;      // distance between unit normals of adjacent sides from which there is a corner: 47 degrees
constexpr double kSafe = 0.25;       // times the angle to the next side and the length: twice the distance between a side and its arc

/// First number that both ascending lists contain; -1: none.
int common(const std::vector<int>& a, const std::vector<int>& b) {
  for (const int x : a)
    if (std::find(b.begin(), b.end(), x) != b.end()) return x;
  return -1;
}

std::vector<int> united(const std::vector<int>& a, const std::vector<int>& b) {
  std::set<int> all(a.begin(), a.end());
  all.insert(b.begin(), b.end());
  return {all.begin(), all.end()};
}

}  // namespace

OverlapSearch::OverlapSearch(const std::vector<SubdomainMesh>& meshes, int bodies, const std::set<int>& given)
    : meshes_(meshes), bodies_(bodies), given_(given) {
  if (bodies < 2) return;
  for (const SubdomainMesh& mesh : meshes) {
    MeshOutline& own = outlines_.emplace_back();
    std::map<std::pair<int, int>, int> groupOf;
    for (const auto& [name, sides] : mesh.sideGroups) {
      for (const Side& side : sides) groupOf.try_emplace({side.element, side.side}, static_cast<int>(groups_.size()));
      groups_.push_back(name);
    }
    std::set<std::pair<int, int>> seams;
    for (const SubdomainMesh::SeamSide& seam : mesh.seamSides) seams.insert({seam.element, seam.side});
    std::set<int> used;
    for (const Side& side : outline(mesh)) {
      if (seams.count({side.element, side.side})) continue;
      const auto group = groupOf.find({side.element, side.side});
      const std::vector<int> nodes = mesh.nodesOf(side);
      used.insert(nodes.begin(), nodes.end());
      for (const std::vector<int>& cell : linearCells(static_cast<int>(nodes.size()), mesh.dimension)) {
        LinearSide& part = own.sides.emplace_back(LinearSide{{}, group == groupOf.end() ? -1 : group->second});
        for (const int local : cell) part.nodes.push_back(nodes[local]);
      }
    }
    own.nodes.assign(used.begin(), used.end());
    if (mesh.contactEnds.empty()) continue;
    std::map<int, int> lineOf;
    for (const ContactRow& row : mesh.contactRows) lineOf[row.pair.id] = row.pair.line;
    own.contacts.resize(mesh.nodes());
    const std::map<int, int> under = nodesUnderCoatings(mesh);
    for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) {
      const auto inner = under.find(end.node);
      std::vector<int>& lines = own.contacts[inner == under.end() ? end.node : inner->second];
      const int line = lineOf.at(end.pair);
      if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    }
  }
}

/// One search, for bodies at fixed positions.
class OverlapSearch::Search {
 public:
  Search(const Comm& comm, const OverlapSearch& all, const std::vector<Vector>& displacement) : comm_(comm), all_(all) {
    for (std::size_t i = 0; i < all.outlines_.size(); ++i) place(i, displacement);
  }

  std::vector<Overlap> run() {
    if (!findNeighbours()) return {};
    gather();
    collectively(comm_, "looking for bodies that overlap", [&] {
      for (std::size_t i = 0; i < all_.outlines_.size(); ++i) search(i);
    });
    std::vector<Overlap> mine;
    for (const auto& [key, overlap] : deepest_) mine.push_back(overlap);
    deepest_.clear();
    for (const Overlap& overlap : joinEverywhere(comm_, mine)) keep(overlap);
    std::vector<Overlap> result;
    for (const auto& [key, overlap] : deepest_) result.push_back(overlap);
    return result;
  }

 private:
  /// Positions of a mesh's nodes on the outline, and its facets.
  void place(std::size_t i, const std::vector<Vector>& displacement) {
    const SubdomainMesh& mesh = all_.meshes_[i];
    const MeshOutline& outline = all_.outlines_[i];
    dimension_ = mesh.dimension;
    std::vector<Point>& places = places_.emplace_back(mesh.nodes());
    std::vector<std::vector<int>>& facetsAt = facetsAt_.emplace_back(mesh.nodes());
    for (const int node : outline.nodes) {
      Point& x = places[node] = mesh.point(node);
      if (displacement.empty()) continue;
      for (int k = 0; k < mesh.dimension; ++k) x[k] += mesh.total(displacement[i], Eigen::Index(node) * mesh.dimension + k);
    }
    std::vector<Facet>& facets = facets_.emplace_back();
    std::vector<int>& sideOf = sideOfFacet_.emplace_back();
    for (std::size_t s = 0; s < outline.sides.size(); ++s) {
      const std::vector<int>& nodes = outline.sides[s].nodes;
      for (std::size_t third = 2; third < std::max<std::size_t>(nodes.size(), 3); ++third) {
        Facet facet;
        facet.body = mesh.body;
        facet.group = outline.sides[s].group;
        const auto corner = [&](int k) { return places[nodes[k]]; };
        facet.corners = {corner(0), corner(mesh.dimension == 2 ? 1 : int(third) - 1),
                         mesh.dimension == 2 ? Point{0, 0, 0} : corner(int(third))};
        const Point along = minus(facet.corners[1], facet.corners[0]);
        const Point area = mesh.dimension == 2 ? Point{along[1], -along[0], 0} : cross(along, minus(facet.corners[2], facet.corners[0]));
        const double size = norm(area);
        if (!(size > 0.0)) continue;  // degenerate
        facet.normal = scaled(1.0 / size, area);
        for (int a = 0; a < mesh.dimension; ++a)
          facet.size = std::max(facet.size, norm(minus(facet.corners[(a + 1) % mesh.dimension], facet.corners[a])));
        for (const int node : nodes) {
          facetsAt[node].push_back(static_cast<int>(facets.size()));
          if (!outline.contacts.empty()) facet.contacts = united(facet.contacts, outline.contacts[node]);
        }
        facets.push_back(facet);
        sideOf.push_back(static_cast<int>(s));
      }
    }
    for (const int node : outline.nodes)
      for (const int f : facetsAt[node])
        for (const int other : facetsAt[node])
          if (const double turn = norm(minus(facets[f].normal, facets[other].normal)); turn < kSmooth)
            facets[f].bulge = std::max(facets[f].bulge, kSafe * turn * facets[f].size);
  }

  /// Boxes of the bodies, and which of them intersect. False if none do.
  bool findNeighbours() {
    const int d = 3, count = all_.bodies_;
    const double far = std::numeric_limits<double>::infinity();
    std::vector<double> mine(std::size_t(2 * d * count) + 2, far), least(mine.size());  // lowest, minus highest; all finite; - dimension
    mine.end()[-2] = 1.0;
    mine.end()[-1] = -dimension_;
    for (std::size_t i = 0; i < places_.size(); ++i)
      for (const int node : all_.outlines_[i].nodes)
        for (int k = 0; k < d; ++k) {
          const double x = places_[i][node][k];
          if (!std::isfinite(x)) mine.end()[-2] = 0.0;
          double* box = &mine[2 * d * std::size_t(all_.meshes_[i].body)];
          box[k] = std::min(box[k], x);
          box[d + k] = std::min(box[d + k], -x);
        }
    Teuchos::reduceAll(comm_, Teuchos::REDUCE_MIN, static_cast<int>(mine.size()), mine.data(), least.data());
    dimension_ = static_cast<int>(-least.end()[-1]);
    if (least.end()[-2] == 0.0) return false;
    for (int b = 0; b < count; ++b) {
      BoundingBox& box = boxes_.emplace_back();
      const double* values = &least[2 * d * std::size_t(b)];
      if (values[0] == far) continue;  // no nodes
      box.include(Point{values[0], values[1], values[2]});
      box.include(Point{-values[3], -values[4], -values[5]});
    }
    const BoxTree tree(boxes_);
    neighbours_.resize(count);
    bool any = false;
    for (int b = 0; b < count; ++b) {
      const double rounding = kSameDepth * norm(minus(boxes_[b].high, boxes_[b].low));
      const auto overlaps = [&](const BoundingBox& other) {
        for (int k = 0; k < dimension_; ++k)
          if (!(std::min(boxes_[b].high[k], other.high[k]) - std::max(boxes_[b].low[k], other.low[k]) > rounding)) return false;
        return true;
      };
      for (const int c : tree.find(overlaps))
        if (c != b) neighbours_[b].push_back(c), any = true;
    }
    return any;
  }

  /// Outlines of the bodies that intersect others, on every rank.
  void gather() {
    std::vector<Facet> mine;
    for (const std::vector<Facet>& facets : facets_)
      for (const Facet& facet : facets)
        if (!neighbours_[facet.body].empty()) mine.push_back(facet);
    Packer packer;
    packer.put(all_.groups_);
    packer.put(mine);
    for (const std::string& bytes : allGather(comm_, packer.bytes())) {
      Unpacker unpacker(bytes);
      const auto names = unpacker.get<std::vector<std::string>>();
      for (Facet& facet : unpacker.get<std::vector<Facet>>()) {
        if (facet.group >= 0) facet.group += static_cast<int>(names_.size());
        everywhere_.push_back(std::move(facet));
      }
      names_.insert(names_.end(), names.begin(), names.end());
    }
    std::map<int, std::vector<const Facet*>> ofBody;
    std::map<int, std::set<int>> joined;  // bodies at each contact with a given gap
    for (const Facet& facet : everywhere_) {
      ofBody[facet.body].push_back(&facet);
      for (const int line : facet.contacts)
        if (all_.given_.count(line)) joined[line].insert(facet.body);
    }
    for (const auto& contact : joined) {
      const std::set<int>& bodies = contact.second;
      for (const int body : bodies) {
        std::vector<int>& others = neighbours_[body];
        others.erase(std::remove_if(others.begin(), others.end(), [&](int other) { return bodies.count(other) > 0; }), others.end());
      }
    }
    std::set<int> wanted;
    for (const SubdomainMesh& mesh : all_.meshes_) wanted.insert(neighbours_[mesh.body].begin(), neighbours_[mesh.body].end());
    for (const int body : wanted)
      if (ofBody.count(body)) bodies_.try_emplace(body, dimension_, ofBody.at(body));
  }

  void search(std::size_t i) {
    const SubdomainMesh& mesh = all_.meshes_[i];
    if (neighbours_[mesh.body].empty()) return;
    std::map<std::pair<int, int>, std::vector<int>> facetsOfEdge;
    for (std::size_t f = 0; f < facets_[i].size(); ++f) {
      const std::vector<int>& nodes = all_.outlines_[i].sides[sideOfFacet_[i][f]].nodes;
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const int a = nodes[k], b = nodes[(k + 1) % nodes.size()];
        facetsOfEdge[{std::min(a, b), std::max(a, b)}].push_back(static_cast<int>(f));
      }
    }
    static const std::vector<int> none;
    const auto contactsAt = [&](int node) -> const std::vector<int>& {
      return all_.outlines_[i].contacts.empty() ? none : all_.outlines_[i].contacts[node];
    };
    for (const int body : neighbours_[mesh.body]) {
      const auto found = bodies_.find(body);
      if (found == bodies_.end()) continue;
      const BodyOutline& other = found->second;
      const BoundingBox& box = boxes_[body];
      for (const int node : all_.outlines_[i].nodes) {
        const Point& x = places_[i][node];
        if (facetsAt_[i][node].empty() || box.distance(x) > 0.0) continue;
        judge(facets_[i], facetsAt_[i][node], contactsAt(node), x, other, body);
      }
      for (const auto& [edge, facets] : facetsOfEdge) {
        const Point &a = places_[i][edge.first], &b = places_[i][edge.second];
        BoundingBox own;
        own.include(a);
        own.include(b);
        if (!meet(own, box)) continue;
        std::vector<double> cuts = other.crossings(a, b);
        if (cuts.empty()) continue;
        cuts.insert(cuts.begin(), 0.0);
        cuts.push_back(1.0);
        for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
          judge(facets_[i], facets, united(contactsAt(edge.first), contactsAt(edge.second)),
                plus(a, scaled(0.5 * (cuts[k] + cuts[k + 1]), minus(b, a))), other, body);
      }
    }
  }

  /// \param at  facets of `own` that meet at this point
  void judge(const std::vector<Facet>& own, const std::vector<int>& at, const std::vector<int>& contacts, const Point& place,
             const BodyOutline& other, int body) {
    const BodyOutline::Depth depth = other.depthAt(place);
    const Facet& nearest = *depth.nearest;
    double bulge = 0.0, size = std::numeric_limits<double>::infinity();
    const Facet* facing = &own[at.front()];
    for (const int f : at) {
      bulge = std::max(bulge, own[f].bulge);
      size = std::min(size, own[f].size);
      if (dot(own[f].normal, nearest.normal) < dot(facing->normal, nearest.normal)) facing = &own[f];
    }
    if (!(depth.size > bulge + nearest.bulge + kInside * std::min(size, nearest.size))) return;
    const int contact = common(contacts, nearest.contacts);
    if (contact >= 0 && !(depth.size > kPassed * std::max(facing->size, nearest.size))) return;
    const auto name = [](const std::vector<std::string>& names, int group) { return group < 0 ? std::string() : names[group]; };
    keep({facing->body, body, name(all_.groups_, facing->group), name(names_, nearest.group), depth.size, place, contact, dimension_});
  }

  void keep(const Overlap& overlap) {
    const auto [low, high] = std::minmax(overlap.body, overlap.into);
    Overlap& kept = deepest_[{low, high, overlap.contact}];
    // Among equal ones a fixed choice, independent of the number of ranks.
    if (overlap.depth > (1.0 + kSameDepth) * kept.depth || (overlap.depth > (1.0 - kSameDepth) * kept.depth && overlap.place < kept.place))
      kept = overlap;
  }

  const Comm& comm_;
  const OverlapSearch& all_;
  int dimension_ = 2;
  std::vector<std::vector<Point>> places_;               // by mesh and node, of the outline
  std::vector<std::vector<Facet>> facets_;               // by mesh
  std::vector<std::vector<int>> sideOfFacet_;            // by mesh
  std::vector<std::vector<std::vector<int>>> facetsAt_;  // by mesh and node
  std::vector<BoundingBox> boxes_;                       // one per body
  std::vector<std::vector<int>> neighbours_;             // bodies whose boxes overlap, by body
  std::vector<Facet> everywhere_;                        // gathered facets
  std::vector<std::string> names_;                       // their groups
  std::map<int, BodyOutline> bodies_;
  std::map<std::array<int, 3>, Overlap> deepest_;  // by bodies and contact
};

std::vector<Overlap> OverlapSearch::find(const Comm& comm, const std::vector<Vector>& displacement) const {
  if (bodies_ < 2) return {};
  return Search(comm, *this, displacement).run();
}

std::string inWords(const Overlap& overlap, const std::vector<std::string>& bodies, const std::vector<std::string>& contacts, bool drawn,
                    const std::string& unit) {
  char depth[40];
  std::snprintf(depth, sizeof depth, "%.3g", overlap.depth);
  const auto side = [](const std::string& group) { return group.empty() ? std::string("a side without a group") : "'" + group + "'"; };
  std::string text = "warning: body '" + bodies[overlap.body] + "' " + (drawn ? "is drawn" : "is") + " inside body '" +
                     bodies[overlap.into] + "', " + depth + (unit.empty() ? "" : " " + unit) + " deep at " +
                     placeText(overlap.place, overlap.dimension) + ", with " + side(overlap.group) + " behind " + side(overlap.nearest);
  if (overlap.contact < 0) return text + ": no contact is declared there";
  return text + ": their contact '" + contacts[overlap.contact] + "' joins other parts of these sides";
}

}  // namespace suture
