#include <suture/algebra/CholmodFactor.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/answer/solvability/Solvability.hpp>
#include <suture/base/Errors.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/monolithic/Monolithic.hpp>
#include <suture/monolithic/MonolithicContact.hpp>
#include <suture/monolithic/MonolithicFriction.hpp>
#include <suture/monolithic/MonolithicSystem.hpp>
#include <suture/motion/RigidMotion.hpp>
#include <suture/pairs/PairFrame.hpp>
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

// Rigid motions of loose parts in the contact dofs: orthonormal columns, zero outside their part.
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
    // A part without contact would have zero columns; checkSolvability refuses such scenes.
    if (own.rows() < columns) throw InternalError("a loose part has fewer contact dofs than rigid motions");
    z(dofsOf[p], Eigen::seqN(first[p], columns)) = orthonormalBasis(own, 1e-14);
  }
  return z;
}

// Shift that keeps loose bodies definite; zero for other bodies, whose accuracy it would reduce.
Vector shiftOf(const MonolithicSystem& system, const RigidParts& rigid) {
  const bool anyLoose = std::any_of(rigid.parts.begin(), rigid.parts.end(), [](const RigidPart& part) { return part.free.cols() > 0; });
  if (!anyLoose) return {};
  Vector shift = CholmodFactor::trailingDiagonal(system.stiffness().lower(), system.contactDofs());
  for (int i = 0; i < system.contactDofs(); ++i)
    if (rigid.parts[rigid.partOfNode[system.contactDof()[i].node]].free.cols() == 0) shift[i] = 0.0;
  return shift;
}

/// Contact problem for the correction at the displacement x: `load` are the forces on the free dofs, `held` the resulting displacements of
/// the interior dofs with fixed contact dofs.
struct Rest {
  Vector x, load, held;
};

/// True if some law restricts sliding or never opens a pair.
bool lawsDecide(const Constraints& constraints, int dimension) {
  return std::any_of(constraints.pairs.begin(), constraints.pairs.end(), [&](const ContactPair& pair) {
    const ContactLaw& law = constraints.laws.of(pair.line);
    return law.rows(dimension) > 1 || !law.separates();
  });
}

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
    contact.lines.push_back(constraints.pairs[system.rows()[i].pair].line);
  }
  contact.diagonal = system.stiffness().diagonal().tail(trailing);
  if (!lawsDecide(constraints, mesh.dimension)) return contact;
  const Vector& diagonal = contact.diagonal;
  contact.nodal = Vector::Zero(contact.bounds.size());
  for (std::size_t i = 0; i < contact.dofs.size(); ++i)
    for (std::size_t k = 0; k < contact.dofs[i].size(); ++k)
      contact.nodal[Eigen::Index(i)] += contact.coefficients[i][k] * contact.coefficients[i][k] / diagonal[contact.dofs[i][k]];
  for (std::size_t i = 0; i < system.rows().size(); ++i) {
    const ContactPair& pair = constraints.pairs[system.rows()[i].pair];
    if (system.rows()[i].component == 0)
      contact.pairs.push_back({int(i), 0, &constraints.laws.of(pair.line), pair.position, pair.length, pair.past.slipped});
    ++contact.pairs.back().rows;
  }
  return contact;
}

/// One step of iterative refinement, which restores digits lost in the factorisation: round-off of the stiffest elements acts like springs
/// to the ground and affects the softer elements next to them. The residual is formed from stresses, which vanish in rigid motions, and the
/// contact problem of the residual is solved with the same factor.
void refine(const Mesh& mesh, const Constraints& constraints, const MonolithicSystem& system, const RigidParts& rigid,
            const CholmodFactor& factor, const MonolithicOptions& options, Vector& x, ContactSolution& contact) {
  const Vector diagonal = system.stiffness().diagonal();
  if (diagonal.size() == 0 || (!options.balances && diagonal.maxCoeff() <= kMuchStiffer * diagonal.minCoeff())) return;
  const int trailing = system.contactDofs(), leading = system.dofs() - trailing;
  Rest rest{x, system.onFree(system.nodalForces() - system.internalForces(system.expand(x))), {}};
  Matrix inner = rest.load.head(leading);
  factor.solveLeading(inner);
  Vector step = Vector::Zero(system.dofs());
  if (constraints.pairs.empty()) {
    step = inner;
  } else {
    rest.held = inner;
    const CondensedContact problem = condense(mesh, constraints, system, rigid, factor, rest);
    const auto quiet = [](const ActiveSetStep&) {};
    const ContactSolution found = problem.pairs.empty() ? solveCondensedContact(problem, contact.active, options.maximumIterations, quiet)
                                                        : solveFriction(problem, contact.states, options.maximumIterations, quiet);
    if (!found.converged) return;
    contact.force = found.force;
    contact.active = found.active;
    contact.states = found.states;
    step.tail(trailing) = found.x;
    inner = rest.load.head(leading) - (system.stiffness() * step).head(leading);
    factor.solveLeading(inner);
    step.head(leading) = inner;
  }
  x += step;
}

