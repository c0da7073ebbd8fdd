#include <suture/adapt/SingularVertices.hpp>
#include <suture/adapt/SizePlan.hpp>
#include <suture/mesh/BoxTree.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace suture {

namespace {

constexpr double kLeastRatio = 0.125, kMostRatio = 2.0;
constexpr double kGrowth = 0.5;               // growth of the size per distance; 1 makes bad elements
constexpr double kLeastSingular = 1.0 / 512;  // least ratio there
constexpr double kEven = 1.2;                 // ratio of sizes in an element up to which their mean counts
constexpr double kApart = 1.02;               // least ratio of different sizes, for divided differences
constexpr double kOfSlide = 2.0;              // least size over the slide of a contact
constexpr double kOfExtent = 1e-7;            // least size over the extent of the mesh: Gmsh merges points closer than 1e-8 of it
constexpr double kPerHalving = 10.0;          // elements around a vertex between a size and half of it
constexpr double kRounding = 8.0;             // steps per power of two
constexpr int kBisections = 60;

/// Edge length of the regular simplex of an element's size.
double sizeOf(const Mesh& mesh, int element) {
  const double size = std::abs(signedSize(mesh, element));
  return mesh.dimension == 2 ? std::sqrt(4 / std::sqrt(3.0) * size) : std::cbrt(6 * std::sqrt(2.0) * size);
}

/// h_new / h of all elements as a function of c. Elements at singular vertices have errors of a low order, whatever the order of the
/// element, and few elements between the old and the new size, because sizes grow away from the vertex.
class Ratios {
 public:
  Ratios(const std::vector<double>& squares, const std::vector<int>& singular, int order, int dimension)
      : squares_(squares), singular_(singular), order_(order), dimension_(dimension) {}

  double ratio(double c, std::size_t element) const {
    const double square = squares_[element];
    if (square <= 0) return kMostRatio;
    if (isSingular(element)) return std::clamp(std::pow(kTip * c / square, 0.5 / kSingularOrder), kLeastSingular, 1.0);
    return std::clamp(std::pow(c / square, 1.0 / (2 * order_ + dimension_)), kLeastRatio, kMostRatio);
  }
  double errorSquare(double c) const {
    return sum([&](std::size_t e) { return squares_[e] * std::pow(ratio(c, e), isSingular(e) ? 2 * kSingularOrder : 2.0 * order_); });
  }
  double elements(double c) const {
    return sum([&](std::size_t e) {
      const double here = ratio(c, e);
      return isSingular(e) ? 1 - kPerHalving / kAround * std::log2(here) : std::pow(here, -dimension_);
    });
  }
  /// The largest c with errorSquare(c) <= wanted; if there is none, the smallest one that matters.
  double forError(double wanted) const {
    return bisect([&](double c) { return errorSquare(c) <= wanted; });
  }
  /// The smallest c with elements(c) <= most.
  double forElements(double most) const {
    return bisect([&](double c) { return elements(c) > most; });
  }

 private:
  // About so many elements are at a vertex; the squared error of one of them that costs as much to reduce as c elsewhere.
  static constexpr double kAround = 6.0, kTip = 5.0;

  bool isSingular(std::size_t element) const { return singular_[element] >= 0; }
  template <typename Of>
  double sum(const Of& of) const {
    double all = 0;
    for (std::size_t e = 0; e < squares_.size(); ++e) all += of(e);
    return all;
  }
  /// Border between values of c that are small enough, and those that are not.
  template <typename Small>
  double bisect(const Small& isSmall) const {
    double largest = 0, least = std::numeric_limits<double>::infinity();
    for (const double square : squares_)
      if (square > 0) largest = std::max(largest, square), least = std::min(least, square);
    if (largest == 0) return 0;
    const double exponent = 2 * order_ + dimension_;
    double low = std::log(least) + exponent * std::log(kLeastRatio) + std::log(kLeastSingular),
           high = std::log(largest) + exponent * std::log(kMostRatio);
    for (int k = 0; k < kBisections; ++k) {
      const double middle = 0.5 * (low + high);
      (isSmall(std::exp(middle)) ? low : high) = middle;
    }
    return std::exp(low);
  }

