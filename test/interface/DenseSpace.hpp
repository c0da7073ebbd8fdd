#pragma once
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Operator.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/interface/InterfaceSpace.hpp>

#include <algorithm>

namespace suture::blocks {

/// Vectors and operators of an interface space as dense ones, whose rows are all unknowns, ascending by id: the same on any number of
/// ranks. Built from the map alone, without the space's own gather and scatter. All functions except place() are collective.
struct DenseSpace {
  const InterfaceSpace& space;
  std::vector<GlobalId> ids;

  explicit DenseSpace(const InterfaceSpace& given);

  int size() const { return int(ids.size()); }
  int owned() const { return int(space.map()->getNodeNumElements()); }
  int place(GlobalId id) const { return int(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin()); }

  MultiVectorPtr vector(const Matrix& values) const;
  Matrix dense(const MultiVector& values) const;
  Matrix dense(const Operator& op) const;
  /// Result of gather() for unit vectors: the matrix T of a space's relations, all unknowns x all unknowns. Rows that several ranks see
  /// must agree; `spread` is the largest difference.
  Matrix gathered(double* spread = nullptr) const;
};

}  // namespace suture::blocks
