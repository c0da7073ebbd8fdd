// Needs SUTURE_GMSH. One rank: the cache is local.
#include <suture/reader/gmsh/GmshReader.hpp>
#include <suture/reader/gmsh/MeshCache.hpp>
#include <suture/reader/gmsh/MeshKey.hpp>

#include <sys/wait.h>

#include <Teuchos_UnitTestHarness.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <reader/MeshTesting.hpp>

using namespace suture;
using meshtesting::Folder;
using meshtesting::problemsOf;

namespace {

namespace fs = std::filesystem;

/// A mesh of `nodes` nodes, different for each `seed`.
GmshMesh meshLike(int seed, std::size_t nodes = 50) {
  GmshMesh mesh;
  for (std::size_t i = 0; i < nodes; ++i) {
    mesh.tags.push_back(i + 1);
    for (int k = 0; k < 3; ++k) mesh.coordinates.push_back(seed + 0.25 * static_cast<double>(i) + k);
  }
  mesh.blocks.push_back({2, seed, 2, {0, 1, 2}, {}});
  mesh.addGroup(2, 1, "body " + std::to_string(seed), seed);
  mesh.descriptions["face"] = "plane " + std::to_string(seed);
  return mesh;
}

bool equal(const std::optional<GmshMesh>& found, const GmshMesh& expected) {
  return found && found->tags == expected.tags && found->coordinates == expected.coordinates &&
         found->blocks.size() == expected.blocks.size() && found->blocks[0].nodes == expected.blocks[0].nodes &&
         found->groups == expected.groups && found->descriptions == expected.descriptions;
}

std::vector<fs::path> filesIn(const std::string& folder) {
  std::vector<fs::path> all;
  std::error_code none;
  for (const auto& file : fs::directory_iterator(folder, none)) all.push_back(file.path());
  return all;
}

std::string bytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

void put(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

/// A folder with the program "mesher", which all entries of a test depend on.
struct Setting {
  Folder folder;
  std::string program = folder.write("mesher", "one"), cache = folder.path() + "/a/b";
  std::vector<FileStamp> programs{*stampOf(program)};
};

// A rectangle W x 1; `more` at the end.
std::string rectangleOf(const std::string& more = "") {
  return "SetFactory(\"OpenCASCADE\");\nDefineConstant[ W = 2 ];\nRectangle(1) = {0, 0, 0, W, 1};\nPhysical Surface(\"body\") = {1};\n" +
         more + "\n";
}

double rightEnd(const Mesh& mesh) {
  double largest = 0;
  for (int i = 0; i < mesh.nodes(); ++i) largest = std::max(largest, mesh.point(i)[0]);
  return largest;
}

/// Reads with a time limit that Gmsh cannot keep: succeeds only if the mesh is in the cache.
std::string withoutGmsh(GmshInput input, Mesh& mesh) {
  input.seconds = 1e-6;
  return problemsOf([&] { mesh = readGmsh(input); });
}

}  // namespace

TEUCHOS_UNIT_TEST(MeshCache, FindsWhatItHasStoredUnderItsKeyOnly) {
  const Setting own;
  const MeshCache cache(own.cache);
  TEST_ASSERT(!cache.find("a key"));
  cache.store("a key", own.programs, meshLike(1));
  cache.store("another", own.programs, meshLike(2));
  TEST_ASSERT(equal(cache.find("a key"), meshLike(1)));
  TEST_ASSERT(equal(MeshCache(own.cache).find("another"), meshLike(2)));
  TEST_ASSERT(!cache.find("a key "));
  TEST_ASSERT(!cache.find(""));
  cache.store("a key", own.programs, meshLike(3));
  TEST_ASSERT(equal(cache.find("a key"), meshLike(3)));
  TEST_EQUALITY(filesIn(own.cache).size(), std::size_t(2));
}

TEUCHOS_UNIT_TEST(MeshCache, DoesNotTrustTheNameOfAFile) {
  const Setting own;
  const MeshCache cache(own.cache);
  cache.store("a key", own.programs, meshLike(1));
  const fs::path first = filesIn(own.cache)[0];
  cache.store("another", own.programs, meshLike(2));
  for (const fs::path& file : filesIn(own.cache))
    if (file != first) fs::copy_file(file, first, fs::copy_options::overwrite_existing);  // as if both keys had the same hash
  TEST_ASSERT(!cache.find("a key"));
  TEST_ASSERT(equal(cache.find("another"), meshLike(2)));
}

TEUCHOS_UNIT_TEST(MeshCache, MissesADamagedFileAndReplacesIt) {
  const Setting own;
  const MeshCache cache(own.cache);
  cache.store("a key", own.programs, meshLike(1));
  const fs::path file = filesIn(own.cache)[0];
  const std::string sound = bytesOf(file);
  for (std::size_t at = 0; at < sound.size(); at += 7) {
    std::string damaged = sound;
    damaged[at] = static_cast<char>(damaged[at] ^ 16);
    put(file, damaged);
    TEST_ASSERT(!cache.find("a key"));
  }
  for (const std::size_t length : {std::size_t(0), std::size_t(1), std::size_t(8), sound.size() / 2, sound.size() - 1}) {
    put(file, sound.substr(0, length));
    TEST_ASSERT(!cache.find("a key"));
  }
  put(file, sound + "x");
  TEST_ASSERT(!cache.find("a key"));
  cache.store("a key", own.programs, meshLike(1));
  TEST_ASSERT(equal(cache.find("a key"), meshLike(1)));
}

TEUCHOS_UNIT_TEST(MeshCache, MissesMeshesOfAnotherProgram) {
  const Setting own;
  const MeshCache cache(own.cache);
  cache.store("a key", own.programs, meshLike(1));
  fs::last_write_time(own.program, fs::last_write_time(own.program) + std::chrono::seconds(1));
  TEST_ASSERT(!cache.find("a key"));
  cache.store("a key", {*stampOf(own.program)}, meshLike(2));
  TEST_ASSERT(equal(cache.find("a key"), meshLike(2)));
  fs::remove(own.program);
  TEST_ASSERT(!cache.find("a key"));
}

TEUCHOS_UNIT_TEST(MeshCache, RemovesTheMeshesThatWereUsedLongestAgo) {
  const Setting own;
  MeshCache(own.cache).store("0", own.programs, meshLike(0));
  const std::uintmax_t one = fs::file_size(filesIn(own.cache)[0]);
  const MeshCache cache(own.cache, 6 * one);
  const auto age = [&] {
    for (const fs::path& file : filesIn(own.cache)) fs::last_write_time(file, fs::last_write_time(file) - std::chrono::seconds(10));
  };
  for (int i = 1; i < 20; ++i) {
    age();
    cache.store(std::to_string(i), own.programs, meshLike(i));
    TEST_ASSERT(equal(cache.find("0"), meshLike(0)));  // used all the time
    std::uintmax_t total = 0;
    for (const fs::path& file : filesIn(own.cache)) total += fs::file_size(file);
    TEST_COMPARE(total, <=, 6 * one);
  }
  TEST_ASSERT(equal(cache.find("19"), meshLike(19)));
  TEST_ASSERT(!cache.find("1"));
  cache.store("large", own.programs, meshLike(1, 500));  // more than a quarter of the size
  TEST_ASSERT(!cache.find("large"));
  TEST_ASSERT(equal(cache.find("19"), meshLike(19)));
}

TEUCHOS_UNIT_TEST(MeshCache, LeavesFilesOfOthersAndRemovesAbandonedParts) {
  const Setting own;
  fs::create_directories(own.cache);
  put(own.cache + "/note.txt", std::string(100000, 'x'));
  put(own.cache + "/0123.mesh.AbCdEf", "part of a process that has died");
  put(own.cache + "/0123.mesh.GhIjKl", "part of a process that runs");
  fs::last_write_time(own.cache + "/0123.mesh.AbCdEf", fs::file_time_type::clock::now() - std::chrono::hours(2));
  MeshCache(own.cache, 50000).store("a key", own.programs, meshLike(1));
  TEST_ASSERT(fs::exists(own.cache + "/note.txt"));
  TEST_ASSERT(fs::exists(own.cache + "/0123.mesh.GhIjKl"));
  TEST_ASSERT(!fs::exists(own.cache + "/0123.mesh.AbCdEf"));
}

TEUCHOS_UNIT_TEST(MeshCache, DoesWithoutAUsableFolder) {
  const Setting own;
  for (const std::string& folder : {std::string(), own.program, std::string("/proc/none/of/it")}) {
    const MeshCache cache(folder);
    cache.store("a key", own.programs, meshLike(1));
    TEST_ASSERT(!cache.find("a key"));
  }
  MeshCache(own.cache).store("a key", {}, meshLike(1));  // made by unknown programs
  TEST_ASSERT(!MeshCache(own.cache).find("a key"));
}

// Four processes store and find three meshes of one key in turn; a file is small enough to be written in one piece, and large enough not to
// be.
TEUCHOS_UNIT_TEST(MeshCache, IsSharedByProcesses) {
  const Setting own;
  constexpr int rounds = 60;
  std::vector<pid_t> children;
  for (int child = 0; child < 4; ++child) {
    const pid_t id = fork();
    if (id == 0) {
      const MeshCache cache(own.cache);
      bool good = true;
      for (int i = 0; i < rounds; ++i) {
        const int seed = (child + i) % 3;
        cache.store("key", own.programs, meshLike(seed, seed == 0 ? 10 : 20000));
        const std::optional<GmshMesh> found = cache.find("key");
        if (!found) good = false;
        const int of = found ? found->blocks.at(0).tag : 0;
        good = good && equal(found, meshLike(of, of == 0 ? 10 : 20000));
      }
      _exit(good ? 0 : 1);
    }
    children.push_back(id);
  }
  for (const pid_t id : children) {
    int status = 1;
    const pid_t ended = waitpid(id, &status, 0);
    TEST_EQUALITY(ended, id);
    TEST_EQUALITY(status, 0);
  }
  TEST_EQUALITY(filesIn(own.cache).size(), std::size_t(1));
}

TEUCHOS_UNIT_TEST(MeshCache, SavesTheReaderFromRunningGmsh) {
  const Folder folder;
  GmshInput input{folder.write("a.geo", rectangleOf()), {}, 1.0};
  const std::string expected = readGmsh(input).hash();
  Mesh mesh;
  SUTURE_CHECK_SAYS(withoutGmsh(input, mesh), "Mesh/Time Limit");
  input.cache = folder.path() + "/cache";
  SUTURE_CHECK_SAYS(withoutGmsh(input, mesh), "Mesh/Time Limit");
  TEST_EQUALITY(readGmsh(input).hash(), expected);
  TEST_EQUALITY(withoutGmsh(input, mesh), "no error");
  TEST_EQUALITY(mesh.hash(), expected);
  TEST_EQUALITY(mesh.source, input.path);
  fs::create_directory(folder.path() + "/elsewhere");  // the same geometry in another folder
  fs::copy_file(input.path, folder.path() + "/elsewhere/a.geo");
  input.path = folder.path() + "/elsewhere/a.geo";
  TEST_EQUALITY(withoutGmsh(input, mesh), "no error");
  TEST_EQUALITY(mesh.source, input.path);
}

TEUCHOS_UNIT_TEST(MeshCache, KnowsAllThatChangesTheMesh) {
  const Folder folder;
  folder.write("part.geo", "L = 3;\n");
  const GmshInput plain{folder.write("a.geo", "Include \"part.geo\";\n" + rectangleOf("Mesh.MeshSizeMax = 0.1 * L;")), {}, 1.0};
  GmshInput input = plain;
  input.cache = folder.path() + "/cache";
  const int coarse = readGmsh(input).elements();
  Mesh mesh;
  TEST_EQUALITY(withoutGmsh(input, mesh), "no error");

  const auto newMesh = [&](const std::string& what, const GmshInput& changed) {
    out << what << "\n";
    Mesh unused;
    SUTURE_CHECK_SAYS(withoutGmsh(changed, unused), "Mesh/Time Limit");
    return readGmsh(changed);
  };
  GmshInput changed = input;
  changed.constants["W"] = 5;
  const Mesh wider = newMesh("a constant", changed);
  TEST_FLOATING_EQUALITY(rightEnd(wider), 5.0, 1e-12);
  changed = input;
  changed.meshSizeFactor = 0.5;
  const Mesh smaller = newMesh("the factor of sizes", changed);
  TEST_COMPARE(smaller.elements(), >, 2 * coarse);
  changed = input;
  changed.largest = 0.1;
  const Mesh limited = newMesh("the size", changed);
  TEST_COMPARE(limited.elements(), >, 2 * coarse);
  changed = input;
  changed.order = 2;
  const Mesh curved = newMesh("the order", changed);
  TEST_ASSERT(curved.cells[0] == Cell::Triangle6);
  folder.write("part.geo", "L = 1;\n");
  const Mesh included = newMesh("an included file", input);
  TEST_COMPARE(included.elements(), >, 2 * coarse);
  folder.write("part.geo", "L = 3;\n");
  TEST_EQUALITY(withoutGmsh(input, mesh), "no error");
  TEST_EQUALITY(mesh.elements(), coarse);
  folder.write("a.geo", "Include \"part.geo\";\n" + rectangleOf("Mesh.MeshSizeMax = 0.1 * L; Physical Curve(\"end\") = {2};"));
  const Mesh named = newMesh("the file", input);
  TEST_EQUALITY(named.sideGroups.count("end"), std::size_t(1));
}

TEUCHOS_UNIT_TEST(MeshCache, KeepsNoMeshThatDependsOnMoreThanTheFiles) {
  const Folder folder;
  GmshInput input{"", {}, 1.0};
  input.cache = folder.path() + "/cache";
  for (const std::string word :
       {"x = Cpu;", "x = Rand(1);", "If(StrLen(CurrentDirectory) > 3)\nEndIf", "x = FileExists(\"a\");", "x = TotalMemory;"}) {
    input.path = folder.write("a.geo", word + "\n" + rectangleOf());
    readGmsh(input);
  }
  TEST_EQUALITY(filesIn(input.cache).size(), std::size_t(0));
  input.path = folder.write("a.geo", "// Cpu\n" + rectangleOf());
  input.allowPrograms = true;  // may read any file
  readGmsh(input);
  TEST_EQUALITY(filesIn(input.cache).size(), std::size_t(0));
  input.allowPrograms = false;
  readGmsh(input);
  TEST_EQUALITY(filesIn(input.cache).size(), std::size_t(1));
}

TEUCHOS_UNIT_TEST(MeshCache, KeepsNoAssemblyWhosePartsAreInOtherFiles) {
  const Folder folder;
  const MesherOrder order;
  TEST_ASSERT(meshKey(order, {}, {folder.write("a.step", "DATA;\n#1=PRODUCT('a');\n")}).has_value());
  TEST_ASSERT(!meshKey(order, {}, {folder.write("a.step", "DATA;\n#1=DOCUMENT_FILE('part.step');\n")}));
  TEST_ASSERT(!meshKey(order, {}, {folder.path() + "/missing.step"}));
}

TEUCHOS_UNIT_TEST(MeshCache, KeepsNoMeshOfAFailure) {
  const Folder folder;
  GmshInput input{folder.write("a.geo", "Point(1) = {0, 0, 0};\nLine(1) = {1, 7};\n"), {}, 1.0};
  input.cache = folder.path() + "/cache";
  for (int i = 0; i < 2; ++i) SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh(input); }), "Gmsh reports");
  TEST_EQUALITY(filesIn(input.cache).size(), std::size_t(0));
}

