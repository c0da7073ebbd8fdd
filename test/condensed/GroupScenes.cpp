#include <Teuchos_ParameterList.hpp>
#include <condensed/GroupScenes.hpp>

namespace suture::blocks {

GroupOf::GroupOf(const Scene& given, const std::string& solver) : scene(given), all(given, alone()) {
  std::vector<ContactGroup::Member> list;
  std::vector<GlobalId> boundary;
  for (int s : all.partition.groups.at(0)) {
    const Subdomain& subdomain = *all.subdomains[s];
    members.push_back(&subdomain);
    list.push_back({&subdomain});
    for (int i = 0; i < subdomain.dofs(); ++i)
      for (int other : subdomain.mesh().others(subdomain.nodeOf(i)))
        if (all.partition.groupOf[other] != 0) boundary.push_back(subdomain.globalDof(i));
  }
  std::sort(boundary.begin(), boundary.end());
  boundary.erase(std::unique(boundary.begin(), boundary.end()), boundary.end());
  group = Registry<ContactGroup>::instance().make("Exact", ContactGroup::Parts{0, list, boundary, localSolver(solver)}, Parameters());
}

std::map<GlobalId, Point> GroupOf::displacements(const ContactGroup::Response& response) const {
  std::map<GlobalId, Point> u;
  for (std::size_t m = 0; m < members.size(); ++m) {
    const Vector values = members[m]->cartesian(rowsAt(response.displacement, group->positionsOf(int(m))));
    for (int node = 0; node < members[m]->mesh().nodes(); ++node)
      u[members[m]->mesh().globalNodes[node]] = {values(2 * node), values(2 * node + 1), 0};
  }
  return u;
}

double GroupOf::gapOf(const ContactPair& pair, std::map<GlobalId, Point>& u) {
  double gap = pair.gap;
  for (int k = 0; k < 2; ++k) gap -= (u[pair.ends[0].node][k] - u[pair.ends[1].node][k]) * pair.normal[k];
  return gap;
}

}  // namespace suture::blocks
