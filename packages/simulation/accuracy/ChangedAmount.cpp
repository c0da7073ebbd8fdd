#include <suture/base/Collective.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/Point.hpp>
#include <suture/simulation/accuracy/ChangedAmount.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

namespace suture {

namespace {

constexpr double kPerpendicularTo = 1e-9;  // cosine between directions that is round-off

/// Displacement of a node if a condition moves by one along an axis: the part of the axis in the directions that the condition holds.
std::map<int, Point> motionsOf(const std::vector<Support>& supports, const Amount& amount) {
  std::map<int, Point> all;
  for (const Support& support : supports) {
    if (support.condition != amount.number) continue;
    const double along = support.direction[static_cast<std::size_t>(amount.component)];
    Point& motion = all.try_emplace(support.node, Point{0, 0, 0}).first->second;
    motion = plus(motion, scaled(along, support.direction));
  }
  return all;
}

void moveRules(std::vector<NodeRule>& rules, const std::map<int, Point>& motions, double by) {
  for (NodeRule& rule : rules) {
    const auto motion = motions.find(rule.node);
    if (motion == motions.end()) continue;
    for (std::size_t k = 0; k < 3; ++k)
      if (rule.fixed[k]) rule.value[k] += by * dot(rule.axes[k], motion->second);
  }
}

bool meet(const Point& a, const Point& b) { return std::abs(dot(a, b)) > kPerpendicularTo * norm(a) * norm(b); }

/// Why the condition cannot move, as far as this mesh shows.
std::string whyNotMove(const SubdomainMesh& mesh, const Amount& amount) {
  std::map<GlobalId, Point> moved;
  for (const auto& [node, motion] : motionsOf(mesh.supports, amount))
    if (norm(motion) > 0.0) moved[mesh.globalNodes[static_cast<std::size_t>(node)]] = motion;
  std::map<int, std::vector<Point>> own;
  for (const Support& support : mesh.supports) {
    const auto motion = moved.find(mesh.globalNodes[static_cast<std::size_t>(support.node)]);
    if (motion == moved.end()) continue;
    if (support.condition != amount.number) {
      if (meet(support.direction, motion->second)) return "it shares nodes with another support, which holds them in the same direction";
      continue;
    }
    if (support.atPoint) return "it holds a single node";
    for (const Point& other : own[support.node])
      if (meet(other, support.direction)) return "it holds nodes in directions that are not perpendicular";
    own[support.node].push_back(support.direction);
  }
  for (const ContactRow& row : mesh.contactRows)
    for (const PairEnd& end : row.pair.ends) {
      const auto motion = moved.find(end.node);
      if (motion != moved.end() && meet(row.pair.normal, motion->second)) return "it holds nodes of a contact along the normal";
    }
  return "";
}

/// One pair of a contact, for checks of the whole contact.
struct PairOfLine {
  int line = -1, id = -1;
  std::vector<int> nodes;
  Point normal{0, 0, 0};
  int isHeld = 0;

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.line), each(self.id), each(self.nodes), each(self.normal), each(self.isHeld);
  }
};

std::vector<PairOfLine> pairsOf(const SubdomainMesh& mesh) {
  std::multimap<GlobalId, const Support*> supports;
  for (const Support& support : mesh.supports) supports.emplace(mesh.globalNodes[static_cast<std::size_t>(support.node)], &support);
  std::vector<PairOfLine> all;
  for (const ContactRow& row : mesh.contactRows) {
    PairOfLine own{row.pair.line, row.pair.id, {}, row.pair.normal};
    for (const PairEnd& end : row.pair.ends) {
      own.nodes.push_back(end.node);
      const auto [first, last] = supports.equal_range(end.node);
      for (auto one = first; one != last; ++one) own.isHeld = own.isHeld || meet(one->second->direction, row.pair.normal);
    }
    all.push_back(std::move(own));
  }
  return all;
}

/// Why the sides of a contact cannot approach each other. On rank 0.
std::string whyNotApproach(const std::vector<PairOfLine>& pairs, int line) {
  std::set<int> ofOthers;
  const PairOfLine* first = nullptr;
  for (const PairOfLine& pair : pairs) {
    if (pair.line != line)
      ofOthers.insert(pair.nodes.begin(), pair.nodes.end());
    else if (!first)
      first = &pair;
  }
  if (!first) return "it has no pairs";
  for (const PairOfLine& pair : pairs) {
    if (pair.line != line) continue;
    if (norm(minus(pair.normal, first->normal)) > kPerpendicularTo) return "its sides are not plane";
    if (pair.isHeld) return "a support holds its nodes along the normal";
    if (std::any_of(pair.nodes.begin(), pair.nodes.end(), [&](int node) { return ofOthers.count(node) > 0; }))
      return "it shares nodes with another contact";
  }
  return "";
}

