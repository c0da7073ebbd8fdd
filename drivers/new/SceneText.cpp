#include "SceneText.hpp"

#include <algorithm>
#include <sstream>
#include <suture/base/scene/Xml.hpp>

namespace suture::proposal {

namespace {

/// XML forbids two hyphens in a comment.
std::string inComment(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at)) text.replace(at, 2, "- -");
  return text;
}

std::string number(double value) {
  std::ostringstream text;
  text.precision(6);
  text << (value == 0.0 ? 0.0 : value);
  return text.str();
}

std::string point(const Point& p, int dimension = 2) {
  std::string text = "(";
  for (int k = 0; k < dimension; ++k) text += (k > 0 ? ", " : "") + number(p[k]);
  return text + ")";
}

std::string array(const std::vector<std::string>& names) {
  std::string text = "{";
  for (std::size_t i = 0; i < names.size(); ++i) text += (i > 0 ? ", " : "") + names[i];
  return text + "}";
}

class Writer {
 public:
  void comment(const std::string& words) { line("<!-- " + inComment(words) + " -->"); }
  void open(const std::string& name) {
    line("<ParameterList name=\"" + escaped(name) + "\">");
    ++depth_;
  }
  void close() {
    --depth_;
    line("</ParameterList>");
  }
  void parameter(const std::string& name, const std::string& type, const std::string& value, const std::string& words = "") {
    line("<Parameter name=\"" + escaped(name) + "\" type=\"" + type + "\" value=\"" + escaped(value) + "\"/>" +
         (words.empty() ? "" : "  <!-- " + inComment(words) + " -->"));
  }
  /// Lines that wait for the user: a comment which holds parameters.
  void example(const std::string& words, const std::vector<std::string>& lines) {
    line("<!-- " + inComment(words));
    for (const std::string& text : lines) line("  " + text);
    line("-->");
  }
  void line(const std::string& text) { text_ << std::string(2 * depth_, ' ') << text << "\n"; }
  void space() { text_ << "\n"; }
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::size_t depth_ = 0;
};

std::string entry(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
}

void listGroups(Writer& out, const NewScene& scene) {
  out.line("<!-- Surface groups (bodies and their parts), curve groups (places for conditions and contact):");
  for (std::size_t b = 0; b < scene.bodies.names.size(); ++b)
    out.line(
        inComment("  body    " + scene.bodies.names[b] + "  from " + point(scene.boxes[b].first) + " to " + point(scene.boxes[b].second)));
  for (const auto& [part, body] : scene.bodies.parts) out.line(inComment("  part    " + part + "  of " + body));
  for (const Group& group : scene.groups)
    out.line(inComment("  curve   " + group.name + "  " +
                       (group.body >= 0 ? "on " + scene.bodies.names[group.body] : std::string("on several bodies")) + ", from " +
                       point(group.low) + " to " + point(group.high) + ", " + std::to_string(group.sides) + " sides, length " +
                       number(group.size)));
  out.line("-->");
}

void materials(Writer& out, const NewScene& scene) {
  out.open("Bodies");
  for (const std::string& body : scene.bodies.names) {
    out.open(body);
    out.parameter("Material", "string", "steel");
    std::vector<std::string> regions;
    for (const auto& [part, of] : scene.bodies.parts)
      if (of == body) {
        regions.push_back("<ParameterList name=\"" + escaped(part) + "\">");
        regions.push_back("  " + entry("Group", "string", escaped(part)));
        regions.push_back("  " + entry("Material", "string", "steel"));
        regions.push_back("</ParameterList>");
      }
    if (!regions.empty()) {
      regions.insert(regions.begin(), "<ParameterList name=\"Regions\">");
      regions.push_back("</ParameterList>");
      for (std::string& text : regions) text = inComment(text);
      out.example("parts with materials of their own:", regions);
    }
    out.close();
  }
  out.close();
  out.open("Materials");
  out.open("steel");
  out.parameter("Young Modulus", "double", "2.1e11", "FILL IN: in units of stress");
  out.parameter("Poisson Ratio", "double", "0.3", "FILL IN");
  out.close();
  out.close();
}

