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

/// Kind of the subdomains of a body: its physics.
struct SubdomainKind {
  using Maker = std::function<std::unique_ptr<Subdomain>(const SubdomainMesh&, const ElasticModel&)>;
  std::string name = "Elastic";  ///< for messages
  Maker make{};                  ///< empty: elastic, with the body's material
};

/// Kinds of all bodies, from `Bodies/<name>/Subdomain`. Local. \param bodies  the scene's list
std::vector<SubdomainKind> subdomainKinds(const Parameters& bodies);

/// Subdomains of this rank's meshes, not assembled. `meshes` and `model` must outlive them. Collective.
/// \param kinds     of each body; empty: all elastic
/// \param needsLaw  a material law is needed at every point: subdomains with their own physics are refused
/// \throws InputError  for such bodies
Subdomains makeSubdomains(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                          const std::vector<SubdomainKind>& kinds, bool needsLaw);

/// Collective. \throws NumericalError
void assemble(const Comm& comm, const Subdomains& subdomains);

/// Elastic subdomains, assembled. Collective. \throws NumericalError
Subdomains makeSubdomains(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model);

/// Frees the subdomains that follow the model, which are not needed to verify a solution, and sets them to null. Local.
void releaseFollowers(Subdomains& subdomains);

}  // namespace suture