std::string whyNotContact(const SceneParts& parts, int line) {
  std::vector<PairOfLine> mine;
  for (const SubdomainMesh& mesh : parts.cut.meshes) {
    std::vector<PairOfLine> more = pairsOf(mesh);
    std::move(more.begin(), more.end(), std::back_inserter(mine));
  }
  const std::vector<PairOfLine> all = joinOnRoot(parts.run.comm(), mine);
  return broadcast(parts.run.comm(), parts.run.comm().getRank() == 0 ? whyNotApproach(all, line) : "");
}

/// The first of the texts of all ranks that is not empty. Collective.
std::string firstOf(const Comm& comm, const std::string& mine) {
  for (const std::string& text : allGather(comm, mine))
    if (!text.empty()) return text;
  return "";
}

std::string whyNotLoad(const Load& load) {
  if (load.control != Load::Control::None) return "its amount is found by the program";
  if (load.kind != Load::Kind::Traction && load.kind != Load::Kind::Pressure) return "it is not a traction, force or pressure on sides";
  return "";
}

}  // namespace

std::string whyNotChangeable(const SceneParts& parts, const Amount& amount) {
  if (amount.kind == Amount::Kind::Load) return whyNotLoad(parts.scene.model.loads[static_cast<std::size_t>(amount.number)]);
  if (amount.kind == Amount::Kind::Contact) return whyNotContact(parts, amount.number);
  std::string mine;
  for (const SubdomainMesh& mesh : parts.cut.meshes) {
    if (mine.empty()) mine = mesh.rigidGroups.empty() ? whyNotMove(mesh, amount) : "the scene has rigid groups";
  }
  return firstOf(parts.run.comm(), mine);
}

Point normalOf(const std::vector<PairResult>& pairs, int line) {
  const auto first = std::find_if(pairs.begin(), pairs.end(), [&](const PairResult& pair) { return pair.line == line; });
  return first == pairs.end() ? Point{0, 0, 0} : first->normal;
}

ChangedAmount::ChangedAmount(SceneParts& parts, const Amount& amount, double by) : parts_(parts) {
  for (const SubdomainMesh& mesh : parts.cut.meshes) {
    rules_.push_back(mesh.rules);
    lifted_.push_back(mesh.lift.gaps);
    gaps_.emplace_back();
    for (const ContactRow& row : mesh.contactRows) gaps_.back().push_back({row.pair.gap, row.normal().gap});
  }
  wholeRules_ = parts.constraints.rules;
  for (const ContactPair& pair : parts.constraints.pairs) wholeGaps_.push_back(pair.gap);
  for (const Load& load : parts.scene.model.loads) factors_.push_back(load.factor);
  if (amount.kind == Amount::Kind::Support)
    moveSupports(amount, by);
  else if (amount.kind == Amount::Kind::Contact)
    approach(amount.number, by);
  else
    parts.scene.model.loads[static_cast<std::size_t>(amount.number)].factor *= 1.0 + by;
}

ChangedAmount::~ChangedAmount() {
  std::vector<SubdomainMesh>& meshes = parts_.cut.meshes;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    meshes[m].rules = rules_[m];
    meshes[m].lift.gaps = lifted_[m];
    for (std::size_t r = 0; r < gaps_[m].size(); ++r) {
      meshes[m].contactRows[r].pair.gap = gaps_[m][r].pair;
      meshes[m].contactRows[r].normal().gap = gaps_[m][r].equation;
    }
  }
  parts_.constraints.rules = wholeRules_;
  for (std::size_t p = 0; p < wholeGaps_.size(); ++p) parts_.constraints.pairs[p].gap = wholeGaps_[p];
  for (std::size_t l = 0; l < factors_.size(); ++l) parts_.scene.model.loads[l].factor = factors_[l];
}

void ChangedAmount::moveSupports(const Amount& amount, double by) {
  for (SubdomainMesh& mesh : parts_.cut.meshes) moveRules(mesh.rules, motionsOf(mesh.supports, amount), by);
  moveRules(parts_.constraints.rules, motionsOf(parts_.constraints.supports, amount), by);
}

void ChangedAmount::approach(int line, double by) {
  for (SubdomainMesh& mesh : parts_.cut.meshes)
    for (ContactRow& row : mesh.contactRows) {
      if (row.pair.line != line) continue;
      row.pair.gap -= by;
      row.normal().gap -= by;
      if (const auto lifted = mesh.lift.gaps.find(row.pair.id); lifted != mesh.lift.gaps.end()) lifted->second -= by;
    }
  for (ContactPair& pair : parts_.constraints.pairs)
    if (pair.line == line) pair.gap -= by;
}

}  // namespace suture
