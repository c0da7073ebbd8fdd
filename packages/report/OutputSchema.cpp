#include <Teuchos_ParameterList.hpp>
#include <filesystem>
#include <suture/report/OutputSchema.hpp>
#include <suture/report/answers/Probes.hpp>

namespace suture {

Schema outputSchema() {
  return Schema("Files that a run writes.")
      .text("Folder", "", "Output folder, made if missing, relative to the current folder. Empty: the name of the scene file with '_out'.")
      .boolean("Fields", true,
               "Write the fields (fields_0000.vtkhdf, contact_0000.vtkhdf); history.csv and summary.json are always written.")
      .boolean("Error Estimate", false,
               "Estimate the discretisation error in the energy norm from recovered stresses, element by element (field ErrorEstimate; "
               "summary, console). An automatic tolerance does so anyway.")
      .boolean("Mesh Error", true,
               "Where no other estimate is made: estimate the discretisation error from averaged stresses, rougher and cheaper (summary, "
               "console); a warning above 25 %.")
      .boolean("Nodal Stresses", false,
               "Recover the stresses at the nodes from those inside the elements (a tenth of the time of a large linear scene): fields "
               "NodalStress, NodalVonMises and NodalPrincipalStress, and the extremes of summary and console, which on boundaries are "
               "larger than those at the elements' centroids.")
      .boolean("Tables", true, "Write contact.csv, a row a pair, and reactions.csv, a row a condition and contact.")
      .boolean("Checkpoint", false,
               "Write checkpoint.h5 of a run that converged, too: the next load step starts from it (--restart). One that did not always "
               "leaves it.")
      .real("Checkpoint Every", 0.0,
            "Minutes after which an outer iteration that has ended writes checkpoint.h5, so that a run that is killed loses at most that "
            "(and the iteration in hand); removed at the end of a run that converged. 0: never.",
            Range::atLeast(0), "min")
      .wordOrNumber("Enlargement", "Automatic", {"Automatic"}, Range::positive(),
                    "How many times suture_plot enlarges the displacements; Automatic: to about a twentieth of the scene's size.")
      .list("Probes",
            Schema("Tables of values at points, along lines and along groups, named by the user.").each("<probe>", probeSchema()));
}

std::string outputFolder(const SceneFile& scene) {
  const Parameters& all = *scene.parameters;
  if (all.isSublist("Output")) {
    const Parameters& output = all.sublist("Output");
    if (output.isType<std::string>("Folder")) {
      const std::string folder = output.get<std::string>("Folder");
      if (!folder.empty()) return folder;
    }
  }
  return std::filesystem::path(scene.path).stem().string() + "_out";
}

}  // namespace suture
