#pragma once
#include <suture/report/Checkpoint.hpp>
#include <suture/simulation/SceneParts.hpp>
#include <suture/solver/Method.hpp>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace suture {

/// State of a scene at the end of a phase, and its transfer to the parts of the next phase: displacements by the nodes of the whole mesh,
/// pairs by contact and carrying node.
class PhaseChange {
 public:
  /// \param before  parts of the phase that ends; may be destroyed afterwards. Collective.
  PhaseChange(const SceneParts& before, const Solution& solution);

  /// Fits placed bodies to the deformed sides of their contacts: gaps and slips of their pairs are measured from the moment at which the
  /// body was placed, now or before an earlier phase. Before the mesh is cut. Local (rank 0; does nothing on other ranks). \param
  /// absentBefore  bodies and regions that did not exist in the last phase
  void fit(SceneParts& next, const std::set<std::string>& absentBefore);

  /// Continues the load path in the next phase, which is cut: histories of pairs, steps so far, and the forces by which removed parts held
  /// the others, as loads that fall to zero. Collective.
  void goOn(SceneParts& next);

  /// After goOn(): start of the solver, and of its path.
  const Start& start() const { return start_; }
  const PathState& path() const { return path_; }

 private:
  /// Contact and carrying node of a pair, in the whole mesh. Pairs of one key keep their order.
  using Key = std::pair<std::string, int>;
  struct Pair {
    PairResult result;
    ContactPair::Past past;
    std::optional<double> fit;  ///< part of its gap by which a placed body fits to a deformed side [length]
  };
  std::map<Key, std::vector<Pair>> pairs_;         // on rank 0
  std::map<int, Point> displacement_, reference_;  // node of the whole mesh; on rank 0
  std::map<std::string, BodyForces> carried_;
  /// Least safety factors with the names of their body and region (empty: the body's own material).
  std::vector<std::pair<std::pair<std::string, std::string>, LeastSafety>> safety_;
  PathState path_;
  Start start_;
  /// Forces of parts removed before, of which a part still acts: by node of the whole mesh, on rank 0.
  std::vector<std::pair<Release, std::map<int, Point>>> pending_;
  std::map<int, ContactPair::Past> fitted_;  // by id in the next phase, of pairs of placed bodies; on rank 0

  std::map<int, Point> byWholeNode(const SceneParts& parts, const std::vector<Vector>& values) const;
  Point displacementOf(int node) const;
  const Pair* find(const SceneParts& next, const ContactPair& pair, std::map<Key, std::size_t>& used) const;
  void takePairs(const SceneParts& next);
  void takeBodies(const Scene& next);
  std::vector<Vector> onMeshes(const SceneParts& next, const std::map<int, Point>& byWholeNode) const;
  void takePending(const SceneParts& before);
  void addPending(SceneParts& next) const;
  void addRelease(SceneParts& next) const;
};

}  // namespace suture
