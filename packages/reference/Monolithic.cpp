#include <suture/algebra/CholmodFactor.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Errors.hpp>
#include <suture/constraints/RigidMotion.hpp>
#include <suture/reference/Monolithic.hpp>
#include <suture/reference/MonolithicContact.hpp>
#include <suture/reference/MonolithicSystem.hpp>
#include <suture/solver/solvability/Solvability.hpp>
#include <suture/subdomain/SubdomainProblem.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace suture {

namespace {

Point nodal(const Vector& field, int node, int dimension) {
  Point p{0, 0, 0};
  for (int k = 0; k < dimension; ++k) p[k] = field[Eigen::Index(node) * dimension + k];
  return p;
}

// Rigid motions of loose parts, seen in the contact dofs: orthonormal columns, zero outside their part.
Matrix looseMotions(const Mesh& mesh, const MonolithicSystem& system, const RigidParts& rigid) {
  int modes = 0;
  std::vector<int> first;
  for (const RigidPart& part : rigid.parts) {
    first.push_back(modes);
    modes += int(part.free.cols());
  }
  Matrix z = Matrix::Zero(system.contactDofs(), modes);
  std::vector<std::vector<int>> dofsOf(rigid.parts.size());
  for (int i = 0; i < system.contactDofs(); ++i) {
    const auto& [node, direction] = system.contactDof()[i];
    const int p = rigid.partOfNode[node];
    const RigidPart& part = rigid.parts[p];
    if (part.free.cols() == 0) continue;
    dofsOf[p].push_back(i);
    z.row(i).segment(first[p], part.free.cols()) =
        Eigen::Map<const Vector>(direction.data(), mesh.dimension).transpose() * part.at(mesh.point(node), mesh.dimension) * part.free;
  }
  for (std::size_t p = 0; p < rigid.parts.size(); ++p) {
    const Eigen::Index columns = rigid.parts[p].free.cols();
    if (columns == 0) continue;
    const Matrix own = z(dofsOf[p], Eigen::seqN(first[p], columns));
    // A part without contact keeps its columns of zeros; checkSolvability has refused such a scene before.
    if (own.rows() < columns) throw InternalError("a loose part has fewer contact dofs than rigid motions");
    z(dofsOf[p], Eigen::seqN(first[p], columns)) = orthonormalBasis(own, 1e-14);
  }
  return z;
}

// The shift that keeps loose bodies definite; others need none and lose no digits to it.
Vector shiftOf(const MonolithicSystem& system, const RigidParts& rigid) {
  const bool anyLoose = std::any_of(rigid.parts.begin(), rigid.parts.end(), [](const RigidPart& part) { return part.free.cols() > 0; });
  if (!anyLoose) return {};
  Vector shift = CholmodFactor::trailingDiagonal(system.stiffness().lower(), system.contactDofs());
  for (int i = 0; i < system.contactDofs(); ++i)
    if (rigid.parts[rigid.partOfNode[system.contactDof()[i].node]].free.cols() == 0) shift[i] = 0.0;
  return shift;
}

/// Problem that remains at the displacement x: `load` are the forces on the free dofs, `held` the displacements of the interior dofs under
/// them while contact dofs stay where they are.
struct Rest {
  Vector x, load, held;
};

CondensedContact condense(const Mesh& mesh, const Constraints& constraints, const MonolithicSystem& system, const RigidParts& rigid,
                          const CholmodFactor& factor, const Rest& rest) {
  CondensedContact contact;
  contact.stiffness = factor.trailingSchur();
  const int trailing = system.contactDofs(), leading = system.dofs() - trailing;
  Vector held = Vector::Zero(system.dofs());
  held.head(leading) = rest.held;
  contact.load = rest.load.tail(trailing) - (system.stiffness() * held).tail(trailing);
  for (int i = 0; i < trailing; ++i)
    if (i == 0 || mesh.bodyOfNode[system.contactDof()[i].node] != mesh.bodyOfNode[system.contactDof()[i - 1].node])
      contact.blocks.push_back(i);
  contact.blocks.push_back(trailing);
  contact.kernel = looseMotions(mesh, system, rigid);
  contact.surfaces = mesh.dimension == 3;
  contact.bounds.resize(Eigen::Index(system.rows().size()));
  for (std::size_t i = 0; i < system.rows().size(); ++i) {
    contact.dofs.push_back(system.rows()[i].dofs);
    contact.coefficients.push_back(system.rows()[i].coefficients);
    double& bound = contact.bounds[Eigen::Index(i)];
    bound = system.rows()[i].bound;
    for (std::size_t k = 0; k < system.rows()[i].dofs.size(); ++k)
      bound -= system.rows()[i].coefficients[k] * rest.x[leading + system.rows()[i].dofs[k]];
    contact.lines.push_back(constraints.pairs[i].line);
  }
  return contact;
}

/// Restores digits that the factorisation has lost: rounding of the stiffest elements holds them like springs to the ground, and softer
/// ones beside them feel it. One step of iterative refinement: the residual is formed from stresses, which know no rigid motions, and the
/// contact problem of the residual is solved with the same factor.
void refine(const Mesh& mesh, const Constraints& constraints, const MonolithicSystem& system, const RigidParts& rigid,
            const CholmodFactor& factor, int most, Vector& x, ContactSolution& contact) {
  const Vector diagonal = system.stiffness().diagonal();
  if (diagonal.size() == 0 || diagonal.maxCoeff() <= kMuchStiffer * diagonal.minCoeff()) return;
  const int trailing = system.contactDofs(), leading = system.dofs() - trailing;
  Rest rest{x, system.onFree(system.nodalForces() - system.internalForces(system.expand(x))), {}};
  Matrix inner = rest.load.head(leading);
  factor.solveLeading(inner);
  Vector step = Vector::Zero(system.dofs());
  if (constraints.pairs.empty()) {
    step = inner;
  } else {
    rest.held = inner;
    const ContactSolution found =
        solveCondensedContact(condense(mesh, constraints, system, rigid, factor, rest), contact.active, most, [](const ActiveSetStep&) {});
    if (!found.converged) return;
    contact.force = found.force;
    contact.active = found.active;
    step.tail(trailing) = found.x;
    inner = rest.load.head(leading) - (system.stiffness() * step).head(leading);
    factor.solveLeading(inner);
    step.head(leading) = inner;
  }
  x += step;
}

// Energy and balance from element forces of the final displacement: independent of the factorisation.
void balance(const Mesh& mesh, const Constraints& constraints, const MonolithicSystem& system, MonolithicResult& result) {
  const int dimension = mesh.dimension;
  const Vector internal = system.internalForces(result.displacement);
  result.energy = 0.5 * result.displacement.dot(internal) - result.displacement.dot(system.nodalForces());

  Vector support = internal - system.nodalForces();
  for (const PairResult& pair : result.pairs) {
    const ContactPair& condition = constraints.pairs[pair.id];
    for (const PairEnd& end : condition.ends)
      for (int k = 0; k < dimension; ++k) support[Eigen::Index(end.node) * dimension + k] += pair.force * end.weight * condition.normal[k];
    result.balance.addPair(condition, pair.force);
  }
  std::vector<const NodeRule*> ruleOf(mesh.nodes(), nullptr);
  for (const NodeRule& rule : constraints.rules) ruleOf[rule.node] = &rule;
  for (int i = 0; i < mesh.nodes(); ++i)
    result.balance.addNode(nodal(system.nodalForces(), i, dimension), nodal(support, i, dimension), ruleOf[i], dimension);
  system.addParts(result.displacement, result.balance);
  result.balance.finish(mesh.axisymmetric);
}

std::vector<PairResult> pairResults(const Mesh& mesh, const Constraints& constraints, const Vector& displacement, const Vector& force,
                                    const std::vector<char>& active) {
  std::vector<PairResult> results;
  for (const ContactPair& pair : constraints.pairs) {
    std::vector<Point> ofEnds;
    for (const PairEnd& end : pair.ends) ofEnds.push_back(nodal(displacement, end.node, mesh.dimension));
    results.push_back(
        pairResult(pair, {pair.id, active[pair.id] ? constraints.laws.of(pair.line).pressed() : ContactState(), force[pair.id]}, ofEnds));
  }
  return results;
}

}  // namespace

