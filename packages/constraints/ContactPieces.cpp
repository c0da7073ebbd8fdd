#include <suture/base/DisjointSets.hpp>
#include <suture/constraints/ContactPieces.hpp>

#include <algorithm>
#include <map>
#include <tuple>

namespace suture {

std::vector<ContactPiece> findPieces(const std::vector<ContactLine>& lines, const std::vector<PairedLine>& paired,
                                     std::vector<ContactPair>& pairs) {
  DisjointSets components(static_cast<int>(pairs.size()));
  std::vector<int> lineOf;                           // pair -> index into `lines`
  std::map<std::tuple<int, int, int>, int> firstAt;  // bodies, node -> a pair there
  int base = 0;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    for (const PairedLine::Chain& chain : paired[l].chains)
      for (int i = 1; i < chain.count; ++i) components.join(base + chain.first + i - 1, base + chain.first + i);
    for (std::size_t i = 0; i < paired[l].pairs.size(); ++i) {
      const int id = base + static_cast<int>(i);
      lineOf.push_back(static_cast<int>(l));
      for (const PairEnd& end : pairs[id].ends)
        components.join(id, firstAt.emplace(std::make_tuple(lines[l].bodyA, lines[l].bodyB, end.node), id).first->second);
    }
    base += static_cast<int>(paired[l].pairs.size());
  }

  std::vector<ContactPiece> pieces;
  std::map<int, int> pieceOfRoot;
  for (ContactPair& pair : pairs) {
    const auto [at, isNew] = pieceOfRoot.emplace(components.lowest(pair.id), static_cast<int>(pieces.size()));
    const ContactLine& line = lines[lineOf[pair.id]];
    if (isNew) {
      pieces.emplace_back();
      pieces.back().bodyA = line.bodyA;
      pieces.back().bodyB = line.bodyB;
    }
    pair.piece = at->second;
    pieces[pair.piece].pairs.push_back(pair.id);
  }

  std::map<std::string, int> uses;
  for (ContactPiece& piece : pieces) {
    int last = -1;
    for (const int id : piece.pairs) {  // in the order of the lines
      if (lineOf[id] == last) continue;
      piece.name += (last < 0 ? "" : " + ") + lines[lineOf[id]].name;
      last = lineOf[id];
    }
    const int use = ++uses[piece.name];
    if (use > 1) piece.name += " " + std::to_string(use);
  }
  return pieces;
}

}  // namespace suture