TEUCHOS_UNIT_TEST(MeshCache, KeepsTheNamesAndShapesOfACadFile) {
  const Folder folder;
  GmshInput input{SUTURE_SOURCE_DIR "/test/reader/cad/solid.igs", {}, 1.0};
  input.cache = folder.path() + "/cache";
  SideDescriptions made, kept;
  const Mesh first = readGmsh(input, &made);
  input.seconds = 1e-6;
  const Mesh second = readGmsh(input, &kept);
  TEST_EQUALITY(first.hash(), second.hash());
  TEST_ASSERT(!made.empty() && made == kept);
  input.unit = "in";
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh(input); }), "Mesh/Time Limit");
}

TEUCHOS_UNIT_TEST(MeshCache, LiesWhereTheEnvironmentSays) {
  const std::vector<const char*> names{"SUTURE_MESH_CACHE", "XDG_CACHE_HOME", "HOME"};
  std::map<std::string, std::string> before;
  for (const char* name : names)
    if (const char* value = std::getenv(name)) before[name] = value;
  const auto folderWith = [&](const std::vector<const char*>& values) {
    for (std::size_t i = 0; i < names.size(); ++i) setenv(names[i], values[i], 1);
    return meshCacheFolder();
  };
  TEST_EQUALITY(folderWith({"/x", "/c", "/h"}), "/x");
  TEST_EQUALITY(folderWith({"off", "/c", "/h"}), "");
  TEST_EQUALITY(folderWith({"", "/c", "/h"}), "/c/suture/meshes");
  TEST_EQUALITY(folderWith({"", "relative", "/h"}), "/h/.cache/suture/meshes");
  TEST_EQUALITY(folderWith({"", "", "/h"}), "/h/.cache/suture/meshes");
  TEST_EQUALITY(folderWith({"", "", ""}), "");
  for (const char* name : names) before.count(name) ? setenv(name, before[name].c_str(), 1) : unsetenv(name);
}
