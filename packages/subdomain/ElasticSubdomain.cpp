#include <suture/elasticity/SubdomainLoads.hpp>
#include <suture/subdomain/ElasticSubdomain.hpp>
#include <suture/subdomain/NodalAssembly.hpp>
#include <suture/subdomain/RigidModes.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace suture {

SparseMatrix ElasticSubdomain::assembleStiffness(const std::function<const Material&(int element)>& materials) const {
  const SubdomainMesh& m = mesh();
  const int d = components();
  ElementMatrices matrices;
  matrices.reserve(m.connectivity.size() * m.connectivity.size() / std::max(m.elements(), 1) * d * d);
  elementStiffnesses(m, materials, model_.plane, [&](int element, ConstLocalView given) {
    const auto nodes = m.nodesOf(element);
    const auto begin = matrices.size();
    matrices.insert(matrices.end(), given.data(), given.data() + given.size());
    if (!std::any_of(nodes.begin(), nodes.end(), [this](int node) { return axes(node) != nullptr; })) return;
    Eigen::Map<Matrix> k(matrices.data() + begin, given.rows(), given.cols());
    for (std::size_t a = 0; a < nodes.size(); ++a)
      if (const Matrix* q = axes(nodes[a])) {
        k.middleRows(a * d, d) = (*q * k.middleRows(a * d, d)).eval();
        k.middleCols(a * d, d) = (k.middleCols(a * d, d) * q->transpose()).eval();
      }
  });
  return assembleNodal(m, d, matrices);
}

void ElasticSubdomain::doAssemble(SparseMatrix& stiffness, Vector& load) {
  const SubdomainMesh& m = mesh();
  SparseMatrix assembled = assembleStiffness([this](int element) -> const Material& { return materialOf(element); });
  stiffness.swap(assembled);  // Eigen would copy it
  load = subdomainLoads(m, model_);
  toAxes(load);
}

Matrix ElasticSubdomain::doRigidModes() const {
  Matrix modes = suture::rigidModes(mesh());
  toAxes(modes);
  return modes;
}

Matrix ElasticSubdomain::doCoarseModes() const {
  Matrix modes = sectionModes(mesh());
  toAxes(modes);
  return modes;
}

Vector ElasticSubdomain::doSeamFlux() const {
  const SubdomainMesh& m = mesh();
  Vector flux = Vector::Zero(Eigen::Index(m.nodes()) * components());
  if (!model_.nearlyIncompressible()) return flux;
  for (const SubdomainMesh::SeamSide& seam : m.seamSides)
    addSideFlux(m, {seam.element, seam.side}, seam.neighbour > m.id ? 1.0 : -1.0, flux);
  // psi_j sum to one: lengths times weights are integrals of each node's own shape function, on either side of a mortar, too.
  std::map<int, const ContactPair*> pairs;
  for (const ContactRow& row : m.contactRows) pairs[row.pair.id] = &row.pair;
  for (const SubdomainMesh::ContactEnd& end : m.contactEnds) {
    const ContactPair& pair = *pairs.at(end.pair);
    for (int k = 0; k < components(); ++k)
      flux(end.node * components() + k) += std::abs(pair.ends[end.end].weight) * pair.length * pair.normal[k];
  }
  return flux;
}

Vector ElasticSubdomain::doShearDiagonal() const {
  if (!model_.nearlyIncompressible()) return Vector();
  std::map<const Material*, Material> withoutVolume;  // the same shear modulus, no Lame constant
  return assembleStiffness([&](int element) -> const Material& {
           const Material& given = materialOf(element);
           return withoutVolume.try_emplace(&given, Material{given.name, given.young / (1 + given.poisson), 0.0}).first->second;
         })
      .diagonal();
}

Vector ElasticSubdomain::doYoungModulus() const {
  Vector young = Vector::Zero(mesh().nodes());
  for (int element = 0; element < mesh().elements(); ++element)
    for (const int node : mesh().nodesOf(element)) young(node) = std::max(young(node), materialOf(element).young);
  return young;
}

}  // namespace suture
