#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/base/RigidFrame.hpp>
#include <suture/base/RigidValues.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/motion/MovingBodies.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kSpread = 1e-6;  // least extent of gauge nodes across their longest extent, relative, that determines a rotation

/// True if the motions of nodes determine the rigid motion of their body.
bool determine(const Mesh& mesh, const std::vector<int>& nodes) {
  std::vector<Point> points;
  for (const int node : nodes) points.push_back(mesh.point(node));
  const RigidFrame frame = RigidFrame::around(points);
  Matrix sums = Matrix::Zero(rigidMotions(mesh.dimension), rigidMotions(mesh.dimension));
  for (const Point& point : points) {
    const Matrix own = frame.at(point, mesh.dimension);
    sums += own.transpose() * own;
  }
  const Vector values = singularValues(sums).values;
  return values.size() > 0 && values[values.size() - 1] > kSpread * kSpread * values[0];
}

}  // namespace

MovingBodies::MovingBodies(const Mesh& drawn, const Constraints& constraints, std::vector<bool> rests) : drawn_(&drawn) {
  const RigidParts rigid = freeRigidMotions(drawn, constraints);
  partOf_ = rigid.partOfNode;
  const std::size_t parts = rigid.parts.size();
  rests.resize(drawn.bodies.size(), false);
  for (const auto& part : rigid.parts) rests_.push_back(rests[static_cast<std::size_t>(part.body)]);
  std::vector<double> weight(static_cast<std::size_t>(drawn.nodes()), 0.0);
  for (int e = 0; e < drawn.elements(); ++e)
    for (const int node : drawn.nodesOf(e))
      weight[static_cast<std::size_t>(node)] += std::abs(signedSize(drawn, e)) / drawn.nodesOf(e).size();
  std::vector<Gauge> all(parts), held(parts), grouped(parts);
  for (int node = 0; node < drawn.nodes(); ++node) {
    if (partOf_[static_cast<std::size_t>(node)] < 0) continue;
    Gauge& gauge = all[static_cast<std::size_t>(partOf(node))];
    gauge.nodes.push_back(node), gauge.weights.push_back(weight[static_cast<std::size_t>(node)]);
  }
  const RigidGroupNodes inGroups(constraints.rigidGroups, drawn.dimension);
  for (const NodeRule& rule : constraints.rules) {
    const auto last = rule.fixed.begin() + drawn.dimension;
    if (inGroups.contains(rule.node) || std::find(rule.fixed.begin(), last, false) != last) continue;
    Gauge& gauge = held[static_cast<std::size_t>(partOf(rule.node))];
    gauge.nodes.push_back(rule.node), gauge.weights.push_back(1.0);
    gauge.isHeld = true;
  }
  for (const RigidGroup& group : constraints.rigidGroups) {
    const int part = partOf(group.nodes.front());
    Gauge& gauge = grouped[static_cast<std::size_t>(part)];
    if (!gauge.nodes.empty() && !this->rests(part))
      throw InputError(
          "Boundary Conditions/" + constraints.conditions[static_cast<std::size_t>(group.condition)],
          "is a second Rigid Group of body '" +
              drawn.bodies[static_cast<std::size_t>(drawn.bodyOfNode[static_cast<std::size_t>(group.nodes.front())])] +
              "'; with Motion = Moving the group determines the motion of its body: use one, and a Displacement for other sides");
    gauge.nodes = group.nodes;
    gauge.weights.assign(group.nodes.size(), 1.0);
  }
  for (std::size_t p = 0; p < parts; ++p) {
    for (const Gauge* one : {&grouped[p], &held[p], &all[p]})
      if (!one->nodes.empty() && (one == &all[p] || determine(drawn, one->nodes))) {
        gauges_.push_back(*one);
        break;
      }
    frames_.emplace_back(rigid.parts[p].centre);
    bodies_.push_back(rigid.parts[p].body);
  }
  beside_ = Vector::Zero(Eigen::Index(drawn.coordinates.size()));
}

