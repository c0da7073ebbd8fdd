#include <suture/base/AgreedDimension.hpp>
#include <suture/base/Errors.hpp>
#include <suture/interface/ContactEntities.hpp>
#include <suture/interface/Directory.hpp>
#include <suture/interface/InterfaceSpace.hpp>

#include <Teuchos_Comm.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>

namespace suture {

InterfaceSpace::InterfaceSpace(CommPtr comm, const InterfaceLayout& layout)
    : comm_(std::move(comm)), localIds_(layout.locals), dimension_(agreedDimension(*comm_, layout.dimension)) {
  if (dimension_ == 0) throw InternalError("no rank knows the dimension of the interface");
  std::vector<GlobalId> touched;
  for (const auto& boundary : layout.boundaries) touched.insert(touched.end(), boundary.begin(), boundary.end());
  // The owner of an unknown must have a local problem with it, not only use it as a partner.
  map_ = Tpetra::createOneToOne(mapOf(comm_, touched));
  touched.insert(touched.end(), layout.partners.begin(), layout.partners.end());
  overlap_ = mapOf(comm_, std::move(touched));
  import_ = Teuchos::rcp(new Import(map_, overlap_));
  ownedRows_.own().resize(overlap_->getNodeNumElements());
  for (int place = 0; place < overlapSize(); ++place) ownedRows_.own()[place] = map_->getLocalElement(overlap_->getGlobalElement(place));

  couplings_.own().reserve(layout.boundaries.size());
  for (const auto& boundary : layout.boundaries) {
    std::vector<int> columns(boundary.size());
    for (std::size_t i = 0; i < boundary.size(); ++i) columns[i] = overlap_->getLocalElement(boundary[i]);
    couplings_.own().emplace_back(std::move(columns));
  }
  relationOf_.assign(ownedRows_->size(), -1);
  unknowns_ = joinUnknowns(overlap_, map_, layout.unknowns);
  exchangeSharers(layout);
  addEntities(layout);
}

void InterfaceSpace::exchangeSharers(const InterfaceLayout& layout) {
  std::vector<std::vector<int>> mine(ownedRows_->size());
  for (std::size_t i = 0; i < couplings_->size(); ++i)
    for (const int place : coupling(static_cast<int>(i)).columns()) mine[place].push_back(layout.locals[i]);
  sharers_ = joinNumbers(overlap_, map_, mine);
}

/// Takes the entities of the layout; an unknown of more than two local problems that is in none of them is a vertex.
void InterfaceSpace::addEntities(const InterfaceLayout& layout) {
  const auto placesOf = [&](const std::vector<GlobalId>& ids) {
    std::vector<int> places;
    for (const GlobalId id : ids)
      if (const int place = overlap_->getLocalElement(id); place >= 0) places.push_back(place);
    return places;
  };
  for (const InterfaceLayout::Entity& entity : layout.entities) {
    InterfaceEntity own{entity.kind, entity.sharers, placesOf(entity.unknowns), placesOf(entity.ends), false};
    if (!own.unknowns.empty()) entities_.own().push_back(std::move(own));
  }
  const std::vector<int> entityOf = entityOfPlaces();
  for (int place = 0; place < overlapSize(); ++place)
    if (sharers(place).size() > 2 && entityOf[place] < 0)
      entities_.own().push_back({EntityKind::Vertex, sharers(place), {place}, {}, false});
  entities_.own().shrink_to_fit();
}

std::vector<int> InterfaceSpace::entityOfPlaces() const {
  std::vector<int> entityOf(ownedRows_->size(), -1);
  for (std::size_t e = 0; e < entities_->size(); ++e)
    for (const int place : entities()[e].unknowns) entityOf[place] = static_cast<int>(e);
  return entityOf;
}

/// Removes unknowns from their entities.
void InterfaceSpace::leaveEntities(const std::vector<char>& leaves) {
  if (std::find(leaves.begin(), leaves.end(), 1) == leaves.end()) return;
  const auto gone = [&](int place) { return leaves[place] != 0; };
  std::vector<InterfaceEntity>& all = entities_.own();
  for (InterfaceEntity& entity : all)
    for (std::vector<int>* places : {&entity.unknowns, &entity.ends})
      places->erase(std::remove_if(places->begin(), places->end(), gone), places->end());
  const auto empty = [](const InterfaceEntity& entity) { return entity.unknowns.empty(); };
  all.erase(std::remove_if(all.begin(), all.end(), empty), all.end());
}

std::shared_ptr<const InterfaceSpace> InterfaceSpace::related(std::vector<InterfaceRelation> relations,
                                                              const std::vector<std::vector<int>>& neighbours) const {
  if (!relations_.empty()) throw InternalError("the space has relations already");
  std::vector<InterfaceRelation> plain;
  std::vector<int> inRows;  // unknowns of relations that are not plain
  std::vector<char> expressed(ownedRows_->size(), 0), named(ownedRows_->size(), 0);
  for (const InterfaceRelation& relation : relations)
    if (relation.others.size() > 1)
      for (const int other : relation.others) named[other] = 1;
  for (const InterfaceRelation& relation : relations) {
    // On a mortar, rows of opposite nodes are rows like the others.
    if (relation.others.size() < 2 && (relation.others.empty() || !named[relation.others[0]])) {
      plain.push_back(relation);
      continue;
    }
    expressed[relation.unknown] = 1;
    inRows.push_back(relation.unknown);
    inRows.insert(inRows.end(), relation.others.begin(), relation.others.end());
  }
  const std::shared_ptr<InterfaceSpace> derived = withRelations(std::move(relations), neighbours);
  if (inRows.empty()) return derived;
  std::vector<std::vector<int>> stretches;  // ended by rows of several terms
  for (const auto& chain : neighbours) {
    stretches.emplace_back();
    for (const int place : chain)
      if (dimension_ == 3)
        stretches.back().push_back(place >= 0 && expressed[place] ? -1 : place);
      else if (!expressed[place])
        stretches.back().push_back(place);
      else if (!stretches.back().empty())
        stretches.emplace_back();
  }
  derived->broken_ = withRelations(std::move(plain), stretches, inRows);
  return derived;
}

std::shared_ptr<const InterfaceSpace> InterfaceSpace::without(const std::vector<int>& places) const {
  auto derived = std::make_shared<InterfaceSpace>(*this);
  std::vector<char> leaves(ownedRows_->size(), 0);
  for (const int place : places) leaves[place] = 1;
  for (InterfaceRelation& relation : derived->relations_) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < relation.others.size(); ++k) {
      if (leaves[relation.others[k]]) continue;
      relation.others[kept] = relation.others[k];
      relation.coefficients[kept++] = relation.coefficients[k];
    }
    relation.others.resize(kept);
    relation.coefficients.resize(kept);
  }
  for (const int place : places) {
    derived->relationOf_[place] = static_cast<int>(derived->relations_.size());
    derived->relations_.push_back({place, {}, {}});
    derived->sharers_.own()[place].clear();
  }
  derived->leaveEntities(leaves);
  if (broken_) derived->broken_ = broken_->without(places);
  return derived;
}

