#include <interface/Interfaces.hpp>

namespace suture::blocks {

Interface::Interface(const Scene& given, const CommPtr& comm, const std::vector<double>& youngOf, const std::string& solver,
                     const std::string& schur)
    : scene(given),
      all(given, comm, youngOf),
      problem(comm, all.partition, all.subdomains, localSolver(solver), [schur] { return schurComplement(schur); }),
      closed(problem.initialState()),
      linearised(problem.linearise(closed)),
      space(problem.space()) {
  std::set<GlobalId> seen;
  for (const auto& local : linearised.matrix->locals()) seen.insert(local->boundary().begin(), local->boundary().end());
  overlap.assign(seen.begin(), seen.end());
}

int Twins::place(GlobalId unknown) const {
  return int(std::lower_bound(single.overlap.begin(), single.overlap.end(), unknown) - single.overlap.begin());
}

Matrix Twins::toDense(const MultiVector& values) const {
  Matrix seen;
  spread.space->gather(values, seen);
  const Vector ranks = ranksThatSee(spread);
  Matrix mine = Matrix::Zero(size(), seen.cols()), sum(size(), seen.cols());
  for (std::size_t i = 0; i < spread.overlap.size(); ++i) mine.row(place(spread.overlap[i])) = seen.row(i) / ranks(i);
  Teuchos::reduceAll(*spread.space->comm(), Teuchos::REDUCE_SUM, int(mine.size()), mine.data(), sum.data());
  return sum;
}

Matrix Twins::toDenseSingle(const MultiVector& values) const {
  Matrix seen;
  single.space->gather(values, seen);
  return seen;
}

Matrix Twins::toDense(const Operator& op) const {
  const MultiVectorPtr x = toSpread(Matrix::Identity(size(), size())), y = spread.space->vector(size());
  op.apply(*x, *y);
  return toDense(*y);
}

Vector Twins::ranksThatSee(const Interface& one) {
  Matrix ones = Matrix::Ones(int(one.overlap.size()), 1);
  one.space->sum(ones);
  return ones.col(0);
}

MultiVectorPtr Twins::to(const Interface& one, const Matrix& values) const {
  const Vector ranks = ranksThatSee(one);
  Matrix seen(int(one.overlap.size()), values.cols());
  for (std::size_t i = 0; i < one.overlap.size(); ++i) seen.row(i) = values.row(place(one.overlap[i])) / ranks(i);
  const MultiVectorPtr made = one.space->vector(int(values.cols()));
  one.space->scatterAdd(seen, *made);
  return made;
}

Scene pressed(Scene scene) {
  scene.fixLower();
  scene.hold("upper_top", 0, 0.01);
  scene.hold("upper_top", 1, -0.015);
  return scene;
}

Scene stackedBlocks(int middleRows) {
  std::vector<Box> all(3);
  const char* names[3] = {"lower", "middle", "upper"};
  for (int k = 0; k < 3; ++k) {
    all[k].name = names[k];
    all[k].y0 = k;
    all[k].y1 = k + 1;
    all[k].nx = 4;
    all[k].ny = 6;
    all[k].blocksY = k == 1 ? middleRows : 2;
  }
  Scene scene = scenes::fromBoxes(all, 100.0, 0.3);
  scene.sideA = "middle_top";
  scene.sideB = "upper_bottom";
  scene.pairUp();
  const Constraints above = scene.constraints;
  scene.sideA = "lower_top";
  scene.sideB = "middle_bottom";
  scene.pairUp();
  scene.constraints.pieces.push_back({"above", {}, {1, 2}, {}, 0.0, {}});
  for (ContactPair pair : above.pairs) {
    pair.id = int(scene.constraints.pairs.size());
    pair.line = pair.piece = 1;
    scene.constraints.pairs.push_back(pair);
    scene.constraints.pieces.back().pairs.push_back(pair.id);
  }
  scene.fixLower();
  scene.hold("upper_top", 0, 0.0);
  scene.hold("upper_top", 1, -0.01);
  for (int node : scene.nodesOf("upper_top"))
    if (scene.mesh.point(node)[0] < 0.3) scene.holdNode(node, 1, 0.03);
  scene.holdNode(scene.constraints.pairs[2].ends[1].node, 0, 0.0);  // the middle block may not slide out
  return scene;
}

Scene loadedRectangle() {
  Box box;
  box.x1 = 3;
  box.y1 = 2;
  box.nx = 9;
  box.ny = 6;
  box.blocksX = 3;
  box.blocksY = 2;
  Scene scene = scenes::fromBoxes({box}, 50.0, 0.3);
  scene.hold("body_left", 0, 0.01);
  scene.hold("body_left", 1, -0.02);
  scene.pressure("body_top", 3.0);
  scene.model.loads.push_back({Load::Kind::BodyForce, "", {0.5, -2.0, 0}});
  return scene;
}

}  // namespace suture::blocks
