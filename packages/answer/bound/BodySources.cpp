#include <suture/answer/bound/BodySources.hpp>

#include <algorithm>

namespace suture {

namespace {

// Deviation of body forces from polynomials, relative to their size, that is round-off.
constexpr double kPolynomialSource = 1e-9;

}  // namespace

template <int D>
BodySources<D>::BodySources(const SubdomainMesh& mesh, const ElasticModel& model, const BoundKind& kind, std::set<std::string>& reasons)
    : mesh_(mesh), model_(model), kind_(kind), reasons_(reasons) {
  for (const Load& load : model.loads) {
    const bool acts = load.onBody() && load.actsOn(model.bodies[mesh.body]);
    if (acts && load.onElements()) loads_.push_back(&load);
    if (acts && load.isInitial() && (!load.expressions.empty() || load.isLocal))
      reasons.insert("initial strains or stresses vary within the elements");
  }
  if (!loads_.empty()) scratch_ = Vector::Zero(Eigen::Index(D) * mesh.nodes());
}

template <int D>
typename BodySources<D>::Place BodySources<D>::at(int element, const Place& place) const {
  Point here{0, 0, 0};
  for (int k = 0; k < D; ++k) here[k] = place[k];
  Place sum = Place::Zero();
  for (const Load* load : loads_) {
    const double mass = load->usesDensity() ? model_.materialOf(mesh_, element, mesh_.body).density.value_or(0.0) : 1.0;
    const Point value = load->at(here);
    for (int k = 0; k < D; ++k) sum[k] += load->factor * mass * value[k];
  }
  return sum;
}

template <int D>
void BodySources<D>::addForces(int element) {
  const auto density = [&](int i) { return model_.materialOf(mesh_, i, mesh_.body).density.value_or(0.0); };
  for (const Load* load : loads_) addBodyForce(mesh_, {element}, *load, scratch_, density);
}

template <int D>
double BodySources<D>::setSources(int element, double volume, BoundElement<D>& simplex) {
  using Nodes = SimplexNodes<D>;
  simplex.sources.setZero();
  if (loads_.empty()) return 0.0;
  const Place middle = at(element, simplex.places.rowwise().mean());
  Eigen::Matrix<double, D, D + 1> corners;
  for (int i = 0; i <= D; ++i) corners.col(i) = at(element, simplex.places.col(i));
  if (kind_.degree == 1)
    simplex.sources.col(0) = middle;
  else
    simplex.sources = corners;
  // Deviation from the polynomial at the centre and in the middle of the edges.
  double deviation = kind_.degree == 1 ? 0.0 : (middle - corners.rowwise().mean()).norm();
  for (int edge = 0; edge < Nodes::edges; ++edge) {
    const int i = Nodes::ends[edge][0], j = Nodes::ends[edge][1];
    const Place value = at(element, 0.5 * (simplex.places.col(i) + simplex.places.col(j)));
    const Place expected = kind_.degree == 1 ? middle : Place(0.5 * (corners.col(i) + corners.col(j)));
    deviation = std::max(deviation, (value - expected).norm());
  }
  for (int i = 0; i <= D && kind_.degree == 1; ++i) deviation = std::max(deviation, (corners.col(i) - middle).norm());
  if (deviation <= kPolynomialSource * corners.cwiseAbs().maxCoeff()) return 0.0;
  reasons_.insert("body forces are not polynomials of degree " + std::to_string(kind_.degree - 1));
  // |f - f_h| h / pi (Poincare's inequality on a convex element) over the square root of the smallest stiffness.
  const double h = (simplex.places.rowwise().maxCoeff() - simplex.places.rowwise().minCoeff()).norm();
  const double soft = 1.0 / simplex.compliance.diagonal().maxCoeff();
  return volume * deviation * deviation * h * h / (9.87 * soft);
}

template class BodySources<2>;
template class BodySources<3>;

}  // namespace suture