/// \param inRows  unknowns of other relations: vertices if one of these relations joins them to other local problems
std::shared_ptr<InterfaceSpace> InterfaceSpace::withRelations(std::vector<InterfaceRelation> relations,
                                                              const std::vector<std::vector<int>>& neighbours,
                                                              const std::vector<int>& inRows) const {
  auto derived = std::make_shared<InterfaceSpace>(*this);
  derived->relations_ = std::move(relations);
  std::vector<char> isPoint(ownedRows_->size(), 0), joined(ownedRows_->size(), 0), single(ownedRows_->size(), 0),
      leaves(ownedRows_->size(), 0);
  for (const InterfaceEntity& entity : entities())
    for (const int place : entity.kind == EntityKind::Vertex ? entity.unknowns : entity.ends) isPoint[place] = 1;
  for (std::size_t r = 0; r < derived->relations_.size(); ++r) {
    const InterfaceRelation& relation = derived->relations_[r];
    derived->relationOf_[relation.unknown] = static_cast<int>(r);
    leaves[relation.unknown] = 1;
    for (const int other : relation.others) {
      std::vector<int>& all = derived->sharers_.own()[other];
      std::vector<int> both;
      std::set_union(all.begin(), all.end(), sharers(relation.unknown).begin(), sharers(relation.unknown).end(), std::back_inserter(both));
      all = std::move(both);
      joined[other] = 1;
      // Neighbours in a row of several terms have no common displacement.
      if (relation.others.size() > 1 || (dimension_ == 2 && isPoint[relation.unknown])) single[other] = 1;
    }
  }
  for (const InterfaceRelation& relation : derived->relations_) derived->sharers_.own()[relation.unknown].clear();
  for (const int place : inRows)
    if (joined[place]) single[place] = 1;
  for (std::size_t place = 0; place < ownedRows_->size(); ++place) {
    if (!joined[place]) continue;
    const bool changed = derived->sharers(static_cast<int>(place)) != sharers(static_cast<int>(place));
    if (dimension_ == 3) {  // cells determine which of them are on an edge or a face
      if (changed || single[place]) leaves[place] = 1;
      continue;
    }
    // On a line, local problems change at unknowns with more than two of them.
    if ((isPoint[place] && changed) || derived->sharers(static_cast<int>(place)).size() > 2) single[place] = 1;
    if (isPoint[place] && !changed) single[place] = 0;  // keeps its entity
    if (single[place]) leaves[place] = 1;
  }
  derived->leaveEntities(leaves);
  for (InterfaceEntity& found : contactEntities(*derived, neighbours, std::move(single)))
    derived->entities_.own().push_back(std::move(found));
  return derived;
}

