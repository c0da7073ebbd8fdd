#include <suture/adapt/MarkedSimplex.hpp>

#include <algorithm>

namespace suture {

namespace {

using Edge = std::array<int, 2>;

bool contains(const Edge& edge, int vertex) { return edge[0] == vertex || edge[1] == vertex; }

/// True if an even number of exchanges leads from 0 1 2 3 to these numbers.
bool isEven(const std::array<int, 4>& numbers) {
  int inversions = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) inversions += numbers[i] > numbers[j] ? 1 : 0;
  return inversions % 2 == 0;
}

}  // namespace

MarkedSimplex<3> arranged(const MarkedSimplex<3>& given, const Edge& edge, const std::array<Edge, 4>& faceEdge, bool flag) {
  std::array<int, 4> from{edge[0], edge[1], -1, -1};
  int count = 2;
  for (int k = 0; k < 4; ++k)
    if (!contains(edge, k)) from[count++] = k;
  if (!isEven(from)) std::swap(from[2], from[3]);
  MarkedSimplex<3> result;
  for (int k = 0; k < 4; ++k) {
    result.vertices[k] = given.vertices[from[k]];
    result.tags[k] = given.tags[from[k]];
  }
  const auto mark = [&](int opposite, int end) {
    const Edge& own = faceEdge[from[opposite]];
    if (!contains(own, from[end])) return 2;
    return contains(own, from[2]) ? 0 : 1;
  };
  result.marks = faceMarks(mark(0, 1), mark(1, 0), flag);
  return result;
}

template <>
std::pair<MarkedSimplex<2>, MarkedSimplex<2>> bisected(const MarkedSimplex<2>& parent, int middle) {
  const auto [a, b, c] = parent.vertices;
  const auto [oppositeA, oppositeB, oppositeC] = parent.tags;
  return {{{c, a, middle}, {oppositeC, 0, oppositeB}, 0}, {{b, c, middle}, {0, oppositeC, oppositeA}, 0}};
}

// Local vertices: 0 1 are a, the middle (first part) or the middle, b (second part); 2 3 are c d.
template <>
std::pair<MarkedSimplex<3>, MarkedSimplex<3>> bisected(const MarkedSimplex<3>& parent, int middle) {
  const auto [a, b, c, d] = parent.vertices;
  const auto [oppositeA, oppositeB, oppositeC, oppositeD] = parent.tags;
  const int markA = parent.marks % 3, markB = parent.marks / 3 % 3;
  const bool planar = markA == markB && markA < 2, flagged = parent.marks >= 9;
  const auto refinementEdge = [](int mark, int kept) { return mark == 2 ? Edge{2, 3} : Edge{kept, 2 + mark}; };
  const auto newFace = [&](int vertex) { return planar && flagged ? Edge{vertex, 2 + markA} : Edge{2, 3}; };
  const Edge first = refinementEdge(markB, 0), second = refinementEdge(markA, 1);
  const bool flag = planar && !flagged;
  return {
      arranged({{a, middle, c, d}, {0, oppositeB, oppositeC, oppositeD}, 0}, first, {newFace(1), first, Edge{0, 3}, Edge{0, 2}}, flag),
      arranged({{middle, b, c, d}, {oppositeA, 0, oppositeC, oppositeD}, 0}, second, {second, newFace(0), Edge{1, 3}, Edge{1, 2}}, flag)};
}

}  // namespace suture
