#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace suture {

using Subdomains = std::vector<std::unique_ptr<Subdomain>>;

/// The kind of subdomain that a body is cut into: its physics.
struct SubdomainKind {
  using Maker = std::function<std::unique_ptr<Subdomain>(const SubdomainMesh&, const ElasticModel&)>;
  std::string name = "Elastic";  ///< for messages
  Maker make{};                  ///< empty: elastic, of the body's material
};

/// The kinds that a scene names, `Bodies/<name>/Subdomain`, body by body. Local. \param bodies  the scene's list
std::vector<SubdomainKind> subdomainKinds(const Parameters& bodies);

/// Subdomains of this rank's meshes, not assembled. `meshes` and `model` must outlive them. Collective.
/// \param kinds     of each body; empty: all elastic
/// \param needsLaw  the law of a material is needed at every point: physics of a subdomain's own is refused
/// \throws InputError  names such bodies
Subdomains makeSubdomains(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                          const std::vector<SubdomainKind>& kinds, bool needsLaw);

/// Collective. \throws NumericalError
void assemble(const Comm& comm, const Subdomains& subdomains);

/// Elastic subdomains, assembled. Collective. \throws NumericalError
Subdomains makeSubdomains(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model);

/// Frees the subdomains (null then) that nobody needs to judge an answer: those that follow the model. Local.
void releaseFollowers(Subdomains& subdomains);

}  // namespace suture
