#include <Eigen/Eigenvalues>
#include <suture/answer/LargestStrain.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/elasticity/ElementMap.hpp>

namespace suture {

namespace {

template <int D>
void search(const SubdomainMesh& mesh, const Vector& displacement, double least, Largest& strains, Largest& rotations) {
  for (int e = 0; e < mesh.elements(); ++e) {
    const Span<const int> nodes = mesh.nodesOf(e);
    ElementMap<D> map(mesh, e, referenceElement(mesh.cells[e], Rule::Centroid));
    map.at(0);
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (int i = 0; i < D; ++i) {
        const double u = mesh.total(displacement, Eigen::Index(nodes[a]) * D + i);
        for (int k = 0; k < D; ++k) gradient(i, k) += u * map.gradient(static_cast<int>(a))[k];
        if (i == 0) gradient(2, 2) += u * map.hoop(static_cast<int>(a));
      }
    const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
    const double rotation =
        0.5 * Eigen::Vector3d(gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0), gradient(1, 0) - gradient(0, 1)).norm();
    const auto place = [&] { return map.place(); };
    if (rotation > least) rotations.take(rotation, mesh.body, mesh.globalElements[e], place);
    const double bound = strain.norm();  // upper bound of the principal strains
    if (bound <= least || !strains.mayTake(bound)) continue;
    const double largest =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(strain, Eigen::EigenvaluesOnly).eigenvalues().cwiseAbs().maxCoeff();
    if (largest > least) strains.take(largest, mesh.body, mesh.globalElements[e], place);
  }
}

}  // namespace

LargestStrain largestStrain(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& displacement,
                            double least, int body) {
  Largest mine[2], all[2];
  collectively(comm, "looking for the largest strain", [&] {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      if (body >= 0 && meshes[i].body != body) continue;
      meshes[i].dimension == 2 ? search<2>(meshes[i], displacement[i], least, mine[0], mine[1])
                               : search<3>(meshes[i], displacement[i], least, mine[0], mine[1]);
    }
  });
  Packer packer;
  for (const Largest& one : mine) packer.put(one);
  for (const std::string& bytes : allGather(comm, packer.bytes())) {
    Unpacker unpacker(bytes);
    for (Largest& one : all) {
      Largest theirs;
      unpacker.get(theirs);
      one.take(theirs);
    }
  }
  return {all[0].found(), all[1].found()};
}

}  // namespace suture
