#include <precond/CoarseElementsOf.hpp>

#include <Teuchos_CommHelpers.hpp>

namespace suture::blocks {

CoarseElements coarseElementsOf(const Blocks& all, const Dense& whole) {
  CoarseElements coarse;
  coarse.size = int(whole.place.size());
  std::set<int> known;
  for (const auto& subdomain : all.subdomains) {
    std::map<int, int> order;  // coarse unknown -> free unknown of the subdomain
    for (int dof = 0; dof < subdomain->dofs(); ++dof) {
      const int number = whole.place.at(subdomain->globalDof(dof));
      order[number] = dof;
      if (known.insert(number).second)
        coarse.unknowns.push_back({number, subdomain->mesh().point(subdomain->nodeOf(dof)), subdomain->direction(dof), 0.0});
    }
    CoarseElement element;
    element.id = subdomain->mesh().id;
    std::vector<int> dofs;
    for (const auto& [number, dof] : order) {
      element.unknowns.push_back(number);
      dofs.push_back(dof);
    }
    element.matrix = Matrix(block(subdomain->stiffness().full(), dofs, dofs));
    coarse.elements.push_back(std::move(element));
  }
  std::sort(coarse.unknowns.begin(), coarse.unknowns.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return coarse;
}

Vector CoarseParts::sum(const Vector& mine) const {
  Vector own = Vector::Zero(size), all(size);
  own(names) = mine;
  Teuchos::reduceAll(*comm, Teuchos::REDUCE_SUM, size, own.data(), all.data());
  return all;
}

Vector CoarseParts::partOf(const Vector& all) const {
  const Vector sharers = sum(Vector::Ones(int(names.size())));
  return all(names).cwiseQuotient(sharers(names));
}

Vector CoarseParts::joined(const Vector& mine) const { return sum(mine).cwiseQuotient(sum(Vector::Ones(int(names.size())))); }

}  // namespace suture::blocks
