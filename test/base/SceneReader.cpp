// Everything a scene file can do wrong, and the traps of Teuchos' own reader (doc/numerics.md): each is an error here.
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_Comm.hpp>
#include <Teuchos_DefaultComm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <cstdio>
#include <fstream>

namespace {

using namespace suture;

Schema bodySchema() {
  return Schema("one body")
      .text("Material", std::nullopt, "name of a material")
      .real("Thickness", 1.0, "out of the plane", Range::positive());
}

Schema sceneSchema() {
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

const char* const body = R"(<ParameterList name="Bodies"><ParameterList name="left"><Parameter name="Material" type="string" value="rock"/>
  </ParameterList></ParameterList>)";

std::string scene(const std::string& inside) {
  return "<ParameterList name=\"Suture\">\n" + std::string(body) + "\n" + inside + "\n</ParameterList>\n";
}

std::string parameter(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\"" + (type.empty() ? "" : " type=\"" + type + "\"") + " value=\"" + value + "\"/>";
}

std::string list(const std::string& name, const std::string& inside) {
  return "<ParameterList name=\"" + name + "\">" + inside + "</ParameterList>";
}

SceneFile parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parseScene(text, "dir/scene.xml", sceneSchema(), overrides);
}

/// The whole message of the error, or "" if there was none.
std::string errorOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string errorOfSolver(const std::string& inside) { return errorOf(scene(list("Outer Solver", inside))); }

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Values ----------------------------------------------------------------------------------------------------------------------------

TEUCHOS_UNIT_TEST(SceneReader, FillsEveryDefault) {
  const SceneFile file = parse(scene(""));
  const Parameters& all = *file.parameters;
  TEST_EQUALITY(all.get<std::string>("Model"), "Plane Strain");
  TEST_EQUALITY(all.get<bool>("Check"), false);
  TEST_EQUALITY(all.sublist("Bodies").sublist("left").get<double>("Thickness"), 1.0);
  const Parameters& solver = all.sublist("Outer Solver");
  TEST_EQUALITY(solver.get<double>("Tolerance"), 1e-8);
  TEST_EQUALITY(solver.get<int>("Maximum Iterations"), 50);
  TEST_EQUALITY(solver.get<std::string>("Type"), "Newton");
  TEST_EQUALITY(solver.sublist("Newton").get<double>("Inner Tolerance"), 1e-2);
  TEST_EQUALITY(solver.sublist("Successive Approximation").get<std::string>("Relaxation"), "Automatic");
  TEST_EQUALITY(all.sublist("Load").get<Teuchos::Array<double>>("Value").size(), 2);
  TEST_ASSERT(solver.isSublist("Chord") && !solver.sublist("Chord").isParameter("Depth"));
  TEST_ASSERT(!all.isParameter("Plugin"));
  TEST_EQUALITY(file.folder, "dir");
  TEST_EQUALITY(file.text, scene(""));
}

TEUCHOS_UNIT_TEST(SceneReader, TellsDefaultsFromWhatWasGiven) {
  const SceneFile file = parse(scene(list("Outer Solver", parameter("Tolerance", "double", "1e-8"))));
  const Parameters& solver = file.parameters->sublist("Outer Solver");
  TEST_ASSERT(!solver.getEntry("Tolerance").isDefault());
  TEST_ASSERT(solver.getEntry("Maximum Iterations").isDefault());
}

TEUCHOS_UNIT_TEST(SceneReader, TakesNumbersAsTheyAreWritten) {
  const std::string load = list("Load", parameter("Value", "Array(double)", "{-2.5e-2, 0}") + parameter("Nodes", "Array(int)", "{3, 1}") +
                                            parameter("Groups", "Array(string)", "{top, left side}"));
  const SceneFile file = parse(scene(load + list("Constants", parameter("scale", "double", "0.52e10") + parameter("n", "int", "3"))));
  const Parameters& given = file.parameters->sublist("Load");
  TEST_EQUALITY(given.get<Teuchos::Array<double>>("Value")[0], -0.025);
  TEST_EQUALITY(given.get<Teuchos::Array<int>>("Nodes")[1], 1);
  TEST_EQUALITY(given.get<Teuchos::Array<std::string>>("Groups")[1], "left side");
  TEST_EQUALITY(file.parameters->sublist("Constants").get<double>("scale"), 5.2e9);
  TEST_EQUALITY(file.parameters->sublist("Constants").get<double>("n"), 3.0);
}

