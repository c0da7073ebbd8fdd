#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <suture/answer/error/PressureOscillation.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Version.hpp>
#include <suture/report/Figures.hpp>
#include <suture/report/OutputFolder.hpp>
#include <suture/report/ParametersJson.hpp>
#include <suture/report/RunRecord.hpp>
#include <suture/report/Summary.hpp>
#include <suture/report/answers/Answers.hpp>
#include <suture/report/answers/Transmissions.hpp>

using Json = nlohmann::ordered_json;

namespace suture {
namespace {

// Version of the columns of all tables; summary.json and doc/schema list it per table.
constexpr int kTableVersion = 1;

Json components(const Point& vector, int dimension) {
  Json all = Json::array();
  for (int k = 0; k < dimension; ++k) all.push_back(vector[std::size_t(k)]);
  return all;
}

std::string textOf(const Parameters& list, const std::string& name) {
  return list.isType<std::string>(name) ? list.get<std::string>(name) : std::string();
}

Json known(double value) { return value < 0.0 ? Json() : Json(value); }

Json auxiliary(const AuxiliaryRow& row) {
  return {{"iterations", row.pcg},
          {"condition", row.condition},
          {"tolerance", row.tolerance},
          {"residual", row.residual},
          {"algebraic_error", known(row.energyError)},
          {"iteration_seconds", known(row.iterationSeconds)},
          {"contact", row.contact}};
}

// Errors against the exact solution, if there is one, and estimated errors in the energy norm.
Json errors(const Solution& answer) {
  Json all = Json::object();
  for (const auto& [name, value] : answer.errors) all[name] = value;
  const auto& estimate = answer.discretisation;
  if (estimate) {
    all["estimated_energy_norm"] = estimate->energyNorm;
    all["estimated_energy_norm_relative"] = estimate->relative();
  }
  if (answer.meshError) all["averaged_energy_norm_relative"] = *answer.meshError;
  if (answer.energyError >= 0.0) {
    all["algebraic_energy_norm"] = answer.energyError;
    if (estimate && estimate->solutionNorm > 0.0) all["algebraic_energy_norm_relative"] = answer.energyError / estimate->solutionNorm;
  }
  if (estimate && all.contains("energy_norm")) all["effectivity"] = estimate->energyNorm / all["energy_norm"].get<double>();
  return all;
}

// Bound of the error in the energy norm; the figures are missing where nothing could be computed.
Json bound(const ErrorBound& of, const AccuracyReached* accuracy) {
  Json all = {{"strict", of.strict}, {"reasons", of.reasons}};
  if (!of.exists) return all;
  all["total"] = of.total;
  all["relative"] = of.relative();
  all["discretisation"] = of.discretisation;
  all["algebraic"] = of.algebraic;
  all["oscillation"] = of.oscillation;
  if (accuracy && accuracy->geometry) all["geometry"] = *accuracy->geometry * of.solutionNorm;
  all["energy_lower"] = of.energyLower;
  all["energy_upper"] = of.energyUpper;
  all["imbalance"] = of.imbalance;
  return all;
}

Json outer(const Solution& answer, const std::vector<OuterRow>& rows) {
  double condition = 0.0;
  for (const OuterRow& row : rows) condition = std::max(condition, row.condition);
  return {{"solver", answer.outerSolver}, {"iterations", answer.iterations},
          {"pcg_total", answer.pcgTotal}, {"other_applications", answer.otherApplications},
          {"condition", condition},       {"residual", answer.residual},
          {"estimates", answer.estimates}};
}

Json friction(const FrictionFigures& of, int dimension) {
  return {{"sticking", of.sticking},
          {"slipping", of.slipping},
          {"max_mobilisation", of.maxMobilisation},
          {"mean_mobilisation", of.meanMobilisation()},
          {"dissipated_work", of.dissipated},
          {"tangential_force", components(of.onB, dimension)}};
}

Json contact(const Run& run, int dimension) {
  const ContactFigures all = contactFigures(run.solution, run.size.pieces);
  Json contact = {
      {"pieces", run.size.pieces},       {"pairs", all.pairs},      {"active", all.active},  {"touching_without_force", all.touching},
      {"max_pressure", all.maxPressure}, {"force", Json::object()}, {"max_gap", all.maxGap}, {"max_penetration", all.maxPenetration},
      {"by_piece", Json::object()}};
  const std::vector<double> oscillations = pressureOscillations(run.solution.pairs, run.pieces);
  for (std::size_t p = 0; p < run.pieces.size() && p < all.forceOnB.size(); ++p) {
    contact["force"][run.pieces[p].name] = components(all.forceOnB[p], dimension);
    contact["by_piece"][run.pieces[p].name] = {{"pairs", all.pairsOf[p]},
                                               {"active", all.activeOf[p]},
                                               {"max_pressure", all.pressureOf[p]},
                                               {"max_gap", all.gapOf[p]},
                                               {"pressure_error_estimate", pressureError(run.pieces[p], all.pressureOf[p])},
                                               {"pressure_oscillation", all.pressureOf[p] > 0 ? oscillations[p] / all.pressureOf[p] : 0.0}};
    if (all.frictionOf[p].pairs > 0) contact["by_piece"][run.pieces[p].name]["friction"] = friction(all.frictionOf[p], dimension);
  }
  if (all.friction.pairs > 0) contact["friction"] = friction(all.friction, dimension);
  return contact;
}

Json neutralMotions(const std::vector<NeutralMotion>& motions) {
  Json all = Json::array();
  for (const NeutralMotion& motion : motions)
    all.push_back({{"body", motion.body}, {"motion", motion.words}, {"loaded", motion.loaded}, {"both_senses", motion.bothSenses}});
  return all;
}

Json sharedForces(const std::vector<UndeterminedForces>& forces) {
  Json all = Json::array();
  for (const UndeterminedForces& one : forces)
    all.push_back({{"contacts", one.contacts}, {"pairs", one.pairs}, {"determined_totals", one.totals}});
  return all;
}

Json verification(const Verification& verdict) {
  Json all = Json::object();
  for (const Check& check : verdict.checks) all[check.name] = {{"value", check.value}, {"bound", check.bound}, {"where", check.where}};
  return all;
}

Json accuracy(const AccuracyReached& reached) {
  Json levels = Json::array();
  for (const AccuracyLevel& level : reached.levels) {
    levels.push_back({{"unknowns", level.unknowns},
                      {"elements", level.elements},
                      {"error", level.error},
                      {"strict", level.strict},
                      {"seconds", level.seconds},
                      {"iterations", level.iterations},
                      {"outer", level.outer},
                      {"energy", level.energy},
                      {"refinement", level.refinement}});
    if (level.estimate) levels.back()["estimate"] = *level.estimate;
    if (level.value) levels.back()["value"] = *level.value;
    if (level.energyError) levels.back()["energy_error"] = *level.energyError;
    if (level.geometry) levels.back()["geometry"] = *level.geometry;
  }
  Json all = {{"requested", reached.requested}, {"quantity", reached.quantity}, {"reached", reached.reached},
              {"strict", reached.strict},       {"limit", reached.limit},       {"levels", levels}};
  if (reached.geometry) all["geometry"] = *reached.geometry;
  if (reached.uniform)
    all["uniform"] = {{"order", reached.uniform->order}, {"unknowns", reached.uniform->unknowns}, {"seconds", reached.uniform->seconds}};
  return all;
}

Json loadSteps(const Run& run, int dimension) {
  const std::vector<StepRow>& steps = run.steps;
  const auto forces = [&](const StepRow& row) {
    Json all = Json::object();
    for (std::size_t line = 0; line < row.forceOnB.size(); ++line)
      all[run.contactsOfPath.at(line)] = components(row.forceOnB[line], dimension);
    return all;
  };
  Json rows = Json::array();
  for (const StepRow& row : steps)
    rows.push_back({{"step", row.step},
                    {"time", row.time},
                    {"length", row.length},
                    {"outer", row.outer},
                    {"pcg", row.pcg},
                    {"given_up", row.givenUp},
                    {"active", row.active},
                    {"sticking", row.sticking},
                    {"slipping", row.slipping},
                    {"changed", row.changed},
                    {"residual", row.residual},
                    {"energy", row.energy},
                    {"dissipated_work", row.work.dissipated},
                    {"contact_force", forces(row)}});
  const PathWork& work = steps.back().work;
  return {{"count", steps.size()},
          {"time", steps.back().time},
          {"work",
           {{"external", work.external},
            {"stored", work.stored},
            {"normal", work.normal},
            {"tangential", work.tangential},
            {"dissipated", work.dissipated},
            {"imbalance", work.imbalance()},
            {"step_error", work.stepError()}}},
          {"steps", rows}};
}

}  // namespace

std::string summaryText(const Run& run, const RunFigures& figures, ExitCode code) {
  const int dimension = dimensionOf(run);
  const Memory& memory = figures.memory;
  const Memory read = memoryFigures(run.comm, run.solution.bytesRead / (1 << 20));
  const ElementsByRank elements = elementsByRank(run);
  std::string text;

  collectivelyOnRoot(run.comm, "making summary.json", [&] {
    const Solution& answer = run.solution;
    const Parameters& parameters = *run.scene.parameters;
    Json phases = Json::object();
    for (const Timers::Statistics& phase : figures.phases)
      phases[phase.phase] = {{"min", phase.min}, {"avg", phase.avg}, {"max", phase.max}};
    Json versions = {{"suture", version()}, {"commit", commit()}};
    for (const auto& [library, number] : libraryVersions()) versions[library] = number;

    Json tables = Json::object();
    for (const char* table : {"history", "steps", "contact", "reactions", "probe"}) tables[table] = kTableVersion;
    Json summary = {
        {"format", {{"name", RunRecord::kName}, {"version", RunRecord::kVersion}, {"tables", tables}}},
        {"title", textOf(parameters, "Title")},
        {"scene", run.scene.path},
        {"units", textOf(parameters, "Units")},
        {"converged", answer.converged},
        {"exit_code", int(code)},
        {"failure", answer.failure},
        {"dimension", dimension},
        {"dofs", run.size.dofs},
        {"nodes", run.size.nodes},
        {"elements", run.size.elements},
        {"subdomains", run.size.subdomains},
        {"groups", run.size.groups},
        {"ranks", run.comm.getSize()},
        {"elements_by_rank", {{"min", elements.least}, {"max", elements.most}, {"imbalance", elements.imbalance()}}},
        {"interface_dofs", run.size.interfaceDofs},
        {"auxiliary", auxiliary(answer.auxiliary)},
        {"outer", outer(answer, run.monitor.rows())},
        {"preconditioner",
         {{"coarse_size", answer.coarseSize},
          {"setup_seconds", answer.setupSeconds},
          {"lowest_eigenvalue", known(answer.lowestEigenvalue)}}},
        {"contact", contact(run, dimension)},
        {"neutral_motions", neutralMotions(answer.neutral)},
        {"undetermined_forces", sharedForces(answer.sharedForces)},
        {"energy", answer.energy},
        {"max_displacement", figures.largestDisplacement},
        {"equilibrium",
         {{"applied", components(answer.verification.balance.applied, dimension)},
          {"reactions", components(answer.verification.balance.reactions, dimension)},
          {"imbalance", answer.verification.balance.imbalance}}},
        {"extremes", extremesJson(run, dimension)},
        {"reactions", reactionsJson(run, dimension)},
        {"verified", answer.verification.holds()},
        {"verification", verification(answer.verification)},
        {"error", errors(answer)},
        {"notes", run.monitor.notes()},
        {"phases", phases},
        {"seconds", run.timers.total()},
        {"solver_data_mb", {{"min", read.min}, {"avg", read.avg}, {"max", read.max}, {"sum", read.sum}}},
        {"schur_complements", answer.chosenSchur},
        {"peak_memory_mb", {{"min", memory.min}, {"avg", memory.avg}, {"max", memory.max}, {"sum", memory.sum}}},
        {"mesh_hash", run.meshHash},
        {"command_line", run.invocation.commandLine},
        {"record", recordJson(run.scene, run.invocation)},
        {"versions", versions},
        {"parameters", toJson(parameters)},
    };
    if (!answer.rigidGroups.empty()) summary["rigid_groups"] = rigidGroupsJson(run, dimension);
    if (!answer.safety.ofBodies.empty()) summary["safety"] = safetyJson(run, dimension);
    if (run.accuracy) summary["accuracy"] = accuracy(*run.accuracy);
    if (answer.bound) summary["bound"] = bound(*answer.bound, run.accuracy ? &*run.accuracy : nullptr);
    if (!run.steps.empty()) summary["load_steps"] = loadSteps(run, dimension);
    const std::vector<Transmission> transmissions = readTransmissions(parameters);
    if (!transmissions.empty()) summary["transmissions"] = transmissionsJson(run.steps, transmissions);
    // Text that is not UTF-8 (a title in Latin-1) must not make the results unwritable.
    text = summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  });
  return text;
}

std::string writeSummary(const Run& run, const RunFigures& figures, ExitCode code, const std::string& path) {
  const std::string text = summaryText(run, figures, code);
  collectivelyOnRoot(run.comm, "writing summary.json", [&] { writeTextFile(path, text); });
  return text;
}

}  // namespace suture
