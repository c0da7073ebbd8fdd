#pragma once
#include <suture/partition/SubdomainMesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// Peak memory of this rank's subdomains, in 2^20 bytes, from their meshes: n unknowns on N nodes, c coupled pairs of nodes, b unknowns on
/// the boundary,
///     12 (d^2 c + d (d + 1) N / 2)   stiffness, its lower triangle, d components per node
///     6 c d log2(n)                  interior factor in single precision
///     6.6 b^2 + 200 b                Schur complement, its constrained inverse and basis
///     130 n                          mesh, loads, fields
/// and 55 MB for program and libraries. All terms except the last are fitted to eleven runs with explicit Schur complements, with all five
/// element shapes, 94k to 983k unknowns, on one and two ranks; the last one to the test drivers.memory since Gmsh runs as a separate
/// program. The estimate is 11 % below to 9 % above the measured values. In 3D, with F the factor entries of CostModel, and contact rows of
/// more than two terms (a mortar) with t terms each,
///     2.2 F(n - b) + 8.6 F(n)        interior factor and sparse inverse in single precision, bases, mesh, loads, fields
///     contact rows                   in each subdomain all rows of its clusters
///     sum of 100 t + 19 t^2          relations, and the matrix that distributes the jumps of a mortar
/// in addition to the stiffness, fitted to sixteen runs of 4k to 86k unknowns (press with all five element shapes, matching or not, and the
/// 3D scenes of input/): the estimate is 17 % below to 11 % above the measured values. Local.
double estimatedMegabytes(const std::vector<SubdomainMesh>& meshes);

/// The same for Monolithic with n unknowns: 8 n log2(n) factor entries, and 500 bytes per unknown. Fitted to one run: tunnel with 937k
/// unknowns took 1646 MB; the estimate is 1627. Local.
double estimatedMonolithicMegabytes(GlobalId unknowns, int dimension = 2);

/// Compares, before the work starts, the estimates of all ranks on a machine with its memory, and the estimate of each rank with the rest
/// of its address space limit (ulimit -v).
/// \param mine   estimate of this rank [MB]
/// \param limit  Subdomain/Memory Limit: megabytes for all ranks on one machine; 0: the available memory of the machine
/// \return the sum over all ranks of the job [MB]
/// \throws EnvironmentError  if they exceed it; the message has the figures and suggests changes. Collective.
double checkMemory(const Comm& comm, double mine, double limit);

/// Part of the estimates for program and libraries. [MB] Local.
double programMegabytes();

}  // namespace suture
