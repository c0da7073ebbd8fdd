#pragma once
#include <suture/contact/ContactGroup.hpp>
#include <suture/contact/LinearisedGroup.hpp>

#include <support/Blocks.hpp>

namespace suture::blocks {

constexpr PairStatus kOpen = PairStatus::Open, kClosed = PairStatus::Slip;

/// The first contact group of a scene.
struct GroupOf {
  Scene scene;
  Blocks all;
  std::unique_ptr<ContactGroup> group;
  std::vector<const Subdomain*> members;

  explicit GroupOf(const Scene& given, const std::string& solver = "CHOLMOD") : scene(given), all(given, alone()) {
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
    group = std::make_unique<ContactGroup>(0, list, boundary, localSolver(solver));
  }

  int size() const { return int(group->boundary().size()); }
  std::vector<PairStatus> status(PairStatus all) const { return std::vector<PairStatus>(group->rows().size(), all); }
  ContactGroup::Response respond(const Vector& trace) const { return group->respond(trace, status(kClosed)); }

  /// Cartesian displacements of the nodes of the mesh that the group holds.
  std::map<GlobalId, Point> displacements(const ContactGroup::Response& response) const {
    std::map<GlobalId, Point> u;
    for (std::size_t m = 0; m < members.size(); ++m) {
      const Vector values = members[m]->cartesian(rowsAt(response.displacement, group->positionsOf(int(m))));
      for (int node = 0; node < members[m]->mesh().nodes(); ++node)
        u[members[m]->mesh().globalNodes[node]] = {values(2 * node), values(2 * node + 1), 0};
    }
    return u;
  }
  static double gapOf(const ContactPair& pair, std::map<GlobalId, Point>& u) {
    double gap = pair.gap;
    for (int k = 0; k < 2; ++k) gap -= (u[pair.ends[0].node][k] - u[pair.ends[1].node][k]) * pair.normal[k];
    return gap;
  }
};

inline Matrix dense(const LocalProblem& problem) { return problem.schurBlock(range(problem.size())); }
inline Vector eigenvalues(const Matrix& a) { return Eigen::SelfAdjointEigenSolver<Matrix>(0.5 * (a + a.transpose())).eigenvalues(); }

}  // namespace suture::blocks
