#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/answer/verdict/VerifyPlaces.hpp>
#include <suture/base/Point.hpp>
#include <suture/motion/RigidMotionLifting.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace suture {

namespace {

constexpr double kStraight = 1e-6;      // angle between neighbours' normals up to which the sides count as flat there [rad]
constexpr double kTurned = 0.05;        // largest turn of the normals along a slide that only shifts positions [rad]
constexpr double kExplainedTurn = 2.0;  // multiple of the deformations that explains the rotation of a body
constexpr double kInPlane = 1e-9;       // distance of an obstacle's feet from one plane up to which it is plane, relative to its extent

Point without(const Point& direction, const Point& vector) { return minus(vector, scaled(dot(vector, direction), direction)); }

/// A pair, assembled from its ends.
struct PlacedPair {
  const PairResult* said = nullptr;
  Finding where;
  Point normal{0, 0, 0}, jump{0, 0, 0}, arm{0, 0, 0};
  double gap = 0.0;                       // current gap [length]
  double cell = 0.0;                      // cell size of the finer side [length]
  double weights = 0.0, magnitude = 0.0;  // sums over the ends
  double curvature = 0.0;                 // [1 / length]
  bool restricted = false;

  bool meetsObstacle() const { return std::abs(weights) > 1e-9 * magnitude; }
};

/// Directions along which an obstacle is uniform: tangential to it at each of its pairs.
class EndlessDirections {
 public:
  void add(const PlacedPair& pair) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) normals_(i, j) += pair.normal[i] * pair.normal[j];
    const Point foot = plus(scaled(1.0 / pair.weights, pair.arm), scaled(pair.said->initialGap, pair.normal));
    if (count_++ == 0) first_ = foot, normal_ = pair.normal;
    const double beside = std::abs(dot(minus(foot, first_), normal_));
    beside_ = std::max(beside_, beside);
    extent_ = std::max(extent_, length(minus(foot, first_)) + std::abs(pair.said->initialGap));
  }
  /// The part of a slide along which the obstacle changes.
  Point rest(const Point& slide) const {
    const Eigenpairs axes = symmetricEigenpairs(normals_);
    std::vector<Point> endless;
    for (int k = 0; k < 3; ++k)
      if (axes.values[k] < count_ * kStraight * kStraight) endless.push_back({axes.vectors(0, k), axes.vectors(1, k), axes.vectors(2, k)});
    const bool isPlane = endless.size() == 2;
    if (isPlane && beside_ > kInPlane * extent_) return slide;  // a gap given by the scene, or along the sides' normals
    Point left = slide;
    for (const Point& direction : endless) left = without(direction, left);
    return left;
  }

 private:
  Matrix normals_ = Matrix::Zero(3, 3);
  Point first_{0, 0, 0}, normal_{0, 0, 0};
  double beside_ = 0.0, extent_ = 0.0;
  int count_ = 0;
};

class PlaceJudge {
 public:
  explicit PlaceJudge(ContactPlaces places) : places_(std::move(places)) {
    putTogether();
    findCurvatures();
    findRims();
    for (const auto& [id, pair] : pairs_)
      if (pair.meetsObstacle()) endless_[pair.said->line].add(pair);
  }

  void judgeSlides(Findings& findings) const {
    for (const auto& [id, pair] : pairs_) {
      Point slip = without(pair.normal, pair.jump);
      if (pair.meetsObstacle()) slip = endless_.at(pair.said->line).rest(slip);
      const double slid = length(slip);
      if (carries(pair))
        take(pair, std::max(slid, rolled(pair)), findings);
      else if (0.5 * pair.curvature * slid * slid > pair.gap && pair.said->kind.separates)
        take(pair, slid, findings);
    }
  }

  void judgeOffsets(Findings& findings) const {
    struct Couple {
      Point moment{0, 0, 0};
      double largest = 0.0;
      Finding where;
    };
    std::map<std::array<int, 3>, Couple> couples;  // by line and bodies
    for (const auto& [id, pair] : pairs_) {
      if (pair.meetsObstacle() || !pair.restricted || !carries(pair)) continue;
      const double apart = -dot(plus(pair.arm, pair.jump), pair.normal);
      const Point moment = scaled(apart, cross(pair.normal, pair.said->tangential));
      Couple& couple = couples[{pair.said->line, pair.where.body, pair.where.other}];
      couple.moment = plus(couple.moment, moment);
      if (length(moment) < couple.largest) continue;
      couple.largest = length(moment);
      couple.where = pair.where;
    }
    for (const auto& [key, couple] : couples) {
      const double scale = std::min(momentOf(key[1]), momentOf(key[2]));
      findings.take(Quantity::Offset, length(couple.moment), Bounds::offset * scale, scale, couple.where);
    }
  }

