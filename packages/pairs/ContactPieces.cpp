#include <suture/algebra/DisjointSets.hpp>
#include <suture/pairs/ContactPieces.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace suture {

namespace {

/// Bodies of a pair on side A and on side B; an empty set represents a rigid obstacle.
struct PairBodies {
  std::set<int> a, b;
  bool operator<(const PairBodies& other) const { return a < other.a || (a == other.a && b < other.b); }
};
PairBodies bodiesOf(const Mesh& mesh, const ContactSurface& contact, const ContactPair& pair) {
  PairBodies bodies;
  for (const PairEnd& end : pair.ends) {
    const bool onA = contact.a.surface->nodes().count(end.node) > 0;
    (onA ? bodies.a : bodies.b).insert(mesh.bodyOfNode[end.node]);
  }
  return bodies;
}

/// Names pieces after their contacts, with a number if several pieces would have the same name.
void nameThem(const std::vector<ContactSurface>& contacts, const std::vector<int>& contactOf, std::vector<ContactPiece>& pieces) {
  std::map<std::string, int> uses;
  for (ContactPiece& piece : pieces) {
    int last = -1;
    for (const int id : piece.pairs) {  // in the order of the contacts
      const ContactSurface& contact = contacts[contactOf[id]];
      if (contactOf[id] == last) continue;
      last = contactOf[id];
      if (contact.spring > 0 && !piece.name.empty()) continue;  // an earlier pair has the same entry
      piece.name += (piece.name.empty() ? "" : " + ") + contact.name;
    }
    const int use = ++uses[piece.name];
    if (use > 1) piece.name += " " + std::to_string(use);
  }
}

}  // namespace

std::vector<ContactPiece> findPieces(const Mesh& mesh, const std::vector<ContactSurface>& contacts,
                                     const std::vector<PairedSurface>& paired, std::vector<ContactPair>& pairs) {
  DisjointSets components(static_cast<int>(pairs.size()));
  std::vector<int> contactOf, baseOf;                 // pair -> index into `contacts`, contact -> its first pair
  std::map<std::pair<PairBodies, int>, int> firstAt;  // bodies, node -> a pair there
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    baseOf.push_back(static_cast<int>(contactOf.size()));
    for (const std::vector<int>& cell : paired[c].cells)
      for (const int other : cell) components.join(baseOf[c] + cell.front(), baseOf[c] + other);
    contactOf.insert(contactOf.end(), paired[c].pairs.size(), static_cast<int>(c));
  }
  std::vector<PairBodies> bodies;
  for (const ContactPair& pair : pairs) {
    bodies.push_back(bodiesOf(mesh, contacts[contactOf[pair.id]], pair));
    for (const PairEnd& end : pair.ends)
      components.join(pair.id, firstAt.emplace(std::make_pair(bodies.back(), end.node), pair.id).first->second);
  }

  std::vector<ContactPiece> pieces;
  std::map<int, int> pieceOfRoot;
  for (ContactPair& pair : pairs) {
    const auto [at, isNew] = pieceOfRoot.emplace(components.lowest(pair.id), static_cast<int>(pieces.size()));
    if (isNew) pieces.emplace_back();
    pair.piece = at->second;
    ContactPiece& piece = pieces[pair.piece];
    piece.pairs.push_back(pair.id);
    piece.isWithinOneBody = contacts[contactOf[pair.id]].isWithinOneBody() && (isNew || piece.isWithinOneBody);
    for (const std::set<int>& own : {bodies[pair.id].a, bodies[pair.id].b}) piece.bodies.insert(piece.bodies.end(), own.begin(), own.end());
  }
  for (ContactPiece& piece : pieces) {
    std::sort(piece.bodies.begin(), piece.bodies.end());
    piece.bodies.erase(std::unique(piece.bodies.begin(), piece.bodies.end()), piece.bodies.end());
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    for (std::vector<int> cell : paired[c].cells) {
      for (int& id : cell) id += baseOf[c];
      pieces[pairs[cell.front()].piece].cells.push_back(std::move(cell));
    }
    for (AxisPoint point : paired[c].onAxis) {
      for (int& id : point.pairs) id += baseOf[c];
      pieces[pairs[point.pairs[0]].piece].onAxis.push_back(point);
    }
  }
  nameThem(contacts, contactOf, pieces);
  return pieces;
}

}  // namespace suture
