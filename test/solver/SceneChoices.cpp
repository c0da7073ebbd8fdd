#include <Tpetra_MultiVector.hpp>
#include <solver/SceneChoices.hpp>

namespace suture::blocks {

Schema solverSchema() {
  Schema schema;
  schema.list("Bodies", Schema());
  addSolverParameters(schema);
  return schema;
}

Parameters solverParameters(const std::vector<std::string>& settings) {
  return *parseScene("<ParameterList name=\"Suture\"/>", "test.xml", solverSchema(), settings).parameters;
}

MultiVectorPtr someStep(const InterfaceSpace& space, double size, double seed) {
  const MultiVectorPtr x = space.vector();
  auto values = localView(*x);
  for (Eigen::Index k = 0; k < values.rows(); ++k)
    values(k, 0) = size * std::sin(seed + 12.9898 * double(space.map()->getGlobalElement(int(k)) + 1));
  return x;
}

double norm(const MultiVector& x) { return std::sqrt(dot(x, x)); }

}  // namespace suture::blocks
