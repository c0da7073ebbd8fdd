#include <report/SampleRun.hpp>
#include <suture/answer/values/NodalStresses.hpp>

namespace sample {

Stress exactStress() {
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), mu = young / (2 * (1 + poisson));
  const double trace = Uxx + Uyy;
  return {lambda * trace + 2 * mu * Uxx, lambda * trace + 2 * mu * Uyy, lambda * trace, mu * (Uxy + Uyx)};
}

SampleRun::SampleRun(const std::string& folder, int finer)
    : comm_(Tpetra::getDefaultComm()), monitor_(nullptr, false), folder_(folder), finer_(finer) {
  makeScene();
  const suture::Mesh mesh = makeMesh();
  const suture::Partition partition = cut(mesh);
  subdomains_ = suture::distribute(*comm_, mesh, suture::Constraints{}, partition);
  model_.bodies = {"lower", "upper"};
  model_.materialOfBody = {{"rock", young, poisson}, {"rock", young, poisson}};
  makeSolution();
  size_.nodes = 2 * (6 * finer + 1) * (3 * finer + 1);
  size_.elements = 2 * 2 * 6 * 3 * finer * finer;
  size_.dofs = 100;
  size_.interfaceDofs = 8;
  size_.subdomains = 3;
  size_.groups = 1;
  size_.pairs = 4;
  size_.pieces = 2;
  monitor_.auxiliary(solution_.auxiliary);
  for (const auto& row : rows()) monitor_.outer(row);
  timers_.add("solve", 0.25 * (1 + comm_->getRank()));
}

std::vector<suture::OuterRow> SampleRun::rows() {
  return {{1, 9, 24.125, 3.1e-3, 1e-3, 3, 1, -1.2093e8, 1.0, 0.02}, {2, 7, 24.0, 4.4e-9, 1e-9, 2, 0, -1.2094e8, 0.5, 0.03}};
}

suture::Run SampleRun::run() {
  return {*comm_,
          scene_,
          model_,
          pieces_,
          subdomains_,
          size_,
          solution_,
          monitor_,
          timers_,
          "abcd",
          {{"suture_solve", "scene.xml", "--set", "Outer Solver/Type=Chord"}},
          folder_,
          {"floor, below"},
          {"joint", "crack"}};
}

void SampleRun::makeScene() {
  scene_.path = "somewhere/scene.xml";
  scene_.text = "<ParameterList name=\"Suture\"/>";
  scene_.parameters = Teuchos::rcp(new Teuchos::ParameterList("Suture"));
  scene_.parameters->set<std::string>("Title", "Two \"blocks\"");
  scene_.parameters->set<std::string>("Units", "m, N, Pa");
  scene_.parameters->sublist("Output").set<std::string>("Stress Axes", "Global");
  Teuchos::ParameterList& solver = scene_.parameters->sublist("Outer Solver");
  solver.set<std::string>("Tolerance", "1e-8");
  solver.set("Maximum Iterations", 50);
  solver.set<std::string>("Type", "Active Set");
  solver.set("Values", Teuchos::Array<double>(2, -0.5));
  scene_.parameters->sublist("Partition").sublist("METIS").set("Seed", 7);
}

suture::Mesh SampleRun::makeMesh() const {
  suture::Mesh mesh;
  if (comm_->getRank() != 0) return mesh;
  suture::Box lower, upper;
  lower.name = "lower";
  upper.name = "upper";
  lower.x1 = upper.x1 = 2;
  upper.y0 = 1;
  upper.y1 = 2;
  lower.nx = upper.nx = 6 * finer_;
  lower.ny = upper.ny = 3 * finer_;
  lower.blocksX = 2;
  mesh = suture::boxes({lower, upper});
  suture::assignBodies(mesh, {"lower", "upper"});
  return mesh;
}

suture::Partition SampleRun::cut(const suture::Mesh& mesh) const {
  suture::Partition partition;
  partition.names = {"subdomain_lower_0_0", "subdomain_lower_1_0", "subdomain_upper_0_0"};
  partition.bodyOf = {0, 0, 1};
  partition.elementsOf = {18 * finer_ * finer_, 18 * finer_ * finer_, 36 * finer_ * finer_};
  partition.groupOf = {-1, -1, -1};
  for (int s = 0; s < 3; ++s) partition.rankOf.push_back(s % comm_->getSize());
  partition.subdomainOfElement.assign(std::size_t(mesh.elements()), -1);
  for (int e = 0; e < mesh.elements(); ++e) {
    double x = 0, y = 0;
    for (const int n : mesh.nodesOf(e)) {
      x += mesh.point(n)[0] / 3;
      y += mesh.point(n)[1] / 3;
    }
    partition.subdomainOfElement[std::size_t(e)] = y > 1 ? 2 : (x > 1 ? 1 : 0);
  }
  return partition;
}

