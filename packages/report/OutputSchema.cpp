#include <Teuchos_ParameterList.hpp>
#include <filesystem>
#include <suture/report/OutputSchema.hpp>
#include <suture/report/answers/Probes.hpp>
#include <suture/report/answers/Transmissions.hpp>

namespace suture {

Schema outputSchema() {
  return Schema("Files written by a run.")
      .text("Folder", "",
            "Output folder, relative to the current folder; created if missing. Empty: the name of the scene file with '_out'.")
      .boolean("Fields", true,
               "Write the fields (fields_0000.vtkhdf, contact_0000.vtkhdf); history.csv and summary.json are always written.")
      .boolean("Error Estimate", false,
               "Estimate the discretisation error in the energy norm from recovered stresses, per element (field ErrorEstimate, "
               "summary, console). Implied by an automatic tolerance.")
      .boolean("Error Bound", false,
               "Bound the error in the energy norm from above, without unknown constants, and give the contribution of each element (field "
               "ErrorBound, summary, console). Where that is not possible, the figure is an estimate, with the reason.")
      .boolean("Error Bars", false,
               "Estimate the errors of the forces of contacts and supports (force_error in the summary), from the estimate of the "
               "discretisation error, which it implies; mark extremes of stresses and pressures as estimate, or as singular where the "
               "exact value is unbounded.")
      .texts(
          "Strict Error Bars", std::vector<std::string>{},
          "Names of boundary conditions and contacts, or All: bounds between which the exact force of a support or contact lies, and for "
          "a load the mean displacement along it (force_low, force_high and others in the summary). Each takes two to six more solutions "
          "on the same mesh per component of the force. Implies Error Bars and Error Bound, and requires that the latter is strict.")
      .boolean("Mesh Error", true,
               "If there is no other estimate: estimate the discretisation error from averaged stresses, a rougher and cheaper method "
               "(summary, console). Warns above 25 %.")
      .boolean(
          "Nodal Stresses", false,
          "Recover the stresses at the nodes from those inside the elements (takes a tenth of the time of a large linear scene): fields "
          "NodalStress, NodalVonMises and NodalPrincipalStress, and the extremes in summary and console. On boundaries they are "
          "larger than the stresses at element centroids.")
      .oneOf("Stress Axes", "Global", {"Body", "Global"},
             "Axes of the components of stresses in fields and probes. Body: the axes of the drawn body, which turn with a body that moves "
             "far (Motion = Moving): stresses along a shaft or a tooth, wherever it is. Principal directions have global axes.")
      .boolean("Tables", true, "Write contact.csv, one row per pair, and reactions.csv, one row per condition and contact.")
      .boolean(
          "Checkpoint", false,
          "Write checkpoint.h5 also for a run that converged, so that the next load step can start from it (--restart). A run that did "
          "not converge always writes it.")
      .real("Checkpoint Every", 0.0,
            "Interval in minutes: the first outer iteration that ends after it writes checkpoint.h5, so that a killed run loses at most "
            "this time and the current iteration. Removed at the end of a run that converged. 0: never.",
            Range::atLeast(0), "min")
      .real("Displacements Since", 0.0,
            "One of Load Steps/Times: later steps also have the displacements since then (field DisplacementSince, summary, console), as "
            "those caused by an excavation without those of the in-situ state. 0: none.",
            Range::atLeast(0))
      .wordOrNumber("Enlargement", "Automatic", {"Automatic"}, Range::positive(),
                    "Factor by which suture_plot enlarges the displacements; Automatic: to about a twentieth of the model size, "
                    "at most such that no gap or hole closes in the picture; with Motion = Moving 1.")
      .list("Probes", Schema("Tables of values at points, along lines and on groups, named by the user.").each("<probe>", probeSchema()))
      .list("Transmissions", Schema("Tables of how one rigid group follows another, named by the user; needs Load Steps.")
                                 .each("<transmission>", transmissionSchema()));
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
