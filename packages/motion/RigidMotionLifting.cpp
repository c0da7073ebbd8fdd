#include <suture/base/AgreedDimension.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/Point.hpp>
#include <suture/base/RigidValues.hpp>
#include <suture/motion/BodyParts.hpp>
#include <suture/motion/RigidMotionLifting.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace suture {

namespace {

using Extended = long double;

constexpr double kRigid = 0.25;      // largest remainder of a rigid fit, relative to the largest prescribed value
constexpr double kBalanced = 1e-12;  // sum of a pair's weights that counts as zero, relative to the weights: round-off
constexpr double kNoGap = 5e-16;     // largest remainder of a gap that counts as closed, relative to gap and motion: round-off of both
constexpr int kAmplitudeBits = 46;   // bits of the largest amplitude that are kept: the rest is round-off of the fit

/// End of a pair: the motion of its node, and the contribution of its prescribed components to the rows.
struct End {
  int pair, end;
  Extended given[3];              // weight direction . remainder of prescribed components, for each row
  std::array<Extended, 3> moved;  // motion
  Extended along;                 // normal . motion
  double weight;
};

Extended dot(const Point& axis, const std::array<Extended, 3>& moved) {
  return axis[0] * moved[0] + axis[1] * moved[1] + axis[2] * moved[2];
}

using Amplitudes = std::array<Extended, 6>;

std::array<Extended, 3> motionAt(const RigidPart& part, const Amplitudes& amplitudes, const Point& point, int dimension) {
  std::array<Extended, 3> arm{0, 0, 0}, translation, rotation;
  for (int k = 0; k < dimension; ++k) arm[k] = (Extended(point[k]) - part.centre[k]) / part.radius;
  splitAmplitudes(amplitudes, dimension, translation, rotation);
  return rigidDisplacement(translation, rotation, arm);
}

Amplitudes extended(const Vector& amplitudes) {
  Amplitudes all{0, 0, 0, 0, 0, 0};
  for (Eigen::Index k = 0; k < amplitudes.size(); ++k) all[k] = amplitudes[k];
  return all;
}

/// Rounding has no cost (the remainder is prescribed) and keeps translations exact: the remainders of equal values are equal to the last
/// bit.
void round(Vector& amplitudes) {
  const double largest = amplitudes.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return;
  const double unit = std::ldexp(1.0, std::ilogb(largest) - kAmplitudeBits);
  for (double& amplitude : amplitudes) amplitude = unit * std::nearbyint(amplitude / unit);
}

class Lifting {
 public:
  Lifting(const Comm& comm, std::vector<SubdomainMesh>& meshes, const CarriedMotions& carry) : comm_(comm), meshes_(meshes), carry_(carry) {
    for (const SubdomainMesh& mesh : meshes) rigid_.emplace_back(mesh.rigidGroups, mesh.dimension);
  }
  bool run();
  /// Moves a lifted scene again, by amplitudes of each part.
  void further(const std::vector<Vector>& motion);

 private:
  void findParts();
  bool choose();
  void takeTranslationsAsPrescribed();
  void shiftRules();
  void shiftRows();

  std::array<Extended, 3> at(std::size_t mesh, int node) const {
    const int part = parts_->partOf[mesh];
    return motionAt(parts_->parts[part], amplitudes_[part], meshes_[mesh].point(node), dimension_);
  }

  /// Part of a rule's value that a motion accounts for. \param moved  motion of the rule's node
  Extended movedBy(std::size_t mesh, const NodeRule& rule, int component, const std::array<Extended, 3>& moved) const {
    Extended along = dot(rule.axes[std::size_t(component)], moved);
    rigid_[mesh].forEachMaster(rule.node, component, [&](int node, int master, double coefficient) {
      along -= coefficient * at(mesh, node)[std::size_t(master)];
    });
    return along;
  }

