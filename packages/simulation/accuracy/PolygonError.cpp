#include <suture/base/Collective.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/HookesLaw.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/simulation/accuracy/LevelError.hpp>
#include <suture/simulation/accuracy/PolygonError.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <numeric>

namespace suture {

namespace {

constexpr double kPressureStep = 1e-4;  // step of the derivative of a pressure over the diameter of its element

/// Changes of the potential energy where the boundary at an element moves.
struct EnergyRates {
  Vector perVolume;  ///< for each volume between a straight side and its curve [stress]
  Vector perExcess;  ///< for each added length of the side, in 3D area [force / length]
};

/// Displacement and its gradient at the centre of a simplex, from its vertices.
struct LinearField {
  Point centre{0, 0, 0};
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();  ///< component x direction

  LinearField(const SubdomainMesh& mesh, int element, const Vector& displacement) : centre(centreOf(mesh, element)) {
    const int d = mesh.dimension;
    const Span<const int> nodes = mesh.nodesOf(element);
    Matrix places(d, d), moves(d, d);
    for (int i = 0; i <= d; ++i)
      for (int k = 0; k < d; ++k) {
        const double u = displacement[Eigen::Index(nodes[i]) * d + k], u0 = displacement[Eigen::Index(nodes[0]) * d + k];
        value[k] += u / (d + 1);
        if (i == 0) continue;
        places(k, i - 1) = mesh.point(nodes[i])[static_cast<std::size_t>(k)] - mesh.point(nodes[0])[static_cast<std::size_t>(k)];
        moves(k, i - 1) = u - u0;
      }
    gradient.topLeftCorner(d, d) = moves * places.inverse();
  }
};

Eigen::Vector3d vectorOf(const Point& point) { return {point[0], point[1], point[2]}; }

class RatesOfMesh {
 public:
  RatesOfMesh(const SubdomainMesh& mesh, const ElasticModel& model, const Vector& displacement)
      : mesh_(mesh), model_(model), displacement_(displacement) {}

  EnergyRates find() {
    addStrainEnergy();
    Vector work = Vector::Zero(mesh_.elements());
    rates_.perExcess = work;
    for (const Load& load : model_.loads) {
      if (load.onElements() && load.actsOn(model_.bodies[mesh_.body])) addBodyForce(load);
      if (load.kind == Load::Kind::Pressure) addPressure(load);
      if (load.kind == Load::Kind::Traction) addTraction(load, work);
    }
    for (const ElasticSupport& support : model_.supports) addSupport(support, work);
    rates_.perVolume = rates_.perVolume.cwiseAbs() + work;
    return std::move(rates_);
  }

 private:
  void addStrainEnergy() {
    const Matrix stresses = elementStresses(mesh_, model_, displacement_);
    rates_.perVolume = Vector::Zero(mesh_.elements());
    for (int e = 0; e < mesh_.elements(); ++e) {
      const Material& material = model_.materialOf(mesh_, e, mesh_.body);
      rates_.perVolume[e] = mesh_.dimension == 2 ? HookesLaw<2>(material, model_.plane).complementary(stresses.row(e).transpose()) / 2
                                                 : HookesLaw<3>(material, model_.plane).complementary(stresses.row(e).transpose()) / 2;
    }
  }

  void addBodyForce(const Load& load) {
    for (int e = 0; e < mesh_.elements(); ++e) {
      const LinearField u(mesh_, e, displacement_);
      const double density = load.usesDensity() ? model_.materialOf(mesh_, e, mesh_.body).density.value_or(0.0) : 1.0;
      rates_.perVolume[e] -= load.factor * density * vectorOf(load.at(u.centre)).dot(u.value);
    }
  }

  void addPressure(const Load& load) {
    for (const Side& side : sidesOf(mesh_.sideGroups, load.groups)) {
      const LinearField u(mesh_, side.element, displacement_);
      const double p = load.at(u.centre)[0], length = u.value.norm();
      double along = 0.0;  // change of the pressure along the displacement
      if (load.varies() && length > 0) {
        const double step = kPressureStep * diameterOf(mesh_, side.element) / length;
        Point moved = u.centre;
        for (int k = 0; k < 3; ++k) moved[static_cast<std::size_t>(k)] += step * u.value[k];
        along = (load.at(moved)[0] - p) / step;
      }
      rates_.perVolume[side.element] += load.factor * (p * u.gradient.trace() + along);
    }
  }

  void addTraction(const Load& load, Vector& work) {
    for (const Side& side : sidesOf(mesh_.sideGroups, load.groups)) {
      const LinearField u(mesh_, side.element, displacement_);
      const Eigen::Vector3d traction = load.factor * vectorOf(load.at(u.centre));
      rates_.perExcess[side.element] += std::abs(traction.dot(u.value));
      work[side.element] += (u.gradient.transpose() * traction).norm();
    }
  }

  void addSupport(const ElasticSupport& support, Vector& work) {
    const double stiffness = std::max(support.normal, support.tangential);
    for (const Side& side : sidesOf(mesh_.sideGroups, support.groups)) {
      const LinearField u(mesh_, side.element, displacement_);
      rates_.perExcess[side.element] += stiffness * u.value.squaredNorm() / 2;
      work[side.element] += stiffness * (u.gradient.transpose() * u.value).norm();
    }
  }

  const SubdomainMesh& mesh_;
  const ElasticModel& model_;
  const Vector& displacement_;
  EnergyRates rates_;
};

}  // namespace

double PolygonError::square() const { return std::accumulate(squares.begin(), squares.end(), 0.0); }

PolygonError polygonError(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                          const std::vector<Vector>& displacement, std::vector<ChordSide> sides, int elements) {
  PolygonError error;
  int any = sides.empty() ? 0 : 1;
  broadcastBytes(comm, &any, sizeof any);
  if (any == 0) return error;
  std::vector<Vector> perVolume, perExcess;
  collectively(comm, "estimating the effect of straight sides", [&] {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      EnergyRates rates = RatesOfMesh(meshes[i], model, displacement[i]).find();
      perVolume.push_back(std::move(rates.perVolume));
      perExcess.push_back(std::move(rates.perExcess));
    }
  });
  const std::vector<double> ofVolume = valuesOnRoot(comm, meshes, perVolume, elements);
  const std::vector<double> ofExcess = valuesOnRoot(comm, meshes, perExcess, elements);
  for (const ChordSide& side : sides) {
    const auto e = static_cast<std::size_t>(side.element);
    error.squares.push_back(2 * (ofVolume[e] * side.volume + ofExcess[e] * side.excess));
  }
  error.sides = std::move(sides);
  return error;
}

}  // namespace suture
