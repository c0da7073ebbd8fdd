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

}  // namespace suture::blocks
