#include <suture/mesh/Generators.hpp>
#include <suture/reader/MeshReader.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <reader/MeshTesting.hpp>

using namespace suture;
using meshtesting::fileParameter;
using meshtesting::Folder;
using meshtesting::world;

namespace {

// Error message of reading, which must be the same on all ranks (and must not hang).
std::string said(const std::string& parameters, const std::string& folder) {
  const std::string text = meshtesting::problemsOf([&] { meshtesting::read(parameters, folder); });
  return meshtesting::sameEverywhere(text) ? text : "different messages";
}

const std::string boxesOfTwo =
    "<Parameter name=\"Generator\" type=\"string\" value=\"Boxes\"/><ParameterList name=\"Boxes\">"
    "<ParameterList name=\"z below\"><Parameter name=\"X\" type=\"Array(double)\" value=\"{0, 4}\"/>"
    "<Parameter name=\"Cells\" type=\"Array(int)\" value=\"{8, 3}\"/><Parameter name=\"Blocks\" type=\"Array(int)\" value=\"{4, 1}\"/>"
    "</ParameterList>"
    "<ParameterList name=\"a above\"><Parameter name=\"Y\" type=\"Array(double)\" value=\"{1, 2}\"/>"
    "<Parameter name=\"Cell\" type=\"string\" value=\"Quadrilateral4\"/></ParameterList></ParameterList>";

}  // namespace

TEUCHOS_UNIT_TEST(MeshReader, GeneratesTheBoxesOfTheScene) {
  const Mesh mesh = meshtesting::read(boxesOfTwo, ".");
  if (world()->getRank() == 0) {
    Box below, above;
    below.name = "z below", below.x1 = 4, below.nx = 8, below.ny = 3, below.blocksX = 4;
    above.name = "a above", above.y0 = 1, above.y1 = 2, above.cell = Cell::Quadrilateral4;
    TEST_EQUALITY(mesh.hash(), boxes({below, above}).hash());
  } else {
    TEST_EQUALITY(mesh.nodes(), 0);
    TEST_EQUALITY(mesh.elements(), 0);
  }
}

TEUCHOS_UNIT_TEST(MeshReader, WantsEitherAFileOrAGenerator) {
  SUTURE_CHECK_SAYS(said("", "."), "Mesh: neither File nor Generator");
  SUTURE_CHECK_SAYS(said(fileParameter("a.geo") + boxesOfTwo, "."), "Mesh: both a File and a Generator");
  SUTURE_CHECK_SAYS(said("<Parameter name=\"Generator\" type=\"string\" value=\"Boxes\"/>", "."), "Mesh/Boxes");
}

TEUCHOS_UNIT_TEST(MeshReader, ReportsUnreadableFiles) {
  const Folder folder;
  folder.write("a.vtk", "");
  folder.write("garbage.msh", "garbage");
  folder.write("empty.geo", "");
  folder.write("broken.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 1\n");
  folder.write("command.geo", "Foo bar;\n");
  folder.write("variable.geo", "a = 1;\nb = bar + a;\n");
  folder.write("a.h5", "garbage");
  SUTURE_CHECK_SAYS(said(fileParameter("a.vtk"), folder.path()),
                    "Mesh/File: 'a.vtk' ends with '.vtk'; expected one of .geo, .msh, .h5, .step");
  SUTURE_CHECK_SAYS(said(fileParameter("none.geo"), folder.path()), "Mesh/File: there is no file " + folder.path() + "/none.geo");
  SUTURE_CHECK_SAYS(said(fileParameter("none.h5"), folder.path()), "none.h5");
  SUTURE_CHECK_SAYS(said(fileParameter("a.h5"), folder.path()), "a.h5");
  SUTURE_CHECK_SAYS(said(fileParameter("garbage.msh"), folder.path()),
                    "garbage.msh: is not a Gmsh mesh; expected $MeshFormat in the first line");
  SUTURE_CHECK_SAYS(said(fileParameter("broken.msh"), folder.path()),
                    "broken.msh: $Nodes, line 5: 1 nodes are announced, but the file ends earlier");
#ifdef SUTURE_TEST_GMSH
  SUTURE_CHECK_SAYS(said(fileParameter("empty.geo"), folder.path()), "empty.geo: contains no surface elements");
  SUTURE_CHECK_SAYS(said(fileParameter("command.geo"), folder.path()), "command.geo, line 1: 'Foo' is not known to be a harmless command");
  SUTURE_CHECK_SAYS(said(fileParameter("variable.geo"), folder.path()), "line 2: Unknown variable 'bar'");
#else
  TEST_THROW(meshtesting::read(fileParameter("variable.geo"), folder.path()), EnvironmentError);
#endif
}

