#include <suture/algebra/CostModel.hpp>
#include <suture/condensed/GroupMemory.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace suture {

double GroupMemory::megabytes() const {
  constexpr double kAnEntry = 17.1;  // bytes; both factors together then have 154 n log2 n
  const double p = rows;
  const double factors = 2 * CostModel(dimension).factorBytes(unknowns, kAnEntry), stiffness = 5 * 12 * stiffnessEntries,
               compliance = 8 * 8 * p * p;
  return (factors + stiffness + compliance) / (1 << 20);
}

GroupMemory groupMemory(const std::vector<const Subdomain*>& members) {
  std::set<int> ids;
  std::map<int, std::size_t> rowsOf;
  for (const Subdomain* member : members) ids.insert(member->mesh().id);
  GroupMemory memory;
  if (!members.empty()) memory.dimension = members.front()->components();
  for (const Subdomain* member : members) {
    const SubdomainMesh& mesh = member->mesh();
    memory.stiffnessEntries += static_cast<double>(member->stiffness().nonZeros());
    for (int dof = 0; dof < member->dofs(); ++dof) {
      const auto others = mesh.others(member->nodeOf(dof));
      const bool counted = std::any_of(others.begin(), others.end(), [&](int other) { return other < mesh.id && ids.count(other) > 0; });
      memory.unknowns += !counted;
    }
    for (const ContactRow& row : mesh.contactRows)
      if (row.canChange()) rowsOf[row.pair.id] = row.equations.size();
  }
  memory.pairs = static_cast<int>(rowsOf.size());
  for (const auto& [pair, rows] : rowsOf) memory.rows += static_cast<int>(rows);
  return memory;
}

}  // namespace suture
