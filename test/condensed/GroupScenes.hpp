#pragma once
#include <suture/condensed/ContactGroup.hpp>
#include <suture/condensed/LinearisedGroup.hpp>

#include <support/Blocks.hpp>

namespace suture::blocks {

constexpr PairStatus kOpen = PairStatus::Open, kClosed = PairStatus::Slip;

/// The first contact group of a scene.
struct GroupOf {
  Scene scene;
  Blocks all;
  std::unique_ptr<ContactGroup> group;
  std::vector<const Subdomain*> members;

  explicit GroupOf(const Scene& given, const std::string& solver = "CHOLMOD");

  int size() const { return int(group->boundary().size()); }
  std::vector<ContactState> status(PairStatus all) const { return std::vector<ContactState>(group->rows().size(), all); }
  ContactGroup::Response respond(const Vector& trace) const { return group->respond(trace, status(kClosed)); }

  /// Cartesian displacements of the nodes of the mesh that the group holds.
  std::map<GlobalId, Point> displacements(const ContactGroup::Response& response) const;
  static double gapOf(const ContactPair& pair, std::map<GlobalId, Point>& u);
};

inline Matrix schurOf(const LocalProblem& problem) { return problem.schurBlock(range(problem.size())); }

}  // namespace suture::blocks
