#include <suture/algebra/RigidAssembly.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/condensed/SpectralRadius.hpp>

#include <Tpetra_MultiVector.hpp>

#include <cmath>

namespace suture {

double largestEigenvalue(const Operator& b, const std::function<void(const MultiVector&, MultiVector&)>& solveA, const MultiVector& start,
                         double relative, int most) {
  // v: orthonormal in the A inner product; av: A v. One step: w = A^-1 B v, hence A w = B v.
  std::vector<MultiVectorPtr> v, av;
  std::vector<double> alpha, beta;
  auto w = Teuchos::rcp(new MultiVector(start, Teuchos::Copy));
  auto aw = Teuchos::rcp(new MultiVector(start, Teuchos::Copy));
  b.apply(start, *aw);
  solveA(*aw, *w);
  double largest = 0.0;
  int settled = 0;
  for (int k = 0; k < most; ++k) {
    const double square = dot(*w, *aw);
    if (!(square > 0.0)) break;
    const double norm = std::sqrt(square);
    if (k > 0) {
      if (norm <= 1e-12 * std::abs(alpha.front())) break;
      beta.push_back(norm);
    }
    w->scale(1.0 / norm);
    aw->scale(1.0 / norm);
    v.push_back(w);
    av.push_back(aw);
    w = Teuchos::rcp(new MultiVector(start, Teuchos::Copy));
    aw = Teuchos::rcp(new MultiVector(start, Teuchos::Copy));
    b.apply(*v.back(), *aw);
    solveA(*aw, *w);
    alpha.push_back(dot(*v.back(), *aw));
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t j = 0; j < v.size(); ++j) {
        const double along = dot(*w, *av[j]);
        w->update(-along, *v[j], 1.0);
        aw->update(-along, *av[j], 1.0);
      }
    const double now = tridiagonalEigenvalues(alpha, beta).back();
    settled = std::abs(now - largest) <= relative * now ? settled + 1 : 0;
    largest = now;
    if (settled == 2) break;
  }
  return largest;
}

std::string whySingular(const InterfaceOperator& withoutContact) {
  const GlobalId untouched = withoutContact.untouched();
  if (untouched > 0) return std::to_string(untouched) + " interface unknowns are shared by contact groups only";
  // A null vector of S_0 is in the kernels of all its terms, which agree on the interface.
  const CommPtr& comm = withoutContact.space()->comm();
  Packer packer;
  collectively(*comm, "collecting motions without contact groups", [&] {
    std::size_t count = 0;
    for (const auto& local : withoutContact.locals()) count += local != nullptr;
    packer.put(count);
    for (const auto& local : withoutContact.locals())
      if (local) {
        const Matrix& kernel = local->kernel();
        packer.put(local->boundary());
        packer.put(static_cast<std::size_t>(kernel.cols()));
        packer.put(std::vector<double>(kernel.data(), kernel.data() + kernel.size()));
      }
  });
  const std::vector<std::string> all = gatherOnRoot(*comm, packer.bytes());
  std::string why;
  collectivelyOnRoot(*comm, "looking for motions without contact groups", [&] {
    std::vector<RigidMember> parts;
    for (const std::string& bytes : all) {
      Unpacker unpacker(bytes);
      for (auto n = unpacker.get<std::size_t>(); n > 0; --n) {
        RigidMember part;
        unpacker.get(part.dofs);
        const auto columns = static_cast<Eigen::Index>(unpacker.get<std::size_t>());
        const auto values = unpacker.get<std::vector<double>>();
        part.modes = Eigen::Map<const Matrix>(values.data(), static_cast<Eigen::Index>(part.dofs.size()), columns);
        part.held.resize(0, columns);
        parts.push_back(std::move(part));
      }
    }
    const Eigen::Index motions = commonRigidMotions(parts).cols();
    if (motions > 0)
      why = "subdomains have " + std::to_string(motions) + (motions == 1 ? " rigid motion" : " rigid motions") +
            " that only contact groups prevent";
  });
  return broadcast(*comm, why);
}

}  // namespace suture
