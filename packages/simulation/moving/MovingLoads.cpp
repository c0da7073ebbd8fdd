#include <suture/base/Collective.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/ElementForces.hpp>
#include <suture/elasticity/loads/ResolveLoads.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/simulation/moving/MovingLoads.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>

namespace suture {

namespace {

// Change of the moments of displaced forces in a round, relative to the sum of their magnitudes, after which the balance at the present
// places has settled. Not critical: from 1e-2 to 1e-5 the forces of a block that rocks change by 5e-7 and its conjugate gradients take 341
// to 363 iterations, those of a roller, a hinge and a cam together 3,664 to 3,748.
constexpr double kSameMoments = 1e-3;

}  // namespace

void MovingLoads::place(const Comm& comm, const DrawnScene& drawn, const MovingBodies& bodies, const std::vector<SubdomainMesh>& meshes,
                        ElasticModel& model) const {
  model.loads = drawn.model.loads;
  std::vector<Point> places;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    places.push_back(model.loads[i].place);
    if (model.loads[i].kind == Load::Kind::PointForce) model.loads[i] = resolved_[i];
    if (comm.getRank() != 0 || model.loads[i].kind != Load::Kind::ReferenceForce) continue;
    const std::vector<Side> sides = sidesOf(drawn.mesh.sideGroups, model.loads[i].groups);
    if (!sides.empty()) places[i] = bodies.frameOf(drawn.mesh.nodesOf(sides.front()).front()).at(places[i]);
  }
  broadcast(comm, places);
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    if (model.loads[i].kind == Load::Kind::ReferenceForce) model.loads[i].place = places[i];
  resolveLoads(comm, meshes, model);
  addCouples(comm, bodies, model);
}

void MovingLoads::addCouples(const Comm& comm, const MovingBodies& bodies, ElasticModel& model) const {
  struct Force {
    int node;
    Point force;
  };
  std::vector<Force> all;
  if (comm.getRank() == 0)
    for (std::size_t part = 0; part < moments_.size(); ++part)
      for (const auto& [node, force] : bodies.couple(static_cast<int>(part), moments_[part])) all.push_back({node, force});
  broadcast(comm, all);
  if (all.empty()) return;
  Load load;
  load.kind = Load::Kind::NodalForces;
  load.name = "couples of displaced forces";
  load.isCorrection = true;
  for (const Force& one : all) load.forces[one.node] = one.force;
  model.loads.push_back(std::move(load));
}

bool MovingLoads::findMoments(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<int>& partOfSubdomain,
                              const ElasticModel& model, const Solution& solution) {
  const int parts = partOfSubdomain.empty() ? 0 : 1 + *std::max_element(partOfSubdomain.begin(), partOfSubdomain.end());
  std::vector<double> mine(3 * static_cast<std::size_t>(parts) + 1, 0.0), all(mine.size());  // the last one: sum of magnitudes
  collectively(comm, "finding moments", [&] {
    for (std::size_t s = 0; s < meshes.size(); ++s) {
      const SubdomainMesh& mesh = meshes[s];
      const auto materialOf = [&](int element) -> const Material& { return model.materialOf(mesh, element, mesh.body); };
      const Vector forces = elementForces(mesh, materialOf, model.plane, solution.displacement[s]).internal;
      double* sum = mine.data() + 3 * static_cast<std::size_t>(partOfSubdomain[static_cast<std::size_t>(mesh.id)]);
      for (int node = 0; node < mesh.nodes(); ++node) {
        const Eigen::Index at = Eigen::Index(node) * mesh.dimension;
        const Point moment =
            cross(pointOf(solution.displacement[s].data() + at, mesh.dimension), pointOf(forces.data() + at, mesh.dimension));
        for (std::size_t k = 0; k < 3; ++k) sum[k] += moment[k];
        mine.back() += norm(moment);
      }
    }
  });
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  moments_.resize(static_cast<std::size_t>(parts), {0, 0, 0});
  double change = 0.0;
  for (std::size_t part = 0; part < moments_.size(); ++part) {
    const Point now{all[3 * part], all[3 * part + 1], all[3 * part + 2]};
    change = std::max(change, norm(minus(now, moments_[part])));
    moments_[part] = now;
  }
  return change <= kSameMoments * all.back();
}

}  // namespace suture
