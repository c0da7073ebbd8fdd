#pragma once
#include <support/DenseAlgebra.hpp>
#include <support/DryLaw.hpp>
#include <suture/search/LinearContactSolver.hpp>
#include <suture/search/RigidBodyModel.hpp>

#include <cmath>
#include <memory>
#include <random>

namespace suture {

using SearchLaw = std::shared_ptr<const ContactLaw>;

/// Nodes of one body before a rigid ground, condensed to them: K u + f = load, u_n <= gap. Components of a node: normal, tangents.
struct CondensedBody : LinearContactSolver {
  int dimension, nodes;
  Matrix stiffness, kernel;
  Vector load, gap;
  ContactLaws laws;
  std::vector<int> line;
  std::vector<FrictionSite> sites;
  std::unique_ptr<RigidBodyModel> rigid;
  int solves = 0;
  bool strange = false;  // a pair had a state that its law does not have
  Vector u;              // solution of the last solve

  CondensedBody(int dims, int count) : dimension(dims), nodes(count), gap(Vector::Zero(count)) {
    stiffness = Matrix::Zero(dims * count, dims * count);
    kernel = Matrix(dims * count, 0);
    load = Vector::Zero(dims * count);
    line.assign(count, 0);
  }

  void random(std::mt19937& engine, bool loose) {
    std::normal_distribution<double> value;
    const int m = nodes * dimension;
    Matrix a(m, m + 2);
    for (double& x : a.reshaped()) x = value(engine);
    stiffness = (a * a.transpose() + 3.0 * m * Matrix::Identity(m, m)) / m;
    for (double& x : load) x = value(engine);
    for (double& x : gap) x = 0.2 * value(engine);
    if (!loose) return;
    kernel = Matrix::Zero(m, dimension);  // translations
    for (int i = 0; i < m; ++i) kernel(i, i % dimension) = 1.0;
    const Matrix away = Matrix::Identity(m, m) - kernel * kernel.transpose() / nodes;
    stiffness = (away * stiffness * away).eval();
  }

  /// Call after everything else is set.
  void begin(std::vector<SearchLaw> all, const std::vector<int>& lines) {
    laws = ContactLaws(std::move(all));
    line = lines;
    RigidBodyModel::Pairs pairs;
    const auto motions = kernel.cols();
    std::vector<Matrix> effects(dimension, Matrix::Zero(nodes, motions));  // by component
    pairs.work = kernel.transpose() * load;
    pairs.penetration = -gap;
    pairs.stiffness = Vector::Ones(nodes);
    pairs.line = line;
    pairs.bodies.assign(nodes, {0});
    pairs.canChange.assign(nodes, 1);
    pairs.bound.assign(nodes, 0);
    pairs.surfaces = dimension == 3;
    for (int i = 0; i < nodes; ++i) {
      for (int k = 0; k < dimension; ++k) effects[k].row(i) = kernel.row(dimension * i + k);
      pairs.stiffness(i) = stiffness(dimension * i, dimension * i);
      sites.push_back({{0.1 * i, 0, 0}, 1.0, stiffness(dimension * i + 1, dimension * i + 1)});
      if (laws.of(line[i]).separates()) continue;
      pairs.canChange[i] = 0;
      pairs.bound[i] = 1;
    }
    pairs.rows = effects[0].sparseView();
    for (int k = 1; k < dimension; ++k) pairs.tangents.emplace_back(effects[k].sparseView());
    rigid = std::make_unique<RigidBodyModel>(std::move(pairs));
  }

  PairStates all(PairStatus status) const {
    PairStates states(nodes, status);
    for (int i = 0; i < nodes; ++i)
      if (!laws.of(line[i]).separates() || laws.of(line[i]).rows(dimension) == 1) states[i] = laws.of(line[i]).pressed();
    return states;
  }

