#include <suture/subdomain/ElasticSubdomain.hpp>
#include <suture/subdomain/RigidModes.hpp>

#include <numeric>

namespace suture {

void ElasticSubdomain::doAssemble(SparseMatrix& stiffness, Vector& load) {
  const SubdomainMesh& m = mesh();
  const int d = components();
  std::vector<Eigen::Triplet<double>> entries;
  elementStiffnesses(m, material(), model_.plane, [&](int element, ConstLocalView given) {
    const auto nodes = m.nodesOf(element);
    Matrix k = given;
    for (std::size_t a = 0; a < nodes.size(); ++a)
      if (const Matrix* q = axes(nodes[a])) {
        k.middleRows(a * d, d) = (*q * k.middleRows(a * d, d)).eval();
        k.middleCols(a * d, d) = (k.middleCols(a * d, d) * q->transpose()).eval();
      }
    for (std::size_t b = 0; b < nodes.size() * d; ++b)
      for (std::size_t a = 0; a < nodes.size() * d; ++a) entries.emplace_back(nodes[a / d] * d + a % d, nodes[b / d] * d + b % d, k(a, b));
  });
  stiffness.resize(m.nodes() * d, m.nodes() * d);
  stiffness.setFromTriplets(entries.begin(), entries.end());

  std::vector<int> all(m.elements());
  std::iota(all.begin(), all.end(), 0);
  for (const Load& given : model_.loads) {
    if (given.kind == Load::Kind::BodyForce) {
      if (given.group.empty() || given.group == model_.bodies[m.body]) addBodyForce(m, all, given, load);
    } else if (const auto sides = m.sideGroups.find(given.group); sides != m.sideGroups.end()) {
      addSideLoad(m, sides->second, given, load);
    }
  }
  toAxes(load);
}

Matrix ElasticSubdomain::doRigidModes() const {
  Matrix modes = suture::rigidModes(mesh());
  toAxes(modes);
  return modes;
}

Vector ElasticSubdomain::doYoungModulus() const { return Vector::Constant(mesh().nodes(), material().young); }

}  // namespace suture