GlobalId InterfaceSpace::size() const { return static_cast<GlobalId>(map_->getGlobalNumElements()); }

MultiVectorPtr InterfaceSpace::vector(int columns) const { return Teuchos::rcp(new MultiVector(map_, static_cast<std::size_t>(columns))); }

int InterfaceSpace::mostRows() const {
  int most = 0;
  for (const Coupling& coupling : *couplings_) most = std::max(most, coupling.rows());
  return most;
}

void InterfaceSpace::unfold(LocalView overlap) const {
  for (const InterfaceRelation& relation : relations_) {
    overlap.row(relation.unknown).setZero();
    for (std::size_t k = 0; k < relation.others.size(); ++k)
      overlap.row(relation.unknown) += relation.coefficients[k] * overlap.row(relation.others[k]);
  }
}

void InterfaceSpace::fold(LocalView overlap, const std::vector<InterfaceRelation>* test) const {
  for (const InterfaceRelation& relation : test ? *test : relations_) {
    for (std::size_t k = 0; k < relation.others.size(); ++k)
      overlap.row(relation.others[k]) += relation.coefficients[k] * overlap.row(relation.unknown);
    overlap.row(relation.unknown).setZero();
  }
}

MultiVector& InterfaceSpace::overlapping(std::size_t columns) const {
  if (work_.is_null() || work_->getNumVectors() != columns) work_ = Teuchos::rcp(new MultiVector(overlap_, columns));
  return *work_;
}

void InterfaceSpace::gather(const MultiVector& owned, Matrix& overlap) const {
  MultiVector& target = overlapping(owned.getNumVectors());
  target.doImport(owned, *import_, Tpetra::INSERT);
  overlap = localView(static_cast<const MultiVector&>(target));
  unfold(overlap);
}

void InterfaceSpace::scatterAdd(const Matrix& overlap, MultiVector& owned, const std::vector<InterfaceRelation>* test) const {
  MultiVector& source = overlapping(static_cast<std::size_t>(overlap.cols()));
  auto values = localView(source);
  values = overlap;
  fold(values, test);
  owned.putScalar(0.0);
  owned.doExport(source, *import_, Tpetra::ADD);
}

void InterfaceSpace::sum(Matrix& overlap) const {
  const auto columns = static_cast<std::size_t>(overlap.cols());
  if (sum_.is_null() || sum_->getNumVectors() != columns) sum_ = vector(static_cast<int>(columns));
  scatterAdd(overlap, *sum_);
  gather(*sum_, overlap);
}

void InterfaceSpace::sumDensities(Matrix& overlap) const {
  for (const InterfaceRelation& relation : relations_) {
    if (relation.others.size() == 1)
      overlap.row(relation.others[0]) += relation.coefficients[0] * relation.coefficients[0] * overlap.row(relation.unknown);
    overlap.row(relation.unknown).setZero();
  }
  MultiVector source(overlap_, static_cast<std::size_t>(overlap.cols())), owned(map_, static_cast<std::size_t>(overlap.cols()));
  localView(source) = overlap;
  owned.doExport(source, *import_, Tpetra::ADD);
  source.doImport(owned, *import_, Tpetra::INSERT);
  overlap = localView(static_cast<const MultiVector&>(source));
  for (const InterfaceRelation& relation : relations_)
    if (relation.others.size() == 1) overlap.row(relation.unknown) = overlap.row(relation.others[0]);
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
