// Values of a scene file and overrides, the same on every rank.
#include <Teuchos_Array.hpp>
#include <Teuchos_Comm.hpp>
#include <Teuchos_DefaultComm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <base/SceneTexts.hpp>
#include <cstdio>
#include <fstream>
#include <suture/base/Collective.hpp>

namespace {

using namespace suture;
using namespace suture::scenes;

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

TEUCHOS_UNIT_TEST(SceneReader, DistinguishesDefaultsFromGivenValues) {
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

TEUCHOS_UNIT_TEST(SceneReader, TakesNumbersWhereATextIsWanted) {
  for (const auto& [type, value] :
       std::vector<std::pair<std::string, std::string>>{{"double", "0.5"}, {"int", "3"}, {"Array(double)", "{0, 1.5}"}})
    TEST_EQUALITY(parse(scene(parameter("Title", type, value))).parameters->get<std::string>("Title"), value);
  const auto groups = parse(scene(list("Load", parameter("Groups", "Array(int)", "{7, 8}")))).parameters->sublist("Load");
  TEST_EQUALITY(groups.get<Teuchos::Array<std::string>>("Groups")[1], "8");
}

TEUCHOS_UNIT_TEST(SceneReader, NotesParametersOfChoicesThatAreNotTaken) {
  const auto notes = [](const std::string& inside, const std::vector<std::string>& overrides = {}) {
    std::string all;
    for (const std::string& note : parse(scene(list("Outer Solver", inside)), overrides).notes) all += note + "\n";
    return all;
  };
  const std::string depth = list("Chord", parameter("Depth", "int", "5")), chord = parameter("Type", "string", "Chord");
  TEST_EQUALITY(notes(depth), "Outer Solver/Chord/Depth has no effect: Outer Solver/Type is 'Newton', not 'Chord'\n");
  TEST_EQUALITY(notes(chord + depth), "");
  TEST_EQUALITY(notes(depth, {"Outer Solver/Type=Chord"}), "");
  TEST_EQUALITY(notes("", {"Outer Solver/Chord/Depth=5"}),
                "Outer Solver/Chord/Depth has no effect: Outer Solver/Type is 'Newton', not 'Chord'\n");
  // A default that is written out, as --print-defaults does, causes no note.
  TEST_EQUALITY(notes(chord + depth + list("Newton", parameter("Inner Tolerance", "double", "0.01"))), "");
  TEST_EQUALITY(notes(chord + depth + list("Newton", parameter("Inner Tolerance", "double", "0.02"))),
                "Outer Solver/Newton/Inner Tolerance has no effect: Outer Solver/Type is 'Chord', not 'Newton'\n");
}

// The choice may be a default that fits the rest of the scene, its parameters may be next to it, and it may be nested in another choice.
TEUCHOS_UNIT_TEST(SceneReader, NotesHandleFittingAdjacentAndNestedChoices) {
  Schema schema("a scene");
  schema.boolean("Contact", true, "or none")
      .choice("Method", "Direct",
              {{"Direct", Schema("factors").choice(
                              "Order", "Natural",
                              {{"Natural", Schema("as it is")}, {"Nested", Schema("cuts").integer("Depth", 3, "levels")}}, "of unknowns")},
               {"Iterative", Schema("steps").integer("Steps", 10, "at most")}},
              "how")
      .fittingDefault([](const Parameters& whole) { return whole.get<bool>("Contact") ? "Iterative" : "Direct"; })
      .choice("Law", "Free", {{"Free", Schema("none").real("Mu", 0.0, "beside")}, {"Tied", Schema("glue").real("Strength", 1.0, "below")}},
              "law", "Free");
  const auto notes = [&](const std::string& inside) {
    std::string all;
    for (const std::string& note : parseScene("<ParameterList name=\"Suture\">" + inside + "</ParameterList>", "scene.xml", schema).notes)
      all += note + "\n";
    return all;
  };
  const std::string steps = list("Iterative", parameter("Steps", "int", "5"));
  TEST_EQUALITY(notes(steps), "");
  TEST_EQUALITY(notes(parameter("Contact", "bool", "false") + steps),
                "Iterative/Steps has no effect: Method is 'Direct', not 'Iterative'\n");
  TEST_EQUALITY(notes(list("Direct", list("Nested", parameter("Depth", "int", "5")))),
                "Direct/Nested/Depth has no effect: Method is 'Iterative', not 'Direct'\n");
  TEST_EQUALITY(notes(parameter("Method", "string", "Direct") + list("Direct", list("Nested", parameter("Depth", "int", "5")))),
                "Direct/Nested/Depth has no effect: Direct/Order is 'Natural', not 'Nested'\n");
  TEST_EQUALITY(notes(parameter("Mu", "double", "0.5")), "");
  TEST_EQUALITY(notes(parameter("Law", "string", "Tied") + parameter("Mu", "double", "0.5")),
                "Mu has no effect: Law is 'Tied', not 'Free'\n");
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
                "Outer Solver/Successive Approximation/Relaxation: 'Non' is neither a known word nor a number: expected one of: None, "
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

/// Message of readScene's error; a note instead if the message differs between ranks.
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

/// A file that only rank 0 can see.
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
    TEST_ASSERT(contains(errorOfFile(*comm, written.path), written.path + ": this is not valid XML: line 2"));
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

// Neither the parser nor the consumers of its result may see these: both recurse for each level.
TEUCHOS_UNIT_TEST(SceneReader, RefusesTooDeepNesting) {
  for (const int depth : {51, 20000, 1000000}) {
    std::string text;
    for (int i = 0; i < depth; ++i) text += "<ParameterList name=\"a>b\">\n<!-- <x> -->";
    TEST_ASSERT(contains(errorOf(text), "line 51: elements are nested more than 50 deep"));
  }
  std::string wide = "<ParameterList>";
  for (int i = 0; i < 100; ++i)
    wide += "<ParameterList name=\"" + std::to_string(i) + "\"><Parameter name=\"a/>\" value='1'/></ParameterList>";
  TEST_ASSERT(!contains(errorOf(wide + "</ParameterList>"), "elements within"));
}

TEUCHOS_UNIT_TEST(SceneReader, ExplainsHowToMeshAGeometry) {
  const std::string text = "Point(1) = {0, 0, 0, .3};";
  const auto said = [&](const std::string& path) {
    try {
      parseScene(text, path, sceneSchema());
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  TEST_EQUALITY(said("dir/part.geo"),
                "dir/part.geo: is a geometry or a mesh, not a scene; 'suture_new dir/part.geo' writes a scene that names it in Mesh/File");
  TEST_ASSERT(contains(said("part.MSH"), "suture_new part.MSH"));
  TEST_ASSERT(contains(said("part.xml"), "this is not valid XML"));
}

TEUCHOS_UNIT_TEST(SceneReader, ReadsRegularFilesOfASceneSizeOnly) {
  const CommPtr comm = Teuchos::DefaultComm<int>::getComm();
  TEST_EQUALITY(errorOfFile(*comm, "/dev/zero"), "/dev/zero: is not a regular file; expected an XML file");
  const Written large(*comm, std::string((16 << 20) + 1, ' '));
  TEST_EQUALITY(errorOfFile(*comm, large.path), large.path + ": has 16777217 bytes; expected an XML file of at most 16777216");
}

TEUCHOS_UNIT_TEST(SceneReader, ADefaultMayFitTheRestOfTheScene) {
  const Schema schema =
      Schema("of a meal")
          .list("Drink", Schema("beside it").text("Name", "water", "what is poured").fittingDefault([](const Parameters& meal) {
            return meal.get<std::string>("Dish") == "Fish" ? "white wine" : "water";
          }))
          .text("Dish", "Soup", "what is eaten");
  const auto drinkOf = [&](const std::vector<std::string>& settings) {
    return parseScene("<ParameterList/>", "meal.xml", schema, settings).parameters->sublist("Drink").get<std::string>("Name");
  };
  TEST_EQUALITY(drinkOf({}), "water");
  TEST_EQUALITY(drinkOf({"Dish=Fish"}), "white wine");
  TEST_EQUALITY(drinkOf({"Dish=Fish", "Drink/Name=beer"}), "beer");
  TEST_THROW(Schema().integer("N", 1, "").fittingDefault([](const Parameters&) { return ""; }), InternalError);
}

}  // namespace
