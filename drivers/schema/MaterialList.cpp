#include "MaterialList.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/elasticity/materials/MaterialFiles.hpp>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

namespace suture {

namespace {

/// A value of a material, as it is printed: in units in which engineers know it.
struct Column {
  const char *name, *unit, *heading;
  double factor;  ///< from SI
};

constexpr Column kColumns[] = {{"Young Modulus", "GPa", "E [GPa]", 1e-9},
                               {"Poisson Ratio", "", "nu", 1.0},
                               {"Density", "kg/m^3", "density [kg/m^3]", 1.0},
                               {"Thermal Expansion", "e-6 / K", "expansion [1e-6 / K]", 1e6},
                               {"Yield Strength", "MPa", "yield [MPa]", 1e-6},
                               {"Tensile Strength", "MPa", "tensile [MPa]", 1e-6},
                               {"Compressive Strength", "MPa", "compressive [MPa]", 1e-6}};

std::string number(double value) {
  std::ostringstream text;
  text.precision(6);
  text << value;
  return text.str();
}

std::string valueIn(const Parameters& material, const Column& column) {
  return material.isType<double>(column.name) ? number(material.get<double>(column.name) * column.factor) : "";
}

std::string textIn(const Parameters& material, const char* name) {
  return material.isType<std::string>(name) ? material.get<std::string>(name) : "";
}

std::string moduli(const Parameters& list, const char* name, double factor) {
  std::string all;
  for (const double value : list.get<Teuchos::Array<double>>(name)) all += (all.empty() ? "" : ", ") + number(value * factor);
  return all;
}

/// Values in lists: constants of strength criteria and of the orthotropic law.
std::vector<std::string> further(const Parameters& material) {
  std::vector<std::string> all;
  const Parameters &shear = material.sublist("Mohr-Coulomb"), &rock = material.sublist("Hoek-Brown");
  if (shear.isType<double>("Cohesion"))
    all.push_back("cohesion " + number(shear.get<double>("Cohesion") * 1e-6) + " MPa, friction angle " +
                  number(shear.get<double>("Friction Angle")) + " degrees");
  if (rock.isType<double>("m_i")) all.push_back("m_i " + number(rock.get<double>("m_i")));
  if (textIn(material, "Type") != "Orthotropic") return all;
  const Parameters& own = material.sublist("Orthotropic");
  all.push_back("E_1, E_2, E_3 " + moduli(own, "Young Moduli", 1e-9) + " GPa; nu_12, nu_23, nu_13 " + moduli(own, "Poisson Ratios", 1.0) +
                "; G_12, G_23, G_13 " + moduli(own, "Shear Moduli", 1e-9) + " GPa");
  return all;
}

/// The criterion that a scene gets without further parameters.
std::string criterion(const Parameters& material) {
  const std::string given = textIn(material, "Strength");
  if (given != "Automatic") return given;
  return material.isType<double>("Yield Strength") ? "von Mises" : "None";
}

std::string joined(const std::vector<std::string>& parts, const char* between) {
  std::string all;
  for (const std::string& part : parts) all += (all.empty() || part.empty() ? "" : between) + part;
  return all;
}

std::string asText(const Parameters& materials) {
  std::string all;
  for (const std::string& name : sublistNames(materials)) {
    const Parameters& material = materials.sublist(name);
    std::vector<std::string> values;
    for (const Column& column : kColumns)
      if (const std::string value = valueIn(material, column); !value.empty())
        values.push_back(std::string(column.name) + " " + value +
                         (*column.unit ? std::string(column.unit[0] == 'e' ? "" : " ") + column.unit : ""));
    for (const std::string& one : further(material)) values.push_back(one);
    values.push_back("Strength " + criterion(material));
    all += name + "\n    " + textIn(material, "Title") + "\n    " + joined(values, ", ") + "\n    Source: " + textIn(material, "Source") +
           "\n";
    if (const std::string remarks = textIn(material, "Remarks"); !remarks.empty()) all += "    " + remarks + "\n";
  }
  return all;
}

std::string asMarkdown(const Parameters& materials) {
  std::string all = "| name | material |", line = "|---|---|";
  for (const Column& column : kColumns) {
    all += " " + std::string(column.heading) + " |";
    line += "---|";
  }
  all += " `Strength` |\n" + line + "---|\n";
  std::string sources;
  for (const std::string& name : sublistNames(materials)) {
    const Parameters& material = materials.sublist(name);
    all += "| `" + name + "` | " + textIn(material, "Title") + " |";
    for (const Column& column : kColumns) all += " " + valueIn(material, column) + " |";
    all += " " + criterion(material) + " |\n";
    const std::vector<std::string> rest = further(material);
    const std::string remarks = joined({joined(rest, "; "), textIn(material, "Remarks")}, ". ");
    sources += "| `" + name + "` | " + textIn(material, "Source") + " | " + remarks + " |\n";
  }
  return all + "\n## Sources and ranges\n\n| name | source | remarks |\n|---|---|---|\n" + sources;
}

}  // namespace

std::string materialList(const std::string& format) {
  const std::string path = builtInMaterialFile();
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, std::string("cannot be read: ") + std::strerror(errno));
  std::ostringstream text;
  text << file.rdbuf();
  if (format == "xml") return text.str();
  const SceneFile all = parseScene(text.str(), path, materialFileSchema());
  return format == "markdown" ? asMarkdown(*all.parameters) : asText(*all.parameters);
}

}  // namespace suture