MonolithicResult solveMonolithic(const Mesh& mesh, const Constraints& constraints, const ElasticModel& model,
                                 const MonolithicOptions& options, Monitor& monitor) {
  return solveMonolithic(mesh, constraints, MonolithicSystem(mesh, constraints, model), options, monitor);
}

MonolithicResult solveMonolithic(const Mesh& mesh, const Constraints& constraints, const MonolithicSystem& system,
                                 const MonolithicOptions& options, Monitor& monitor) {
  const auto begin = std::chrono::steady_clock::now();
  const RigidParts rigid = freeRigidMotions(mesh, constraints);
  checkSolvability(mesh, constraints, system.nodalForces(), rigid);

  MonolithicResult result;
  result.dofs = system.dofs();
  result.contactDofs = system.contactDofs();
  const int trailing = system.contactDofs(), leading = system.dofs() - trailing;
  CholmodOptions factorisation;
  factorisation.ordering = options.ordering;
  factorisation.trailing = trailing;
  factorisation.shift = shiftOf(system, rigid);
  const CholmodFactor factor(system.stiffness().lower(), factorisation);
  result.factorEntries = factor.statistics().factorEntries;
  result.factorFlops = factor.statistics().flops;

  Matrix interior = system.load().head(leading);
  factor.solveLeading(interior);  // contact dofs held at zero
  Vector x = Vector::Zero(system.dofs());
  ContactSolution contact;
  contact.converged = true;
  if (constraints.pairs.empty()) {
    x = interior;
  } else {
    const double heldEnergy = system.prescribedEnergy() - 0.5 * system.load().head(leading).dot(interior.col(0));
    std::vector<char> start;
    for (const ContactState& state : options.start) start.push_back(state.closed());
    const auto tell = [&](const ActiveSetStep& step) {
      OuterRow row;
      row.iteration = ++result.iterations;
      row.residual = row.euclidean = step.residual;
      row.active = step.active;
      row.changed = step.changed;
      row.energy = heldEnergy + step.energy;
      row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      result.residual = step.residual;
      result.rows.push_back(row);
      monitor.outer(row);
    };
    contact = solveCondensedContact(condense(mesh, constraints, system, rigid, factor, {x, system.load(), interior}), start,
                                    options.maximumIterations, tell);
    if (contact.x.size() == 0) throw NumericalError("monolithic solver: " + contact.failure);
    x.tail(trailing) = contact.x;
    interior = system.load().head(leading) - (system.stiffness() * x).head(leading);
    factor.solveLeading(interior);
    x.head(leading) = interior;
  }
  if (contact.converged) refine(mesh, constraints, system, rigid, factor, options.maximumIterations, x, contact);
  result.converged = contact.converged;
  result.failure = contact.failure;
  result.displacement = system.expand(x);
  result.pairs = pairResults(mesh, constraints, result.displacement, contact.force, contact.active);
  balance(mesh, constraints, system, result);
  return result;
}

}  // namespace suture
