#include <precond/BrickScenes.hpp>
#include <precond/Sheets.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/interface/InterfaceSpace.hpp>

namespace suture::blocks {

namespace {

class Sheet : public LocalProblem {
 public:
  Sheet(int id, std::vector<GlobalId> boundary, const Matrix& schur)
      : LocalProblem(id, "sheet", std::move(boundary)), schur_(schur), diagonal_(schur.diagonal()) {
    const Eigenpairs pairs = symmetricEigenpairs(schur);
    int nulls = 0;
    while (pairs.values(nulls) < 1e-10 * pairs.values(pairs.values.size() - 1)) ++nulls;
    kernel_ = pairs.vectors.leftCols(nulls);
  }
  void applySchur(ConstLocalView trace, LocalView flux) const override { flux = schur_ * trace; }
  Vector condensedLoad() const override { return Vector::Zero(size()); }
  double constantEnergy() const override { return 0.0; }
  const Vector& stiffnessDiagonal() const override { return diagonal_; }
  const Matrix& kernel() const override { return kernel_; }
  std::unique_ptr<LocalInverse> inverse() const override { return nullptr; }
  using LocalProblem::inverse;
  Matrix schur() const override { return schur_; }

 private:
  Matrix schur_, kernel_;
  Vector diagonal_;
};

}  // namespace

Sheets::Sheets(const CommPtr& comm, double jump, const std::vector<double>& stiffness) {
  const int cells = 9;
  InterfaceLayout layout;
  std::vector<GlobalId> line;
  InterfaceLayout::Entity edge{EntityKind::Edge, {0, 1, 2}, {}, {}};
  std::vector<InterfaceLayout::Unknown> unknowns;
  for (const int sheet : {0, 1, 2}) {
    const Blocks all(sheet < 2 ? bricks(2, 1, cells, jump, 3, 2) : bricks(2, 1, cells, jump, 2, 3), alone());
    const Subdomain& own = *all.subdomains[sheet % 2];
    const std::vector<int> shared = sharedDofs(own);
    schur.push_back(stiffness[sheet] * denseSchur(own.stiffness().dense(), shared));
    if (sheet > 0) continue;
    for (std::size_t k = 0; k < shared.size(); ++k) {
      const Point place = own.mesh().point(own.nodeOf(shared[k]));
      line.push_back(GlobalId(k));
      unknowns.push_back({GlobalId(k), place, own.direction(shared[k])});
      const bool end = place[1] < 1e-9 || place[1] > 1 - 1e-9;
      edge.unknowns.push_back(GlobalId(k));
      if (end)
        edge.ends.push_back(GlobalId(k));
      else
        inner.push_back(int(k));
    }
  }
  LocalProblems locals;
  for (int sheet = comm->getRank(); sheet < 3; sheet += comm->getSize()) {
    layout.dimension = 2;
    layout.locals.push_back(sheet);
    layout.boundaries.push_back(line);
    layout.unknowns = unknowns;
    layout.entities = {edge};
    locals.push_back(std::make_shared<Sheet>(sheet, line, schur[sheet]));
  }
  matrix = Teuchos::rcp(new InterfaceOperator(std::make_shared<InterfaceSpace>(comm, layout), std::move(locals)));
}

}  // namespace suture::blocks
