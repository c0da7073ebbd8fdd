#include <suture/algebra/WorkSpace.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/precond/Bddc.hpp>
#include <suture/precond/coarse/ClusterCoarse.hpp>
#include <suture/precond/coarse/CoarseClusters.hpp>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <map>

namespace suture {

namespace {

/// Elements of the clusters of this rank, by cluster; within one by id, so that sums do not depend on where elements come from. Collective.
std::map<int, std::vector<CoarseElement>> sendToClusters(const Comm& comm, const std::vector<CoarseElement>& elements,
                                                         const CoarseClusters& clusters) {
  std::map<int, Packer> packers;
  for (const int rank : clusters.neighbours) packers[rank];
  for (std::size_t i = 0; i < elements.size(); ++i) {
    Packer& packer = packers.at(clusters.rankOf[i]);
    packer.put(clusters.clusterOf[i]);
    pack(elements[i], packer);
  }
  std::map<int, std::string> bytes;
  for (const auto& [rank, packer] : packers) bytes[rank] = packer.bytes();
  std::map<int, std::vector<CoarseElement>> result;
  for (const auto& [rank, message] : swapWithNeighbours(comm, bytes))
    for (Unpacker reader(message); !reader.done();) {
      const int cluster = reader.get<int>();
      result[cluster].push_back(unpackCoarseElement(reader));
    }
  for (auto& entry : result)
    std::sort(entry.second.begin(), entry.second.end(), [](const CoarseElement& a, const CoarseElement& b) { return a.id < b.id; });
  return result;
}

}  // namespace

ClusterCoarse::ClusterCoarse(CommPtr comm, const CoarseElements& coarse, int locals, const CoarseOptions& levels)
    : comm_(std::move(comm)), size_(coarse.size) {
  const CoarseClusters clusters = coarseClusters(*comm_, coarse, levels.clusters);
  count_ = clusters.count;
  const std::map<int, std::vector<CoarseElement>> members = sendToClusters(*comm_, coarse.elements, clusters);
  LocalProblems problems;
  collectively(*comm_, "factoring the clusters of the coarse problem", [&] {
    for (std::size_t k = 0; k < clusters.layout.locals.size(); ++k) {
      const int id = clusters.layout.locals[k];
      problems_.push_back(std::make_shared<ClusterProblem>(id, clusters.layout.boundaries[k], members.at(id)));
      problems.push_back(problems_.back());
    }
  });
  space_ = std::make_shared<InterfaceSpace>(comm_, clusters.layout);
  if (space_->size() == 0) return;  // clusters that do not touch

  CoarseOptions next = levels;
  next.clusters = 0;
  // As deep as there is something to gain: clusters that are hardly fewer than their members, and a level forced upon few, end it.
  if (levels.above == 0 || 2 * count_ > locals) next.above = std::max(count_, 1);
  const auto matrix = Teuchos::rcp(new InterfaceOperator(space_, std::move(problems)));
  const auto bddc = Teuchos::rcp(new Bddc(std::make_unique<StiffnessDiagonalWeighting>(), rigidModeConstraints(), next));
  bddc->initialize(space_);
  // Closed pairs whose equations name four unknowns each leave a cluster of one side free in ways that no edge constraint knows.
  try {
    bddc->compute(matrix);
  } catch (const NumericalError& error) {
    throw InputError("Preconditioner/BDDC/Coarse Level Above", std::string("the coarse problem of ") + std::to_string(locals) +
                                                                   " local problems cannot be divided into " + std::to_string(count_) +
                                                                   " clusters (" + error.what() + "). With " + std::to_string(locals) +
                                                                   " or more it is solved exactly; or choose other Coarse Clusters");
  }
  inverse_ = std::make_unique<ChebyshevInverse>(matrix, bddc, levels.accuracy);
  right_ = space_->vector();
  left_ = space_->vector();
}

const Vector& ClusterCoarse::solve(const Vector& mine) const {
  load_.resize(size_);
  answer_.setZero(size_);
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, size_, mine.data(), load_.data());
  const auto loadsOf = [&](const ClusterProblem& problem, LocalView interior) {
    for (std::size_t i = 0; i < problem.interior().size(); ++i) interior(static_cast<int>(i), 0) = load_(problem.interior()[i]);
  };
  overlap_.setZero(space_->overlapSize(), 1);
  for (std::size_t k = 0; k < problems_.size(); ++k) {
    const ClusterProblem& problem = *problems_[k];
    WorkSpace interior(static_cast<int>(problem.interior().size()), 1, interior_), flux(problem.size(), 1, trace_);
    loadsOf(problem, interior.values);
    problem.condense(interior.values, flux.values);
    space_->coupling(static_cast<int>(k)).addTransposed(flux.values, overlap_);
  }
  if (inverse_) {
    space_->scatterAdd(overlap_, *right_);
    {
      auto values = localView(*right_);
      for (int row = 0; row < values.rows(); ++row) values(row, 0) += load_(static_cast<int>(space_->map()->getGlobalElement(row)));
    }
    inverse_->apply(*right_, *left_);
    space_->gather(*left_, overlap_);
    const auto values = localView(static_cast<const MultiVector&>(*left_));
    for (int row = 0; row < values.rows(); ++row) answer_(static_cast<int>(space_->map()->getGlobalElement(row))) = values(row, 0);
  }
  for (std::size_t k = 0; k < problems_.size(); ++k) {
    const ClusterProblem& problem = *problems_[k];
    WorkSpace interior(static_cast<int>(problem.interior().size()), 1, interior_), trace(problem.size(), 1, trace_);
    loadsOf(problem, interior.values);
    space_->coupling(static_cast<int>(k)).restrictTo(overlap_, trace.values);
    problem.recover(trace.values, interior.values);
    for (std::size_t i = 0; i < problem.interior().size(); ++i) answer_(problem.interior()[i]) = interior.values(static_cast<int>(i), 0);
  }
  load_ = answer_;
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, size_, load_.data(), answer_.data());
  return answer_;
}

}  // namespace suture
