#include <numeric>
#include <suture/partition/ContactGroups.hpp>

namespace suture {
namespace {

// Disjoint sets of subdomains and pieces.
class Sets {
 public:
  explicit Sets(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int i, int j) { parent_[find(i)] = find(j); }

 private:
  std::vector<int> parent_;
};

}  // namespace

ContactGroups contactGroups(const Constraints& constraints, const NodeSubdomains& holders, int subdomains) {
  const int pieces = static_cast<int>(constraints.pieces.size());
  Sets sets(subdomains + pieces);
  for (int piece = 0; piece < pieces; ++piece)
    for (int id : constraints.pieces[piece].pairs)
      for (const PairEnd& end : constraints.pairs[id].ends)
        for (int s : holders.of(end.node)) sets.join(subdomains + piece, s);

  ContactGroups all;
  all.groupOf.assign(subdomains, -1);
  std::vector<int> groupOfSet(subdomains + pieces, -1);
  for (int piece = 0; piece < pieces; ++piece) {
    int& group = groupOfSet[sets.find(subdomains + piece)];
    if (group < 0) {
      group = static_cast<int>(all.groups.size());
      all.groups.emplace_back();
      all.piecesOf.emplace_back();
    }
    all.piecesOf[group].push_back(piece);
  }
  for (int s = 0; s < subdomains; ++s) {
    all.groupOf[s] = groupOfSet[sets.find(s)];
    if (all.groupOf[s] >= 0) all.groups[all.groupOf[s]].push_back(s);
  }
  return all;
}

}  // namespace suture