Vector MovingBodies::placement() const {
  const int d = drawn_->dimension;
  Vector all = Vector::Zero(beside_.size());
  for (int node = 0; node < drawn_->nodes(); ++node) {
    if (partOf(node) < 0) continue;
    const Point x = drawn_->point(node), moved = minus(frameOf(node).at(x), x);
    for (int k = 0; k < d; ++k) all[Eigen::Index(node) * d + k] = moved[static_cast<std::size_t>(k)];
  }
  return all;
}

Mesh MovingBodies::meshAt(const Vector& displacement) const {
  Mesh mesh = *drawn_;
  mesh.drawn = drawn_->coordinates;
  for (std::size_t i = 0; i < mesh.coordinates.size(); ++i) mesh.coordinates[i] += displacement[Eigen::Index(i)];
  return mesh;
}

Mesh MovingBodies::placed() const { return meshAt(placement()); }
Mesh MovingBodies::present() const { return meshAt(placement() + beside_); }

void MovingBodies::move(int part, const Motion& motion) {
  if (rests(part)) return;
  frames_[static_cast<std::size_t>(part)].move(motion.shift, motion.rotation, motion.about);
  const Eigen::Matrix3d by = rotationBy(motion.rotation).toRotationMatrix();
  const int d = drawn_->dimension;
  for (int node = 0; node < drawn_->nodes(); ++node) {
    if (partOf(node) != part) continue;
    const Point own = pointOf(beside_.data() + Eigen::Index(node) * d, d);
    const Eigen::Vector3d turned = by * Eigen::Map<const Eigen::Vector3d>(own.data());
    for (int k = 0; k < d; ++k) beside_[Eigen::Index(node) * d + k] = turned[k];
  }
}

/// Mean place of the nodes that determine the frame of a part, on the placed body.
Point MovingBodies::centreOf(std::size_t part) const {
  const Gauge& gauge = gauges_[part];
  Point centre{0, 0, 0};
  double sum = 0.0;
  for (std::size_t i = 0; i < gauge.nodes.size(); ++i) {
    sum += gauge.weights[i];
    centre = plus(centre, scaled(gauge.weights[i], frames_[part].at(drawn_->point(gauge.nodes[i]))));
  }
  return scaled(1.0 / sum, centre);
}