void conditions(Writer& out, const NewScene& scene) {
  out.open("Boundary Conditions");
  for (const Support& support : scene.supports) {
    const bool moved = support.displacement != Point{0, 0, 0};
    out.open((moved ? "push " : "hold ") + support.body);
    out.parameter("Group", "string", support.group, "FILL IN: an example that lets the scene run");
    out.parameter("Type", "string", "Displacement");
    out.parameter("Value", "Array(double)", "{" + number(support.displacement[0]) + ", " + number(support.displacement[1]) + "}");
    out.close();
  }
  out.example(
      "the other kinds, each with the Group it acts on:",
      {"<ParameterList name=\"roller\">", "  " + entry("Group", "string", "..."),
       "  " + entry("Type", "string", "Bilateral") + "   normal displacement zero, free to slide", "</ParameterList>",
       "<ParameterList name=\"pressure\">", "  " + entry("Group", "string", "..."), "  " + entry("Type", "string", "Pressure"),
       "  " + entry("Value", "Array(double)", "{1e6}") + "   positive pushes into the body", "</ParameterList>",
       "<ParameterList name=\"traction\">", "  " + entry("Group", "string", "..."), "  " + entry("Type", "string", "Traction"),
       "  " + entry("Value", "Array(double)", "{0, 1e6}") + "   force on an area", "</ParameterList>", "<ParameterList name=\"weight\">",
       "  " + entry("Type", "string", "Body Force"),
       "  " + entry("Value", "Array(double)", "{0, -7.7e4}") + "   force on a volume; on one body with a Body", "</ParameterList>"});
  out.close();
}

void contacts(Writer& out, const NewScene& scene) {
  if (scene.contacts.all.empty()) {
    out.example("no curve groups of different bodies face each other; a contact is",
                {"<ParameterList name=\"Contact\">", "  <ParameterList name=\"joint\">", "    " + entry("Side A", "string", "..."),
                 "    " + entry("Side B", "string", "..."), "  </ParameterList>", "</ParameterList>"});
    return;
  }
  out.open("Contact");
  for (const Contact& contact : scene.contacts.all) {
    out.open(contact.sideA + " on " + (contact.sideB.size() == 1 ? contact.sideB[0] : contact.sideB[0] + " and others"));
    out.comment("proposed: least distance " + number(contact.gap));
    out.parameter("Side A", "string", contact.sideA);
    if (contact.sideB.size() == 1)
      out.parameter("Side B", "string", contact.sideB[0]);
    else
      out.parameter("Side B", "Array(string)", array(contact.sideB));
    out.close();
  }
  out.close();
}

}  // namespace

std::string sceneText(const NewScene& scene) {
  Writer out;
  out.open("Suture");
  out.comment("Made by suture_new. It runs as it is; FILL IN marks examples. 'suture_schema' documents every parameter.");
  listGroups(out, scene);
  out.space();
  out.parameter("Title", "string", scene.title);
  out.parameter("Model", "string", scene.model, "Plane Strain | Plane Stress | Axisymmetric");
  out.parameter("Units", "string", "m, N, Pa", "FILL IN: printed, never converted; all numbers of the scene are in these");
  out.space();
  out.open("Mesh");
  out.parameter("File", "string", scene.file);
  if (!scene.constants.empty()) {
    out.open("Constants");
    for (const std::string& constant : scene.constants) {
      const std::size_t at = constant.find('=');
      out.parameter(constant.substr(0, at), "double", constant.substr(at + 1));
    }
    out.close();
  }
  out.close();
  out.space();
  materials(out, scene);
  out.space();
  conditions(out, scene);
  out.space();
  contacts(out, scene);
  out.space();
  out.open("Output");
  out.parameter("Nodal Stresses", "bool", "true", "largest values at boundaries; off saves a tenth of the time of a large scene");
  out.close();
  out.close();
  return out.text();
}

}  // namespace suture::proposal