  // One linear system in displacements and forces; unknown forces of rows that do not hold follow from the states.
  ContactAnswer solve(const PairStates& states, double) override {
    ++solves;
    for (int i = 0; i < nodes; ++i) strange = strange || (laws.of(line[i]).rows(dimension) == 1 && states[i].status == PairStatus::Stick);
    const int n = nodes * dimension;
    Matrix a = Matrix::Zero(2 * n, 2 * n);
    Vector b = Vector::Zero(2 * n);
    a.topLeftCorner(n, n) = stiffness;
    a.topRightCorner(n, n).setIdentity();
    b.head(n) = load;
    for (int i = 0; i < nodes; ++i) {
      const ContactState& state = states[i];
      for (int k = 0; k < dimension; ++k) {
        const int row = dimension * i + k;
        if (state.holds(k)) {
          a(n + row, row) = 1.0;
          b(n + row) = k == 0 ? gap(i) : 0.0;
          continue;
        }
        a(n + row, n + row) = 1.0;
        if (k == 0) continue;
        if (state.closed()) {
          a(n + row, n + dimension * i) = -state.friction * state.direction[k];
          b(n + row) = state.bound * state.direction[k];
        }
        const Point across{0.0, -state.direction[2], state.direction[1]};
        for (int j = 1; j < dimension; ++j) a(n + row, dimension * i + j) -= state.transverseStiffness * across[k] * across[j];
      }
    }
    ContactAnswer answer;
    if (dense::rank(a) < 2 * n) {
      answer.solved = false;
      return answer;
    }
    const Vector x = dense::solve(a, b);
    u = x.head(n);
    answer.force = answer.jump = Matrix::Zero(nodes, 3);
    for (int i = 0; i < nodes; ++i)
      for (int k = 0; k < dimension; ++k) {
        answer.force(i, k) = x(n + dimension * i + k);
        if (!states[i].holds(k)) answer.jump(i, k) = u(dimension * i + k) - (k == 0 ? gap(i) : 0.0);
      }
    answer.energy = 0.5 * u.dot(stiffness * u) - load.dot(u);
    const double size = answer.force.rowwise().norm().maxCoeff();
    answer.forceTolerance = Vector::Constant(nodes, 1e-11 * size);
    answer.jumpTolerance = Vector::Constant(nodes, 1e-12 * (u.cwiseAbs().maxCoeff() + gap.cwiseAbs().maxCoeff()));
    force = answer.force;
    return answer;
  }

  void move(const Vector& motion) override { u += kernel * motion; }
  Vector motion() const override { return kernel.transpose() * u / nodes; }

  /// Largest violation of the optimality conditions by the last solve, each condition separately; relative to the largest force.
  double violation() const {
    const double size = force.cwiseAbs().maxCoeff() + 1e-6 * load.cwiseAbs().maxCoeff() + 1e-300,
                 length = u.cwiseAbs().maxCoeff() + gap.cwiseAbs().maxCoeff();
    double worst = 0.0;
    const auto atMost = [&](double value, double bound, double scale) { worst = std::max(worst, (value - bound) / scale); };
    Vector balance = stiffness * u - load;
    for (int i = 0; i < nodes; ++i) {
      const ContactLaw& law = laws.of(line[i]);
      const double normal = force(i, 0), open = gap(i) - u(dimension * i), tangential = std::hypot(force(i, 1), force(i, 2));
      for (int k = 0; k < dimension; ++k) balance(dimension * i + k) += force(i, k);
      double slip = 0.0, work = 0.0;
      for (int k = 1; k < dimension; ++k) {
        slip = std::hypot(slip, u(dimension * i + k));
        work += force(i, k) * u(dimension * i + k);
      }
      if (!law.separates()) {
        atMost(std::abs(open), 0.0, length);
        law.rows(dimension) > 1 ? atMost(slip, 0.0, length) : atMost(tangential, 0.0, size);
        continue;
      }
      atMost(-normal, 0.0, size);
      atMost(-open, 0.0, length);
      atMost(std::min(normal / size, open / length), 0.0, 1.0);
      double bound = 0.0;
      if (law.rows(dimension) > 1 && open < 1e-9 * length) {
        // The bound from a trial that certainly slides.
        ContactTrial trial;
        trial.place = sites[i].place;
        trial.size = sites[i].size;
        trial.force[0] = std::max(normal, 1e-300);
        trial.jump[1] = 1e10;
        bound = law.project(trial, PairStatus::Slip).largest(normal);
      }
      atMost(tangential, bound, size);
      atMost(bound * slip - work, 0.0, size * length);  // at its bound, and along the slip, where it slips
    }
    atMost(balance.cwiseAbs().maxCoeff(), 0.0, size + load.cwiseAbs().maxCoeff());
    return worst;
  }

 private:
  Matrix force;
};

/// States of all pairs from the digits of a number: open, stick, slip either way.
inline PairStates statesOfNumber(int number, int pairs, double cohesion, double mu) {
  PairStates states(pairs);
  for (int i = 0; i < pairs; ++i, number /= 4) {
    if (number % 4 == 1) states[i] = PairStatus::Stick;
    if (number % 4 > 1) states[i] = {PairStatus::Slip, {0.0, number % 4 == 2 ? 1.0 : -1.0, 0.0}, cohesion, mu};
  }
  return states;
}

}  // namespace suture