  const std::vector<double>& squares_;
  const std::vector<int>& singular_;
  int order_, dimension_;
};

double rounded(double ratio) { return std::exp2(std::round(kRounding * std::log2(ratio)) / kRounding); }

struct Link {
  int to;
  double length;
};

/// Nodes that limit each other's sizes, with their distances: those of an edge, and facing ones.
std::vector<std::vector<Link>> linksOf(const Mesh& mesh, const std::vector<FacingNodes>& facing) {
  std::vector<std::vector<Link>> links(static_cast<std::size_t>(mesh.nodes()));
  const auto link = [&](int a, int b, double length) {
    links[static_cast<std::size_t>(a)].push_back({b, length});
    links[static_cast<std::size_t>(b)].push_back({a, length});
  };
  for (int e = 0; e < mesh.elements(); ++e) {
    const CellInfo& cell = cellInfo(mesh.cells[e]);
    const Span<const int> nodes = mesh.nodesOf(e);
    for (std::size_t k = 0; k < cell.edges.size(); ++k) {
      const int a = nodes[cell.edges[k][0]], b = nodes[cell.edges[k][1]];
      const double length = norm(minus(mesh.point(a), mesh.point(b)));
      link(a, b, length);
      if (cell.order < 2) continue;
      const int middle = nodes[static_cast<std::size_t>(cell.vertices) + k];
      link(a, middle, length / 2);
      link(b, middle, length / 2);
    }
  }
  for (const FacingNodes& pair : facing)
    if (pair.a < mesh.nodes() && pair.b < mesh.nodes()) link(pair.a, pair.b, pair.distance);
  return links;
}

/// Lowers sizes so that they grow by at most kGrowth times the length of a link.
void limitGrowth(const std::vector<std::vector<Link>>& links, std::vector<double>& sizes) {
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting;
  for (std::size_t node = 0; node < sizes.size(); ++node)
    if (std::isfinite(sizes[node])) waiting.push({sizes[node], static_cast<int>(node)});
  while (!waiting.empty()) {
    const auto [size, node] = waiting.top();
    waiting.pop();
    if (size > sizes[static_cast<std::size_t>(node)]) continue;
    for (const Link& link : links[static_cast<std::size_t>(node)]) {
      double& other = sizes[static_cast<std::size_t>(link.to)];
      const double most = size + kGrowth * link.length;
      if (most >= other) continue;
      other = most;
      waiting.push({most, link.to});
    }
  }
}

/// Raises the sizes of facing nodes to a multiple of their slide.
void keepAboveSlides(const std::vector<FacingNodes>& facing, std::vector<double>& sizes) {
  for (const FacingNodes& pair : facing)
    for (const int node : {pair.a, pair.b})
      if (node < static_cast<int>(sizes.size()))
        sizes[static_cast<std::size_t>(node)] = std::max(sizes[static_cast<std::size_t>(node)], kOfSlide * pair.slide);
}

/// Raises the sizes to what the mesher can resolve.
void keepResolved(const Mesh& mesh, std::vector<double>& sizes) {
  BoundingBox all;
  for (int node = 0; node < mesh.nodes(); ++node) all.include(mesh.point(node));
  const double least = kOfExtent * norm(minus(all.high, all.low));
  for (double& size : sizes) size = std::max(size, least);
}

/// Mean of h^-d over a simplex, on which h is linear. \param sizes  h at its d + 1 vertices
/// The integral of the d-th derivative of a function g of h over a simplex is d! times its size times the divided difference of g at the
/// vertices (Hermite and Genocchi); g = -log h in 2D, log h / 2 in 3D.
double meanDensity(std::vector<double> sizes) {
  const std::size_t dimension = sizes.size() - 1;
  std::sort(sizes.begin(), sizes.end());
  if (sizes.back() <= kEven * sizes.front())
    return std::pow(std::accumulate(sizes.begin(), sizes.end(), 0.0) / static_cast<double>(sizes.size()), -static_cast<double>(dimension));
  std::vector<double> differences;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    if (k > 0) sizes[k] = std::max(sizes[k], kApart * sizes[k - 1]);
    differences.push_back(std::log(sizes[k]));
  }
  for (std::size_t order = 1; order <= dimension; ++order)
    for (std::size_t k = dimension; k >= order; --k) differences[k] = (differences[k] - differences[k - 1]) / (sizes[k] - sizes[k - order]);
  return dimension == 2 ? -2 * differences[2] : 3 * differences[3];
}

