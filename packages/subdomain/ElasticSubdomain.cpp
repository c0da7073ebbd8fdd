#include <suture/elasticity/loads/ElasticSupports.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>
#include <suture/subdomain/ElasticSubdomain.hpp>
#include <suture/subdomain/RigidModes.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace suture {

SparseMatrix ElasticSubdomain::assembleStiffness(const std::function<const Material&(int element)>& materials) const {
  return assembled([&](const auto& take) { supportedStiffnesses(mesh(), mesh().sideGroups, materials, model_, take); });
}

void ElasticSubdomain::doAssemble(SparseMatrix& stiffness, Vector& load) {
  SparseMatrix assembled = assembleStiffness([this](int element) -> const Material& { return materialOf(element); });
  stiffness.swap(assembled);  // an assignment would copy
  load = doLoad();
}

Vector ElasticSubdomain::doLoad() {
  Vector load = subdomainLoads(mesh(), model_);
  toAxes(load);
  return load;
}

Matrix ElasticSubdomain::doStresses(const Vector& displacement) const { return elementStresses(mesh(), model_, displacement); }

Matrix ElasticSubdomain::doRigidModes() const {
  Matrix modes = suture::rigidModes(mesh());
  toAxes(modes);
  return modes;
}

Hint ElasticSubdomain::doHint(const std::string& name) const {
  if (name == Hint::kYoungModulus) return {youngModulus(), Hint::Join::Largest};
  if (name == Hint::kCoarseModes) {
    Matrix modes = sectionModes(mesh());
    toAxes(modes);
    return {modes, Hint::Join::Columns};
  }
  if (!model_.nearlyIncompressible()) return {};
  if (name == Hint::kShearDiagonal) return {shearDiagonal(), Hint::Join::Sum};
  if (name == Hint::kSeamFlux) return {seamFlux(), Hint::Join::Sum};
  return {};
}

Vector ElasticSubdomain::seamFlux() const {
  const SubdomainMesh& m = mesh();
  Vector flux = Vector::Zero(Eigen::Index(m.nodes()) * components());
  for (const SubdomainMesh::SeamSide& seam : m.seamSides)
    addSideFlux(m, {seam.element, seam.side}, seam.neighbour > m.id ? 1.0 : -1.0, flux);
  // psi_j sum to one: lengths times weights are the integrals of each node's own shape function, also on both sides of a mortar.
  std::map<int, const ContactPair*> pairs;
  for (const ContactRow& row : m.contactRows) pairs[row.pair.id] = &row.pair;
  for (const SubdomainMesh::ContactEnd& end : m.contactEnds) {
    const ContactPair& pair = *pairs.at(end.pair);
    for (int k = 0; k < components(); ++k)
      flux(end.node * components() + k) += std::abs(pair.ends[end.end].weight) * pair.length * pair.normal[k];
  }
  toAxes(flux);
  return flux;
}

Vector ElasticSubdomain::shearDiagonal() const {
  std::map<const Material*, Material> withoutVolume;  // the same shear modulus, Lame constant zero
  return assembleStiffness([&](int element) -> const Material& {
           const Material& given = materialOf(element);
           return withoutVolume.try_emplace(&given, Material{given.name, given.young / (1 + given.poisson), 0.0}).first->second;
         })
      .diagonal();
}

Vector ElasticSubdomain::youngModulus() const {
  const int d = components();
  Vector young = Vector::Zero(Eigen::Index(mesh().nodes()) * d);
  for (int element = 0; element < mesh().elements(); ++element)
    for (const int node : mesh().nodesOf(element))
      young.segment(node * d, d) = young.segment(node * d, d).cwiseMax(materialOf(element).young);
  for (const auto& [outer, inner] : nodesUnderCoatings(mesh())) young.segment(outer * d, d) = young.segment(inner * d, d);
  return young;
}

}  // namespace suture
