#include <suture/answer/PairResult.hpp>
#include <suture/answer/verdict/VerifyLift.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/RigidValues.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace suture {

namespace {

constexpr double kRounded = 8.0;  // times the round-off of the compared values

/// End of a pair, on the rank that counts its node. Trivially copyable.
struct LiftedEnd {
  int pair, body;
  double closing, size;  // weight x normal . motion, and of its magnitudes
  double weight;
  double before, gap;  // gap of the pair before and after the lift
  Point slid;          // weight x motion, along the sides
  Point slip;          // past slip of the pair, before minus after the lift
  Point place;
};

Point motionOf(const SubdomainMesh& mesh, int node) {
  return pointOf(mesh.lift.motion.data() + Eigen::Index(node) * mesh.dimension, mesh.dimension);
}

Finding at(const SubdomainMesh& mesh, int node) {
  Finding where;
  where.body = mesh.body;
  where.place = mesh.point(node);
  return where;
}

double largestComponent(const Point& p) { return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}); }

/// Rotation of a mesh's motion about its first node. The node farthest from it gives the rotation perpendicular to their line; in 3D the
/// node farthest from this line gives the rotation along it. Zero for a body of revolution.
Point turnOf(const SubdomainMesh& mesh) {
  if (mesh.axisymmetric) return {0, 0, 0};
  const Point origin = mesh.point(0), shift = motionOf(mesh, 0);
  Point arm{0, 0, 0}, turned = shift;
  double farthest = 0.0;
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Point away = minus(mesh.point(node), origin);
    if (const double squared = dot(away, away); squared > farthest) farthest = squared, arm = away, turned = motionOf(mesh, node);
  }
  if (farthest == 0.0) return {0, 0, 0};
  const Point across = scaled(1.0 / farthest, cross(arm, minus(turned, shift)));
  if (mesh.dimension == 2) return across;
  Point offLine{0, 0, 0}, rest{0, 0, 0};
  double most = 0.0;
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Point away = minus(mesh.point(node), origin), off = minus(away, scaled(dot(away, arm) / farthest, arm));
    if (const double squared = dot(off, off); squared > most) {
      most = squared, offLine = off;
      rest = minus(minus(motionOf(mesh, node), shift), cross(across, away));
    }
  }
  return most == 0.0 ? across : plus(across, scaled(dot(arm, cross(offLine, rest)) / (most * farthest), arm));
}

/// Checks that the motion is rigid up to round-off: a few nodes determine the motion of all others. For a body of revolution it is a
/// translation along the axis.
void judgeMotion(const SubdomainMesh& mesh, Findings& findings) {
  const Point origin = mesh.point(0), turn = turnOf(mesh);
  const Point shift = mesh.axisymmetric ? Point{0.0, motionOf(mesh, 0)[1], 0.0} : motionOf(mesh, 0);
  double largest = 0.0;
  for (int node = 0; node < mesh.nodes(); ++node) largest = std::max(largest, largestComponent(motionOf(mesh, node)));
  const double allowed = kRounded * (mesh.dimension - 1) * unitRoundoff * largest;  // in 3D the rotation depends on one more node
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Point arm = minus(mesh.point(node), origin);
    const Point rest = minus(minus(motionOf(mesh, node), shift), rigidDisplacement<double>({0, 0, 0}, turn, arm));
    const double size = largestComponent(rest);
    if (size > 0.0 && findings.isWorse(Quantity::Prescribed, size, allowed))
      findings.take(Quantity::Prescribed, size, allowed, allowed, at(mesh, node));
  }
}

void judgeRules(const SubdomainMesh& mesh, Findings& findings) {
  const RigidGroupNodes rigid(mesh.rigidGroups, mesh.dimension);
  for (std::size_t r = 0; r < mesh.rules.size(); ++r) {
    const NodeRule& rule = mesh.rules[r];
    const Point motion = motionOf(mesh, rule.node);
    for (int k = 0; k < mesh.dimension; ++k) {
      if (!rule.fixed[k]) continue;
      const double before = mesh.lift.values.at(r)[k];
      double size = length(motion) + std::abs(before), along = dot(rule.axes[k], motion);
      rigid.forEachMaster(rule.node, k, [&](int node, int component, double coefficient) {
        const double follows = coefficient * dot(rigid.axis(node, component), motionOf(mesh, node));
        along -= follows;
        size += std::abs(follows);
      });
      findings.take(Quantity::Prescribed, std::abs(along + rule.value[k] - before), kRounded * unitRoundoff * size, size,
                    at(mesh, rule.node));
    }
  }
}