TEUCHOS_UNIT_TEST(SceneReader, TakesAnIntWhereADoubleIsWantedAndOneNumberForAnArray) {
  const SceneFile file =
      parse(scene(list("Outer Solver", parameter("Tolerance", "int", "1")) + list("Load", parameter("Value", "double", "0.5e7"))));
  TEST_EQUALITY(file.parameters->sublist("Outer Solver").get<double>("Tolerance"), 1.0);
  const auto value = file.parameters->sublist("Load").get<Teuchos::Array<double>>("Value");
  TEST_EQUALITY(value.size(), 1);
  TEST_EQUALITY(value[0], 0.5e7);
}

TEUCHOS_UNIT_TEST(SceneReader, NeedsNoTypeAttribute) {
  const SceneFile file = parse(scene(parameter("Check", "", "true") + list("Outer Solver", parameter("Maximum Iterations", "", "7"))));
  TEST_EQUALITY(file.parameters->get<bool>("Check"), true);
  TEST_EQUALITY(file.parameters->sublist("Outer Solver").get<int>("Maximum Iterations"), 7);
}

TEUCHOS_UNIT_TEST(SceneReader, WordOrNumberIsStoredAsText) {
  const auto relaxation = [](const std::string& type, const std::string& value) {
    return scene(list("Outer Solver", list("Successive Approximation", parameter("Relaxation", type, value))));
  };
  for (const auto& [type, value] :
       std::vector<std::pair<std::string, std::string>>{{"string", "None"}, {"double", "0.25"}, {"", "0.5"}, {"int", "1"}}) {
    const SceneFile file = parse(relaxation(type, value));
    TEST_EQUALITY(file.parameters->sublist("Outer Solver").sublist("Successive Approximation").get<std::string>("Relaxation"), value);
  }
  TEST_EQUALITY(errorOf(relaxation("string", "Non")),
                "Outer Solver/Successive Approximation/Relaxation: 'Non' is neither a word known here nor a number: expected one of: None, "
                "Automatic, or a number > 0. Did you mean 'None'?");
  TEST_EQUALITY(errorOf(relaxation("", "-1")), "Outer Solver/Successive Approximation/Relaxation: -1 is not above 0");
}

TEUCHOS_UNIT_TEST(SceneReader, TakesCommentsEntitiesAndAByteOrderMark) {
  const std::string text = "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<!-- <b> & -->\n" +
                           scene("<!-- x -->" + parameter("Title", "string", "a &lt; b &amp; &quot;c&quot; &#65;"));
  TEST_EQUALITY(parse(text).parameters->get<std::string>("Title"), "a < b & \"c\" A");
}

TEUCHOS_UNIT_TEST(SceneReader, ResolvedSceneReadsBackAsItself) {
  const SceneFile first =
      parse(scene(parameter("Title", "string", "a &lt; &quot;b&quot; &amp; c") + parameter("Plugin", "string", "x.so") +
                  list("Load", parameter("Value", "Array(double)", "{0.1, 1e-300}")) +
                  list("Outer Solver", parameter("Type", "string", "Chord") + list("Chord", parameter("Depth", "int", "5")))));
  const std::string xml = toXml(*first.parameters);
  const SceneFile again = parse(xml);
  TEST_EQUALITY(toXml(*again.parameters), xml);
  TEST_EQUALITY(again.parameters->sublist("Load").get<Teuchos::Array<double>>("Value")[1], 1e-300);
}

