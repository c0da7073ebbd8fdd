#pragma once
#include <Teuchos_CommHelpers.hpp>
#include <suture/condensed/CondensedProblem.hpp>

#include <set>
#include <support/Blocks.hpp>

namespace suture::blocks {

/// A scene's interface problem over a communicator.
struct Interface {
  Scene scene;
  Blocks all;
  CondensedProblem problem;
  InterfaceState closed;                       ///< zero trace, all pairs closed
  InterfaceProblem::Linearisation linearised;  ///< there
  std::shared_ptr<const InterfaceSpace> space;
  std::vector<GlobalId> overlap;  ///< unknowns that this rank sees, in the order of space->overlap()

  Interface(const Scene& given, const CommPtr& comm, const std::vector<double>& youngOf = {}, const std::string& solver = "CHOLMOD",
            const std::string& schur = "Implicit");
  const InterfaceOperator& matrix() const { return *linearised.matrix; }
};

/// A distributed interface and its copy on every rank alone, whose unknowns, ascending, are the rows of dense vectors and matrices here:
/// the same on any number of ranks.
struct Twins {
  Interface spread, single;

  explicit Twins(const Scene& scene, const std::vector<double>& youngOf = {})
      : spread(scene, world(), youngOf), single(scene, alone(), youngOf) {}

  int size() const { return int(single.overlap.size()); }
  int place(GlobalId unknown) const;

  MultiVectorPtr toSpread(const Matrix& values) const { return to(spread, values); }
  MultiVectorPtr toSingle(const Matrix& values) const { return to(single, values); }

  /// Collective.
  Matrix toDense(const MultiVector& values) const;

  /// The same for a vector of the copy, whose order on one rank need not be ascending. Local.
  Matrix toDenseSingle(const MultiVector& values) const;

  /// A distributed operator as a dense matrix, column by column. Collective.
  Matrix toDense(const Operator& op) const;

 private:
  static Vector ranksThatSee(const Interface& one);
  MultiVectorPtr to(const Interface& one, const Matrix& values) const;
};

/// wavyBlocks() held below, pressed and moved on top: some pairs open, some closed.
Scene pressed(Scene scene);
inline Scene pressedBlocks(int refinement = 1) { return pressed(wavyBlocks(100.0, 40.0, refinement)); }

/// Three stacked blocks, the lowest fixed, the uppermost turned down on its right end; two contact groups, which may be on two ranks.
/// \param middleRows  subdomains of the middle block: with 3 a plain one lies between the groups, with 2 they touch
Scene stackedBlocks(int middleRows);

/// A rectangle of 3 x 2 subdomains moved on its left side and loaded; no contact.
Scene loadedRectangle();

}  // namespace suture::blocks
