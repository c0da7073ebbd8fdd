#pragma once
#include <suture/subdomain/Subdomain.hpp>

#include <vector>

namespace suture {

/// Size of a contact group, and its cost to the one rank on which it lives. Known before anything is factored.
struct GroupMemory {
  GlobalId unknowns = 0;          ///< free ones, those that several members hold once
  double stiffnessEntries = 0.0;  ///< entries of all members together
  int pairs = 0;                  ///< pairs that can move
  int rows = 0;                   ///< their rows, along normals and tangents
  int dimension = 2;              ///< 2 or 3

  /// Estimate, on the safe side, of the memory of a ContactGroup and its linearisation, in 2^20 bytes:
  ///     2 factors (boundary held, boundary free) as CostModel has them, 5 copies of the stiffness at 12 bytes an entry,
  ///     8 dense matrices of rows x rows (compliance, its closed block and its factor, held and free, and temporaries).
  /// In the plane that is 7 n log2(n) entries at 11 bytes, where 7 is the largest that was measured with CHOLMOD and AMD for two unknowns a
  /// node, up to n = 600,000: a square of 4-node
  /// quadrilaterals gives 3.8 (n = 3,000), 4.6 (50,000), 6.2 (200,000), 7.1 (600,000), of triangles 2.1 to 4.4, of quadratic elements at
  /// most 7.0, strips of 16:1, which groups along a line resemble, half to two thirds of that; an entry takes 10 to 12 bytes with its
  /// index.
  double megabytes() const;
};

/// Memory of one group. \param members  subdomains of the group, assembled. Local.
GroupMemory groupMemory(const std::vector<const Subdomain*>& members);

}  // namespace suture