TEUCHOS_UNIT_TEST(SceneReader, PathsAndSublistNamesAreTheUsers) {
  const SceneFile file = parse(scene(""), {"Bodies/right/Material=rock", "Bodies/a body/Material=clay"});
  const Parameters& bodies = file.parameters->sublist("Bodies");
  TEST_EQUALITY(pathOf(bodies.sublist("a body"), "Material"), "Bodies/a body/Material");
  TEST_EQUALITY(pathOf(file.parameters->sublist("Outer Solver").sublist("Newton")), "Outer Solver/Newton");
  TEST_EQUALITY(pathOf(*file.parameters, "Title"), "Title");
  TEST_EQUALITY(pathOf(*file.parameters), "");
  TEST_ASSERT((sublistNames(bodies) == std::vector<std::string>{"left", "right", "a body"}));
}

// Traps of Teuchos' reader ----------------------------------------------------------------------------------------------------------

TEUCHOS_UNIT_TEST(SceneReader, RefusesAnIntThatIsNone) {
  for (const std::string bad : {"abc", "3.7", "", "5x", "99999999999", "1e2"}) {
    TEST_ASSERT(
        contains(errorOfSolver(parameter("Maximum Iterations", "int", bad)), "Outer Solver/Maximum Iterations: '" + bad + "' is not"));
    TEST_ASSERT(contains(errorOfSolver(parameter("Maximum Iterations", "", bad)),
                         "Outer Solver/Maximum Iterations: '" + bad + "' is not an integer: expected an integer, >= 1"));
  }
}

TEUCHOS_UNIT_TEST(SceneReader, RefusesADoubleThatIsNone) {
  for (const std::string bad : {"1e-8x", "", "nan", "inf", "-inf", "1e999", "1,5", "{1}"})
    TEST_EQUALITY(errorOfSolver(parameter("Tolerance", "double", bad)),
                  "Outer Solver/Tolerance: '" + bad + "' is not a (finite) number: expected a number, > 0");
}

TEUCHOS_UNIT_TEST(SceneReader, RefusesDuplicates) {
  const std::string twice = parameter("Tolerance", "double", "1e-6") + parameter("Tolerance", "double", "1e-8");
  TEST_EQUALITY(errorOfSolver(twice), "Outer Solver/Tolerance: is given twice; one of the two must go");
  TEST_EQUALITY(errorOf(scene(list("Load", "") + list("Load", ""))), "Load: is given twice; one of the two must go");
  TEST_EQUALITY(errorOf(scene(body)), "Bodies: is given twice; one of the two must go");
  TEST_ASSERT(contains(errorOf(scene(list("Load", "") + parameter("Load", "int", "1"))), "Load: is given twice"));
}

TEUCHOS_UNIT_TEST(SceneReader, RefusesMalformedXmlWithTheLine) {
  TEST_ASSERT(contains(errorOf("<ParameterList name=\"Suture\">\n\n</Parameter>"), "dir/scene.xml: this is no XML: line 3: "));
  for (const char* bad :
       {"<ParameterList>", "<ParameterList", "</ParameterList>", "<ParameterList/></ParameterList>", "<ParameterList/><ParameterList/>",
        "<ParameterList a='1' a='2'/>", "<ParameterList name=\"a<b\"/>", "<ParameterList>&nosuch;</ParameterList>", "<ParameterList/> junk",
        "junk", "<!-- ", "<ParameterList><!-- </ParameterList>", "<", "<?xml", "<ParameterList name=\"x/>"})
    TEST_ASSERT(contains(errorOf(bad), "dir/scene.xml: this is no XML: line 1: "));
}

TEUCHOS_UNIT_TEST(SceneReader, RefusesAnEmptyFile) {
  TEST_EQUALITY(errorOf(""), "dir/scene.xml: the file is empty");
  TEST_EQUALITY(errorOf(" \n\t "), "dir/scene.xml: the file is empty");
  TEST_ASSERT(errorOf("<!-- nothing but a remark -->") != "");
}

