#include <suture/algebra/WorkSpace.hpp>
#include <suture/base/Collective.hpp>
#include <suture/precond/Bddc.hpp>
#include <suture/precond/Mechanisms.hpp>
#include <suture/precond/coarse/ClusterCoarse.hpp>
#include <suture/precond/coarse/CoarseClusters.hpp>

#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <sstream>

namespace suture {

ClusterCoarse::ClusterCoarse(const CommPtr& comm, CoarseElements coarse, int locals, const CoarseOptions& levels)
    : size_(coarse.size), accuracy_(levels.accuracy) {
  const CoarseClusters clusters = coarseClusters(comm, coarse, locals, levels.clusters);
  count_ = clusters.count;
  coarse.unknowns = std::vector<InterfaceLayout::Unknown>();
  const std::vector<int> names = namesIn(coarse.elements);
  space_ = std::make_shared<InterfaceSpace>(comm, clusters.layout);
  LocalProblems problems;
  collectively(*comm, "factoring the clusters of the coarse problem", [&] {
    const std::vector<int>& ids = clusters.layout.locals;
    std::vector<std::vector<CoarseElement>> members(ids.size());
    for (std::size_t i = 0; i < coarse.elements.size(); ++i) members[clusters.clusterOf[i]].push_back(std::move(coarse.elements[i]));
    coarse.elements = std::vector<CoarseElement>();
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const std::vector<CoarseElement> own = std::move(members[k]);  // freed with its cluster
      problems_.push_back(std::make_shared<ClusterProblem>(ids[k], clusters.layout.boundaries[k], own,
                                                           rigidMotionsOf(*space_, space_->coupling(static_cast<int>(k)).columns(), true)));
      problems.push_back(problems_.back());
      interiors_.push_back(placesAmong(names, problems_.back()->interior()));
    }
  });
  if (space_->size() == 0) return;  // the clusters share no unknowns
  for (int place = 0; place < space_->overlapSize(); ++place) boundary_.push_back(static_cast<int>(space_->id(place)));
  boundary_ = placesAmong(names, boundary_);

  CoarseOptions next = levels;
  next.clusters = 0;
  // Recursion ends when it does not pay: the number of clusters exceeds half that of their members, or this level was forced.
  if (levels.above == 0 || 2 * count_ > locals) next.above = std::max(count_, 1);
  const auto matrix = Teuchos::rcp(new InterfaceOperator(space_, std::move(problems)));
  const auto bddc = Teuchos::rcp(new Bddc(next));
  bddc->initialize(space_);
  bddc->compute(matrix);
  inverse_ = std::make_unique<ChebyshevInverse>(matrix, bddc, levels.accuracy);
  further_ = bddc->remark();
  right_ = space_->vector();
  left_ = space_->vector();
}

std::string ClusterCoarse::remark() const {
  if (!inverse_ || !inverse_->isClamped()) return further_;
  std::ostringstream text;
  text.precision(2);
  text << "coarse problem: the " << count_ << " clusters have a condition number of " << inverse_->largest() << ", so that "
       << inverse_->steps() << " Chebyshev steps do not reach Coarse Accuracy " << accuracy_
       << "; expect more iterations. A larger Coarse Level Above factors the coarse problem instead";
  if (!further_.empty()) text << "; " << further_;
  return text.str();
}

const Vector& ClusterCoarse::solve(const Vector& mine) const {
  answer_.resize(mine.size());
  const auto loadsOf = [&](std::size_t k, LocalView interior) {
    for (std::size_t i = 0; i < interiors_[k].size(); ++i) interior(static_cast<int>(i), 0) = mine(interiors_[k][i]);
  };
  overlap_.resize(space_->overlapSize(), 1);
  for (int place = 0; place < space_->overlapSize(); ++place) overlap_(place, 0) = mine(boundary_[place]);
  for (std::size_t k = 0; k < problems_.size(); ++k) {
    const ClusterProblem& problem = *problems_[k];
    WorkSpace interior(static_cast<int>(interiors_[k].size()), 1, interior_), flux(problem.size(), 1, trace_);
    loadsOf(k, interior.values);
    problem.condense(interior.values, flux.values);
    space_->coupling(static_cast<int>(k)).addTransposed(flux.values, overlap_);
  }
  if (inverse_) {
    space_->scatterAdd(overlap_, *right_);
    inverse_->apply(*right_, *left_);
    space_->gather(*left_, overlap_);
    for (int place = 0; place < space_->overlapSize(); ++place) answer_(boundary_[place]) = overlap_(place, 0);
  }
  for (std::size_t k = 0; k < problems_.size(); ++k) {
    const ClusterProblem& problem = *problems_[k];
    WorkSpace interior(static_cast<int>(interiors_[k].size()), 1, interior_), trace(problem.size(), 1, trace_);
    loadsOf(k, interior.values);
    space_->coupling(static_cast<int>(k)).restrictTo(overlap_, trace.values);
    problem.recover(trace.values, interior.values);
    for (std::size_t i = 0; i < interiors_[k].size(); ++i) answer_(interiors_[k][i]) = interior.values(static_cast<int>(i), 0);
  }
  return answer_;
}

}  // namespace suture