  const Comm& comm_;
  std::vector<SubdomainMesh>& meshes_;
  const CarriedMotions& carry_;
  std::vector<RigidGroupNodes> rigid_;  // by mesh
  int dimension_ = 2;
  std::unique_ptr<BodyParts> parts_;
  std::vector<Amplitudes> amplitudes_;  // by part
};

/// Sets translations that belong to one prescribed value to this value, to the last bit: its remainder is zero.
void Lifting::takeTranslationsAsPrescribed() {
  const std::size_t parts = parts_->parts.size(), d = std::size_t(dimension_);
  const double none = -std::numeric_limits<double>::infinity();
  std::vector<double> mine(2 * d * parts, none), all(mine);  // for each part and component: largest value, and minus the smallest
  for (std::size_t s = 0; s < meshes_.size(); ++s)
    for (const NodeRule& rule : meshes_[s].rules)
      for (std::size_t k = 0; k < d; ++k) {
        if (!rule.fixed[k] || rule.axes[k][k] != 1.0 || rigid_[s].contains(rule.node)) continue;
        double* own = &mine[2 * (d * std::size_t(parts_->partOf[s]) + k)];
        own[0] = std::max(own[0], rule.value[k]);
        own[1] = std::max(own[1], -rule.value[k]);
      }
  Teuchos::reduceAll(comm_, Teuchos::REDUCE_MAX, int(mine.size()), mine.data(), all.data());
  for (std::size_t p = 0; p < parts; ++p) {
    Vector& lift = parts_->lift[p];
    if (lift.size() == 0 || !lift.tail(lift.size() - dimension_).isZero(0.0)) continue;
    const double rounding = std::ldexp(lift.cwiseAbs().maxCoeff(), 1 - kAmplitudeBits);
    for (std::size_t k = 0; k < d; ++k) {
      const double* of = &all[2 * (d * p + k)];
      if (of[0] == -of[1] && std::abs(of[0] - lift[Eigen::Index(k)]) <= rounding) lift[Eigen::Index(k)] = of[0];
    }
  }
}

/// Chooses the motion of each part: the best fit, if it leaves a small remainder of the prescribed values, plus the motion of `carry`.
bool Lifting::choose() {
  const std::size_t parts = parts_->parts.size();
  for (std::size_t p = 0; p < parts; ++p)
    if (parts_->sprung[p]) parts_->lift[p].setZero();
  for (Vector& lift : parts_->lift) round(lift);
  takeTranslationsAsPrescribed();
  for (const Vector& lift : parts_->lift) amplitudes_.push_back(extended(lift));
  std::vector<double> mine(2 * parts, 0.0), all(2 * parts);
  for (std::size_t s = 0; s < meshes_.size(); ++s)
    for (const NodeRule& rule : meshes_[s].rules) {
      const auto moved = at(s, rule.node);
      for (int k = 0; k < dimension_; ++k) {
        if (!rule.fixed[k]) continue;
        double *value = &mine[2 * parts_->partOf[s]], *rest = value + 1;
        *value = std::max(*value, std::abs(rule.value[k]));
        *rest = std::max(*rest, std::abs(double(rule.value[k] - movedBy(s, rule, k, moved))));
      }
    }
  Teuchos::reduceAll(comm_, Teuchos::REDUCE_MAX, int(mine.size()), mine.data(), all.data());
  for (std::size_t p = 0; p < parts; ++p)
    if (!(all[2 * p + 1] <= kRigid * all[2 * p])) parts_->lift[p].setZero();
  std::vector<Vector> carried(parts, Vector::Zero(rigidMotions(dimension_)));
  if (carry_) carried = carry_(*parts_);
  bool any = false;
  for (std::size_t p = 0; p < parts; ++p) {
    round(carried[p]);
    const Amplitudes prescribed = extended(parts_->lift[p]), beside = extended(carried[p]);
    for (std::size_t k = 0; k < beside.size(); ++k) {
      amplitudes_[p][k] = prescribed[k] + beside[k];
      any = any || amplitudes_[p][k] != 0;
    }
  }
  return any;
}

void Lifting::shiftRules() {
  for (std::size_t s = 0; s < meshes_.size(); ++s) {
    SubdomainMesh& mesh = meshes_[s];
    if (mesh.lift.motion.size() == 0) {
      mesh.lift.motion = Vector::Zero(Eigen::Index(mesh.nodes()) * dimension_);
      for (const NodeRule& rule : mesh.rules) mesh.lift.values.push_back(rule.value);
    }
    for (std::size_t r = 0; r < mesh.rules.size(); ++r) {
      NodeRule& rule = mesh.rules[r];
      const auto moved = at(s, rule.node);
      for (int k = 0; k < dimension_; ++k)
        if (rule.fixed[k]) rule.value[k] = double(mesh.lift.values[r][k] - movedBy(s, rule, k, moved));
    }
    for (int node = 0; node < mesh.nodes(); ++node) {
      const auto moved = at(s, node);
      for (int k = 0; k < dimension_; ++k) mesh.lift.motion[Eigen::Index(node) * dimension_ + k] = double(moved[k]);
    }
    const Amplitudes& own = amplitudes_[parts_->partOf[s]];
    mesh.lift.amplitudes.assign(own.begin(), own.end());
  }
}

/// Gaps, and the slips from which the pairs of a law with friction slide: the motion is part of both.
void Lifting::shiftRows() {
  std::vector<End> mine;
  for (std::size_t s = 0; s < meshes_.size(); ++s) {
    const SubdomainMesh& mesh = meshes_[s];
    std::map<int, const ContactPair*> pairs;
    for (const ContactRow& row : mesh.contactRows) pairs[row.pair.id] = &row.pair;
    std::map<int, const NodeRule*> rules;
    for (const NodeRule& rule : mesh.rules) rules[rule.node] = &rule;
    for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) {
      const Span<const int> others = mesh.others(end.node);
      if (std::any_of(others.begin(), others.end(), [&](int other) { return other < mesh.id; })) continue;
      const ContactPair& pair = *pairs.at(end.pair);
      const auto moved = at(s, end.node);
      End own{end.pair, end.end, {0, 0, 0}, moved, dot(pair.normal, moved), pair.ends[end.end].weight};
      if (const auto rule = rules.find(end.node); rule != rules.end()) {
        const std::vector<Point> directions = rowDirections(pair, dimension_);
        for (int k = 0; k < dimension_; ++k) {
          if (!rule->second->fixed[k]) continue;
          const Point& axis = rule->second->axes[k];
          for (std::size_t row = 0; row < directions.size(); ++row) {
            double across = 0.0;
            for (int c = 0; c < dimension_; ++c) across += axis[c] * directions[row][c];
            own.given[row] += Extended(own.weight) * across * rule->second->value[k];
          }
        }
      }
      mine.push_back(own);
    }
  }
  std::vector<End> ends = joinEverywhere(comm_, mine);
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.pair != b.pair ? a.pair < b.pair : a.end < b.end; });

  struct Shift {
    Extended moved = 0, size = 0;
    std::array<Extended, 3> given{0, 0, 0}, slid{0, 0, 0};
  };
  std::map<int, Shift> shifts;
  for (std::size_t first = 0, last = 0; first < ends.size(); first = last) {
    Shift& shift = shifts[ends[first].pair];
    Extended sum = 0, size = 0;
    for (last = first; last < ends.size() && ends[last].pair == ends[first].pair; ++last) {
      sum += ends[last].weight;
      size += std::abs(ends[last].weight);
      for (std::size_t row = 0; row < 3; ++row) shift.given[row] += ends[last].given[row];
    }
    // Equal motion of both sides changes no gap, even if mortar weights sum to zero only up to round-off.
    const bool isBalanced = std::abs(sum) <= kBalanced * size;
    const Extended common = isBalanced ? ends[first].along : 0;
    const std::array<Extended, 3> commonMotion = isBalanced ? ends[first].moved : std::array<Extended, 3>{0, 0, 0};
    for (std::size_t e = first; e < last; ++e) {
      for (std::size_t k = 0; k < 3; ++k) shift.slid[k] += ends[e].weight * (ends[e].moved[k] - commonMotion[k]);
      shift.moved += ends[e].weight * (ends[e].along - common);
      shift.size += std::abs(ends[e].weight * ends[e].along);
    }
  }
  for (SubdomainMesh& mesh : meshes_)
    for (ContactRow& row : mesh.contactRows) {
      const Shift& shift = shifts.at(row.pair.id);
      const double before = mesh.lift.gaps.emplace(row.pair.id, row.pair.gap).first->second;
      // Bodies that were moved into contact must touch: round-off would press them together or separate them.
      const Extended size = shift.size + std::abs(before), rest = before - shift.moved;
      row.pair.gap = shift.moved != 0 && std::abs(rest) <= kNoGap * size ? 0.0 : double(rest);
      row.normal().gap = double(row.pair.gap - shift.given[0]);
      if (!row.restrictsSliding()) continue;
      const Point slid = slidingPart(row.pair, {double(shift.slid[0]), double(shift.slid[1]), double(shift.slid[2])});
      const Point slipped = mesh.lift.slips.emplace(row.pair.id, row.pair.past.slip).first->second;
      row.pair.past.slip = minus(slipped, slid);
      const std::vector<Point> directions = rowDirections(row.pair, dimension_);
      for (std::size_t k = 1; k < row.equations.size(); ++k)
        row.equations[k].gap = double(suture::dot(row.pair.past.slip, directions[k]) - shift.given[k]);
    }
}