TEUCHOS_UNIT_TEST(MeshReader, RefusesConstantsWhereNothingIsMeshed) {
  const std::string constants =
      "<ParameterList name=\"Constants\"><Parameter name=\"W\" type=\"double\" value=\"1\"/></ParameterList>"
      "<Parameter name=\"Mesh Size Factor\" type=\"double\" value=\"0.5\"/>";
  const std::string text = said(fileParameter("a.h5") + constants, ".");
  SUTURE_CHECK_SAYS(text, "Mesh/Constants: needs a .geo file");
  SUTURE_CHECK_SAYS(text, "Mesh/Mesh Size Factor: needs a file that Gmsh meshes (.geo, .step");
}

TEUCHOS_UNIT_TEST(MeshReader, RefusesSizeAndOrderWhereNothingIsMeshed) {
  const std::string both = "<Parameter name=\"Size\" type=\"double\" value=\"0.5\"/><Parameter name=\"Order\" type=\"int\" value=\"2\"/>";
  for (const std::string& source : {fileParameter("a.h5"), fileParameter("a.msh"), boxesOfTwo}) {
    const std::string text = said(source + both, ".");
    SUTURE_CHECK_SAYS(text, "Mesh/Size: needs a file that Gmsh meshes");
    SUTURE_CHECK_SAYS(text, "Mesh/Order: needs a file that Gmsh meshes");
  }
  SUTURE_CHECK_SAYS(said(boxesOfTwo + both, "."), "found a Generator: set Cell and Cells of its boxes");
  SUTURE_CHECK_SAYS(said(fileParameter("a.step") + "<Parameter name=\"Order\" type=\"int\" value=\"3\"/>", "."), "Mesh/Order: ");
}

#ifdef SUTURE_TEST_GMSH
TEUCHOS_UNIT_TEST(MeshReader, ReadsACadFileOnRankZero) {
  const std::string in = "<Parameter name=\"Length Unit\" type=\"string\" value=\"in\"/>";
  const Mesh mesh = meshtesting::read(fileParameter("bolted_joint_in.step") + in, SUTURE_SOURCE_DIR "/test/reader/cad");
  const bool root = world()->getRank() == 0;
  TEST_EQUALITY(mesh.elementGroups.size(), std::size_t(root ? 3 : 0));
  TEST_EQUALITY(mesh.sideGroups.size(), std::size_t(root ? 14 : 0));
  const Folder folder;
  folder.write("empty.step", "");
  SUTURE_CHECK_SAYS(said(fileParameter("empty.step") + in, folder.path()), "empty.step is empty");
  SUTURE_CHECK_SAYS(said(fileParameter("none.stp") + in, folder.path()), "Mesh/File: there is no file " + folder.path() + "/none.stp");
}

TEUCHOS_UNIT_TEST(MeshReader, ReadsTheTunnelOnRankZero) {
  const Mesh mesh =
      meshtesting::read(fileParameter("tunnel.geo") +
                            "<ParameterList name=\"Constants\"><Parameter name=\"scale\" type=\"double\" value=\"4\"/></ParameterList>",
                        SUTURE_SOURCE_DIR "/input/tunnel");
  const bool root = world()->getRank() == 0;
  TEST_EQUALITY(mesh.elements() > 500 && mesh.elements() < 1000, root);
  TEST_EQUALITY(mesh.sideGroups.size(), std::size_t(root ? 9 : 0));
}

TEUCHOS_UNIT_TEST(MeshReader, ReportsAnUnknownConstantAlikeOnAllRanks) {
  const std::string constants = "<ParameterList name=\"Constants\"><Parameter name=\"tlt\" type=\"double\" value=\"1\"/></ParameterList>";
  const std::string text = said(fileParameter("tunnel.geo") + constants, SUTURE_SOURCE_DIR "/input/tunnel");
  SUTURE_CHECK_SAYS(text, "Mesh/Constants/tlt: ");
  SUTURE_CHECK_SAYS(text, "Did you mean 'tilt'?");
}
#endif