void collectEnds(const SubdomainMesh& mesh, std::vector<LiftedEnd>& ends) {
  std::map<int, const ContactPair*> pairs;
  for (const ContactRow& row : mesh.contactRows) pairs[row.pair.id] = &row.pair;
  for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) {
    if (!counts(mesh, end.node)) continue;
    const ContactPair& pair = *pairs.at(end.pair);
    const Point motion = motionOf(mesh, end.node);
    const double weight = pair.ends[end.end].weight;
    ends.push_back({end.pair, mesh.body, weight * dot(pair.normal, motion), std::abs(weight) * length(motion), weight,
                    mesh.lift.gaps.at(end.pair), pair.gap, slidingPart(pair, scaled(weight, motion)),
                    minus(mesh.pastSlip(pair), pair.past.slip), pair.position});
  }
}

void judgeGaps(std::vector<LiftedEnd> ends, Findings& findings) {
  std::stable_sort(ends.begin(), ends.end(), [](const LiftedEnd& a, const LiftedEnd& b) { return a.pair < b.pair; });
  for (std::size_t first = 0, last = 0; first < ends.size(); first = last) {
    double gap = ends[first].before, size = std::abs(gap), weights = 0.0, magnitudes = 0.0, far = 0.0;
    Point slid = ends[first].slip;
    Finding where;
    where.pair = ends[first].pair;
    where.place = ends[first].place;
    where.body = where.other = ends[first].body;
    for (last = first; last < ends.size() && ends[last].pair == where.pair; ++last) {
      gap -= ends[last].closing;
      slid = minus(slid, ends[last].slid);
      size += ends[last].size;
      weights += ends[last].weight;
      magnitudes += std::abs(ends[last].weight);
      far = std::max(far, ends[last].size / std::abs(ends[last].weight));
      if (ends[last].body != where.body) where.other = ends[last].body;
    }
    // If both sides move alike, no gap changes, although the weights of a mortar sum to zero only up to round-off.
    const double unbalanced = std::abs(weights) <= kBalanced * magnitudes ? std::abs(weights) * far : 0.0;
    if (!(size > 0.0)) continue;
    findings.take(Quantity::Prescribed, std::abs(gap - ends[first].gap), kRounded * unitRoundoff * size + unbalanced, size, where);
    if (ends[first].slip != Point{0, 0, 0})
      findings.take(Quantity::Prescribed, length(slid), kRounded * unitRoundoff * size + unbalanced, size, where);
  }
}

}  // namespace

void verifyLift(const Comm& comm, const Answer& answer, const SeamExchange& seams, Findings& findings) {
  int lifted = 0, any = 0;
  for (const SubdomainMesh& mesh : answer.meshes) lifted = lifted || mesh.lift.motion.size() > 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, lifted, Teuchos::outArg(any));
  if (!any) return;
  std::vector<LiftedEnd> ends;
  std::vector<Matrix> motions;
  collectively(comm, "verifying the rigid motions", [&] {
    for (const SubdomainMesh& mesh : answer.meshes) {
      if (mesh.lift.motion.size() != Eigen::Index(mesh.coordinates.size())) throw InternalError("only some subdomains have a lift");
      judgeMotion(mesh, findings);
      judgeRules(mesh, findings);
      collectEnds(mesh, ends);
      motions.emplace_back(Eigen::Map<const Matrix>(mesh.lift.motion.data(), mesh.dimension, mesh.nodes()));
    }
  });
  for (const SeamExchange::Difference& apart : seams.differences(motions)) {
    const SubdomainMesh& mesh = answer.meshes[apart.mesh];
    const double size = length(motionOf(mesh, apart.node));
    findings.take(Quantity::Seams, apart.size, kRounded * unitRoundoff * size, size, at(mesh, apart.node));
  }
  const std::vector<LiftedEnd> all = joinOnRoot(comm, ends);
  if (comm.getRank() == 0) judgeGaps(all, findings);
}

}  // namespace suture
