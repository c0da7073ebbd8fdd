#include <interface/DenseSpace.hpp>

namespace suture::blocks {

DenseSpace::DenseSpace(const InterfaceSpace& given) : space(given) {
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

MultiVectorPtr DenseSpace::vector(const Matrix& values) const {
  const MultiVectorPtr made = space.vector(int(values.cols()));
  auto view = localView(*made);
  for (int i = 0; i < owned(); ++i) view.row(i) = values.row(place(space.map()->getGlobalElement(i)));
  return made;
}

Matrix DenseSpace::dense(const MultiVector& values) const {
  Matrix mine = Matrix::Zero(size(), int(values.getNumVectors())), sum(mine.rows(), mine.cols());
  const auto view = localView(values);
  for (int i = 0; i < owned(); ++i) mine.row(place(space.map()->getGlobalElement(i))) = view.row(i);
  Teuchos::reduceAll(*space.comm(), Teuchos::REDUCE_SUM, int(mine.size()), mine.data(), sum.data());
  return sum;
}

Matrix DenseSpace::dense(const Operator& op) const {
  const MultiVectorPtr y = space.vector(size());
  op.apply(*vector(Matrix::Identity(size(), size())), *y);
  return dense(*y);
}

Matrix DenseSpace::gathered(double* spread) const {
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

}  // namespace suture::blocks
