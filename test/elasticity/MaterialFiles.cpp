// Materials of files: the built-in file, units, own files, entries based on others, and refused input.
#include <Teuchos_ParameterList.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <fstream>
#include <set>
#include <sstream>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/materials/MaterialFiles.hpp>

namespace suture {
namespace {

Schema sceneWithMaterials() {
  Schema scene("a scene");
  scene.text("Units", "m, N, Pa", "names").list("Bodies", Schema().each("body", bodySchema()), true);
  scene.list("Materials", Schema().each("material", materialSchema()));
  addMaterialFilesParameter(scene);
  return scene.completedBy(materialFiles());
}

std::string parameter(const std::string& name, const std::string& value) {
  return "<Parameter name='" + name + "' value='" + value + "'/>";
}

std::string list(const std::string& name, const std::string& content) {
  return "<ParameterList name='" + name + "'>" + content + "</ParameterList>";
}

/// A scene with one body. \param top  further entries
std::string sceneText(const std::string& material, const std::string& top = "") {
  return list("Suture", list("Bodies", list("part", parameter("Material", material))) + top);
}

/// Reads a scene with own files given as texts.
SceneFile read(const std::string& text, const std::map<std::string, std::string>& files = {}, const std::vector<std::string>& set = {}) {
  IncludedFiles included;
  for (const auto& [path, content] : files) included[path] = {content, ""};
  return parseScene(text, "scene.xml", sceneWithMaterials(), set, "", included);
}

const Parameters& materialOf(const SceneFile& scene, const std::string& name) {
  return scene.parameters->sublist("Materials").sublist(name);
}

/// All errors of a scene, one per line.
std::string errors(const std::string& text, const std::map<std::string, std::string>& files = {}) {
  std::string all;
  try {
    read(text, files);
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems()) all += problem.path + ": " + problem.message + "\n";
  }
  return all;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEUCHOS_UNIT_TEST(MaterialFiles, EveryBuiltInMaterialIsCompleteAndCited) {
  std::ifstream file(builtInMaterialFile());
  std::ostringstream text;
  text << file.rdbuf();
  const SceneFile all = parseScene(text.str(), builtInMaterialFile(), materialFileSchema());
  TEST_COMPARE_ARRAYS(sublistNames(*all.parameters), builtInMaterials());
  TEST_COMPARE(builtInMaterials().size(), >=, 40u);
  std::set<std::string> criteria;
  for (const std::string& name : builtInMaterials()) {
    const Parameters& material = all.parameters->sublist(name);
    for (const char* needed : {"Title", "Source"}) TEST_COMPARE(material.get<std::string>(needed).size(), >, 10u);
    TEST_ASSERT(material.isType<double>("Density"));
    // Values of no standard carry their range, except physical constants of standards.
    if (has(material.get<std::string>("Source"), "Typical")) TEST_ASSERT(material.isType<std::string>("Remarks"));
    // In the units of a scene, with a valid law and strength.
    const SceneFile scene = read(sceneText(name, parameter("Units", "mm, N, MPa")));
    const Parameters& converted = materialOf(scene, name);
    const std::string type = converted.get<std::string>("Type");
    const auto law = Registry<MaterialLaw>::instance().make(type, converted.isSublist(type) ? converted.sublist(type) : converted);
    const double young = nearestIsotropic(law->stiffness()).young;  // throws for an invalid law
    Problems problems;
    if (const auto strength = strengthOf(converted, problems)) criteria.insert(strength->name());
    TEST_ASSERT(problems.empty());
    // Moduli of solids in MPa, densities in t / mm^3: wrong powers of ten would be outside.
    TEST_COMPARE(young, >, 1.0);
    TEST_COMPARE(young, <, 3e5);
    TEST_COMPARE(converted.get<double>("Density"), >, 4e-10);
    TEST_COMPARE(converted.get<double>("Density"), <, 1e-8);
    if (converted.isType<double>("Thermal Expansion")) TEST_COMPARE(converted.get<double>("Thermal Expansion"), <, 3e-4);
  }
  TEST_EQUALITY(criteria.size(), 3u);  // rocks have none until the scene chooses one
}

TEUCHOS_UNIT_TEST(MaterialFiles, BuiltInSteelInTheUnitsOfTheScene) {
  const SceneFile si = read(sceneText("S355")), mm = read(sceneText("S355", parameter("Units", "mm, N, MPa")));
  TEST_EQUALITY(materialOf(si, "S355").get<double>("Young Modulus"), 2.1e11);
  TEST_EQUALITY(materialOf(mm, "S355").get<double>("Young Modulus"), 2.1e5);
  TEST_EQUALITY(materialOf(mm, "S355").get<double>("Yield Strength"), 355.0);
  TEST_EQUALITY(materialOf(mm, "S355").get<double>("Density"), 7.85e-9);
  TEST_EQUALITY(materialOf(mm, "S355").get<double>("Poisson Ratio"), 0.3);
  TEST_ASSERT(has(materialOf(mm, "S355").get<std::string>("Source"), "EN 10025-2") &&
              has(materialOf(mm, "S355").get<std::string>("Source"), "(built-in material)"));
  TEST_ASSERT(mm.notes.empty());
  // Lists are converted, too: moduli of wood, strengths of rock.
  const SceneFile woods = read(sceneText("Spruce", parameter("Units", "m, kN, kPa"))),
                  rocks = read(sceneText("Granite", parameter("Units", "m, MN, MPa")));
  const Parameters &wood = materialOf(woods, "Spruce"), &rock = materialOf(rocks, "Granite");
  TEST_FLOATING_EQUALITY(wood.sublist("Orthotropic").get<Teuchos::Array<double>>("Young Moduli")[0], 1.188e7, 1e-14);
  TEST_FLOATING_EQUALITY(wood.sublist("Orthotropic").get<Teuchos::Array<double>>("Poisson Ratios")[0], 0.372, 1e-14);
  TEST_EQUALITY(rock.sublist("Mohr-Coulomb").get<double>("Cohesion"), 55.0);
  TEST_EQUALITY(rock.sublist("Hoek-Brown").get<double>("m_i"), 32.0);
}

TEUCHOS_UNIT_TEST(MaterialFiles, UnitsThatCannotBeConvertedAreErrorsOnlyIfAMaterialNeedsThem) {
  TEST_ASSERT(has(errors(sceneText("S355", parameter("Units", "mm, N, Pa"))), "Units: 'mm, N, Pa' is not consistent"));
  TEST_ASSERT(has(errors(sceneText("S355", parameter("Units", "furlong, N, Pa"))), "Units: no such unit of length 'furlong'"));
  TEST_ASSERT(has(errors(sceneText("S355", parameter("Units", "mm, N, Pa"))), "material 'S355' from a file is converted to these units"));
  const std::string own = list("Materials", list("mine", parameter("Young Modulus", "1") + parameter("Poisson Ratio", "0")));
  TEST_EQUALITY(errors(sceneText("mine", own + parameter("Units", "furlong, N, Pa"))), "");
}

TEUCHOS_UNIT_TEST(MaterialFiles, UnknownNamesListTheNearestOfAllSources) {
  const std::string file = list("Materials", list("alloy 7", parameter("Young Modulus", "1") + parameter("Poisson Ratio", "0")));
  const std::string files = parameter("Material Files", "own.xml");
  TEST_ASSERT(has(errors(sceneText("S356")), "Bodies/part/Material: no such material 'S356'. Did you mean 'S355'?"));
  TEST_ASSERT(has(errors(sceneText("alloy 6", files), {{"own.xml", file}}),
                  "Did you mean 'alloy 7'? Known: in the scene: none; in 'own.xml': alloy 7"));
  const std::string own = list("Materials", list("rock", parameter("Young Modulus", "1") + parameter("Poisson Ratio", "0")));
  TEST_ASSERT(has(errors(sceneText("rok", own)), "Did you mean 'rock'? Known: in the scene: rock; built in: "));
}

TEUCHOS_UNIT_TEST(MaterialFiles, TheSceneWinsThenItsFilesThenTheBuiltInFile) {
  const auto stiff = [](const std::string& young) { return parameter("Young Modulus", young) + parameter("Poisson Ratio", "0"); };
  const std::string own = list("Materials", list("S355", stiff("1"))), files = parameter("Material Files", "{own.xml}");
  const std::map<std::string, std::string> file{
      {"own.xml", list("Materials", parameter("Units", "mm, N, MPa") + list("S355", stiff("2")))}};
  const SceneFile scene = read(sceneText("S355", own + files), file);
  TEST_EQUALITY(materialOf(scene, "S355").get<double>("Young Modulus"), 1.0);
  TEST_EQUALITY(scene.notes.size(), 1u);
  TEST_ASSERT(has(scene.notes[0], "Materials/S355: the scene's entry is used, not that of 'own.xml'"));
  TEST_ASSERT(has(read(sceneText("S355", own)).notes.at(0), "not that of the built-in materials"));
  const SceneFile second = read(sceneText("S355", files), file);
  TEST_EQUALITY(materialOf(second, "S355").get<double>("Young Modulus"), 2e6);  // MPa in Pa
  TEST_EQUALITY(materialOf(second, "S355").get<std::string>("Source"), "(from own.xml)");
  TEST_ASSERT(!materialOf(second, "S355").isParameter("Yield Strength"));  // a whole entry, not a mixture
}

TEUCHOS_UNIT_TEST(MaterialFiles, EntriesBasedOnAMaterialGiveWhatDiffers) {
  const std::string own =
      list("Materials", list("my granite", parameter("Based On", "Granite") + parameter("Strength", "Hoek-Brown") +
                                               parameter("Young Modulus", "2e10") + list("Hoek-Brown", parameter("GSI", "60"))));
  const SceneFile scene = read(sceneText("my granite", own));
  const Parameters& rock = materialOf(scene, "my granite");
  TEST_EQUALITY(rock.get<double>("Young Modulus"), 2e10);
  TEST_EQUALITY(rock.get<double>("Poisson Ratio"), 0.22);
  TEST_EQUALITY(rock.sublist("Hoek-Brown").get<double>("GSI"), 60.0);
  TEST_EQUALITY(rock.sublist("Hoek-Brown").get<double>("m_i"), 32.0);
  TEST_ASSERT(has(rock.get<std::string>("Source"), "own values: Strength, Young Modulus, Hoek-Brown/GSI"));
  TEST_ASSERT(scene.notes.empty());
  Problems problems;
  TEST_EQUALITY(strengthOf(rock, problems)->name(), std::string("Hoek-Brown"));
  TEST_ASSERT(problems.empty());
  // --set alone changes one value of a material.
  const SceneFile set = read(sceneText("S355"), {}, {"Materials/S355/Yield Strength=3e8"});
  TEST_EQUALITY(materialOf(set, "S355").get<double>("Yield Strength"), 3e8);
  TEST_EQUALITY(materialOf(set, "S355").get<double>("Young Modulus"), 2.1e11);
  // In a file, and through two levels.
  const std::map<std::string, std::string> file{
      {"own.xml", list("Materials", parameter("Units", "mm, N, MPa") +
                                        list("plate", parameter("Based On", "S355") + parameter("Yield Strength", "335")) +
                                        list("old plate", parameter("Based On", "plate") + parameter("Young Modulus", "2e5")))}};
  const SceneFile plate = read(sceneText("old plate", parameter("Material Files", "own.xml")), file);
  TEST_EQUALITY(materialOf(plate, "old plate").get<double>("Yield Strength"), 335e6);
  TEST_EQUALITY(materialOf(plate, "old plate").get<double>("Young Modulus"), 2e11);
  TEST_EQUALITY(materialOf(plate, "old plate").get<double>("Density"), 7850.0);
}

TEUCHOS_UNIT_TEST(MaterialFiles, ErrorsOfFilesNameTheFile) {
  const std::string files = parameter("Material Files", "own.xml");
  const auto in = [&](const std::string& content) { return errors(sceneText("a", files), {{"own.xml", list("Materials", content)}}); };
  const std::string good = parameter("Young Modulus", "1") + parameter("Poisson Ratio", "0");
  TEST_EQUALITY(in(list("a", good)), "");
  TEST_ASSERT(has(in(list("a", good + parameter("Densty", "1"))), "own.xml: a/Densty: no such parameter. Did you mean 'Density'?"));
  TEST_ASSERT(has(in(list("a", good) + list("b", parameter("Young Modulus", "1"))), "own.xml: b/Poisson Ratio: is missing"));
  TEST_ASSERT(has(in(list("a", good) + parameter("Unit", "m, N, Pa")),
                  "own.xml: Unit: no such parameter in a material file. Did you mean 'Units'?"));
  TEST_ASSERT(has(in(list("a", good) + parameter("Units", "m, N, MPa")), "own.xml: Units: 'm, N, MPa' is not consistent"));
  TEST_ASSERT(has(in(list("a", parameter("Based On", "b")) + list("b", parameter("Based On", "a"))), "is based on itself"));
  TEST_ASSERT(has(errors(sceneText("a", files), {{"own.xml", "<ParameterList"}}), "own.xml: this is not valid XML"));
  TEST_ASSERT(
      has(errors(sceneText("a", parameter("Material Files", "no such file.xml"))), "Material Files: 'no such file.xml' cannot be read: "));
  const std::string circle = list("Materials", list("a", parameter("Based On", "b")) + list("b", parameter("Based On", "a")));
  TEST_ASSERT(has(errors(sceneText("a", circle)), "Based On: the material is based on itself"));
  TEST_ASSERT(has(errors(sceneText("a", list("Materials", list("a", parameter("Based On", "Granit"))))),
                  "Materials/a/Based On: no such material 'Granit'. Did you mean 'Granite'?"));
}

TEUCHOS_UNIT_TEST(MaterialFiles, StrengthsWithMissingValuesAreErrors) {
  const auto problemOf = [](const std::string& content) {
    const SceneFile scene =
        read(sceneText("a", list("Materials", list("a", parameter("Young Modulus", "1") + parameter("Poisson Ratio", "0") + content))));
    Problems problems;
    strengthOf(scene.parameters->sublist("Materials").sublist("a"), problems);
    std::string all;
    for (const Problem& problem : problems.list()) all += problem.path + ": " + problem.message + "\n";
    return all;
  };
  TEST_EQUALITY(problemOf(""), "");
  TEST_ASSERT(has(problemOf(parameter("Strength", "von Mises")), "Materials/a/Yield Strength: is missing: Strength is 'von Mises'"));
  TEST_ASSERT(has(problemOf(parameter("Strength", "Principal Stress")), "Materials/a/Tensile Strength: is missing"));
  TEST_ASSERT(has(problemOf(parameter("Strength", "Hoek-Brown")), "Materials/a/Compressive Strength: is missing"));
  TEST_ASSERT(has(problemOf(parameter("Strength", "Hoek-Brown")), "Materials/a/Hoek-Brown/GSI: is missing"));
  const std::string rock = parameter("Strength", "Hoek-Brown") + parameter("Compressive Strength", "1");
  TEST_ASSERT(
      has(problemOf(rock + list("Hoek-Brown", parameter("m_b", "1") + parameter("s", "1") + parameter("GSI", "50"))), "GSI: beside m_b"));
  TEST_ASSERT(
      has(problemOf(rock + list("Hoek-Brown", parameter("s", "1") + parameter("GSI", "50") + parameter("m_i", "5"))), "s: without m_b"));
  TEST_EQUALITY(problemOf(rock + list("Hoek-Brown", parameter("m_b", "1") + parameter("s", "1"))), "");
  TEST_ASSERT(has(problemOf(parameter("Strength", "Mohr-Coulomb") +
                            list("Mohr-Coulomb", parameter("Cohesion", "0") + parameter("Friction Angle", "0"))),
                  "Mohr-Coulomb/Cohesion: is 0"));
  TEST_ASSERT(has(errors(sceneText("a", list("Materials", list("a", parameter("Young Modulus", "1") + parameter("Poisson Ratio", "0") +
                                                                        parameter("Strength", "Mohr-Coulomb"))))),
                  "Materials/a/Mohr-Coulomb/Friction Angle: is missing"));
}

}  // namespace
}  // namespace suture