void SampleRun::makeSolution() {
  using suture::PairStatus;
  for (const auto& mesh : subdomains_) {
    suture::Vector u(2 * mesh.nodes());
    for (int n = 0; n < mesh.nodes(); ++n) {
      const suture::Point value = displacementAt(mesh.point(n));
      u.segment(2 * n, 2) << value[0], value[1];
    }
    solution_.displacement.push_back(u);
  }
  solution_.nodalStresses =
      suture::nodalStresses(*comm_, subdomains_, model_, suture::recoverStresses(*comm_, subdomains_, model_, solution_.displacement));
  solution_.extremes = suture::findExtremes(*comm_, {subdomains_, model_, solution_.displacement, {}, solution_.nodalStresses});
  solution_.verification.reactions.supports = {{{1, 4, 0}, {0, 0, 2}}};
  solution_.converged = true;
  solution_.outerSolver = "Chord";
  solution_.iterations = 2;
  solution_.pcgTotal = 16;
  solution_.residual = 4.4e-9;
  solution_.auxiliary = {8, 22.6, 1e-2, 3e-3, true};
  solution_.energy = -1.25;
  solution_.verification.balance.applied = {1, -4, 0};
  solution_.verification.balance.reactions = {-1, 4, 0};
  solution_.verification.balance.imbalance = 3e-12;
  solution_.verification.checks = {{"residual", 2e-9, 1e-6, "body 'left', (0, 0)", ""}};
  solution_.estimates = {{"mu", 21.6}};
  if (comm_->getRank() != 0) return;
  pieces_ = {{"joint", {0, 1, 2}, {0, 1}, {{0, 1}, {1, 2}}, 0.0, {}}, {"crack", {3}, {0, 1}, {}, 0.0, {}}};
  const double force[] = {2.0, 3.0, 0.0, 5.0}, gap[] = {0.0, -1e-15, 4e-3, 0.0};
  for (int i = 0; i < 4; ++i) {
    suture::PairResult pair;
    pair.id = i;
    pair.line = pair.piece = i == 3 ? 1 : 0;
    pair.bodies = {0, 1};
    pair.length = 0.5;
    pair.state = i == 2 ? PairStatus::Open : PairStatus::Slip;
    pair.initialGap = 1e-3;
    pair.gap = gap[i];
    pair.force = force[i];
    pair.pressure = force[i] / 0.5;
    pair.arc = i == 3 ? 0.0 : 0.5 * i;
    pair.position = {0.5 * i, 1.0, 0.0};
    pair.displacement = displacementAt(pair.position);
    pair.normal = i == 3 ? suture::Point{0.6, 0.8, 0.0} : suture::Point{0.0, 1.0, 0.0};
    solution_.pairs.push_back(pair);
  }
}

void SampleRun::rub() {
  using suture::PairStatus;
  if (comm_->getRank() != 0) return;
  for (suture::PairResult& pair : solution_.pairs) pair.kind.restrictsSliding = true;
  const auto set = [&](int i, const suture::ContactState& state, const suture::Point& tangential, double bound) {
    suture::PairResult& pair = solution_.pairs[std::size_t(i)];
    pair.state = state;
    pair.tangential = tangential;
    pair.bound = bound;
  };
  set(0, {PairStatus::Slip, {0, -1, 0}, 0, 0.4}, {0.8, 0, 0}, 0.8);  // forces 2, 3, 0, 5
  set(1, {PairStatus::Stick, {0, 0, 0}, 0, 0.4}, {0.6, 0, 0}, 1.2);
  set(3, {PairStatus::Stick, {0, 0, 0}, 0, 0.4}, {0.8, -0.6, 0}, 2.0);
  solution_.pairs[0].slip = {2e-3, 0, 0};
  solution_.pairs[0].dissipated = 1.6e-3;
}

}  // namespace sample
