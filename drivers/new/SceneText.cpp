#include "SceneText.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <sstream>
#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/base/scene/Xml.hpp>

namespace suture::proposal {

namespace {

constexpr std::size_t kWidth = 120;  // characters per comment line

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

/// Components without round-off digits. \param least  smaller components are round-off
std::string components(const Point& p, int dimension, double least) {
  std::string text;
  for (int k = 0; k < dimension; ++k) text += (k > 0 ? ", " : "") + number(std::abs(p[k]) > least ? p[k] : 0.0);
  return text;
}

/// The value of an Array(double), without components far below the accuracy of a mean normal.
std::string vector(const Point& p, int dimension) { return "{" + components(p, dimension, 1e-5 * norm(p)) + "}"; }

/// Names of neighbouring lists, including lists in comments, since each may be uncommented.
class Names {
 public:
  /// Makes a name unique by appending a number, and replaces the characters that separate names in a path.
  std::string unique(std::string name) {
    for (const char* mark : {"->", "/", "="})
      for (std::size_t at = name.find(mark); at != std::string::npos; at = name.find(mark, at)) name.replace(at, std::strlen(mark), "_");
    std::string own = name;
    for (int i = 2; !taken_.insert(own).second; ++i) own = name + " " + std::to_string(i);
    return own;
  }

 private:
  std::set<std::string> taken_;
};

std::string array(const std::vector<std::string>& names) {
  std::string text = "{";
  for (std::size_t i = 0; i < names.size(); ++i) text += (i > 0 ? ", " : "") + names[i];
  return text + "}";
}

class Writer {
 public:
  /// Writes a comment, wrapped between words.
  void comment(const std::string& words) { line(wrapped("<!-- " + inComment(words) + " -->")); }
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
  /// Writes a comment that contains parameters, which the user may uncomment.
  void example(const std::string& words, const std::vector<std::string>& lines) {
    line(wrapped("<!-- " + inComment(words)));
    for (const std::string& text : lines) line("  " + text);
    line("-->");
  }
  void line(const std::string& text) { text_ << std::string(2 * depth_, ' ') << text << "\n"; }
  void space() { text_ << "\n"; }
  std::string text() const { return text_.str(); }

 private:
  std::string wrapped(const std::string& words) const {
    std::istringstream rest(words);
    std::string text, word;
    std::size_t column = 0;
    while (rest >> word) {
      const bool next = column > 0 && column + word.size() > kWidth && word != "-->";
      text += (next ? "\n" + std::string(2 * depth_ + 5, ' ') : column > 0 ? " " : "") + word;
      column = (next ? 5 : column + 1) + word.size();
    }
    return text;
  }

  std::ostringstream text_;
  std::size_t depth_ = 0;
};

std::string entry(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
}

/// Gmsh's terms for groups of sides: physical curves in 2D, physical surfaces in 3D.
std::string sideWord(const NewScene& scene) { return scene.dimension == 2 ? "curve" : "surface"; }
std::string physicalSide(const NewScene& scene) { return scene.dimension == 2 ? "Physical Curve" : "Physical Surface"; }

void listGroups(Writer& out, const NewScene& scene) {
  double scale = 0.0;
  for (const auto& [low, high] : scene.boxes) scale = std::max({scale, norm(low), norm(high)});
  // A CAD kernel is accurate to about 1e-10 of the drawing.
  const auto place = [&](const Point& p) { return "(" + components(p, scene.dimension, 1e-9 * scale) + ")"; };
  out.line(std::string("<!-- ") + (scene.dimension == 2 ? "Surface" : "Volume") + " groups (bodies and their parts), " + sideWord(scene) +
           " groups (for conditions and contact):");
  for (std::size_t b = 0; b < scene.bodies.names.size(); ++b)
    out.line(
        inComment("  body    " + scene.bodies.names[b] + "  from " + place(scene.boxes[b].first) + " to " + place(scene.boxes[b].second)));
  for (const auto& [part, body] : scene.bodies.parts) out.line(inComment("  part    " + part + "  of " + body));
  const auto shape = [&](const Group& group) {
    const auto at = scene.descriptions.find(group.name);
    return at == scene.descriptions.end() ? std::string() : ", " + at->second;
  };
  for (const Group& group : scene.groups)
    out.line(inComment("  " + (sideWord(scene) + "   ").substr(0, 8) + group.name + "  " +
                       (group.body >= 0 ? "on " + scene.bodies.names[group.body] : std::string("on several bodies")) + shape(group) +
                       ", from " + place(group.low) + " to " + place(group.high) + ", " + std::to_string(group.sides) +
                       (scene.dimension == 2 ? " element edges, length " : " element faces, area ") + number(group.size)));
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
      out.example("parts with other materials:", regions);
    }
    out.close();
  }
  out.close();
  out.open("Materials");
  out.open("steel");
  out.parameter("Young Modulus", "double", number(scene.units.youngModulus()), "FILL IN: in the unit of stress");
  out.parameter("Poisson Ratio", "double", "0.3", "FILL IN");
  out.close();
  out.close();
}

