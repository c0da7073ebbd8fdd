#include <suture/algebra/DisjointSets.hpp>
#include <suture/partition/PairHolders.hpp>
#include <suture/partition/cut/ContactGroups.hpp>

namespace suture {

ContactGroups contactGroups(const Constraints& constraints, const NodeSubdomains& holders, int subdomains) {
  const int pieces = static_cast<int>(constraints.pieces.size());
  const PairHolders ofPairs(constraints, holders);
  DisjointSets sets(subdomains + pieces);
  for (int piece = 0; piece < pieces; ++piece)
    for (int id : constraints.pieces[piece].pairs)
      for (const PairEnd& end : constraints.pairs[id].ends)
        for (int s : ofPairs.of(end.node)) sets.join(subdomains + piece, s);

  ContactGroups all;
  all.groupOf.assign(subdomains, -1);
  std::vector<int> groupOfSet(subdomains + pieces, -1);
  for (int piece = 0; piece < pieces; ++piece) {
    int& group = groupOfSet[sets.lowest(subdomains + piece)];
    if (group < 0) {
      group = static_cast<int>(all.groups.size());
      all.groups.emplace_back();
      all.piecesOf.emplace_back();
    }
    all.piecesOf[group].push_back(piece);
  }
  for (int s = 0; s < subdomains; ++s) {
    all.groupOf[s] = groupOfSet[sets.lowest(s)];
    if (all.groupOf[s] >= 0) all.groups[all.groupOf[s]].push_back(s);
  }
  return all;
}

}  // namespace suture
