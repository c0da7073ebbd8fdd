#include <precond/CoarseElementsOf.hpp>

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
  return coarse;
}

}  // namespace suture::blocks