SizeField fieldOf(const Mesh& mesh, std::vector<double> sizes) {
  SizeField field;
  field.dimension = mesh.dimension;
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Point point = mesh.point(node);
    field.points.insert(field.points.end(), point.begin(), point.end());
  }
  field.sizes = std::move(sizes);
  for (int e = 0; e < mesh.elements(); ++e) {
    const Span<const int> nodes = mesh.nodesOf(e);
    field.simplices.insert(field.simplices.end(), nodes.begin(), nodes.begin() + mesh.dimension + 1);
  }
  return field;
}

}  // namespace

SizePlan planSizes(const Mesh& mesh, const std::vector<double>& squares, const std::vector<FacingNodes>& facing, const WantedError& wanted,
                   const std::vector<double>& largest) {
  const std::vector<int> singular = singularVertices(mesh, squares);
  const Ratios ratios(squares, singular, cellInfo(mesh.cells.front()).order, mesh.dimension);
  double c = ratios.forError(wanted.square);
  SizePlan result;
  result.isCapped = ratios.elements(c) > wanted.mostElements;
  if (result.isCapped) c = ratios.forElements(wanted.mostElements);
  std::vector<double> sizes(static_cast<std::size_t>(mesh.nodes()), std::numeric_limits<double>::infinity());
  for (int e = 0; e < mesh.elements(); ++e) {
    const double present = sizeOf(mesh, e), size = present * rounded(ratios.ratio(c, static_cast<std::size_t>(e)));
    const int tip = singular[static_cast<std::size_t>(e)];
    for (const int node : mesh.nodesOf(e)) {
      double& least = sizes[static_cast<std::size_t>(node)];
      least = std::min(least, tip < 0 || node == tip ? size : present);
    }
  }
  for (std::size_t node = 0; node < largest.size(); ++node) sizes[node] = std::min(sizes[node], largest[node]);
  keepAboveSlides(facing, sizes);
  keepResolved(mesh, sizes);
  limitGrowth(linksOf(mesh, facing), sizes);
  keepAboveSlides(facing, sizes);
  for (int e = 0; e < mesh.elements(); ++e) {
    const Span<const int> nodes = mesh.nodesOf(e);
    std::vector<double> own;
    for (int k = 0; k <= mesh.dimension; ++k) own.push_back(sizes[static_cast<std::size_t>(nodes[k])]);
    result.elements += std::pow(sizeOf(mesh, e), mesh.dimension) * meanDensity(std::move(own));
  }
  if (result.elements > wanted.mostElements) {
    const double factor = std::pow(result.elements / wanted.mostElements, 1.0 / mesh.dimension);
    for (double& size : sizes) size *= factor;
    result.elements = wanted.mostElements;
    result.isCapped = true;
  }
  result.field = fieldOf(mesh, std::move(sizes));
  return result;
}

SizePlan uniformSizes(const Mesh& mesh, double factor) {
  std::vector<double> sizes(static_cast<std::size_t>(mesh.nodes()), std::numeric_limits<double>::infinity());
  for (int e = 0; e < mesh.elements(); ++e)
    for (const int node : mesh.nodesOf(e))
      sizes[static_cast<std::size_t>(node)] = std::min(sizes[static_cast<std::size_t>(node)], factor * sizeOf(mesh, e));
  return {fieldOf(mesh, std::move(sizes)), mesh.elements() * std::pow(factor, -mesh.dimension), false};
}

}  // namespace suture