 private:
  void take(const PlacedPair& pair, double slid, Findings& findings) const {
    double cell = pair.cell;
    // Away from ends and bends a slide only shifts the points where forces act: it is measured relative to the body.
    if (slid > 0.5 * Bounds::slide * cell && pair.curvature * slid < kTurned && !isNearEnd(pair, slid))
      cell = std::max(cell, Bounds::offset * std::min(places_.motions[pair.where.body].extent, places_.motions[pair.where.other].extent));
    findings.take(Quantity::Slide, slid, Bounds::slide * cell, cell, pair.where);
  }

  /// True if the side may end within a distance.
  bool isNearEnd(const PlacedPair& pair, double reach) const {
    const auto rim = rims_.find(pair.said->piece);
    if (rim == rims_.end()) return true;
    return std::any_of(rim->second.begin(), rim->second.end(),
                       [&](const Point& end) { return length(minus(end, pair.where.place)) <= reach + pair.cell; });
  }

  /// Positions of the pairs on the rim of each piece: on facets that belong to a single cell. A closed line or surface has none.
  void findRims() {
    for (std::size_t p = 0; p < places_.pieces.size(); ++p) {
      std::map<std::array<int, 2>, int> uses;
      for (const std::vector<int>& cell : places_.pieces[p].cells)
        for (std::size_t i = 0; i < cell.size(); ++i) {
          const int a = cell[i], b = cell.size() == 2 ? a : cell[(i + 1) % cell.size()];
          ++uses[{std::min(a, b), std::max(a, b)}];
        }
      if (uses.empty()) continue;
      std::vector<Point>& rim = rims_[static_cast<int>(p)];
      for (const auto& [facet, count] : uses)
        for (const int id : facet)
          if (const auto at = pairs_.find(id); count == 1 && at != pairs_.end()) rim.push_back(at->second.where.place);
    }
  }

  void putTogether() {
    std::map<int, const PairResult*> said;
    for (const PairResult& pair : places_.pairs) said[pair.id] = &pair;
    const auto before = [](const PairEndShare& a, const PairEndShare& b) { return a.pair != b.pair ? a.pair < b.pair : a.end < b.end; };
    std::sort(places_.ends.begin(), places_.ends.end(), before);
    std::map<int, std::map<int, double>> cells;  // per pair and body
    for (const PairEndShare& end : places_.ends) {
      const auto found = said.find(end.pair);
      if (found == said.end()) continue;  // reported by verifyPairs()
      const auto [at, isNew] = pairs_.try_emplace(end.pair);
      PlacedPair& pair = at->second;
      if (isNew) {
        pair.said = found->second;
        pair.where.pair = end.pair;
        pair.where.place = end.place;
        pair.where.body = pair.where.other = end.body;
        pair.normal = end.normal;
        pair.gap = end.gap;
        pair.restricted = end.kind.restrictsSliding;
      }
      if (end.body != pair.where.body) pair.where.other = end.body;
      pair.gap -= end.closing;
      pair.jump = plus(pair.jump, end.jump);
      pair.arm = plus(pair.arm, end.arm);
      pair.weights += end.weight;
      pair.magnitude += std::abs(end.weight);
      double& cell = cells[end.pair][end.body];
      cell = std::max(cell, end.cell);
    }
    for (auto& [id, pair] : pairs_) {
      pair.cell = std::numeric_limits<double>::infinity();
      for (const auto& [body, cell] : cells.at(id)) pair.cell = std::min(pair.cell, cell);
    }
  }

  /// Largest change of the normal towards a neighbour.
  void findCurvatures() {
    for (const ContactPiece& piece : places_.pieces)
      for (const std::vector<int>& cell : piece.cells)
        for (std::size_t i = 0; i < cell.size(); ++i) {
          const auto a = pairs_.find(cell[i]), b = pairs_.find(cell[(i + 1) % cell.size()]);
          if (a == pairs_.end() || b == pairs_.end() || a == b) continue;
          const double turn = length(minus(a->second.normal, b->second.normal));
          if (turn < kStraight) continue;
          const double curvature = turn / length(minus(a->second.where.place, b->second.where.place));
          for (PlacedPair* pair : {&a->second, &b->second}) pair->curvature = std::max(pair->curvature, curvature);
        }
  }

