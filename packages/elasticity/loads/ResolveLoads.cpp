#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/RigidFrame.hpp>
#include <suture/base/RigidValues.hpp>
#include <suture/elasticity/SideMap.hpp>
#include <suture/elasticity/loads/ResolveLoads.hpp>
#include <suture/mesh/NodeAtPoint.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>

namespace suture {

namespace {

constexpr double kCarried = 1e-8;  // relative part of a resultant that nodes on a line cannot carry, above round-off

/// The meshes of a scene, on any number of ranks.
struct Pieces {
  struct Piece {
    const CellBlock* block;
    const SideGroups* groups;
    std::function<GlobalId(int node)> numberOf;
    std::function<int(int node)> bodyOf;
  };
  std::vector<Piece> pieces;
  std::function<void(double*values, int count)> sum, most;                       ///< over all ranks, in place
  std::function<std::vector<NearNode>(const std::vector<NearNode>& mine)> join;  ///< nodes of all ranks
};

/// Calls take(position, measure) at the quadrature points of all sides of a load.
template <typename Take>
void forEachPoint(const Pieces& pieces, const Load& load, Rule rule, const Take& take) {
  for (const Pieces::Piece& piece : pieces.pieces)
    for (const Side& side : sidesOf(*piece.groups, load.groups)) {
      std::vector<Point> points;
      for (const int node : piece.block->nodesOf(side)) points.push_back(piece.block->point(node));
      SideMap map(points, piece.block->dimension, rule, piece.block->axisymmetric);
      for (int q = 0; q < map.reference().points; ++q) {
        map.at(q);
        take(map.place(), map.measure());
      }
    }
}

void makeTraction(const Pieces& pieces, Load& load) {
  double area = 0.0;
  forEachPoint(pieces, load, Rule::Load, [&](const Point&, double measure) { area += measure; });
  pieces.sum(&area, 1);
  load.kind = Load::Kind::Traction;
  load.value = scaled(1.0 / area, load.value);
  load.axis = scaled(1.0 / area, load.axis);
}

void makeLinearTraction(const Pieces& pieces, Load& load) {
  double first[4] = {0, 0, 0, 0};  // area, and its moments
  forEachPoint(pieces, load, Rule::Data, [&](const Point& place, double measure) {
    first[0] += measure;
    for (int k = 0; k < 3; ++k) first[1 + k] += measure * place[k];
  });
  pieces.sum(first, 4);
  load.place = {first[1] / first[0], first[2] / first[0], first[3] / first[0]};
  Matrix inertia = Matrix::Zero(3, 3);
  forEachPoint(pieces, load, Rule::Data, [&](const Point& place, double measure) {
    const Point arm = minus(place, load.place);
    const Eigen::Map<const Eigen::Vector3d> r(arm.data());
    inertia += measure * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  });
  pieces.sum(inertia.data(), 9);
  const Vector spin = leastSquares(inertia, Eigen::Map<const Vector>(load.value.data(), 3));
  load.kind = Load::Kind::Traction;
  load.value = {0, 0, 0};
  std::copy(spin.begin(), spin.end(), load.spin.begin());
}

/// Nodes of a load's groups, each once, by number.
std::map<GlobalId, Point> nodesOfGroups(const Pieces& pieces, const Load& load) {
  std::vector<NearNode> mine;
  for (const Pieces::Piece& piece : pieces.pieces)
    for (const Side& side : sidesOf(*piece.groups, load.groups))
      for (const int node : piece.block->nodesOf(side))
        mine.push_back({0.0, piece.numberOf(node), piece.bodyOf(node), piece.block->point(node)});
  std::map<GlobalId, Point> all;
  for (const NearNode& one : pieces.join(mine)) all.emplace(one.node, one.place);
  return all;
}

void makeNodalForces(const Pieces& pieces, const ElasticModel& model, Load& load, Problems& problems) {
  const std::map<GlobalId, Point> nodes = nodesOfGroups(pieces, load);
  std::vector<Point> places;
  for (const auto& entry : nodes) places.push_back(entry.second);
  const RigidFrame frame = RigidFrame::around(places);
  const int motions = rigidMotions(model.dimension);
  const auto motionsAt = [&](const Point& place) {  // dimension x motions
    Matrix all = frame.at(place, model.dimension);
    if (model.axisymmetric) all.col(0).setZero(), all.col(2).setZero();
    return all;
  };
  Matrix sums = Matrix::Zero(motions, motions);
  for (const auto& entry : nodes) {
    const Matrix own = motionsAt(entry.second);
    sums += own.transpose() * own;
  }
  const Point moment = plus(load.torque, cross(minus(load.place, frame.centre), load.value));
  Vector work = Vector::Zero(motions);  // in the motions
  for (int k = 0; k < model.dimension; ++k) work[k] = load.value[std::size_t(k)];
  for (int k = model.dimension; k < motions; ++k) work[k] = moment[std::size_t(model.dimension == 2 ? 2 : k - 3)] / frame.radius;
  if (model.axisymmetric) work[0] = work[2] = 0.0;
  const Vector spread = leastSquares(sums, work);
  if ((sums * spread - work).norm() > kCarried * work.norm())
    problems.add(load.path + "/Moment", "acts about the line on which all nodes of the group lie; choose a group that resists it");
  load.kind = Load::Kind::NodalForces;
  load.atReference = true;
  for (const auto& [node, place] : nodes) {
    const Vector force = motionsAt(place) * spread;
    Point& given = load.forces[node];
    for (int k = 0; k < model.dimension; ++k) given[std::size_t(k)] = force[k];
  }
}

double extentOf(const Pieces& pieces) {
  const double none = -std::numeric_limits<double>::infinity();
  double box[6] = {none, none, none, none, none, none};  // largest coordinates, and negated smallest ones
  for (const Pieces::Piece& piece : pieces.pieces)
    for (int node = 0; node < piece.block->nodes(); ++node) {
      const Point place = piece.block->point(node);
      for (int k = 0; k < 3; ++k) {
        box[k] = std::max(box[k], place[k]);
        box[3 + k] = std::max(box[3 + k], -place[k]);
      }
    }
  pieces.most(box, 6);
  return norm({box[0] + box[3], box[1] + box[4], box[2] + box[5]});
}

void findNode(const Pieces& pieces, const ElasticModel& model, Load& load, Problems& problems) {
  const double extent = extentOf(pieces);
  NodeAtPoint mine(load.place, extent), all = mine;
  for (const Pieces::Piece& piece : pieces.pieces)
    for (int node = 0; node < piece.block->nodes(); ++node) {
      const Point place = piece.block->point(node);
      if (load.actsOn(model.bodies[piece.bodyOf(node)]))
        mine.offer({norm(minus(place, load.place)), piece.numberOf(node), piece.bodyOf(node), place});
    }
  for (const NearNode& one : pieces.join(mine.candidates())) all.offer(one);
  const auto found = all.choose(load.tolerance, model.bodies, model.dimension, load.path, problems);
  if (!found) return;
  load.node = found->node;
  load.body = model.bodies[found->body];
}

void resolve(const Pieces& pieces, ElasticModel& model) {
  Problems problems;
  for (Load& load : model.loads) {
    if (load.kind == Load::Kind::Force) makeTraction(pieces, load);
    if (load.kind == Load::Kind::Moment) makeLinearTraction(pieces, load);
    if (load.kind == Load::Kind::ReferenceForce) makeNodalForces(pieces, model, load, problems);
    if (load.kind == Load::Kind::PointForce) findNode(pieces, model, load, problems);
  }
  problems.throwIfAny();
}

}  // namespace

void resolveLoads(const Comm& comm, const std::vector<SubdomainMesh>& meshes, ElasticModel& model) {
  Pieces pieces;
  for (const SubdomainMesh& mesh : meshes)
    pieces.pieces.push_back(
        {&mesh, &mesh.sideGroups, [&mesh](int node) { return mesh.globalNodes[node]; }, [&mesh](int) { return mesh.body; }});
  const auto reduce = [&comm](Teuchos::EReductionType how) {
    return [&comm, how](double* values, int count) {
      const std::vector<double> mine(values, values + count);
      Teuchos::reduceAll(comm, how, count, mine.data(), values);
    };
  };
  pieces.sum = reduce(Teuchos::REDUCE_SUM);
  pieces.most = reduce(Teuchos::REDUCE_MAX);
  pieces.join = [&comm](const std::vector<NearNode>& mine) { return joinEverywhere(comm, mine); };
  resolve(pieces, model);
}

void resolveLoads(const Mesh& mesh, ElasticModel& model) {
  const auto alone = [](double*, int) {};
  resolve({{{&mesh, &mesh.sideGroups, [](int node) { return GlobalId(node); }, [&mesh](int node) { return mesh.bodyOfNode[node]; }}},
           alone,
           alone,
           [](const std::vector<NearNode>& mine) { return mine; }},
          model);
}

}  // namespace suture
