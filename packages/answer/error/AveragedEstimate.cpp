#include <Eigen/QR>
#include <suture/answer/error/AveragedEstimate.hpp>
#include <suture/answer/error/PatchExchange.hpp>
#include <suture/answer/verdict/Findings.hpp>
#include <suture/base/Collective.hpp>
#include <suture/elasticity/ElementStress.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace suture {

namespace {

// Stresses below this multiple of the round-off of displacements and of initial stresses count as zero.
constexpr double kRounding = 1e3;
// Stresses below this multiple of the solver's tolerance, relative to earlier load steps, count as zero.
constexpr double kUnsolved = 100.0;

/// Sampling points of the stress of a cell, and the multilinear field through the samples.
struct Samples {
  const ReferenceElement* points = nullptr;
  int vertices = 0;
  Matrix shapes;      ///< vertices x points: shape functions of the cell of order 1
  Matrix toVertices;  ///< points x vertices: least squares
};

Cell linearCell(Cell cell) {
  for (int c = 0; c < kCells; ++c) {
    const CellInfo& other = cellInfo(static_cast<Cell>(c));
    if (other.order == 1 && other.dimension == cellInfo(cell).dimension && other.vertices == cellInfo(cell).vertices)
      return static_cast<Cell>(c);
  }
  throw InternalError("no first-order cell with the vertices of a " + cellInfo(cell).name);
}

Samples makeSamples(Cell cell) {
  const Cell linear = linearCell(cell);
  Samples all;
  all.points = &referenceElement(cell, isSimplex(cell) ? Rule::Sampling : Rule::Stiffness);
  all.vertices = cellInfo(cell).vertices;
  all.shapes.resize(all.vertices, all.points->points);
  for (int q = 0; q < all.points->points; ++q) {
    ReferencePoint at{};
    std::copy_n(all.points->placeAt(q), cellInfo(cell).dimension, at.begin());
    ShapeJet jets[kMostCellNodes];
    shapeJets(linear, at, jets);
    for (int v = 0; v < all.vertices; ++v) all.shapes(v, q) = jets[v].value;
  }
  all.toVertices = Matrix(all.shapes).completeOrthogonalDecomposition().pseudoInverse();
  return all;
}

const Samples& samplesOf(Cell cell) {
  static std::array<Samples, kCells> tables;
  Samples& own = tables[static_cast<std::size_t>(cell)];
  if (!own.points) own = makeSamples(cell);
  return own;
}

/// Squares of energy norms.
struct Norms {
  double error = 0.0, solution = 0.0;
  double rounding = 0.0;  ///< possible contribution of round-off, of displacements and initial stresses, to the solution
};

/// Stresses of one block at the sampling points of its elements. \tparam D  dimension
template <int D>
class SampledStresses {
 public:
  SampledStresses(const SubdomainMesh& mesh, const ElasticModel& model, const VertexPatches& patches)
      : mesh_(mesh), model_(model), patches_(patches) {}

  /// Samples all elements. Returns the sums at the patches, weighted by the elements' sizes, and the sums of these sizes: (components + 1)
  /// x patches.
  Matrix sample(const Vector& displacement, Norms& norms) {
    const InitialState initial(model_, mesh_.body);
    Matrix sums = Matrix::Zero(components + 1, patches_.count());
    for (int e = 0; e < mesh_.elements(); ++e) {
      const Samples& samples = samplesOf(mesh_.cells[e]);
      const HookesLaw<D>& law = lawOf(e);
      ElementStress<D> element(mesh_, e, *samples.points, law, displacement, initial);
      double size = 0.0, largest = 0.0;
      for (const int node : mesh_.nodesOf(e))
        for (int k = 0; k < D; ++k) largest = std::max(largest, std::abs(displacement[D * node + k]));
      const std::size_t begin = samples_.size();
      for (int q = 0; q < samples.points->points; ++q) {
        element.at(q);
        const double measure = element.map().measure();
        const StressVector<D> stress = element.stress();
        addNorms(element, law, stress, measure, largest, norms);
        samples_.insert(samples_.end(), stress.data(), stress.data() + components);
        samples_.push_back(measure);
        size += measure;
      }
      const Span<const int> patches = patches_.of(e);
      if (samples.points->points == 1) {
        for (const int patch : patches) add(&samples_[begin], size, sums.col(patch).data());
        continue;
      }
      const Stresses own = stressesAt(begin, samples.points->points).lazyProduct(samples.toVertices);
      for (int v = 0; v < samples.vertices; ++v) add(own.col(v).data(), size, sums.col(patches[v]).data());
    }
    return sums;
  }