// Energy and balance from element forces of the final displacement, independent of the factorisation.
void balance(const Mesh& mesh, const Constraints& constraints, const MonolithicSystem& system, MonolithicResult& result) {
  const int dimension = mesh.dimension;
  const Vector internal = system.internalForces(result.displacement);
  result.energy = 0.5 * result.displacement.dot(internal) - result.displacement.dot(system.nodalForces());

  Vector support = internal - system.nodalForces();
  for (const PairForce& pair : result.forces) {
    const ContactPair& condition = constraints.pairs[pair.id];
    const Point force = plus(scaled(pair.force, condition.normal), pair.tangential);
    for (const PairEnd& end : condition.ends)
      for (int k = 0; k < dimension; ++k) support[Eigen::Index(end.node) * dimension + k] += end.weight * force[k];
    result.balance.addPair(condition, force);
  }
  std::vector<const NodeRule*> ruleOf(mesh.nodes(), nullptr);
  for (const NodeRule& rule : constraints.rules) ruleOf[rule.node] = &rule;
  const RigidGroupNodes rigid(constraints.rigidGroups, dimension);
  for (int i = 0; i < mesh.nodes(); ++i)
    result.balance.addNode(nodal(system.nodalForces(), i, dimension), nodal(support, i, dimension), ruleOf[i], dimension,
                           rigid.contains(i));
  system.addParts(result.displacement, result.balance);
  result.balance.finish(mesh.axisymmetric);
}

std::vector<PairForce> pairForces(const Mesh& mesh, const Constraints& constraints, const MonolithicSystem& system,
                                  const ContactSolution& contact) {
  std::vector<PairForce> forces;
  for (std::size_t row = 0; row < system.rows().size(); ++row) {
    const ContactPair& pair = constraints.pairs[system.rows()[row].pair];
    const double force = contact.force[Eigen::Index(row)];
    if (const int along = system.rows()[row].component; along > 0) {
      Point& sum = forces.back().tangential;
      sum = plus(sum, scaled(force, pairFrame(pair, mesh.dimension)[along]));
    } else if (contact.states.empty()) {
      forces.push_back({pair.id, contact.active[row] ? constraints.laws.of(pair.line).pressed() : ContactState(), force});
    } else {
      forces.push_back({pair.id, contact.states[pair.id], force});
    }
  }
  return forces;
}

std::vector<PairResult> pairResults(const Mesh& mesh, const Constraints& constraints, const MonolithicResult& result) {
  std::vector<PairResult> results;
  for (const PairForce& force : result.forces) {
    const ContactPair& pair = constraints.pairs[force.id];
    std::vector<Point> ofEnds;
    for (const PairEnd& end : pair.ends) ofEnds.push_back(nodal(result.displacement, end.node, mesh.dimension));
    results.push_back(pairResult(pair, force, ofEnds, PairKind(constraints.laws.of(pair.line), mesh.dimension)));
  }
  return results;
}

/// \param motion  of the contact dofs
[[noreturn]] void refuseSliding(const Mesh& mesh, const MonolithicSystem& system, const Vector& motion) {
  Eigen::Index largest = 0;
  motion.cwiseAbs().maxCoeff(&largest);
  const int node = system.contactDof()[largest].node;
  Point towards{0, 0, 0};
  for (int i = 0; i < system.contactDofs(); ++i)
    if (system.contactDof()[i].node == node) towards = plus(towards, scaled(motion[i], system.contactDof()[i].direction));
  throw NumericalError("no equilibrium exists: body '" + mesh.bodies[mesh.bodyOfNode[node]] + "' slides away, at " +
                       placeText(mesh.point(node), mesh.dimension) + " towards " + placeText(unit(towards), mesh.dimension) +
                       ": friction at its limit cannot carry the loads. Hold the body, reduce its loads, or increase friction");
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
  factor.solveLeading(interior);  // contact dofs fixed at zero
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
    const CondensedContact problem = condense(mesh, constraints, system, rigid, factor, {x, system.load(), interior});
    contact = problem.pairs.empty() ? solveCondensedContact(problem, start, options.maximumIterations, tell)
                                    : solveFriction(problem, options.start, options.maximumIterations, tell);
    if (contact.slides.size() > 0) refuseSliding(mesh, system, contact.slides);
    if (contact.x.size() == 0) throw NumericalError("monolithic solver: " + contact.failure);
    x.tail(trailing) = contact.x;
    interior = system.load().head(leading) - (system.stiffness() * x).head(leading);
    factor.solveLeading(interior);
    x.head(leading) = interior;
  }
  if (contact.converged) refine(mesh, constraints, system, rigid, factor, options, x, contact);
  result.converged = contact.converged;
  result.failure = contact.failure;
  result.displacement = system.expand(x);
  result.contraction = contact.contraction;
  result.forces = pairForces(mesh, constraints, system, contact);
  result.pairs = pairResults(mesh, constraints, result);
  balance(mesh, constraints, system, result);
  return result;
}

}  // namespace suture