/// Writes an example for each straight edge, or plane face, of the whole geometry whose groups belong to several bodies: it may be a plane
/// of symmetry.
void symmetries(Writer& out, const NewScene& scene, Names& given) {
  Point low = scene.boxes[0].first, high = scene.boxes[0].second;
  for (const auto& [least, most] : scene.boxes)
    for (int k = 0; k < scene.dimension; ++k) {
      low[k] = std::min(low[k], least[k]);
      high[k] = std::max(high[k], most[k]);
    }
  const double rounding = 1e-9 * norm(minus(high, low));
  for (int k = 0; k < scene.dimension; ++k)
    for (const double edge : {low[k], high[k]}) {
      std::vector<std::string> names;
      std::set<int> bodies;
      for (const Group& group : scene.groups)
        if (std::abs(group.low[k] - edge) < rounding && std::abs(group.high[k] - edge) < rounding) {
          names.push_back(group.name);
          bodies.insert(group.bodies.begin(), group.bodies.end());
        }
      if (bodies.size() < 2) continue;
      const std::string list = names.size() == 1 ? escaped(names[0]) : escaped(array(names));
      out.example(std::string("if ") + "xyz"[k] + " = " + number(std::abs(edge) > rounding ? edge : 0.0) + " is a plane of symmetry:",
                  {"<ParameterList name=\"" + given.unique(std::string("symmetry ") + "xyz"[k]) + "\">",
                   "  " + inComment(entry("Group", names.size() == 1 ? "string" : "Array(string)", list)),
                   "  " + entry("Type", "string", "Bilateral"), "</ParameterList>"});
    }
}

void conditions(Writer& out, const NewScene& scene) {
  out.open("Boundary Conditions");
  Names given;
  const Supports& supports = scene.supports;
  if (supports.held.empty() && supports.soft.empty())
    out.example(
        "FILL IN: the geometry has no " + sideWord(scene) + " group; name one to hold a body (in Gmsh: " + physicalSide(scene) + "):",
        {"<ParameterList name=\"" + given.unique("hold") + "\">", "  " + entry("Group", "string", "..."),
         "  " + entry("Type", "string", "Displacement"), "  " + entry("Value", "Array(double)", vector({0, 0, 0}, scene.dimension)),
         "</ParameterList>"});
  else if (supports.held.empty())
    out.comment("FILL IN: no group can be held, since all are in contact or reach both sides of a contact; springs hold all bodies.");
  else {
    out.comment("FILL IN: placeholder for the supports: holds the lowest body at its lowest side.");
    out.open(given.unique("hold " + supports.heldBody));
    out.parameter("Group", "string", supports.held);
    out.parameter("Type", "string", "Displacement");
    out.parameter("Value", "Array(double)", vector({0, 0, 0}, scene.dimension));
    out.close();
  }
  if (!supports.pushed.empty()) {
    out.comment(std::string("FILL IN: placeholder for the loads: ") +
                (supports.pushedBody == supports.heldBody ? "compresses the body by a ten-thousandth of its size."
                 : supports.byForce                       ? "pushes the body into contact by a force, since all its sides may touch."
                                                          : "pushes the body into contact, by the gap plus a ten-thousandth of its size."));
    out.open(given.unique("push " + supports.pushedBody));
    out.parameter("Group", "string", supports.pushed);
    out.parameter("Type", "string", supports.byForce ? "Force" : "Displacement");
    out.parameter("Value", "Array(double)", vector(supports.push, scene.dimension));
    out.close();
  }
  if (!supports.soft.empty()) {
    out.comment(
        "FILL IN: placeholder for the supports of " + joinNames(supports.softBodies) +
        ": springs on all their sides, a thousandth as stiff as the bodies, because contact alone does not hold a body in every direction. "
        "Remove the groups of a body once it has its own conditions. Keep the springs of a body that is held only by contact: they "
        "determine its position.");
    out.open(given.unique("soft springs"));
    if (supports.soft.size() == 1)
      out.parameter("Group", "string", supports.soft[0]);
    else
      out.parameter("Group", "Array(string)", array(supports.soft));
    out.parameter("Type", "string", "Elastic Support");
    out.parameter("Normal Stiffness", "double", number(supports.stiffness),
                  "stress / length: Young Modulus / extent of the geometry / 1000");
    out.parameter("Tangential Stiffness", "double", number(supports.stiffness));
    out.close();
  }
  for (const std::string& body : supports.loose)
    out.example(
        "FILL IN: body '" + body + "' has no " + sideWord(scene) +
            " group and cannot be held. Name one of its sides in the geometry, then:",
        {"<ParameterList name=\"" + inComment(escaped(given.unique("keep " + body))) + "\">", "  " + entry("Group", "string", "..."),
         "  " + entry("Type", "string", "Elastic Support"), "  " + entry("Normal Stiffness", "double", number(supports.stiffness)),
         "  " + entry("Tangential Stiffness", "double", number(supports.stiffness)), "</ParameterList>"});
  symmetries(out, scene, given);
  const auto kind = [&](const std::string& name, const std::string& words, const std::vector<std::string>& lines) {
    std::vector<std::string> all{"<ParameterList name=\"" + given.unique(name) + "\">"};
    for (const std::string& text : lines) all.push_back("  " + text);
    all.emplace_back("</ParameterList>");
    out.example(words, all);
  };
  const auto down = [&](double value) { return vector({0, scene.dimension == 2 ? value : 0, value}, scene.dimension); };
  const std::string group = entry("Group", "string", "..."), value = "Value", reals = "Array(double)";
  kind("roller support", "alternative: a roller (zero normal displacement, free to slide)", {group, entry("Type", "string", "Bilateral")});
  kind("pressure", "alternative: a pressure (positive values push into the body)",
       {group, entry("Type", "string", "Pressure"), entry(value, reals, "{" + number(scene.units.pressure()) + "}")});
  kind("traction", "alternative: a traction (force per area)",
       {group, entry("Type", "string", "Traction"), entry(value, reals, down(-scene.units.pressure()))});
  kind("weight", "alternative: a weight (force per volume; Body restricts it to one body)",
       {entry("Type", "string", "Body Force"), entry(value, reals, down(-scene.units.weight()))});
  out.close();
}

