#pragma once
#include <suture/subdomain/Subdomain.hpp>

#include <vector>

namespace suture {

/// Size of a contact group and its memory on its rank. Known before anything is factored.
struct GroupMemory {
  GlobalId unknowns = 0;          ///< free unknowns; those shared by members count once
  double stiffnessEntries = 0.0;  ///< stiffness entries of all members together
  int pairs = 0;                  ///< pairs that can change
  int rows = 0;                   ///< their rows, along normals and tangents
  int dimension = 2;              ///< 2 or 3

  /// Conservative estimate of the memory of a ContactGroup and its linearisation, in 2^20 bytes:
  ///     2 factors (boundary held, boundary free) as in CostModel, 5 copies of the stiffness at 12 bytes per entry,
  ///     8 dense matrices of rows x rows (compliance, its closed block and its factor, held and free, and temporaries).
  /// In 2D a factor is 7 n log2(n) entries at 11 bytes. 7 is about the largest value measured with CHOLMOD and AMD for two unknowns per
  /// node, up to n = 600,000: a square of 4-node quadrilaterals gives 3.8 (n = 3,000), 4.6 (50,000), 6.2 (200,000), 7.1 (600,000);
  /// triangles give 2.1 to 4.4, quadratic elements at most 7.0. Strips of 16:1, which resemble groups along a line, give half to two
  /// thirds of these values. An entry takes 10 to 12 bytes with its index.
  double megabytes() const;
};

/// Memory of one group. \param members  subdomains of the group, assembled. Local.
GroupMemory groupMemory(const std::vector<const Subdomain*>& members);

}  // namespace suture