TEUCHOS_UNIT_TEST(SceneReader, RefusesWhatIsNoParameterList) {
  TEST_EQUALITY(errorOf("<html/>"), "dir/scene.xml: the outermost element must be <ParameterList>, found <html>");
  TEST_ASSERT(contains(errorOf(scene("<Paramter name=\"Title\" value=\"x\"/>")), "no such element <Paramter>. Did you mean 'Parameter'?"));
  TEST_ASSERT(contains(errorOf(scene("stray")), "text outside of any attribute: 'stray'"));
  TEST_ASSERT(contains(errorOfSolver("<Parameter name=\"Tolerance\" vlaue=\"1\"/>"), "Outer Solver/Tolerance: has no attribute 'value'"));
  TEST_ASSERT(contains(errorOfSolver("<Parameter value=\"1\"/>"), "Outer Solver: a parameter without the attribute name"));
  TEST_ASSERT(contains(errorOf(scene(list("Constants", parameter("a/b", "double", "1")))), "Constants: the name 'a/b' contains '/'"));
}

// Schema ----------------------------------------------------------------------------------------------------------------------------

TEUCHOS_UNIT_TEST(SceneReader, NamesTheNearestForAnUnknownParameter) {
  TEST_EQUALITY(errorOfSolver(parameter("Tolerence", "double", "1e-8")),
                "Outer Solver/Tolerence: no such parameter. Did you mean 'Tolerance'? Known here: Maximum Iterations, Tolerance, Type");
}

TEUCHOS_UNIT_TEST(SceneReader, SaysWhereAMisplacedParameterBelongs) {
  TEST_ASSERT(contains(errorOfSolver(parameter("Inner Tolerance", "double", "1")), "One of this name belongs in Newton"));
}

TEUCHOS_UNIT_TEST(SceneReader, NamesTheNearestForAnUnknownList) {
  TEST_EQUALITY(errorOf(scene(list("Outer Sover", ""))),
                "Outer Sover: no such list. Did you mean 'Outer Solver'? Known here: Bodies, Constants, Load, Material, Outer Solver");
}

TEUCHOS_UNIT_TEST(SceneReader, RefusesAListForAParameterAndTheReverse) {
  TEST_EQUALITY(errorOf(scene(parameter("Outer Solver", "string", "Chord"))), "Outer Solver: is a list of parameters, not a parameter");
  TEST_EQUALITY(errorOf(scene(list("Title", ""))), "Title: is a parameter, not a list: expected a text");
}

TEUCHOS_UNIT_TEST(SceneReader, RefusesAWrongType) {
  TEST_EQUALITY(errorOfSolver(parameter("Maximum Iterations", "double", "3")),
                "Outer Solver/Maximum Iterations: is of type double ('3'), expected type int: an integer, >= 1");
  TEST_ASSERT(contains(errorOf(scene(parameter("Title", "int", "3"))), "Title: is of type int ('3'), expected type string"));
  TEST_ASSERT(contains(errorOfSolver(parameter("Tolerance", "flaot", "3")), "Outer Solver/Tolerance: no such type 'flaot'"));
  TEST_ASSERT(contains(errorOf(scene(parameter("Check", "bool", "maybe"))), "Check: 'maybe' is not a truth value: expected true or false"));
  TEST_ASSERT(
      contains(errorOf(scene(list("Load", parameter("Value", "Array(double)", "{1, x}")))), "Load/Value: 'x' is not a (finite) number"));
  TEST_ASSERT(contains(errorOf(scene(list("Load", parameter("Value", "Array(double)", "{1, 2")))), "Load/Value: '{1, 2' cannot be read"));
  TEST_ASSERT(contains(errorOf(scene(list("Load", parameter("Value", "Array(int)", "{1.5}")))),
                       "Load/Value: '{1.5}' is not of its type Array(int)"));
}

