#pragma once
#include <suture/partition/cut/Cut.hpp>

#include <vector>

namespace suture {

/// Renumbers the subdomains of a cut along a curve through their centres (orderAlongHilbertCurve), all bodies together: subdomains with
/// consecutive numbers are close to each other, so that a rank with a run of numbers has a compact set with few neighbours. The numbers do
/// not depend on the ranks. Collective.
/// \param mesh   mesh that the share was made from
/// \param share  its subdomains and their holders get the new numbers
/// \param cut    on rank 0: names, bodies and, if present, subdomains of elements get the new numbers
void numberSubdomainsAlongCurve(const Comm& comm, const CellBlock& mesh, MeshShare& share, Cut& cut);

/// Names "<body> <number>" of subdomains, numbered 1, 2, ... within each body. Local.
std::vector<std::string> numberedNames(const std::vector<std::string>& bodies, const std::vector<int>& bodyOf);

}  // namespace suture