std::string unitsWords(const NewScene& scene) {
  const std::string all = "FILL IN: names for output; nothing is converted: give all numbers in these units";
  return scene.isConverted ? "FILL IN: the mesh is made in this unit of length; give all other numbers in these units" : all;
}

void contacts(Writer& out, const NewScene& scene) {
  if (scene.contacts.all.empty()) {
    out.example("no " + sideWord(scene) + " groups of different bodies face each other; a contact would be:",
                {"<ParameterList name=\"Contact\">", "  <ParameterList name=\"joint\">", "    " + entry("Side A", "string", "..."),
                 "    " + entry("Side B", "string", "..."), "  </ParameterList>", "</ParameterList>"});
    return;
  }
  out.open("Contact");
  out.comment(searchText(scene.contacts));
  Names given;
  for (const Contact& contact : scene.contacts.all) {
    const std::string name = given.unique(nameOf(contact));
    if (!contact.problems.empty()) {
      out.example("FILL IN: " + name + " (" + distanceText(contact) + ") is left out: " + joinNames(contact.problems),
                  {"<ParameterList name=\"" + inComment(escaped(name)) + "\">", "  " + entry("Side A", "string", "..."),
                   "  " + entry("Side B", "string", "..."), "</ParameterList>"});
      continue;
    }
    out.open(name);
    out.comment("proposed: " + distanceText(contact));
    for (const auto& [side, names] : {std::make_pair("Side A", contact.sideA), std::make_pair("Side B", contact.sideB)})
      out.parameter(side, names.size() == 1 ? "string" : "Array(string)", names.size() == 1 ? names[0] : array(names));
    out.close();
  }
  out.close();
}

}  // namespace

std::string distanceText(const Contact& contact) {
  return contact.gap < 0 ? "overlap of " + number(-contact.gap) + ", an interference fit" : "minimum distance " + number(contact.gap);
}

std::string searchText(const Contacts& contacts) {
  return "contacts: sides of different bodies that face each other, up to " + number(contacts.reach) +
         " apart (a twentieth of the smaller body, at least 1.5 element edges)";
}

std::string sceneText(const NewScene& scene) {
  Writer out;
  out.open("Suture");
  out.comment(
      std::string("Created by suture_new. ") +
      (scene.supports.loose.empty()
           ? "The scene runs as it is. Replace the placeholders marked FILL IN."
           : "The scene runs once you add conditions for the bodies below that cannot be held. Replace the placeholders marked FILL IN.") +
      " 'suture_schema' documents every parameter.");
  listGroups(out, scene);
  out.space();
  out.parameter("Title", "string", scene.title);
  out.parameter("Model", "string", scene.model, scene.dimension == 2 ? "Plane Strain | Plane Stress | Axisymmetric" : "");
  out.parameter("Units", "string", scene.units.names(), unitsWords(scene));
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
  out.parameter("Nodal Stresses", "bool", "true",
                "stresses at boundaries, where they are largest; false saves a tenth of the time of a large scene");
  out.close();
  out.close();
  return out.text();
}

}  // namespace suture::proposal