  /// Adds the norm of the samples minus the averages, linear within an element. \param sums  of sample(), over all blocks
  void addErrors(const Matrix& sums, Norms& norms) {
    std::size_t at = 0;
    Stresses averages;
    for (int e = 0; e < mesh_.elements(); ++e) {
      const Samples& samples = samplesOf(mesh_.cells[e]);
      const int count = samples.points->points;
      const HookesLaw<D>& law = lawOf(e);
      const Span<const int> patches = patches_.of(e);
      averages.resize(components, samples.vertices);
      for (int v = 0; v < samples.vertices; ++v) {
        const double* sum = sums.col(patches[v]).data();
        averages.col(v) = Eigen::Map<const StressVector<D>>(sum) / sum[components];
      }
      const auto sample = [&](int q) { return Eigen::Map<const StressVector<D>>(&samples_[at + std::size_t(q * width)]); };
      const auto measure = [&](int q) { return samples_[at + std::size_t(q * width + components)]; };
      if (count == 1) {  // a linear difference on a simplex: exact mass matrix
        StressVector<D> all = StressVector<D>::Zero();
        double squares = 0.0;
        for (int v = 0; v <= D; ++v) {
          const StressVector<D> difference = averages.col(v) - sample(0);
          all += difference;
          squares += law.complementary(difference);
        }
        norms.error += measure(0) / ((D + 1.0) * (D + 2.0)) * (squares + law.complementary(all));
      } else {
        for (int q = 0; q < count; ++q)
          norms.error += measure(q) * law.complementary(averages.lazyProduct(samples.shapes.col(q)) - sample(q));
      }
      at += std::size_t(count) * width;
    }
  }

 private:
  static constexpr int components = stressComponents<D>, width = components + 1;
  using Stresses = Eigen::Matrix<double, components, Eigen::Dynamic, Eigen::ColMajor, components, 8>;
  using Columns = Eigen::Map<const Eigen::Matrix<double, components, Eigen::Dynamic>, 0, Eigen::OuterStride<width>>;

  static void add(const double* stress, double size, double* sum) {
    for (int k = 0; k < components; ++k) sum[k] += size * stress[k];
    sum[components] += size;
  }

  const HookesLaw<D>& lawOf(int element) {
    const Material& material = model_.materialOf(mesh_, element, mesh_.body);
    if (&material != last_) law_ = HookesLaw<D>(material, model_.plane);
    last_ = &material;
    return law_;
  }

  /// Stresses at an element's sampling points. \param begin  their offset in samples_
  Columns stressesAt(std::size_t begin, int count) const { return Columns(&samples_[begin], components, count); }

  /// Norms of the solution, without the stress of initial states where displacements cause a stress. \param largest  displacement
  static void addNorms(const ElementStress<D>& element, const HookesLaw<D>& law, const StressVector<D>& stress, double measure,
                       double largest, Norms& norms) {
    const StressVector<D> own = element.isInitial() ? element.ofDisplacement() : stress;
    norms.solution += measure * law.complementary(own);
    if (element.isInitial()) norms.rounding += unitRoundoff * unitRoundoff * measure * law.complementary(stress - own);
    double steepness = 0.0;
    for (int k = 0; k < D; ++k) steepness += std::abs(element.map().gradient(0)[k]);
    const double strain = unitRoundoff * steepness * largest;
    norms.rounding += measure * law.normal() * strain * strain;
  }

  const SubdomainMesh& mesh_;
  const ElasticModel& model_;
  const VertexPatches& patches_;
  std::vector<double> samples_;  // stress and measure at each point of the elements
  const Material* last_ = nullptr;
  HookesLaw<D> law_;
};

template <int D>
double estimateOf(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                  const std::vector<Vector>& displacement, const EarlierEnergy& earlier) {
  std::vector<VertexPatches> patches;
  std::vector<SampledStresses<D>> stresses;
  std::vector<Matrix> sums;
  Norms norms;
  collectively(comm, "estimating the error of the mesh", [&] {
    patches.reserve(meshes.size());
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const SubdomainMesh& mesh = meshes[i];
      patches.emplace_back(mesh, [&](int element) -> const Material& { return model.materialOf(mesh, element, mesh.body); });
      stresses.emplace_back(mesh, model, patches.back());
      sums.push_back(stresses.back().sample(displacement[i], norms));
    }
  });
  std::vector<const VertexPatches*> all;
  for (const VertexPatches& own : patches) all.push_back(&own);
  SubdomainExchange(comm, meshes, all).sum(sums);
  for (std::size_t i = 0; i < meshes.size(); ++i) stresses[i].addErrors(sums[i], norms);
  const double mine[3] = {norms.error, norms.solution, norms.rounding};
  double total[3];
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 3, mine, total);
  const double unsolved = kUnsolved * earlier.tolerance,
               negligible = kRounding * kRounding * total[2] + unsolved * unsolved * earlier.twice;
  return total[1] > negligible ? std::sqrt(total[0] / total[1]) : 0.0;
}

}  // namespace

double averagedEstimate(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                        const std::vector<Vector>& displacement, const EarlierEnergy& earlier) {
  return model.dimension == 2 ? estimateOf<2>(comm, meshes, model, displacement, earlier)
                              : estimateOf<3>(comm, meshes, model, displacement, earlier);
}

}  // namespace suture
