#pragma once
#include <suture/interface/InterfaceLayout.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace suture {

/// Adds the entities of the subdomains' seams, in unknowns, to a layout. Seams inside one local problem are not entities. Local.
/// \param problemOf  local problem of a subdomain: itself or its contact group
void addSeams(const std::vector<std::unique_ptr<Subdomain>>& subdomains, const std::function<int(int subdomain)>& problemOf,
              InterfaceLayout& layout);

/// Adds free unknowns of a subdomain to a layout: number, point, direction and flux. Local.
void addUnknowns(const Subdomain& subdomain, const std::vector<int>& dofs, InterfaceLayout& layout);

}  // namespace suture
