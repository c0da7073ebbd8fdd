#include <suture/base/Collective.hpp>
#include <suture/base/Progress.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/solver/MakeSubdomains.hpp>
#include <suture/subdomain/ElasticSubdomain.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

std::vector<SubdomainKind> subdomainKinds(const Parameters& bodies) {
  std::vector<SubdomainKind> kinds;
  for (const std::string& name : sublistNames(bodies)) {
    const Parameters& body = bodies.sublist(name);
    kinds.push_back({body.get<std::string>("Subdomain"), [body = Parameters(body)](const SubdomainMesh& mesh, const ElasticModel& model) {
                       return makeStrategy<Subdomain>(body, "Subdomain", mesh, model);
                     }});
  }
  return kinds;
}

Subdomains makeSubdomains(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                          const std::vector<SubdomainKind>& kinds, bool needsLaw) {
  Subdomains subdomains;
  std::vector<int> own;  // bodies of this rank with their own physics
  collectively(comm, "making the subdomains", [&] {
    for (const SubdomainMesh& mesh : meshes) {
      const bool elastic = kinds.empty() || !kinds[mesh.body].make;
      subdomains.push_back(elastic ? std::make_unique<ElasticSubdomain>(mesh, model) : kinds[mesh.body].make(mesh, model));
      if (!subdomains.back()->followsModel()) own.push_back(mesh.body);
    }
  });
  if (!needsLaw) return subdomains;
  Problems problems;
  for (const int body : unionOverRanks(comm, own))
    problems.add(
        "Bodies/" + model.bodies[body] + "/Subdomain",
        "'" + kinds[body].name +
            "' has its own physics, but the scene uses a feature that needs a material law at every point: the outer solver Monolithic, "
            "an Exact Solution, Output/Error Estimate or the tolerance Automatic. A user material law (Materials/<name>/Type) works with "
            "all of these");
  problems.throwIfAny();
  return subdomains;
}

void assemble(const Comm& comm, const Subdomains& subdomains) {
  collectively(comm, "assembling the subdomains", [&] {
    for (const auto& subdomain : subdomains) {
      Progress::count("subdomains", static_cast<long>(subdomains.size()));
      subdomain->assemble();
    }
  });
}

Subdomains makeSubdomains(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model) {
  Subdomains subdomains = makeSubdomains(comm, meshes, model, {}, false);
  assemble(comm, subdomains);
  return subdomains;
}

void releaseFollowers(Subdomains& subdomains) {
  for (auto& subdomain : subdomains)
    if (subdomain->followsModel()) subdomain.reset();
}

}  // namespace suture
