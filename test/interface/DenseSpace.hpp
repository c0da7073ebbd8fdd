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
/// ranks. By the map alone; of the space's own gather and scatter nothing is used. All functions but place() are collective.
struct DenseSpace {
  const InterfaceSpace& space;
  std::vector<GlobalId> ids;

  explicit DenseSpace(const InterfaceSpace& given) : space(given) {
    Packer packer;
    std::vector<GlobalId> mine;
    for (int i = 0; i < owned(); ++i) mine.push_back(space.map()->getGlobalElement(i));
    packer.put(mine);
    for (const std::string& bytes : allGather(*space.comm(), packer.bytes())) {
      Unpacker unpacker(bytes);
      const auto theirs = unpacker.get<std::vector<GlobalId>>();
      ids.insert(ids.end(), theirs.begin(), theirs.end());
    }
    std::sort(ids.begin(), ids.end());
  }

  int size() const { return int(ids.size()); }
  int owned() const { return int(space.map()->getNodeNumElements()); }
  int place(GlobalId id) const { return int(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin()); }

  MultiVectorPtr vector(const Matrix& values) const {
    const MultiVectorPtr made = space.vector(int(values.cols()));
    auto view = localView(*made);
    for (int i = 0; i < owned(); ++i) view.row(i) = values.row(place(space.map()->getGlobalElement(i)));
    return made;
  }
  Matrix dense(const MultiVector& values) const {
    Matrix mine = Matrix::Zero(size(), int(values.getNumVectors())), sum(mine.rows(), mine.cols());
    const auto view = localView(values);
    for (int i = 0; i < owned(); ++i) mine.row(place(space.map()->getGlobalElement(i))) = view.row(i);
    Teuchos::reduceAll(*space.comm(), Teuchos::REDUCE_SUM, int(mine.size()), mine.data(), sum.data());
    return sum;
  }
  Matrix dense(const Operator& op) const {
    const MultiVectorPtr y = space.vector(size());
    op.apply(*vector(Matrix::Identity(size(), size())), *y);
    return dense(*y);
  }
  /// What gather() makes of unit vectors: the matrix T of a space's relations, all unknowns x all unknowns. Rows that several ranks see
  /// must agree; `spread` is by how much they do not.
  Matrix gathered(double* spread = nullptr) const {
    Matrix seen;
    space.gather(*vector(Matrix::Identity(size(), size())), seen);
    Matrix least = Matrix::Constant(size(), size(), 1e300), most = -least, allLeast(size(), size()), allMost(size(), size());
    for (int i = 0; i < seen.rows(); ++i) {
      const int row = place(space.id(i));
      least.row(row) = seen.row(i);
      most.row(row) = seen.row(i);
    }
    Teuchos::reduceAll(*space.comm(), Teuchos::REDUCE_MIN, int(least.size()), least.data(), allLeast.data());
    Teuchos::reduceAll(*space.comm(), Teuchos::REDUCE_MAX, int(most.size()), most.data(), allMost.data());
    if (spread) *spread = (allMost - allLeast).cwiseAbs().maxCoeff();
    return allLeast;
  }
};

}  // namespace suture::blocks