TEUCHOS_UNIT_TEST(SceneReader, RefusesWhatIsOutOfRangeWithTheReason) {
  TEST_EQUALITY(errorOf(scene(list("Material", parameter("Poisson Ratio", "double", "0.5")))),
                "Material/Poisson Ratio: 0.5 is not below 0.5, it must lie in (-1, 0.5) (an incompressible body needs a mixed element)");
  TEST_EQUALITY(errorOfSolver(parameter("Tolerance", "double", "0")), "Outer Solver/Tolerance: 0 is not above 0");
  TEST_EQUALITY(errorOfSolver(parameter("Maximum Iterations", "int", "0")), "Outer Solver/Maximum Iterations: 0 is not at least 1");
  TEST_EQUALITY(errorOf(scene(list("Load", parameter("Nodes", "Array(int)", "{1, -2}")))), "Load/Nodes: -2 is not at least 0");
}

TEUCHOS_UNIT_TEST(SceneReader, RefusesANameThatIsNotAllowed) {
  TEST_EQUALITY(errorOf(scene(parameter("Model", "string", "Plain Strain"))),
                "Model: no such name 'Plain Strain'. Did you mean 'Plane Strain'? Known here: Plane Strain, Plane Stress");
  TEST_EQUALITY(errorOfSolver(parameter("Type", "string", "Cord")),
                "Outer Solver/Type: no such name 'Cord'. Did you mean 'Chord'? Known here: Chord, Newton, Successive Approximation");
}

TEUCHOS_UNIT_TEST(SceneReader, ChecksTheListsOfChoicesNotTaken) {
  TEST_EQUALITY(errorOfSolver(list("Chord", parameter("Depht", "int", "3"))),
                "Outer Solver/Chord/Depht: no such parameter. Did you mean 'Depth'? Known here: Depth");
  TEST_EQUALITY(errorOfSolver(list("Chord", parameter("Depth", "int", "-3"))), "Outer Solver/Chord/Depth: -3 is not at least 0");
}

TEUCHOS_UNIT_TEST(SceneReader, DemandsWhatTheChoiceTakenNeeds) {
  TEST_EQUALITY(errorOfSolver(parameter("Type", "string", "Chord")),
                "Outer Solver/Chord/Depth: is missing and has no default: of Anderson (expected an integer, >= 0)");
  TEST_EQUALITY(errorOfSolver(parameter("Type", "string", "Chord") + list("Chord", parameter("Depth", "int", "3"))), "");
}

TEUCHOS_UNIT_TEST(SceneReader, DemandsRequiredListsAndParameters) {
  TEST_EQUALITY(errorOf("<ParameterList name=\"Suture\"/>"), "Bodies: this list is missing: all bodies");
  TEST_EQUALITY(errorOf("<ParameterList name=\"Suture\"><ParameterList name=\"Bodies\"/></ParameterList>"),
                "Bodies: has 0 lists <body>, expected at least 1: one body");
  TEST_EQUALITY(
      errorOf("<ParameterList name=\"Suture\"><ParameterList name=\"Bodies\"><ParameterList name=\"b\"/></ParameterList></ParameterList>"),
      "Bodies/b/Material: is missing and has no default: name of a material (expected a text)");
}

TEUCHOS_UNIT_TEST(SceneReader, ReportsEverythingAtOnce) {
  const std::string text = scene(parameter("Titel", "string", "x") + list("Material", parameter("Poisson Ratio", "double", "0.7")) +
                                 list("Outer Solver", parameter("Tolerance", "double", "1e-8") + parameter("Tolerance", "double", "1e-8") +
                                                          parameter("Maximum Iterations", "int", "many")) +
                                 list("Loads", ""));
  std::vector<std::string> paths;
  try {
    parse(text, {"Check", "Load/Value=x"});
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems()) paths.push_back(problem.path);
  }
  std::sort(paths.begin(), paths.end());
  TEST_ASSERT((paths == std::vector<std::string>{"--set", "Load/Value", "Loads", "Material/Poisson Ratio",
                                                 "Outer Solver/Maximum Iterations", "Outer Solver/Tolerance", "Titel"}));
}