void Lifting::findParts() {
  dimension_ = agreedDimensionOf(comm_, meshes_);
  std::vector<const SubdomainMesh*> pointers;
  for (const SubdomainMesh& mesh : meshes_) pointers.push_back(&mesh);
  parts_ = std::make_unique<BodyParts>(comm_, pointers, dimension_);
}

bool Lifting::run() {
  if (!carry_ && !prescribesMotion(comm_, meshes_)) return false;
  for (const SubdomainMesh& mesh : meshes_)
    if (mesh.lift.motion.size() > 0) throw InternalError("rigid motions taken out of a scene twice");
  findParts();
  if (!choose()) return false;
  shiftRules();
  shiftRows();
  return true;
}

/// Starts from the values of the scene, not from the remainders of the last motion: a motion that is undone leaves no round-off.
void Lifting::further(const std::vector<Vector>& motion) {
  findParts();
  for (const Vector& amplitudes : motion) amplitudes_.push_back(extended(amplitudes));
  std::vector<char> added(motion.size(), 0);
  for (std::size_t s = 0; s < meshes_.size(); ++s) {
    const std::size_t part = std::size_t(parts_->partOf[s]);
    if (added[part]) continue;
    added[part] = 1;
    const std::vector<Extended>& before = meshes_[s].lift.amplitudes;
    for (std::size_t k = 0; k < before.size(); ++k) amplitudes_[part][k] += before[k];
  }
  shiftRules();
  shiftRows();
}

}  // namespace

