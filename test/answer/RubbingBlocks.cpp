#include <answer/RubbingBlocks.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/Surface.hpp>
#include <suture/pairs/FrictionLaws.hpp>
#include <suture/pairs/PairFrame.hpp>

namespace suture::solids {

namespace {

std::shared_ptr<const ContactLaw> lawOf(const RubbingBlocks& blocks) {
  const Expression none("0"), shear(std::to_string(blocks.shear()));
  const double slope = blocks.shear() / blocks.pressure();
  switch (blocks.way) {
    case Rubs::Glued:
      return std::make_shared<Tied>();
    case Rubs::Guided:
      return std::make_shared<NoSeparation>();
    case Rubs::TrescaSlip:
      return std::make_shared<DryFriction>(shear, none);
    case Rubs::Slip:
      return std::make_shared<DryFriction>(none, Expression(std::to_string(slope)));
    default:
      return std::make_shared<DryFriction>(none, Expression(std::to_string(2 * slope)));
  }
}

}  // namespace

RubbingBlocks::RubbingBlocks(Rubs how, int space, bool obstacle, const Eigen::Matrix3d& turn)
    : way(how), onObstacle(obstacle), dimension(space), frame(turn), along(space == 2 ? Point{1, 0, 0} : Point{0.8, -0.6, 0}) {
  makeScene();
  meshes = distributed(scene);
  for (const SubdomainMesh& mesh : meshes) {
    Vector& u = displacement.emplace_back(mesh.nodes() * dimension);
    for (int node = 0; node < mesh.nodes(); ++node) {
      const Point value = frame * displacementAt(frame.transpose() * mesh.point(node), mesh.body == upper());
      std::copy_n(value.begin(), dimension, u.data() + Eigen::Index(node) * dimension);
    }
  }
  makePairs();
}

Point RubbingBlocks::displacementAt(const Point& place, bool isUpper) const {
  const int up = dimension - 1;
  const double height = place[up] + (onObstacle ? 0.0 : 1.0);
  Point u = scaled(2 * shear() / young * height + (isUpper && slides() ? slid : 0.0), along);
  u[up] = -pressure() / young * height;
  return u;
}

void RubbingBlocks::makeScene() {
  const int up = dimension - 1;
  std::vector<Box> boxes;
  for (const int k : {0, 1}) {
    if (onObstacle && k == 0) continue;
    Box box = dimension == 3 ? cube(Cell::Hexahedron8, 4, 2) : Box();
    if (dimension == 2) box.nx = box.ny = 4, box.blocksX = box.blocksY = 2;
    box.name = k == 0 ? "lower" : "upper";
    (dimension == 3 ? box.z0 : box.y0) = k - 1;
    (dimension == 3 ? box.z1 : box.y1) = k;
    boxes.push_back(box);
  }
  scene = scenes::fromBoxes(boxes, young, 0.0);
  scene.model.dimension = dimension;
  for (const Box& box : boxes) {
    Point force{0, 0, 0};
    force[up] = shear() * along[0];
    scene.traction(box.name + "_right", force);
    scene.traction(box.name + "_left", scaled(-1.0, force));
    if (dimension == 2) continue;
    force[up] = shear() * along[1];
    scene.traction(box.name + "_back", force);
    scene.traction(box.name + "_front", scaled(-1.0, force));
  }
  Point top{0, 0, 0};
  top[up] = 1.0;
  const Point over = displacementAt(top, true);
  for (int k = 0; k < dimension; ++k) {
    scene.hold("upper_top", k, over[k]);
    if (!onObstacle) scene.hold("lower_bottom", k, 0.0);
  }
  Point normal{0, 0, 0};
  normal[up] = onObstacle ? -1.0 : 1.0;
  const std::string sideA = onObstacle ? "upper_bottom" : "lower_top";
  const Surface side(scene.mesh, scene.mesh.sideGroups.at(sideA));
  ContactPiece piece{"joint", {}, {0, 1}, {}, 0.0, {}};
  if (onObstacle) piece.bodies = {0};
  for (const auto& [node, data] : side.nodes()) {
    ContactPair pair;
    pair.id = int(scene.constraints.pairs.size());
    pair.line = pair.piece = 0;
    pair.ends = {{node, 1.0}};
    if (!onObstacle)
      for (const int other : scene.nodesOf("upper_bottom"))
        if (norm(minus(scene.mesh.point(other), data.position)) < 1e-9) pair.ends = matchingEnds(node, other);
    pair.normal = normal;
    pair.length = data.tributary;
    pair.position = data.position;
    piece.pairs.push_back(pair.id);
    scene.constraints.pairs.push_back(pair);
  }
  scene.constraints.pieces = {piece};
  scene.constraints.laws = ContactLaws({lawOf(*this)});
  if (dimension == 3) scene = turned(scene, frame, {0, 0, 0});
}

void RubbingBlocks::makePairs() {
  std::vector<PairForce> forces;
  if (world()->getRank() == 0)
    for (const ContactPair& pair : scene.constraints.pairs) {
      PairForce force;
      force.id = pair.id;
      force.force = pressure() * pair.length;
      force.tangential = scaled(pair.length, tangential());
      force.state = slides() ? PairStatus::Slip : PairStatus::Stick;
      if (way == Rubs::Slip || way == Rubs::Stick) force.state.friction = (way == Rubs::Stick ? 2 : 1) * shear() / pressure();
      if (way == Rubs::TrescaSlip) force.state.bound = shear() * pair.length;
      if (way == Rubs::Slip || way == Rubs::TrescaSlip) {
        const std::vector<Point> axes = pairFrame(pair.normal, dimension);
        for (int k = 1; k < dimension; ++k) force.state.direction[k] = dot(axes[k], tangential()) / shear();
      }
      forces.push_back(force);
    }
  std::vector<const SubdomainMesh*> all;
  for (const SubdomainMesh& mesh : meshes) all.push_back(&mesh);
  pairs = pairResults(*world(), all, displacement, forces);
}

Verification RubbingBlocks::verdict() const {
  return verify(*world(), {meshes, scene.model, displacement, pairs, scene.constraints.pieces, tolerance});
}

void RubbingBlocks::moveUpper(const std::function<void(Point& u)>& change) {
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (int node = 0; meshes[i].body == upper() && node < meshes[i].nodes(); ++node) {
      double* values = &displacement[i][Eigen::Index(node) * dimension];
      Point u = frame.transpose() * pointOf(values, dimension);
      change(u);
      u = frame * u;
      std::copy_n(u.begin(), dimension, values);
    }
}

void RubbingBlocks::lift() {
  const Point motion = frame * scaled(slid, along);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    SubdomainMesh& mesh = meshes[i];
    const Point own = mesh.body == upper() ? motion : Point{0, 0, 0};
    mesh.lift.motion = Vector::Zero(displacement[i].size());
    for (Eigen::Index k = 0; k < mesh.lift.motion.size(); ++k) mesh.lift.motion[k] = own[std::size_t(k % dimension)];
    displacement[i] -= mesh.lift.motion;
    for (NodeRule& rule : mesh.rules) {
      mesh.lift.values.push_back(rule.value);
      for (int k = 0; k < dimension; ++k) rule.value[k] -= dot(rule.axes[k], own);
    }
    for (const ContactRow& row : mesh.contactRows) mesh.lift.gaps[row.pair.id] = row.pair.gap;
  }
  makePairs();
}

}  // namespace suture::solids
