// A schema with one parameter of every kind, and scenes for it.
#pragma once
#include <support/Texts.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>

#include <string>
#include <vector>

namespace suture::scenes {

inline Schema bodySchema() {
  return Schema("one body")
      .text("Material", std::nullopt, "name of a material")
      .real("Thickness", 1.0, "out of the plane", Range::positive());
}

inline Schema sceneSchema() {
  Range poisson{-1.0, 0.5, true, true, "an incompressible body needs a mixed element"};
  return Schema("a scene")
      .text("Title", "", "of the run")
      .boolean("Check", false, "only check")
      .oneOf("Model", "Plane Strain", {"Plane Strain", "Plane Stress"}, "stress state")
      .text("Plugin", std::nullopt, "may be absent")
      .optional()
      .list("Bodies", Schema("all bodies").each("body", bodySchema(), 1), true)
      .list("Constants", Schema("of Gmsh").eachReal("name", "a constant"))
      .list("Material", Schema("elastic").real("Poisson Ratio", 0.3, "nu", poisson))
      .list("Load", Schema("what pulls")
                        .reals("Value", std::vector<double>{0.0, 0.0}, "components", "stress")
                        .integers("Nodes", std::vector<int>{}, "numbers", Range::atLeast(0))
                        .texts("Groups", std::vector<std::string>{}, "names"))
      .list(
          "Outer Solver",
          Schema("contact iterations")
              .real("Tolerance", 1e-8, "where to stop", Range::positive())
              .integer("Maximum Iterations", 50, "at most", Range::atLeast(1))
              .choice("Type", "Newton",
                      {{"Newton", Schema("tangent").real("Inner Tolerance", 1e-2, "relative", Range::positive())},
                       {"Chord", Schema("majorant").integer("Depth", std::nullopt, "of Anderson", Range::atLeast(0))},
                       {"Successive Approximation",
                        Schema("the paper's").wordOrNumber("Relaxation", "Automatic", {"None", "Automatic"}, Range::positive(), "theta")}},
                      "the method"));
}

inline const char* const body =
    R"(<ParameterList name="Bodies"><ParameterList name="left"><Parameter name="Material" type="string" value="rock"/>
  </ParameterList></ParameterList>)";

inline std::string scene(const std::string& inside) {
  return "<ParameterList name=\"Suture\">\n" + std::string(body) + "\n" + inside + "\n</ParameterList>\n";
}

inline std::string parameter(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\"" + (type.empty() ? "" : " type=\"" + type + "\"") + " value=\"" + value + "\"/>";
}

inline std::string list(const std::string& name, const std::string& inside) {
  return "<ParameterList name=\"" + name + "\">" + inside + "</ParameterList>";
}

inline SceneFile parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parseScene(text, "dir/scene.xml", sceneSchema(), overrides);
}

/// The full error message, or "" if there was none.
inline std::string errorOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline std::string errorOfSolver(const std::string& inside) { return errorOf(scene(list("Outer Solver", inside))); }

using texts::contains;

}  // namespace suture::scenes