bool prescribesMotion(const Comm& comm, const std::vector<SubdomainMesh>& meshes) {
  int any = 0, all = 0;
  for (const SubdomainMesh& mesh : meshes)
    for (const NodeRule& rule : mesh.rules)
      for (int k = 0; k < mesh.dimension; ++k) any = any || (rule.fixed[k] && rule.value[k] != 0.0);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, any, Teuchos::outArg(all));
  return all > 0;
}

bool takeOutRigidMotions(const Comm& comm, std::vector<SubdomainMesh>& meshes, const CarriedMotions& carry) {
  return Lifting(comm, meshes, carry).run();
}

void moveFurther(const Comm& comm, std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& motion) {
  Lifting(comm, meshes, {}).further(motion);
}

void adopt(const Comm& comm, const std::vector<SubdomainMesh>& meshes, Constraints& constraints) {
  struct Value {
    GlobalId node;
    Point value;
  };
  struct Gap {
    int pair;
    double gap;
    Point slip;
  };
  std::vector<Value> values;
  std::vector<Gap> gaps;
  for (const SubdomainMesh& mesh : meshes) {
    for (const NodeRule& rule : mesh.rules) values.push_back({mesh.globalNodes[rule.node], rule.value});
    for (const ContactRow& row : mesh.contactRows) gaps.push_back({row.pair.id, row.pair.gap, row.pair.past.slip});
  }
  const std::vector<Value> allValues = joinOnRoot(comm, values);
  const std::vector<Gap> allGaps = joinOnRoot(comm, gaps);
  if (comm.getRank() != 0) return;
  for (const Value& value : allValues) {
    const auto rule = std::lower_bound(constraints.rules.begin(), constraints.rules.end(), value.node,
                                       [](const NodeRule& one, GlobalId node) { return one.node < node; });
    if (rule == constraints.rules.end() || rule->node != value.node) throw InternalError("the mesh does not have a rule of a subdomain");
    rule->value = value.value;
  }
  for (const Gap& gap : allGaps) {
    ContactPair& pair = constraints.pairs.at(gap.pair);
    pair.gap = gap.gap;
    pair.past.slip = gap.slip;
  }
}

Vector withLift(const SubdomainMesh& mesh, Vector beside) {
  if (mesh.lift.motion.size() > 0) beside += mesh.lift.motion;
  return beside;
}

Vector besideLift(const SubdomainMesh& mesh, Vector displacement) {
  if (mesh.lift.motion.size() > 0) displacement -= mesh.lift.motion;
  return displacement;
}

}  // namespace suture
