#include <interface/DenseSpace.hpp>
#include <precond/Preconditioners.hpp>

namespace suture::blocks {

Teuchos::RCP<Preconditioner> neumannNeumann(const Interface& one, const Teuchos::RCP<const InterfaceOperator>& matrix,
                                            const std::string& coarse, const std::string& weighting) {
  const auto made = makePreconditioner(
      resolved("Preconditioner", preconditionerSchema(),
               {"Type=Neumann-Neumann", "Neumann-Neumann/Weighting=" + weighting, "Neumann-Neumann/Coarse Space=" + coarse}));
  made->initialize(one.space);
  made->compute(matrix);
  return made;
}

Parameters bddcList(std::vector<std::string> settings) {
  for (std::string& setting : settings) setting = "BDDC/" + setting;
  settings.insert(settings.begin(), "Type=BDDC");
  return resolved("Preconditioner", preconditionerSchema(), settings);
}

Teuchos::RCP<Preconditioner> bddcWith(const Teuchos::RCP<const InterfaceOperator>& matrix, const std::vector<std::string>& settings) {
  const auto made = makePreconditioner(bddcList(settings));
  made->initialize(matrix->space());
  made->compute(matrix);
  return made;
}

Teuchos::RCP<Preconditioner> bddc(const Teuchos::RCP<const InterfaceOperator>& matrix, const std::string& edges,
                                  const std::string& weighting) {
  return bddcWith(matrix, {"Weighting=" + weighting, "Edge Constraints=" + edges});
}

Lanczos conjugateGradients(const Operator& s, const Operator& m, const InterfaceSpace& space, const MultiVector& rhs) {
  const MultiVectorPtr r = space.vector(), z = space.vector(), p = space.vector(), q = space.vector();
  localView(*r) = localView(rhs);
  m.apply(*r, *z);
  localView(*p) = localView(static_cast<const MultiVector&>(*z));
  double rho = dot(*r, *z);
  const double first = rho;
  std::vector<double> diagonal, offDiagonal;
  double lastAlpha = 1.0, lastBeta = 0.0;
  Lanczos result;
  while (rho > 1e-20 * first && result.iterations < 400) {
    s.apply(*p, *q);
    const double alpha = rho / dot(*p, *q);
    diagonal.push_back(1.0 / alpha + lastBeta / lastAlpha);
    if (result.iterations > 0) offDiagonal.push_back(std::sqrt(lastBeta) / lastAlpha);
    const Matrix before = result.iterates.empty() ? Matrix(Matrix::Zero(localView(*p).rows(), 1)) : result.iterates.back();
    result.iterates.push_back(before + alpha * localView(static_cast<const MultiVector&>(*p)));
    localView(*r) -= alpha * localView(static_cast<const MultiVector&>(*q));
    m.apply(*r, *z);
    const double next = dot(*r, *z);
    lastBeta = next / rho;
    lastAlpha = alpha;
    rho = next;
    result.residuals.push_back(std::sqrt(rho / first));
    const Matrix old = localView(static_cast<const MultiVector&>(*p));
    localView(*p) = localView(static_cast<const MultiVector&>(*z)) + lastBeta * old;
    ++result.iterations;
  }
  const int n = int(diagonal.size());
  Matrix t = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    t(i, i) = diagonal[i];
    if (i > 0) t(i, i - 1) = t(i - 1, i) = offDiagonal[i - 1];
  }
  const Vector values = eigenvalues(t);
  result.condition = values(n - 1) / values(0);
  result.least = values(0);
  return result;
}

Lanczos conjugateGradients(const InterfaceOperator& s, const Preconditioner& m) {
  const DenseSpace all(*s.space());
  return conjugateGradients(s, m, *s.space(), *all.vector(random(all.size(), 1, 5)));
}

int Lanczos::iterationsTo(double tolerance) const {
  const auto reached = [tolerance](double residual) { return residual <= tolerance; };
  return 1 + static_cast<int>(std::find_if(residuals.begin(), residuals.end(), reached) - residuals.begin());
}

Lanczos conditionOf(const Scene& scene, const std::string& coarse, const std::string& weighting, const std::vector<double>& youngOf) {
  const Twins t(scene, youngOf);
  const auto m = neumannNeumann(t.spread, t.spread.linearised.matrix, coarse, weighting);
  return conjugateGradients(t.spread.matrix(), *m, *t.spread.space, *t.toSpread(random(t.size(), 1, 5)));
}

std::vector<double> board(int blocks, double jump, bool columns) {
  std::vector<double> young;
  for (int i = 0; i < blocks; ++i)
    for (int j = 0; j < blocks; ++j) young.push_back((columns ? i : i + j) % 2 == 0 ? 1.0 : jump);
  return young;
}

}  // namespace suture::blocks
