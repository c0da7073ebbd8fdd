#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/precond/coarse/CoarseElement.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <numeric>

namespace suture {

std::vector<int> namesIn(const std::vector<CoarseElement>& elements) {
  std::vector<int> names;
  for (const CoarseElement& element : elements) names.insert(names.end(), element.unknowns.begin(), element.unknowns.end());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::vector<int> placesAmong(const std::vector<int>& names, const std::vector<int>& numbers) {
  std::vector<int> places;
  places.reserve(numbers.size());
  for (const int number : numbers) places.push_back(static_cast<int>(std::lower_bound(names.begin(), names.end(), number) - names.begin()));
  return places;
}

void pack(const CoarseElement& element, Packer& packer) {
  packer.put(element.id);
  packer.put(element.unknowns);
  std::vector<double> lower;
  for (Eigen::Index j = 0; j < element.matrix.cols(); ++j)
    lower.insert(lower.end(), element.matrix.col(j).data() + j, element.matrix.col(j).data() + element.matrix.rows());
  packer.put(lower);
}

CoarseElement unpackCoarseElement(Unpacker& unpacker) {
  CoarseElement element;
  unpacker.get(element.id);
  unpacker.get(element.unknowns);
  const auto lower = unpacker.get<std::vector<double>>();
  const auto size = static_cast<Eigen::Index>(element.unknowns.size());
  element.matrix.resize(size, size);
  auto from = lower.begin();
  for (Eigen::Index j = 0; j < size; from += size - j, ++j) {
    std::copy_n(from, size - j, element.matrix.col(j).data() + j);
    element.matrix.row(j).tail(size - j) = element.matrix.col(j).tail(size - j).transpose();
  }
  return element;
}

std::vector<CoarseElement> gatherCoarseElements(const Comm& comm, std::vector<CoarseElement> mine, bool everywhere) {
  std::vector<CoarseElement> all;
  if (comm.getSize() == 1) {
    all = std::move(mine);
  } else {
    Packer packer;
    for (const CoarseElement& element : mine) pack(element, packer);
    for (const std::string& bytes : everywhere ? allGather(comm, packer.bytes()) : gatherOnRoot(comm, packer.bytes()))
      for (Unpacker unpacker(bytes); !unpacker.done();) all.push_back(unpackCoarseElement(unpacker));
  }
  std::stable_sort(all.begin(), all.end(), [](const CoarseElement& a, const CoarseElement& b) { return a.id < b.id; });
  return all;
}

SparseMatrix assembleCoarseElements(int size, const std::vector<CoarseElement>& elements) {
  // Element columns of each unknown, in the order of elements.
  struct Column {
    int element, column;
  };
  std::vector<int> start(size + 1, 0);
  for (const CoarseElement& element : elements)
    for (const int unknown : element.unknowns) ++start[unknown + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Column> columns(start.back());
  std::vector<int> next(start.begin(), start.end() - 1);
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (std::size_t c = 0; c < elements[e].unknowns.size(); ++c)
      columns[next[elements[e].unknowns[c]]++] = {static_cast<int>(e), static_cast<int>(c)};

  Vector sum = Vector::Zero(size);
  std::vector<int> lastColumn(size, -1), rows;  // last column in which each row occurred; rows of the current column
  SparseMatrix matrix(size, size);
  Eigen::Index most = 0;
  for (const CoarseElement& element : elements) most += element.matrix.size();
  matrix.reserve(most);
  for (int j = 0; j < size; ++j) {
    rows.clear();
    for (int k = start[j]; k < start[j + 1]; ++k) {
      const CoarseElement& element = elements[columns[k].element];
      const int own = columns[k].column;
      for (int i = 0; i < static_cast<int>(element.unknowns.size()); ++i) {
        const int row = element.unknowns[i];
        if (lastColumn[row] != j) {
          lastColumn[row] = j;
          sum(row) = 0.0;
          rows.push_back(row);
        }
        sum(row) += element.matrix(std::max(i, own), std::min(i, own));
      }
    }
    std::sort(rows.begin(), rows.end());
    matrix.startVec(j);
    for (const int row : rows) matrix.insertBack(row, j) = sum(row);
  }
  matrix.finalize();
  return matrix;
}

}  // namespace suture