/// Tensor of inertia of these nodes about their centre.
Matrix MovingBodies::inertiaOf(std::size_t part, const Point& centre) const {
  const Gauge& gauge = gauges_[part];
  Matrix inertia = Matrix::Zero(3, 3);
  for (std::size_t i = 0; i < gauge.nodes.size(); ++i) {
    const Point arm = minus(frames_[part].at(drawn_->point(gauge.nodes[i])), centre);
    const Eigen::Map<const Eigen::Vector3d> r(arm.data());
    inertia += gauge.weights[i] * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  return inertia;
}

namespace {

/// Rotation of nodes with a moment of momentum. \param inertia  of them
Point turnOf(const Matrix& inertia, const Point& momentum, int dimension) {
  if (dimension == 2) return {0, 0, momentum[2] / inertia(2, 2)};
  const Vector solved = leastSquares(inertia, Eigen::Map<const Vector>(momentum.data(), 3));
  return {solved[0], solved[1], solved[2]};
}

}  // namespace

std::map<int, Point> MovingBodies::couple(int part, const Point& moment) const {
  const auto p = static_cast<std::size_t>(part);
  const Gauge& gauge = gauges_[p];
  const Point centre = centreOf(p), turn = turnOf(inertiaOf(p, centre), moment, drawn_->dimension);
  std::map<int, Point> forces;
  for (std::size_t i = 0; i < gauge.nodes.size(); ++i)
    forces[gauge.nodes[i]] = scaled(gauge.weights[i], cross(turn, minus(frames_[p].at(drawn_->point(gauge.nodes[i])), centre)));
  return forces;
}

MovingBodies::Motion MovingBodies::motionOf(int part, const Vector& displacement) const {
  if (rests(part)) return {};
  const auto p = static_cast<std::size_t>(part);
  const int d = drawn_->dimension;
  const Gauge& gauge = gauges_[p];
  const auto at = [&](int node) { return pointOf(displacement.data() + Eigen::Index(node) * d, d); };
  Motion motion;
  double sum = 0.0;
  for (std::size_t i = 0; i < gauge.nodes.size(); ++i) {
    sum += gauge.weights[i];
    motion.shift = plus(motion.shift, scaled(gauge.weights[i], at(gauge.nodes[i])));
  }
  motion.about = centreOf(p);
  motion.shift = scaled(1.0 / sum, motion.shift);
  Point spin{0, 0, 0};
  for (std::size_t i = 0; i < gauge.nodes.size(); ++i)
    spin = plus(spin, scaled(gauge.weights[i], cross(minus(frames_[p].at(drawn_->point(gauge.nodes[i])), motion.about),
                                                     minus(at(gauge.nodes[i]), motion.shift))));
  motion.rotation = turnOf(inertiaOf(p, motion.about), spin, d);
  return motion;
}

bool MovingBodies::goOnFrom(const std::vector<BodyFrame>& frames, const std::vector<double>& beside) {
  if (frames.size() != frames_.size() || Eigen::Index(beside.size()) != beside_.size()) return false;
  frames_ = frames;
  beside_ = Eigen::Map<const Vector>(beside.data(), Eigen::Index(beside.size()));
  return true;
}

void MovingBodies::absorb(const Vector& displacement) {
  const int d = drawn_->dimension;
  const std::vector<BodyFrame> before = frames_;
  std::vector<Motion> motions;
  std::vector<Eigen::Matrix3d> turns;
  for (std::size_t p = 0; p < frames_.size(); ++p) {
    motions.push_back(motionOf(static_cast<int>(p), displacement));
    turns.push_back(rotationBy(motions.back().rotation).toRotationMatrix());
  }
  for (std::size_t p = 0; p < frames_.size(); ++p) frames_[p].move(motions[p].shift, motions[p].rotation, motions[p].about);
  for (int node = 0; node < drawn_->nodes(); ++node) {
    const int part = partOf(node);
    if (part < 0) continue;
    const auto p = static_cast<std::size_t>(part);
    const Point arm = minus(before[p].at(drawn_->point(node)), motions[p].about);
    const Point own = pointOf(displacement.data() + Eigen::Index(node) * d, d);
    const Point rest = minus(minus(own, motions[p].shift), cross(motions[p].rotation, arm));
    const Eigen::Vector3d turned = turns[p] * Eigen::Map<const Eigen::Vector3d>(rest.data());
    for (int k = 0; k < d; ++k) beside_[Eigen::Index(node) * d + k] = turned[k];
  }
}

std::vector<MovingBodies::Motion> MovingBodies::motionsFrom(const MovingBodies& before) const {
  std::vector<Motion> all;
  for (std::size_t p = 0; p < frames_.size(); ++p) {
    const BodyFrame &from = before.frames_[p], &to = frames_[p];
    all.push_back({minus(to.place(), from.place()), turnBetween(from, to), from.place()});
  }
  return all;
}

void MovingBodies::goPartOfTheWay(const MovingBodies& from, double part) {
  const int d = drawn_->dimension;
  const std::vector<BodyFrame> to = frames_;
  const std::vector<Motion> motions = motionsFrom(from);
  frames_ = from.frames_;
  for (std::size_t p = 0; p < frames_.size(); ++p)
    frames_[p].move(scaled(part, motions[p].shift), scaled(part, motions[p].rotation), motions[p].about);
  for (int node = 0; node < drawn_->nodes(); ++node) {
    if (partOf(node) < 0) continue;
    const auto p = static_cast<std::size_t>(partOf(node));
    const Eigen::Index at = Eigen::Index(node) * d;
    const Point before = from.frames_[p].turnBack(pointOf(from.beside_.data() + at, d)),
                now = to[p].turnBack(pointOf(beside_.data() + at, d));
    const Point between = frames_[p].turn(plus(scaled(1.0 - part, before), scaled(part, now)));
    for (int k = 0; k < d; ++k) beside_[at + k] = between[static_cast<std::size_t>(k)];
  }
}

}  // namespace suture
