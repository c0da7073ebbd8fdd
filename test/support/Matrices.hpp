#pragma once
#include <suture/base/Types.hpp>

#include <support/DenseAlgebra.hpp>

#include <Eigen/SparseCore>
#include <initializer_list>
#include <vector>

/// Sparse matrices for tests of factorisations, written from formulas, and the dense algebra that they are compared with.
namespace suture::matrices {

using Sparse = Eigen::SparseMatrix<double>;

// Bilinear squares of an elastic body (both Lame constants 1), written here from the formulas: nodes (nx+1) x (ny+1), nothing held; its
// kernel is the three rigid modes. Scaled by 24 all entries are whole numbers, so that translations are in the kernel without round-off.
Sparse floatingBody(int nx, int ny);

// Coordinates of the node of each unknown.
std::vector<Point> placesOfBody(int nx, int ny);

// Random coordinates, for unknowns without a position.
std::vector<Point> randomPlaces(int n, unsigned seed);

Sparse randomDefinite(int n, unsigned seed);

// A dense matrix by its rows.
Matrix rows(std::initializer_list<std::initializer_list<double>> values);

using dense::difference;
// With the last unknowns as boundary.
inline Matrix denseSchur(const Matrix& a, int trailing) { return dense::denseSchur(a, dense::range(trailing, int(a.rows()) - trailing)); }

}  // namespace suture::matrices
