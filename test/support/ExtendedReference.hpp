#pragma once
#include <support/SmallScenes.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>
#include <suture/monolithic/MonolithicSystem.hpp>

#include <Eigen/SparseCore>
#include <Teuchos_DefaultComm.hpp>

#include <array>
#include <functional>
#include <stdexcept>
#include <vector>

namespace suture::scenes {

/// A small scene solved in extended precision, and certified: all equations as one saddle problem with a set of closed pairs, which is
/// changed until no closed pair pulls and no open one penetrates. Data (element stiffnesses, loads, gaps) are those of the program. Only
/// rank 0 has it.
struct ExtendedReference {
  using Real = long double;
  using Entry = Eigen::Triplet<Real>;
  using Sparse = Eigen::SparseMatrix<Real>;
  using Column = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

  Column displacement;  ///< displacement of the mesh's nodes: node-major, Cartesian
  Column force, gap;    ///< force and gap of each pair
  std::vector<char> closed;

  /// Rigid motion of a body that is taken out of rules and gaps before they are used.
  using Motion = std::function<std::array<Real, 2>(int body, const Point& place)>;

  /// \param start  closed pairs to begin with; none: all
  explicit ExtendedReference(const Scene& scene, std::vector<char> start = {}, const Motion& motion = {});
};

}  // namespace suture::scenes