// --set -----------------------------------------------------------------------------------------------------------------------------

TEUCHOS_UNIT_TEST(SceneReader, OverridesReplaceAndAdd) {
  const SceneFile file = parse(scene(list("Outer Solver", parameter("Tolerance", "double", "1e-6"))),
                               {"Outer Solver/Tolerance=1e-3", "Outer Solver/Chord/Depth = 4", "Title=a = b", "Load/Value={1, 2}",
                                "Bodies/right/Material=rock", "Constants/scale=2"});
  const Parameters& all = *file.parameters;
  TEST_EQUALITY(all.sublist("Outer Solver").get<double>("Tolerance"), 1e-3);
  TEST_EQUALITY(all.sublist("Outer Solver").sublist("Chord").get<int>("Depth"), 4);
  TEST_EQUALITY(all.get<std::string>("Title"), "a = b");
  TEST_EQUALITY(all.sublist("Load").get<Teuchos::Array<double>>("Value")[1], 2.0);
  TEST_EQUALITY(all.sublist("Bodies").sublist("right").get<std::string>("Material"), "rock");
  TEST_EQUALITY(all.sublist("Constants").get<double>("scale"), 2.0);
}

TEUCHOS_UNIT_TEST(SceneReader, OverrideMayRepairTheFile) {
  const std::string bad = scene(list("Outer Solver", parameter("Maximum Iterations", "int", "many")));
  TEST_ASSERT(errorOf(bad) != "");
  TEST_EQUALITY(errorOf(bad, {"Outer Solver/Maximum Iterations=3"}), "");
}

TEUCHOS_UNIT_TEST(SceneReader, RefusesBadOverrides) {
  TEST_EQUALITY(errorOf(scene(""), {"Outer Solver/Tolerence=1"}),
                "Outer Solver/Tolerence: no such parameter. Did you mean 'Tolerance'? Known here: Maximum Iterations, Tolerance, Type");
  TEST_ASSERT(contains(errorOf(scene(""), {"Outer Sover/Tolerance=1"}), "Outer Sover: no such list. Did you mean 'Outer Solver'?"));
  TEST_ASSERT(contains(errorOf(scene(""), {"Outer Solver/Tolerance=1e-8x"}), "Outer Solver/Tolerance: '1e-8x' is not a (finite) number"));
  TEST_EQUALITY(errorOf(scene(""), {"Outer Solver/Tolerance"}),
                "--set: 'Outer Solver/Tolerance' is not of the form Path/To/Parameter=value");
  TEST_EQUALITY(errorOf(scene(""), {"=1"}), "--set: '=1' is not of the form Path/To/Parameter=value");
  TEST_ASSERT(contains(errorOf(scene(""), {"Outer Solver//Tolerance=1"}), "an empty name in the path"));
  TEST_ASSERT(contains(errorOf(scene(""), {"Bodies=1"}), "--set: 'Bodies=1': 'Bodies' is a list, not a parameter"));
  TEST_ASSERT(contains(errorOf(scene(parameter("Title", "string", "x")), {"Title/x=1"}), "'Title' is a parameter, not a list"));
  TEST_EQUALITY(errorOf(scene(""), {"Title=a", "Title=b"}), "Title: is set twice on the command line");
}

// Collective reading ----------------------------------------------------------------------------------------------------------------

/// Message of readScene's error; says so if it is not the same on every rank.
std::string errorOfFile(const Comm& comm, const std::string& path, const std::vector<std::string>& overrides = {}) {
  std::string mine;
  try {
    readScene(comm, path, sceneSchema(), overrides);
  } catch (const InputError& error) {
    mine = error.what();
  }
  for (const std::string& other : allGather(comm, mine)) {
    if (other != mine) return "ranks differ: " + mine + " | " + other;
  }
  return mine;
}

