#include <Eigen/Geometry>
#include <pairs/SpaceScenes.hpp>

namespace pairstesting {

Mesh facing(Cell lower, int nx, int ny, Cell upper, int mx, int my, double gap) {
  Box a, b;
  a.name = "lower", b.name = "upper";
  a.x1 = b.x1 = 2, a.y1 = b.y1 = 1.5;
  a.z0 = -1, a.z1 = 0, b.z0 = gap, b.z1 = 1;
  a.nx = nx, a.ny = ny, b.nx = mx, b.ny = my, a.nz = b.nz = 2;
  a.cell = lower, b.cell = upper;
  Mesh mesh = boxes({a, b});
  assignBodies(mesh, {"lower", "upper"});
  return mesh;
}

Turned::Turned(const Point& axis, double angle)
    : by_(Eigen::AngleAxisd(angle, Eigen::Map<const Eigen::Vector3d>(axis.data()).normalized()).toRotationMatrix()) {}

Point Turned::operator()(const Point& p) const {
  const Vector image = by_ * Eigen::Map<const Vector>(p.data(), 3);
  return {image[0], image[1], image[2]};
}

PairedSurface pairsOf(const Mesh& mesh, const Contact& contact, std::vector<std::string>* notes) {
  Problems problems;
  std::vector<std::string> own;
  const std::vector<ContactSurface> surfaces = contactsOn(mesh, {contact}, problems);
  problems.throwIfAny();
  PairedSurface paired = pairSurface(mesh, surfaces.at(0), problems, notes ? *notes : own);
  problems.throwIfAny();
  return paired;
}

}  // namespace pairstesting
