#include <suture/base/Errors.hpp>
#include <suture/interface/InterfaceSpace.hpp>

#include <Teuchos_Comm.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>

namespace suture {

InterfaceSpace::InterfaceSpace(CommPtr comm, const std::vector<std::vector<GlobalId>>& boundaries,
                               const std::vector<std::vector<Point>>& points, const std::vector<std::vector<int>>& components)
    : comm_(std::move(comm)) {
  std::vector<Map::global_ordinal_type> touched;
  for (const auto& boundary : boundaries) touched.insert(touched.end(), boundary.begin(), boundary.end());
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  overlap_ = Teuchos::rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(),
                                  Teuchos::ArrayView<const Map::global_ordinal_type>(touched.data(), touched.size()), 0, comm_));
  map_ = Tpetra::createOneToOne(overlap_);
  import_ = Teuchos::rcp(new Import(map_, overlap_));

  points_.resize(touched.size());
  components_.resize(touched.size());
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    std::vector<int> columns;
    for (std::size_t k = 0; k < boundaries[i].size(); ++k) {
      columns.push_back(overlap_->getLocalElement(boundaries[i][k]));
      points_[columns.back()] = points[i][k];
      components_[columns.back()] = components[i][k];
    }
    couplings_.emplace_back(std::move(columns));
  }
}

GlobalId InterfaceSpace::size() const { return static_cast<GlobalId>(map_->getGlobalNumElements()); }

MultiVectorPtr InterfaceSpace::vector(int columns) const { return Teuchos::rcp(new MultiVector(map_, static_cast<std::size_t>(columns))); }

void InterfaceSpace::gather(const MultiVector& owned, Matrix& overlap) const {
  MultiVector target(overlap_, owned.getNumVectors());
  target.doImport(owned, *import_, Tpetra::INSERT);
  overlap = localView(static_cast<const MultiVector&>(target));
}

void InterfaceSpace::scatterAdd(const Matrix& overlap, MultiVector& owned) const {
  MultiVector source(overlap_, static_cast<std::size_t>(overlap.cols()));
  localView(source) = overlap;
  owned.putScalar(0.0);
  owned.doExport(source, *import_, Tpetra::ADD);
}

void InterfaceSpace::sum(Matrix& overlap) const {
  MultiVector owned(map_, static_cast<std::size_t>(overlap.cols()));
  scatterAdd(overlap, owned);
  gather(owned, overlap);
}

Eigen::Map<Matrix, 0, Eigen::OuterStride<>> localView(MultiVector& x) {
  const auto view = x.getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto stride = static_cast<Eigen::Index>(x.getStride());
  return {view.data(), static_cast<Eigen::Index>(x.getLocalLength()), static_cast<Eigen::Index>(x.getNumVectors()),
          Eigen::OuterStride<>(stride)};
}

Eigen::Map<const Matrix, 0, Eigen::OuterStride<>> localView(const MultiVector& x) {
  const auto view = x.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto stride = static_cast<Eigen::Index>(x.getStride());
  return {view.data(), static_cast<Eigen::Index>(x.getLocalLength()), static_cast<Eigen::Index>(x.getNumVectors()),
          Eigen::OuterStride<>(stride)};
}

double dot(const MultiVector& a, const MultiVector& b) {
  Teuchos::Array<double> result(1);
  a.dot(b, result());
  return result[0];
}

}  // namespace suture