/// A file that only rank 0 needs to see.
class Written {
 public:
  Written(const Comm& comm, const std::string& text) : comm_(comm), path("scene_" + std::to_string(comm.getSize()) + ".xml") {
    if (comm_.getRank() == 0) std::ofstream(path, std::ios::binary) << text;
  }
  ~Written() {
    if (comm_.getRank() == 0) std::remove(path.c_str());
  }

 private:
  const Comm& comm_;

 public:
  const std::string path;
};

TEUCHOS_UNIT_TEST(SceneReader, EveryRankReadsTheSame) {
  const CommPtr comm = Teuchos::DefaultComm<int>::getComm();
  const Written written(*comm, scene(parameter("Title", "string", "from a file")));
  const SceneFile file = readScene(*comm, written.path, sceneSchema(), {"Check=true"});
  TEST_EQUALITY(file.parameters->get<std::string>("Title"), "from a file");
  TEST_EQUALITY(file.parameters->get<bool>("Check"), true);
  TEST_EQUALITY(file.text, scene(parameter("Title", "string", "from a file")));
  TEST_EQUALITY(file.folder, ".");
}

TEUCHOS_UNIT_TEST(SceneReader, EveryRankThrowsTheSameForABadFile) {
  const CommPtr comm = Teuchos::DefaultComm<int>::getComm();
  {
    const Written written(*comm, "<ParameterList>\n<Parameter name=");
    TEST_ASSERT(contains(errorOfFile(*comm, written.path), written.path + ": this is no XML: line 2"));
  }
  {
    const Written written(*comm, "");
    TEST_EQUALITY(errorOfFile(*comm, written.path), written.path + ": the file is empty");
  }
  {
    const Written written(
        *comm, scene(list("Outer Solver", parameter("Tolerance", "double", "nan") + parameter("Maximum Iterations", "int", "3.7"))));
    const std::string message = errorOfFile(*comm, written.path, {"Modl=Plane Stress"});
    TEST_EQUALITY(std::count(message.begin(), message.end(), '\n'), 2);
    TEST_ASSERT(contains(message, "Modl: no such parameter. Did you mean 'Model'?"));
    TEST_ASSERT(contains(message, "'nan'") && contains(message, "'3.7'"));
  }
}

TEUCHOS_UNIT_TEST(SceneReader, EveryRankThrowsTheSameForAMissingFile) {
  const CommPtr comm = Teuchos::DefaultComm<int>::getComm();
  TEST_EQUALITY(errorOfFile(*comm, "no/such/file.xml"), "no/such/file.xml: cannot be read: No such file or directory");
  TEST_EQUALITY(errorOfFile(*comm, "."), ".: is a folder; expected an XML file");
}

// Neither the parser nor what is made of its answer may see these: both call themselves for each level.
TEUCHOS_UNIT_TEST(SceneReader, RefusesWhatIsTooDeep) {
  for (const int depth : {51, 20000, 1000000}) {
    std::string text;
    for (int i = 0; i < depth; ++i) text += "<ParameterList name=\"a>b\">\n<!-- <x> -->";
    TEST_ASSERT(contains(errorOf(text), "line 51: elements within more than 50 others"));
  }
  std::string wide = "<ParameterList>";
  for (int i = 0; i < 100; ++i)
    wide += "<ParameterList name=\"" + std::to_string(i) + "\"><Parameter name=\"a/>\" value='1'/></ParameterList>";
  TEST_ASSERT(!contains(errorOf(wide + "</ParameterList>"), "elements within"));
}

TEUCHOS_UNIT_TEST(SceneReader, ReadsRegularFilesOfASceneSizeOnly) {
  const CommPtr comm = Teuchos::DefaultComm<int>::getComm();
  TEST_EQUALITY(errorOfFile(*comm, "/dev/zero"), "/dev/zero: is no regular file; expected an XML file");
  const Written large(*comm, std::string((16 << 20) + 1, ' '));
  TEST_EQUALITY(errorOfFile(*comm, large.path), large.path + ": has 16777217 bytes; expected an XML file of at most 16777216");
}

}  // namespace
