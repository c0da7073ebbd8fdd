#pragma once
#include <suture/report/Run.hpp>

#include <string>

namespace suture {

/// The bodies as a VTKHDF grid. Point data: Displacement, NodeId. Cell data: Stress (XX YY ZZ XY YZ XZ, tension positive), PrincipalStress
/// with PrincipalDirection1 and 2, VonMises, Subdomain, Body, ElementId. Every array carries `unit` and `meaning` (sign included) as
/// attributes; /Record as in Provenance.hpp. A seam node occurs once per rank. Collective.
/// \throws EnvironmentError
void writeFields(const Run& run, const std::string& path);

}  // namespace suture