  bool carries(const PlacedPair& pair) const {
    const double force = std::min(places_.bodies[pair.where.body].force, places_.bodies[pair.where.other].force);
    return pair.said->state.closed() && !(length(pair.said->onB()) <= places_.bound * force);
  }

  double rolled(const PlacedPair& pair) const {
    if (pair.curvature == 0.0) return 0.0;
    const Deformation &own = places_.motions[pair.where.body], &other = places_.motions[pair.where.other];
    const bool areTwo = pair.where.other != pair.where.body;
    double radius = std::min(1.0 / pair.curvature, length(minus(pair.where.place, own.centre)));
    if (areTwo) radius = std::min(radius, length(minus(pair.where.place, other.centre)));
    const double turn = length(without(pair.normal, areTwo ? minus(own.rotation, other.rotation) : own.rotation));
    return radius * std::max(0.0, turn - kExplainedTurn * (strainOf(own) + (areTwo ? strainOf(other) : 0.0)));
  }

  /// Deformation of a body as an angle: its best-fit rigid rotation may have this size without a rotation of the body.
  static double strainOf(const Deformation& body) { return body.extent > 0.0 ? body.largest / body.extent : 0.0; }

  double momentOf(int body) const { return places_.bodies[body].force * places_.motions[body].extent; }

  ContactPlaces places_;
  std::map<int, PlacedPair> pairs_;
  std::map<int, EndlessDirections> endless_;  // by line
  std::map<int, std::vector<Point>> rims_;    // by piece
};

}  // namespace

std::vector<double> edgesAlongContact(const SubdomainMesh& mesh) {
  std::vector<double> longest;
  if (mesh.contactEnds.empty()) return longest;
  std::map<int, const ContactRow*> rows;
  for (const ContactRow& row : mesh.contactRows) rows[row.pair.id] = &row;
  std::vector<Point> normals(mesh.nodes(), Point{0, 0, 0});
  std::vector<char> isAtEnd(mesh.nodes(), 0);
  for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) {
    normals[end.node] = rows.at(end.pair)->pair.normal;
    isAtEnd[end.node] = 1;
  }
  const std::map<int, int> under = nodesUnderCoatings(mesh);
  for (const auto& [outer, inner] : under)
    if (isAtEnd[outer]) normals[inner] = normals[outer], isAtEnd[inner] = 1;
  const auto isEnd = [&](int node) { return isAtEnd[node] != 0; };
  longest.resize(mesh.nodes(), 0.0);
  for (int element = 0; element < mesh.elements(); ++element) {
    const Span<const int> nodes = mesh.nodesOf(element);
    if (std::none_of(nodes.begin(), nodes.end(), isEnd)) continue;
    for (const std::array<int, 2>& edge : cellInfo(mesh.cells[element]).edges) {
      const Point along = minus(mesh.point(nodes[edge[1]]), mesh.point(nodes[edge[0]]));
      for (const int node : nodes)
        if (isEnd(node)) longest[node] = std::max(longest[node], length(without(normals[node], along)));
    }
  }
  for (const auto& [outer, inner] : under) longest[outer] = longest[inner];
  return longest;
}

std::vector<Deformation> wholeMotions(const Comm& comm, const Answer& answer, const std::vector<Deformation>& beside) {
  int mine = 0, all = 0;
  for (const SubdomainMesh& mesh : answer.meshes) mine = mine || (mesh.lift.motion.size() > 0 && !mesh.contactEnds.empty());
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  if (!all) return beside;
  std::vector<Vector> whole;
  for (std::size_t i = 0; i < answer.meshes.size(); ++i) whole.push_back(withLift(answer.meshes[i], answer.displacement[i]));
  return deformations(comm, answer.meshes, whole, static_cast<int>(beside.size()));
}

void verifyPlaces(ContactPlaces places, Findings& findings) {
  const PlaceJudge judge(std::move(places));
  judge.judgeSlides(findings);
  judge.judgeOffsets(findings);
}

}  // namespace suture
