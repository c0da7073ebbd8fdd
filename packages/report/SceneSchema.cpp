#include <suture/base/Expression.hpp>
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/constraints/LoadSteps.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/materials/MaterialFiles.hpp>
#include <suture/partition/Partition.hpp>
#include <suture/reader/MeshReader.hpp>
#include <suture/report/AccuracyRequest.hpp>
#include <suture/report/OutputSchema.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/solver/SolverSchema.hpp>
#include <suture/subdomain/Subdomain.hpp>

namespace suture {

namespace {

/// Texts above the report of suture_plot. No program computes with them: they are recorded in `parameters` of summary.json.
Schema headerSchema() {
  return Schema("Texts for the header of the report that suture_plot writes; empty: left out.")
      .text("Project", "", "Name or number of the project, or the customer.")
      .text("Author", "", "Person who answers for the computation.")
      .text("Revision", "", "Revision of the design or of the computation.")
      .text("Date", "", "Date of the report, as it is to be printed.");
}

/// \param inFile  mesh and bodies are required, materials come also from files
Schema schemaOf(bool inFile) {
  const int least = inFile ? 1 : 0;
  Schema scene("A scene: elastic bodies in equilibrium, in unilateral contact with each other.");
  scene.text("Title", "", "Printed and plotted; empty: the name of the file.");
  scene.text(
      "Units", "m, N, Pa",
      "Names of the units of length, force and stress: recorded and printed. The numbers of the scene are never converted; materials of "
      "other files are converted to these units.");
  addModelParameters(scene);
  scene.oneOf(
      "Motion", "Small", {"Moving", "Small"},
      "Small: contact pairs are those of the drawn bodies, displacements are small. Moving: with Load Steps, bodies slide and turn far "
      "while their strains stay small; each step finds its pairs between the present shapes. A Rigid Group drives a body or is its "
      "hinge.");
  scene.list("Constants", constantsSchema());
  scene.list("Functions", functionsSchema());
  scene.list("Mesh", meshSchema(), inFile);
  Schema body = bodySchema();
  body.oneOf("Motion", "Scene", {"Scene", "Small"},
             "Scene: the Motion of the scene. Small: in a scene with Motion = Moving, a body that stays near its drawn place, as in other "
             "scenes; it may have elastic supports, anisotropic materials and initial stresses.");
  body.choice("Subdomain", "Elastic", Registry<Subdomain>::instance().schemas(), "The physics of the body's subdomains.");
  scene.list("Bodies", Schema("The elastic bodies, each named like its element group in the mesh.").each("<body>", body, least), inFile);
  scene.list("Materials", Schema("Materials, named by the user. Further ones come from Material Files and the built-in file.")
                              .each("<material>", materialSchema()));
  if (inFile) {
    addMaterialFilesParameter(scene);
    scene.completedBy(materialFiles());
  }
  scene.list("Boundary Conditions",
             Schema("Loads and supports, named by the user; a node may have several.").each("<condition>", boundaryConditionSchema()));
  scene.list("Load Steps", LoadSteps::schema());
  scene.list("Contact", Schema("Contact lines, named by the user.").each("<line>", contactSchema()));
  scene.list("Exact Solution", exactSolutionSchema());
  scene.list("Partition", partitionSchema());
  addSolverParameters(scene);
  scene.list("Accuracy", AccuracyRequest::schema());
  scene.list("Output", outputSchema());
  scene.list("Report", headerSchema());
  return scene;
}

}  // namespace

Schema sceneSchema() { return schemaOf(true); }
Schema settingsSchema() { return schemaOf(false); }

}  // namespace suture
