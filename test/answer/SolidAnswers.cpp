// The verdict on 3D answers known by hand, in rotated frames: it accepts them, and names planted errors.
#include <Teuchos_UnitTestHarness.hpp>
#include <answer/SolidScenes.hpp>
#include <suture/answer/verdict/Deformation.hpp>
#include <suture/base/Point.hpp>

#include <limits>

namespace suture {
namespace solidanswers {

using solids::operator*;
using solids::PressedBlocks;

// Serendipity hexahedra have negative forces at the vertices of a face under uniform pressure: no possible contact answer.
const std::vector<Cell> contactCells{Cell::Tetrahedron4, Cell::Tetrahedron10, Cell::Hexahedron8,
                                     Cell::Hexahedron27, Cell::Wedge6,        Cell::Pyramid5};

const Eigen::Matrix3d kFrame = solids::rotation({1, 2, -0.5}, 0.9);
const Point kOrigin{3, -2, 5};

const Check& check(const Verification& verdict, const std::string& name) {
  for (const Check& one : verdict.checks)
    if (one.name == name) return one;
  throw std::logic_error("no check of the name " + name);
}

TEUCHOS_UNIT_TEST(SolidAnswers, HoldForEveryCellInAnyFrame) {
  for (const Cell cell : contactCells)
    for (const bool isTurned : {false, true}) {
      const PressedBlocks answer(cell, isTurned ? kFrame : Eigen::Matrix3d::Identity(), isTurned ? kOrigin : Point{0, 0, 0});
      const Verification verdict = answer.verdict();
      TEST_ASSERT(verdict.holds());
      out << cellInfo(cell).name << (isTurned ? " turned " : " ") << verdict.failure() << "\n";
      for (const Check& one : verdict.checks)
        out << "  " << one.name << " " << one.value << " of " << one.bound << " " << one.where << "\n";
    }
}

/// Force and moment about the origin of a uniform traction on a unit square: by its centre.
void agrees(const Resultant& sum, const Point& force, const Point& centre, bool& success, Teuchos::FancyOStream& out) {
  TEST_COMPARE(norm(minus(sum.force, force)), <, 1e-12);
  TEST_COMPARE(norm(minus(sum.moment, cross(centre, force))), <, 1e-11);
}

TEUCHOS_UNIT_TEST(SolidAnswers, BalanceForcesAndMomentsInThreeComponents) {
  for (const Cell cell : contactCells) {
    const PressedBlocks answer(cell, kFrame, kOrigin);
    const Verification verdict = answer.verdict();
    const Point push = kFrame * Point{0, 0, -PressedBlocks::pressure}, pull = scaled(-1.0, push);
    const auto at = [](const Point& p) { return plus(kFrame * p, kOrigin); };
    TEST_COMPARE(norm(minus(verdict.balance.applied, push)), <, 1e-12);
    TEST_COMPARE(norm(minus(verdict.balance.reactions, pull)), <, 1e-11);
    TEST_COMPARE(verdict.balance.imbalance, <, 1e-11);
    agrees(verdict.reactions.loads.at(0), push, at({0.5, 0.5, 1}), success, out);
    agrees(verdict.reactions.supports.at(2), pull, at({0.5, 0.5, -1}), success, out);
    agrees(verdict.reactions.supports.at(0), {0, 0, 0}, at({0, 0, 0}), success, out);
    if (solids::world()->getRank() > 0) continue;
    const ContactResultant contact = contactResultants(answer.pairs, 1, false)[0];
    agrees(contact.onB, pull, at({0.5, 0.5, 0}), success, out);
    TEST_COMPARE(norm(minus(contact.centre, at({0.5, 0.5, 0}))), <, 1e-12);
    TEST_FLOATING_EQUALITY(contact.closed, 1.0, 1e-12);
  }
}

using Plant = std::function<void(PressedBlocks&)>;

/// Strains are of the order of 2.5e-3, and so are displacements.
const std::vector<std::pair<std::string, Plant>> plants{
    {"status", [](PressedBlocks& a) { a.move(1, [](const Point&, Point& u) { u[2] += 1e-7; }); }},
    {"penetration", [](PressedBlocks& a) { a.move(1, [](const Point&, Point& u) { u[2] -= 1e-7; }); }},
    {"penetration",
     [](PressedBlocks& a) { a.move(1, [](const Point& x, Point& u) { u[2] += 1e-7 * (x[1] - 0.5), u[1] -= 1e-7 * x[2]; }); }},
    {"penetration",
     [](PressedBlocks& a) { a.move(1, [](const Point& x, Point& u) { u[2] += 1e-7 * (x[0] - 0.5), u[0] -= 1e-7 * x[2]; }); }},
    {"prescribed", [](PressedBlocks& a) { a.move(1, [](const Point& x, Point& u) { u[0] -= 1e-7 * x[1], u[1] += 1e-7 * x[0]; }); }},
    {"prescribed", [](PressedBlocks& a) { a.move(0, [](const Point&, Point& u) { u[1] += 1e-9; }); }},
    {"residual",
     [](PressedBlocks& a) { a.move(0, [](const Point& x, Point& u) { u[0] += 1e-5 * x[0] * (x[2] + 1) * std::sin(2 * x[1]); }); }},
    {"nodes",
     [](PressedBlocks& a) {
       a.move(1, [](const Point& x, Point& u) {
         if (norm(minus(x, {0.5, 0.5, 0.5})) < 0.15) u[1] += 1e-6;
       });
     }},
    {"residual",
     [](PressedBlocks& a) {
       if (!a.pairs.empty()) a.pairs[a.pairs.size() / 2].force *= 1.01;
     }},
    {"forces",
     [](PressedBlocks& a) {
       for (PairResult& pair : a.pairs) pair.force *= 1.0001;
     }},
    {"moments",
     [](PressedBlocks& a) {
       for (PairResult& pair : a.pairs) pair.force *= 1.0 + 1e-3 * ((kFrame.transpose() * minus(pair.position, kOrigin))[1] - 0.5);
     }},
    {"tension",
     [](PressedBlocks& a) {
       if (!a.pairs.empty()) a.pairs.front().force = -1e-4;
     }},
    {"status",
     [](PressedBlocks& a) {
       if (!a.pairs.empty()) a.pairs[a.pairs.size() / 2].state = PairStatus::Open;
     }},
    {"residual", [](PressedBlocks& a) { a.scene.model.materialOfBody[0].young *= 1.0001; }},
    {"residual", [](PressedBlocks& a) { a.scene.model.materialOfBody[1].poisson += 1e-4; }},
    {"forces",
     [](PressedBlocks& a) {
       a.scene.model.loads.push_back({Load::Kind::BodyForce, "upper", kFrame * Point{0, 0, -1e-5}});
     }},
    {"residual",
     [](PressedBlocks& a) {
       for (SubdomainMesh& mesh : a.meshes)
         for (ContactRow& row : mesh.contactRows) row.pair.normal = kFrame * Point{0, 1e-4, 1};
     }},
    {"seams",
     [](PressedBlocks& a) {
       for (std::size_t i = 0; i < a.meshes.size(); ++i)
         for (int node = 0; node < a.meshes[i].nodes(); ++node)
           if (!counts(a.meshes[i], node)) a.displacement[i][3 * node + 2] += 1e-10;
     }},
    {"residual",
     [](PressedBlocks& a) {
       a.move(1, [](const Point& x, Point& u) {
         if (norm(minus(x, {0.5, 0.5, 0.5})) < 0.15) u[2] = std::numeric_limits<double>::quiet_NaN();
       });
     }},
};

TEUCHOS_UNIT_TEST(SolidAnswers, FailByTheCheckThatSeesWhatIsPlanted) {
  for (const Cell cell : {Cell::Hexahedron8, Cell::Tetrahedron4})
    for (std::size_t k = 0; k < plants.size(); ++k) {
      PressedBlocks answer(cell, kFrame, kOrigin);
      plants[k].second(answer);
      const Verification verdict = answer.verdict();
      const Check& found = check(verdict, plants[k].first);
      out << cellInfo(cell).name << " " << k << ": " << found.name << " " << found.value << " of " << found.bound << " at " << found.where
          << "\n";
      TEST_ASSERT(!verdict.holds());
      TEST_ASSERT(!found.holds());
      TEST_EQUALITY(std::count(found.where.begin(), found.where.end(), ','), found.where.find("pair") == 0 ? 4 : 3);  // three coordinates
    }
}

/// A rotation about any axis common to all bodies was taken out; then one node that did not rotate with its body, and a stretch.
TEUCHOS_UNIT_TEST(SolidAnswers, SeeAMotionTakenOutThatIsNotRigid) {
  const Point turn{0.2, -0.1, 0.3}, shift{1, 2, -3};
  for (const int planted : {0, 1, 2, 3, 4}) {
    PressedBlocks answer(Cell::Hexahedron8, kFrame, kOrigin);
    for (SubdomainMesh& mesh : answer.meshes) {
      mesh.lift.motion = solids::atNodes(mesh, [&](const Point& x) {
        Point motion = plus(shift, cross(turn, x));
        if (planted >= 2) motion[std::size_t(planted - 2)] += 1e-9 * x[std::size_t(planted - 2)];
        if (planted == 1 && mesh.body == 1 && norm(minus(x, plus(kFrame * Point{1, 1, 1}, kOrigin))) < 0.1) motion[2] += 1e-9;
        return motion;
      });
      for (const NodeRule& rule : mesh.rules) {
        mesh.lift.values.push_back(rule.value);
        for (int k = 0; k < 3; ++k)
          for (int c = 0; c < 3; ++c) mesh.lift.values.back()[k] += rule.axes[k][c] * mesh.lift.motion[3 * rule.node + c];
      }
      for (const ContactRow& row : mesh.contactRows) mesh.lift.gaps.emplace(row.pair.id, row.pair.gap);
    }
    const Verification verdict = answer.verdict();
    out << planted << ": " << verdict.failure() << "\n";
    TEST_EQUALITY(verdict.holds(), planted == 0);
    if (planted > 0) TEST_ASSERT(verdict.failure().find("prescribed") != std::string::npos);
  }
}

TEUCHOS_UNIT_TEST(Deformation, IsTheDeviationFromTheBestRigidMotionIn3D) {
  const Eigen::Matrix3d frame = solids::rotation({0.3, -1, 2}, 1.1);
  scenes::Scene scene = solids::turned(solids::fromBoxes({solids::cube(Cell::Hexahedron8, 4, 2)}, 1.0, 0.3), frame, {7, 8, 9});
  const std::vector<SubdomainMesh> meshes = solids::distributed(scene);
  const Point centre = plus(frame * Point{0.5, 0.5, 0.5}, {7, 8, 9}), turn{0.02, -0.05, 0.03};
  // Strains along the axes of the cube do not rotate it on average; its corners move most.
  const Point strain{1e-3, -2e-3, 5e-4};
  const auto displacement = solids::atNodes(meshes, [&](const Point& x) {
    const Point local = frame.transpose() * minus(x, centre);
    return plus(plus({0.1, 0.2, -0.3}, cross(turn, x)), frame * Point{strain[0] * local[0], strain[1] * local[1], strain[2] * local[2]});
  });
  const Deformation found = deformations(*solids::world(), meshes, displacement, 1)[0];
  TEST_FLOATING_EQUALITY(found.turn, norm(turn), 1e-12);
  TEST_FLOATING_EQUALITY(found.largest, 0.5 * norm(strain), 1e-11);
  TEST_FLOATING_EQUALITY(found.extent, 0.5 * std::sqrt(3.0), 1e-12);
  TEST_COMPARE(norm(minus(found.centre, centre)), <, 1e-12);
}

}  // namespace solidanswers
}  // namespace suture
