#include <suture/algebra/DisjointSets.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/RigidValues.hpp>
#include <suture/motion/BodyParts.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace suture {

namespace {

struct Extent {
  int id, body;
  double low[3], high[3];
};

}  // namespace

Vector along(const RigidPart& part, const Point& point, const Point& direction, int dimension) {
  return part.at(point, dimension).transpose() * Eigen::Map<const Vector>(direction.data(), dimension);
}

BodyParts::BodyParts(const Comm& comm, const std::vector<const SubdomainMesh*>& meshes, int dimension) {
  findParts(comm, meshes, dimension);
  findMotions(comm, meshes, dimension);
}

/// Finds the parts: subdomains that share nodes belong to the same part.
void BodyParts::findParts(const Comm& comm, const std::vector<const SubdomainMesh*>& meshes, int dimension) {
  Packer packer;
  for (const SubdomainMesh* given : meshes) {
    const SubdomainMesh& mesh = *given;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Extent extent{mesh.id, mesh.body, {infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (int node = 0; node < mesh.nodes(); ++node) {
      const Point p = mesh.point(node);
      for (int k = 0; k < 3; ++k) {
        extent.low[k] = std::min(extent.low[k], p[k]);
        extent.high[k] = std::max(extent.high[k], p[k]);
      }
    }
    std::vector<int> neighbours(mesh.sharedWith);
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    packer.put(extent);
    packer.put(neighbours);
  }
  std::map<int, Extent> extents;
  std::vector<std::pair<int, int>> joins;
  for (const std::string& bytes : allGather(comm, packer.bytes())) {
    Unpacker unpacker(bytes);
    while (!unpacker.done()) {
      const auto extent = unpacker.get<Extent>();
      extents.emplace(extent.id, extent);
      for (const int other : unpacker.get<std::vector<int>>()) joins.emplace_back(extent.id, other);
    }
  }
  DisjointSets sets(extents.empty() ? 0 : extents.rbegin()->first + 1);
  for (const auto& [one, other] : joins) sets.join(one, other);
  std::map<int, int> partOfRoot;
  std::vector<Extent> boxes;
  std::map<int, int> partOfSubdomain;
  for (const auto& [id, extent] : extents) {
    const auto [at, isNew] = partOfRoot.emplace(sets.lowest(id), static_cast<int>(boxes.size()));
    if (isNew) boxes.push_back(extent);
    partOfSubdomain[id] = at->second;
    Extent& box = boxes[at->second];
    for (int k = 0; k < 3; ++k) {
      box.low[k] = std::min(box.low[k], extent.low[k]);
      box.high[k] = std::max(box.high[k], extent.high[k]);
    }
  }
  for (const Extent& box : boxes) {
    RigidPart part;
    part.body = box.body;
    double square = 0.0;
    for (int k = 0; k < dimension; ++k) {
      part.centre[k] = 0.5 * (box.low[k] + box.high[k]);
      square += std::pow(box.high[k] - box.low[k], 2);
    }
    part.radius = 0.5 * std::sqrt(square);
    parts.push_back(std::move(part));
  }
  for (const SubdomainMesh* mesh : meshes) partOf.push_back(partOfSubdomain.at(mesh->id));
}

namespace {

/// Rows of all ranks by part. Each rank compresses its rows to one triangle per part. \param rows  amplitudes and a value
std::vector<Matrix> gathered(const Comm& comm, const std::map<int, std::vector<Vector>>& rows, std::size_t parts, int amplitudes) {
  Packer packer;
  for (const auto& [part, all] : rows) {
    if (all.empty()) continue;
    Matrix matrix(static_cast<Eigen::Index>(all.size()), amplitudes + 1);
    for (std::size_t i = 0; i < all.size(); ++i) matrix.row(static_cast<Eigen::Index>(i)) = all[i].transpose();
    // Scale values to the order of the motions: the round-off of large values would hide the constraints of a part.
    Matrix scaled = matrix;
    if (const double size = matrix.col(amplitudes).cwiseAbs().maxCoeff(); size > 0.0) scaled.col(amplitudes) /= size;
    const Matrix triangle = orthonormalBasis(scaled, 1e-15).transpose() * matrix;
    packer.put(part);
    packer.put(std::vector<double>(triangle.data(), triangle.data() + triangle.size()));
  }
  std::vector<Matrix> held(parts, Matrix(0, amplitudes + 1));
  for (const std::string& bytes : allGather(comm, packer.bytes())) {
    Unpacker unpacker(bytes);
    while (!unpacker.done()) {
      Matrix& own = held[static_cast<std::size_t>(unpacker.get<int>())];
      const auto values = unpacker.get<std::vector<double>>();
      const Eigen::Map<const Matrix> triangle(values.data(), static_cast<Eigen::Index>(values.size()) / (amplitudes + 1), amplitudes + 1);
      Matrix both(own.rows() + triangle.rows(), amplitudes + 1);
      both << own, triangle;
      own = both;
    }
  }
  return held;
}

}  // namespace

void BodyParts::findMotions(const Comm& comm, const std::vector<const SubdomainMesh*>& meshes, int dimension) {
  const int amplitudes = rigidMotions(dimension);
  std::map<int, std::vector<Vector>> rows, fixed;  // all rows, and those of prescribed components
  sprung.assign(parts.size(), 0);
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const SubdomainMesh& mesh = *meshes[s];
    const RigidPart& part = parts[partOf[s]];
    std::vector<Vector>& own = rows[partOf[s]];
    const auto add = [&](const Vector& row, double value) {
      own.emplace_back(amplitudes + 1);
      own.back() << row, value;
    };
    const RigidGroupNodes rigid(mesh.rigidGroups, dimension);
    for (const NodeRule& rule : mesh.rules)
      for (int k = 0; k < dimension; ++k)
        if (rule.fixed[k]) {
          Vector row = along(part, mesh.point(rule.node), rule.axes[k], dimension);
          rigid.forEachMaster(rule.node, k, [&](int node, int component, double coefficient) {
            row -= coefficient * along(part, mesh.point(node), rigid.axis(node, component), dimension);
          });
          add(row, rule.value[k]);
          fixed[partOf[s]].push_back(own.back());
        }
    for (const SpringDirection& spring : mesh.springs) {
      add(along(part, mesh.point(spring.node), spring.direction, dimension), 0.0);
      sprung[partOf[s]] = 1;
    }
    if (mesh.axisymmetric)  // no radial translation, no rotation in the meridian plane
      for (const int k : {0, 2}) {
        add(Vector::Unit(amplitudes, k), 0.0);
        fixed[partOf[s]].push_back(own.back());
      }
  }
  const std::vector<Matrix> held = gathered(comm, rows, parts.size(), amplitudes);
  std::vector<int> mine(sprung.begin(), sprung.end()), all = mine;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), all.data());
  sprung.assign(all.begin(), all.end());
  const bool anySprung = std::find(all.begin(), all.end(), 1) != all.end();
  const std::vector<Matrix> stopped = anySprung ? gathered(comm, fixed, parts.size(), amplitudes) : held;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Matrix motion = held[p].leftCols(amplitudes);
    parts[p].free = nullSpace(motion);
    const Matrix across =
        parts[p].free.cols() == 0 ? Matrix(Matrix::Identity(amplitudes, amplitudes)) : nullSpace(parts[p].free.transpose());
    lift.push_back(across.cols() > 0 && motion.rows() > 0 ? Vector(across * leastSquares(motion * across, held[p].rightCols(1)))
                                                          : Vector(Vector::Zero(amplitudes)));
    parts[p].soft = Matrix(amplitudes, 0);
    if (sprung[p] && across.cols() > 0) parts[p].soft = across * nullSpace(stopped[p].leftCols(amplitudes) * across);
  }
}

}  // namespace suture
