#pragma once
#include <suture/partition/SubdomainMesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// Memory of this rank's subdomains at the peak of a run, in 2^20 bytes, from their meshes alone: n unknowns on N nodes, c pairs of nodes
/// that are coupled, b unknowns on the boundary,
///     12 (d^2 c + d (d + 1) N / 2)   stiffness, its lower triangle, d components a node
///     6 c d log2(n)                  interior factor in single precision
///     6.6 b^2 + 200 b                Schur complement, its constrained inverse and basis
///     130 n                          mesh, loads, fields
/// and 55 MB for program and libraries. The terms but the last are fitted to eleven runs with explicit Schur complements, of all five
/// shapes of elements, 94k to 983k unknowns, on one and two ranks; the last to those of the test drivers.memory since Gmsh is a program of
/// its own: the estimate is 11 % below to 9 % above them. In space, with entries F of factors as CostModel has them, and contact rows of
/// more than two terms (a mortar) with t terms each,
///     2.2 F(n - b) + 8.6 F(n)        interior factor and sparse inverse in single precision, bases, mesh, loads, fields
///     contact rows                   of each subdomain all those of its clusters
///     sum of 100 t + 19 t^2          relations, and the matrix by which the jumps of a mortar are shared
/// beside the stiffness, fitted to sixteen runs of 4k to 86k unknowns (press with all five shapes of elements, matching or not, and the
/// scenes of input/ in space): the estimate is 17 % below to 11 % above them.
/// Local.
double estimatedMegabytes(const std::vector<SubdomainMesh>& meshes);

/// The same for Monolithic with n unknowns: 8 n log2(n) entries of the factor, and 500 bytes an unknown. Fitted to one run: tunnel with
/// 937k unknowns 1646 MB; the estimate is 1627. Local.
double estimatedMonolithicMegabytes(GlobalId unknowns, int dimension = 2);

/// Compares the estimates of all ranks of a machine with what it has, and that of each rank with what its limit of
/// address space (ulimit -v) leaves, before the work starts.
/// \param mine   estimate of this rank [MB]
/// \param limit  Subdomain/Memory Limit: megabytes that all ranks on one machine may take; 0: what the machine has available
/// \return the sum over all ranks of the job [MB]
/// \throws EnvironmentError  they exceed it: the figures, and what to change. Collective.
double checkMemory(const Comm& comm, double mine, double limit);

/// Part of the estimates that program and libraries take. [MB] Local.
double programMegabytes();

}  // namespace suture
