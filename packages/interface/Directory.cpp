#include <suture/interface/Directory.hpp>
#include <suture/interface/InterfaceSpace.hpp>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

MapPtr mapOf(const CommPtr& comm, std::vector<GlobalId> ids) {
  using GO = Map::global_ordinal_type;
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  const std::vector<GO> sorted(ids.begin(), ids.end());
  return Teuchos::rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(),
                              Teuchos::ArrayView<const GO>(sorted.data(), sorted.size()), 0, comm));
}

/// Exports a sparse matrix, with one row per id and one column per number, from seen rows to owned ones and imports it back.
std::vector<std::vector<int>> joinNumbers(const MapPtr& seen, const MapPtr& owned, const std::vector<std::vector<int>>& mine) {
  using Crs = Tpetra::CrsMatrix<>;
  using GO = Map::global_ordinal_type;
  int last = -1, most = -1;
  for (const auto& numbers : mine)
    for (const int number : numbers) last = std::max(last, number);
  Teuchos::reduceAll(*seen->getComm(), Teuchos::REDUCE_MAX, last, Teuchos::outArg(most));
  const MapPtr columns = Teuchos::rcp(new Map(static_cast<Tpetra::global_size_t>(most + 1), 0, seen->getComm(), Tpetra::LocallyReplicated));
  std::vector<std::size_t> counts(mine.size());
  for (std::size_t k = 0; k < mine.size(); ++k) counts[k] = mine[k].size();
  const auto given = Teuchos::rcp(new Crs(seen, Teuchos::ArrayView<const std::size_t>(counts.data(), counts.size())));
  std::vector<GO> names;
  std::vector<double> ones;
  for (std::size_t k = 0; k < mine.size(); ++k) {
    names.assign(mine[k].begin(), mine[k].end());
    ones.assign(names.size(), 1.0);
    if (!names.empty())
      given->insertGlobalValues(seen->getGlobalElement(static_cast<int>(k)), static_cast<int>(ones.size()), ones.data(), names.data());
  }
  given->fillComplete(columns, owned);
  const auto joined = Tpetra::exportAndFillCompleteCrsMatrix<Crs>(given, Tpetra::Export<>(seen, owned), columns, owned);
  const auto all = Tpetra::importAndFillCompleteCrsMatrix<Crs>(joined, Import(owned, seen), columns, owned);
  std::vector<std::vector<int>> result(mine.size());
  for (std::size_t k = 0; k < mine.size(); ++k) {
    Crs::local_inds_host_view_type places;
    Crs::values_host_view_type values;
    all->getLocalRowView(static_cast<int>(k), places, values);
    for (std::size_t c = 0; c < places.extent(0); ++c) result[k].push_back(static_cast<int>(all->getColMap()->getGlobalElement(places(c))));
    std::sort(result[k].begin(), result[k].end());
  }
  return result;
}

std::vector<InterfaceLayout::Unknown> joinUnknowns(const MapPtr& seen, const MapPtr& owned,
                                                   const std::vector<InterfaceLayout::Unknown>& known) {
  std::vector<GlobalId> ids;
  for (const InterfaceLayout::Unknown& unknown : known) ids.push_back(unknown.id);
  const MapPtr knownMap = mapOf(owned->getComm(), std::move(ids));
  MultiVector source(knownMap, 10), middle(owned, 10), target(seen, 10);
  auto values = localView(source);
  for (const InterfaceLayout::Unknown& unknown : known) {
    const int row = knownMap->getLocalElement(unknown.id);
    for (int k = 0; k < 3; ++k) {
      values(row, k) = unknown.point[k];
      values(row, 3 + k) = unknown.direction[k];
      values(row, 6 + k) = unknown.moment[k];
    }
    values(row, 9) = unknown.flux;
  }
  middle.doExport(source, Tpetra::Export<>(knownMap, owned), Tpetra::INSERT);
  target.doImport(middle, Import(owned, seen), Tpetra::INSERT);
  const auto all = localView(static_cast<const MultiVector&>(target));
  std::vector<InterfaceLayout::Unknown> result;
  result.reserve(all.rows());
  for (int row = 0; row < all.rows(); ++row) {
    InterfaceLayout::Unknown unknown{seen->getGlobalElement(row), {}, {}, {}, all(row, 9)};
    for (int k = 0; k < 3; ++k) {
      unknown.point[k] = all(row, k);
      unknown.direction[k] = all(row, 3 + k);
      unknown.moment[k] = all(row, 6 + k);
    }
    result.push_back(unknown);
  }
  return result;
}

std::vector<int> numberKeys(const CommPtr& comm, const std::vector<GlobalId>& keys, int& count) {
  const MapPtr used = mapOf(comm, keys);
  const MapPtr owned = Tpetra::createOneToOne(used);
  const int mine = static_cast<int>(owned->getNodeNumElements());
  int upToMine = 0;
  Teuchos::scan(*comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(upToMine));
  count = static_cast<int>(owned->getGlobalNumElements());
  MultiVector numbers(owned, 1), seen(used, 1);  // doubles represent these numbers exactly
  auto values = localView(numbers);
  for (int i = 0; i < mine; ++i) values(i, 0) = upToMine - mine + i;
  seen.doImport(numbers, Import(owned, used), Tpetra::INSERT);
  const auto found = localView(static_cast<const MultiVector&>(seen));
  std::vector<int> result;
  result.reserve(keys.size());
  for (const GlobalId key : keys) result.push_back(static_cast<int>(std::lround(found(used->getLocalElement(key), 0))));
  return result;
}

}  // namespace suture
