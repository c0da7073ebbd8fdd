#include <suture/report/Fields.hpp>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <fstream>
#include <set>
#include <suture/base/hdf5/Hdf5Reader.hpp>

#include "SampleRun.hpp"

using namespace suture;

namespace {

// All tests use the same report; read_with_vtk.py and suture_plot read it after them.
std::string written() {
  static bool done = false;
  const std::string folder = sample::folderOf("fields");
  if (!done) {
    sample::SampleRun sample(folder);
    prepareFolder(*sample.comm_, folder);
    writeReport(sample.run(), ExitCode::Done);
    done = true;
  }
  return folder;
}

Hdf5Reader open(const std::string& name) { return Hdf5Reader(*Tpetra::getDefaultComm(), written() + "/" + name); }

TEUCHOS_UNIT_TEST(Fields, CarryTheDisplacementOfEveryPoint) {
  const Hdf5Reader file = open("fields_0000.vtkhdf");
  const std::vector<double> x = file.readReals("/VTKHDF/Points"), u = file.readReals("/VTKHDF/PointData/Displacement");
  TEST_EQUALITY(x.size(), u.size());
  TEST_ASSERT(x.size() >= 3 * 2 * 7 * 4);
  double worst = 0;
  for (std::size_t i = 0; i + 2 < x.size(); i += 3) {
    const Point exact = sample::displacementAt({x[i], x[i + 1], x[i + 2]});
    for (std::size_t k = 0; k < 3; ++k) worst = std::max(worst, std::abs(u[i + k] - exact[k]));
  }
  TEST_COMPARE(worst, <, 1e-17);
}

TEUCHOS_UNIT_TEST(Fields, CarryTheStressOfHookesLawInTheOrderOfVtk) {
  const Hdf5Reader file = open("fields_0000.vtkhdf");
  const std::vector<double> stress = file.readReals("/VTKHDF/CellData/Stress");
  TEST_EQUALITY(stress.size(), 6 * 72);
  const sample::Stress exact = sample::exactStress();
  const double expected[] = {exact.xx, exact.yy, exact.zz, exact.xy, 0.0, 0.0};
  double worst = 0;
  for (std::size_t i = 0; i < stress.size(); ++i) worst = std::max(worst, std::abs(stress[i] - expected[i % 6]));
  TEST_COMPARE(worst, <, 1e-12 * exact.yy);
}

TEUCHOS_UNIT_TEST(Fields, PrincipalStressesTurnTheTensorDiagonal) {
  const Hdf5Reader file = open("fields_0000.vtkhdf");
  const std::vector<double> s = file.readReals("/VTKHDF/CellData/PrincipalStress");
  const std::vector<double> d1 = file.readReals("/VTKHDF/CellData/PrincipalDirection1");
  const std::vector<double> d2 = file.readReals("/VTKHDF/CellData/PrincipalDirection2");
  const sample::Stress exact = sample::exactStress();
  for (std::size_t i = 0; i < s.size(); i += 3) {
    // The tensor rebuilt from its principal axes.
    const double xx = s[i] * d1[i] * d1[i] + s[i + 1] * d2[i] * d2[i];
    const double yy = s[i] * d1[i + 1] * d1[i + 1] + s[i + 1] * d2[i + 1] * d2[i + 1];
    const double xy = s[i] * d1[i] * d1[i + 1] + s[i + 1] * d2[i] * d2[i + 1];
    if (s[i] < s[i + 1] || std::abs(xx - exact.xx) + std::abs(yy - exact.yy) + std::abs(xy - exact.xy) > 1e-11 * exact.yy) success = false;
  }
  TEST_FLOATING_EQUALITY(s[2], exact.zz, 1e-12);
}

TEUCHOS_UNIT_TEST(Fields, CarryTheEstimatedErrorOfEveryElementIfThereIsOne) {
  for (const std::string& name : open("fields_0000.vtkhdf").members("/VTKHDF/CellData")) TEST_INEQUALITY(name, "ErrorEstimate");
  const std::string folder = sample::folderOf("fields_error");
  sample::SampleRun sample(folder);
  sample.solution_.discretisation = DiscretisationError{1.0, 1.0, {}};
  for (const SubdomainMesh& mesh : sample.subdomains_) {
    Vector values(mesh.elements());
    for (int e = 0; e < mesh.elements(); ++e) values(e) = 0.5 + double(mesh.globalElements[e]);
    sample.solution_.discretisation->ofElements.push_back(values);
  }
  prepareFolder(*sample.comm_, folder);
  writeReport(sample.run(), ExitCode::Done);
  const Hdf5Reader file(*sample.comm_, folder + "/fields_0000.vtkhdf");
  const std::vector<double> error = file.readReals("/VTKHDF/CellData/ErrorEstimate"), id = file.readReals("/VTKHDF/CellData/ElementId");
  TEST_EQUALITY(error.size(), 72);
  for (std::size_t i = 0; i < error.size(); ++i) TEST_EQUALITY(error[i], 0.5 + id[i]);
  TEST_EQUALITY(file.readTextAttribute("/VTKHDF/CellData/ErrorEstimate", "unit"), "(Pa m^2)^(1/2)");
}

// 18,432 elements: written in several pieces by up to three ranks. The cells, collected rank by rank, are the triangles of the boxes, each
// with its number, and no point occurs twice on a rank.
TEUCHOS_UNIT_TEST(Fields, OfSeveralPiecesAreOneGrid) {
  const int finer = 16;
  const std::string folder = sample::folderOf("fields_fine");
  sample::SampleRun sample(folder, finer);
  prepareFolder(*sample.comm_, folder);
  writeReport(sample.run(), ExitCode::Done);
  const Hdf5Reader file(*sample.comm_, folder + "/fields_0000.vtkhdf");
  const std::vector<double> x = file.readReals("/VTKHDF/Points"), u = file.readReals("/VTKHDF/PointData/Displacement");
  const std::vector<GlobalId> node = file.readGlobalIds("/VTKHDF/PointData/NodeId"),
                              element = file.readGlobalIds("/VTKHDF/CellData/ElementId"),
                              corner = file.readGlobalIds("/VTKHDF/Connectivity"), offset = file.readGlobalIds("/VTKHDF/Offsets"),
                              points = file.readGlobalIds("/VTKHDF/NumberOfPoints"), cells = file.readGlobalIds("/VTKHDF/NumberOfCells"),
                              corners = file.readGlobalIds("/VTKHDF/NumberOfConnectivityIds");
  const std::vector<int> subdomain = file.readInts("/VTKHDF/CellData/Subdomain"), body = file.readInts("/VTKHDF/CellData/Body");
  TEST_EQUALITY(element.size(), std::size_t(72 * finer * finer));
  TEST_EQUALITY(std::set<GlobalId>(element.begin(), element.end()).size(), element.size());
  TEST_EQUALITY(std::set<GlobalId>(node.begin(), node.end()).size(), std::size_t(2 * (6 * finer + 1) * (3 * finer + 1)));
  TEST_EQUALITY(file.readReals("/VTKHDF/CellData/Stress").size(), 6 * element.size());

  double worst = 0, worstArea = 0;
  for (std::size_t i = 0; i + 2 < x.size(); i += 3) {
    const Point exact = sample::displacementAt({x[i], x[i + 1], x[i + 2]});
    for (std::size_t k = 0; k < 3; ++k) worst = std::max(worst, std::abs(u[i + k] - exact[k]));
  }
  TEST_COMPARE(worst, <, 1e-17);
  int misplaced = 0;
  std::size_t firstPoint = 0, firstCell = 0, firstCorner = 0;
  for (std::size_t part = 0; part < points.size(); ++part) {
    const auto begin = node.begin() + static_cast<std::ptrdiff_t>(firstPoint), end = begin + points[part];
    TEST_EQUALITY(std::set<GlobalId>(begin, end).size(), std::size_t(points[part]));
    for (GlobalId c = 0; c < cells[part]; ++c) {
      const GlobalId* at = offset.data() + firstCell + part + c;  // a partition has one offset more than cells
      const auto place = [&](int k) { return x.data() + 3 * (firstPoint + corner[firstCorner + at[0] + k]); };
      const double *p = place(0), *q = place(1), *r = place(2);
      const double area = 0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
      worstArea = std::max(worstArea, std::abs(area * 36 * finer * finer / 2.0 - 1));
      const double centreX = (p[0] + q[0] + r[0]) / 3, centreY = (p[1] + q[1] + r[1]) / 3;
      const int lies = centreY > 1 ? 2 : (centreX > 1 ? 1 : 0);
      misplaced += at[1] - at[0] != 3 || subdomain[firstCell + c] != lies || body[firstCell + c] != (lies == 2);
    }
    firstPoint += points[part];
    firstCell += cells[part];
    firstCorner += corners[part];
  }
  TEST_EQUALITY(firstCell, element.size());
  TEST_EQUALITY(misplaced, 0);
  TEST_COMPARE(worstArea, <, 1e-10);  // coordinates are multiples of 1/48, rounded
}

TEUCHOS_UNIT_TEST(Fields, NameTheirUnitsAndSigns) {
  const Hdf5Reader file = open("fields_0000.vtkhdf");
  TEST_EQUALITY(file.readTextAttribute("/VTKHDF/CellData/Stress", "unit"), "Pa");
  TEST_ASSERT(file.readTextAttribute("/VTKHDF/CellData/Stress", "meaning").find("tension positive") != std::string::npos);
  TEST_EQUALITY(file.readTextAttribute("/VTKHDF/PointData/Displacement", "unit"), "m");
  const Hdf5Reader contact = open("contact_0000.vtkhdf");
  TEST_ASSERT(contact.readTextAttribute("/VTKHDF/PointData/ContactPressure", "meaning").find("compression positive") != std::string::npos);
  TEST_ASSERT(contact.readTextAttribute("/VTKHDF/PointData/Gap", "meaning").find("positive where open") != std::string::npos);
}

TEUCHOS_UNIT_TEST(Fields, RecordWhereTheyComeFrom) {
  const Hdf5Reader file = open("fields_0000.vtkhdf");
  TEST_EQUALITY(file.readText("/Record/Input"), "<ParameterList name=\"Suture\"/>");
  TEST_ASSERT(file.readText("/Record/Resolved").find("Maximum Iterations") != std::string::npos);
  TEST_EQUALITY(file.readText("/Record/MeshHash"), "abcd");
  TEST_EQUALITY(file.readText("/Record/CommandLine"), "suture_solve scene.xml --set 'Outer Solver/Type=Chord'");
  TEST_EQUALITY(file.readText("/Record/Bodies"), "[\"lower\",\"upper\"]");
  TEST_EQUALITY(file.readText("/Record/Subdomains"), "[\"subdomain_lower_0_0\",\"subdomain_lower_1_0\",\"subdomain_upper_0_0\"]");
}

TEUCHOS_UNIT_TEST(Fields, RecordEverySideOfEveryGroupOnce) {
  const Hdf5Reader file = open("fields_0000.vtkhdf");
  TEST_EQUALITY(file.members("/Record/SideGroups").size(), 8);
  const std::vector<double> top = file.readReals("/Record/SideGroups/lower_top");
  TEST_EQUALITY(top.size(), 6 * 6);
  double length = 0;
  for (std::size_t i = 0; i + 5 < top.size(); i += 6) {
    length += std::hypot(top[i + 3] - top[i], top[i + 4] - top[i + 1]);
    TEST_EQUALITY(top[i + 1], 1.0);
    TEST_EQUALITY(top[i + 4], 1.0);
  }
  TEST_FLOATING_EQUALITY(length, 2.0, 1e-14);
}

TEUCHOS_UNIT_TEST(ContactFields, JoinThePairsOfALineAndKeepALonelyOne) {
  const Hdf5Reader file = open("contact_0000.vtkhdf");
  const std::vector<int> types = file.readInts("/VTKHDF/Types");
  TEST_EQUALITY(types.size(), 3);
  TEST_EQUALITY(types[0], 3);
  TEST_EQUALITY(types[1], 3);
  TEST_EQUALITY(types[2], 1);
  TEST_EQUALITY(file.readText("/Record/ContactPieces"), "[\"joint\",\"crack\"]");
  const std::vector<double> pressure = file.readReals("/VTKHDF/PointData/ContactPressure"), gap = file.readReals("/VTKHDF/PointData/Gap");
  const std::vector<int> active = file.readInts("/VTKHDF/PointData/Active");
  TEST_EQUALITY(pressure.size(), 4);
  TEST_EQUALITY(pressure[3], 10.0);
  TEST_EQUALITY(gap[2], 4e-3);
  TEST_EQUALITY(active[1], 1);
  TEST_EQUALITY(active[2], 0);
}

TEUCHOS_UNIT_TEST(ContactFields, ReportForcesSlipsAndStatesOfSlidingPairs) {
  const std::string folder = sample::folderOf("rubbing"), points = "/VTKHDF/PointData/";
  sample::SampleRun sample(folder);
  prepareFolder(*sample.comm_, folder);
  sample.rub();
  writeReport(sample.run(), ExitCode::Done);
  const Hdf5Reader file(*sample.comm_, folder + "/contact_0000.vtkhdf"), smooth = open("contact_0000.vtkhdf");
  const std::vector<double> traction = file.readReals(points + "TangentialTraction"), bound = file.readReals(points + "FrictionBound"),
                            slip = file.readReals(points + "Slip"), work = file.readReals(points + "DissipatedWork");
  const std::vector<int> stick = file.readInts(points + "Stick");
  TEST_COMPARE_ARRAYS(stick, (std::vector<int>{0, 1, -1, 1}));
  TEST_COMPARE_ARRAYS(bound, (std::vector<double>{1.6, 2.4, 0.0, 4.0}));  // over tributary lengths of .5
  TEST_COMPARE_ARRAYS(work, (std::vector<double>{3.2e-3, 0.0, 0.0, 0.0}));
  TEST_COMPARE_ARRAYS(traction, (std::vector<double>{1.6, 0, 0, 1.2, 0, 0, 0, 0, 0, 1.6, -1.2, 0}));
  TEST_COMPARE_ARRAYS(slip, (std::vector<double>{2e-3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
  TEST_EQUALITY(file.readTextAttribute(points + "DissipatedWork", "unit"), "Pa m");
  TEST_ASSERT(file.readTextAttribute(points + "TangentialTraction", "meaning").find("on side B") != std::string::npos);
  for (const char* name : {"TangentialTraction", "FrictionBound", "Slip", "Stick", "DissipatedWork"})
    TEST_ASSERT(!smooth.has(points + name));
}

TEUCHOS_UNIT_TEST(Report, LeavesNothingBesideItsFiles) {
  const std::string folder = written();
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() != ".png") names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  const std::vector<std::string> expected{"contact.csv", "contact_0000.vtkhdf", "fields_0000.vtkhdf",
                                          "history.csv", "reactions.csv",       "summary.json"};
  TEST_COMPARE_ARRAYS(names, expected);
}

TEUCHOS_UNIT_TEST(Report, ReplacesTheContactFileOfAnEarlierRun) {
  const std::string folder = sample::folderOf("again");
  sample::SampleRun first(folder);
  prepareFolder(*first.comm_, folder);
  writeReport(first.run(), ExitCode::Done);
  TEST_ASSERT(std::filesystem::exists(folder + "/contact_0000.vtkhdf"));
  first.comm_->barrier();
  sample::SampleRun linear(folder);
  linear.size_.pairs = linear.size_.pieces = 0;
  linear.solution_.pairs.clear();
  linear.pieces_.clear();
  writeReport(linear.run(), ExitCode::Done);
  TEST_ASSERT(!std::filesystem::exists(folder + "/contact_0000.vtkhdf"));
  TEST_ASSERT(std::filesystem::exists(folder + "/fields_0000.vtkhdf"));
}

TEUCHOS_UNIT_TEST(OutputFolder, RefusesAFolderThatCannotBeMadeOnAllRanks) {
  const CommPtr comm = Tpetra::getDefaultComm();
  TEST_THROW(prepareFolder(*comm, "/dev/null/out"), EnvironmentError);
  TEST_THROW(prepareFolder(*comm, "/proc/out"), EnvironmentError);
  if (comm->getRank() == 0) std::ofstream("in_the_way") << "x";
  comm->barrier();
  TEST_THROW(prepareFolder(*comm, "in_the_way"), EnvironmentError);
}

}  // namespace
