"""Sections of the report on the run: convergence, verdict, error, cost, provenance."""
import shlex

from .html import esc, number, table
from .report_accuracy import bound_of, bound_rows, bound_sentence

# Checks of the verdict in words, and the scale of their values.
CHECKS = {
    "forces": ("Forces on each body balance", "force through the body"),
    "moments": ("Moments on each body balance", "force through the body times its extent"),
    "residual": ("Nodal forces balance, summed over each body", "force through the body"),
    "nodes": ("Displacement that the imbalance of a node would cause", "deformation of the body"),
    "contact": ("Nodes in contact balance", "largest contact force of the body"),
    "prescribed": ("Prescribed displacements are met", "deformation of the body"),
    "seams": ("Displacements of subdomains agree on the interface", "deformation of the body"),
    "penetration": ("No body penetrates another", "force through the body, over its stiffness"),
    "tension": ("No contact is in tension", "force through the body"),
    "complementarity": ("Each pair has a force or a gap, not both", "force through the body"),
    "status": ("Open pairs carry no force, closed pairs have no gap", "force through the body"),
    "digits": ("Double precision is sufficient", "force through the body"),
    "rotation": ("Rotations of bodies that nothing holds stay small", "radian"),
    "friction": ("Tangential forces stay within their bounds; slipping pairs reach the bound, along the slip", "force through the body"),
    "slip": ("Pairs that stick or are glued do not slip", "force through the body, over its stiffness"),
    "dissipation": ("Friction forces never drive the slip", "force through the body"),
    "slide": ("Sides still face their partners in the mesh", "edge of an element"),
    "offset": ("Contact forces act at one point, not across a gap", "force through the body times its size"),
    "work": ("External work is stored or absorbed by contacts", "external work"),
    "controlled_loads": ("Controlled loads reach their targets", "target"),
}
ERRORS = {
    "estimated_energy_norm": "discretisation, estimated from recovered stresses, energy norm",
    "algebraic_energy_norm": "algebraic, energy norm",
    "energy_norm": "discretisation, against the exact solution, energy norm",
    "displacement_l2": "displacement, against the exact solution, L2",
    "pressure_l2": "contact pressure, against the exact solution, L2",
}


def convergence(run):
    outer, auxiliary = run.summary["outer"], run.summary.get("auxiliary", {})
    rows = []
    if auxiliary.get("iterations"):
        rows.append(("auxiliary problem: PCG iterations, condition", f"{number(auxiliary['iterations'])}, {number(auxiliary.get('condition'))}"))
    if outer.get("solver"):
        rows += [("outer solver", esc(outer["solver"])), ("outer iterations", number(outer.get("iterations"))),
                 ("total PCG iterations", number(outer.get("pcg_total")))]
        if outer.get("condition"):
            rows.append(("largest condition number", number(outer["condition"])))
    rows += [("final relative residual", number(outer.get("residual"), form=".2e")),
             ("tolerance", esc(run.parameter("Outer Solver", "Tolerance", default="")))]
    return table(("", ""), rows)


def load_steps(run):
    found = run.summary["load_steps"]
    given_up = sum(row.get("given_up") or 0 for row in found.get("steps") or [])
    work = found.get("work") or {}
    force, length = run.force_unit, run.length_unit
    rows = [("load steps", number(found.get("count"))), ("time at the end of the last step", number(found.get("time"))),
            ("rejected trials, too long", number(given_up))]
    rows += [(f"{words} [{esc(force)} {esc(length)}]", number(work[key])) for key, words in (
        ("external", "external work"), ("stored", "stored energy"), ("dissipated", "work dissipated by friction")) if key in work]
    if "step_error" in work:
        rows.append(("step size error, relative to the works of loads and motions", number(work["step_error"], form=".3g")))
    return table(("", ""), rows, numeric=(1,))


def verdict(run):
    checks = run.summary.get("verification")
    if not checks:
        return '<p class="soft">Not verified: the run ended earlier.</p>\n'
    rows = []
    for name, check in checks.items():
        value, bound = check.get("value"), check.get("bound")
        holds = value is not None and bound is not None and value <= bound
        words, relative = CHECKS.get(name, (name, ""))
        rows.append((esc(name), esc(words), number(value, form=".2e"), number(bound, form=".2e"), esc(relative),
                     f'<span class="{"holds" if holds else "fails"}">{"holds" if holds else "FAILS"}</span>', esc(check.get("where", "")) or "everywhere"))
    said = run.summary.get("verified")
    return ("<p>An independent computation, which shares no operator with the solver, verifies the solution: " +
            ("<strong class=\"holds\">all checks hold</strong>" if said else "<strong class=\"fails\">NOT VERIFIED</strong>") + ".</p>\n" +
            table(("check", "meaning", "value", "bound", "relative to", "", "largest at"), rows, numeric=(2, 3), long=(6,), key="checks"))


def error(run):
    found = run.summary.get("error", {})
    rows = bound_rows(run)
    for name, words in ERRORS.items():
        if name in found:
            relative = found.get(name + "_relative")
            rows.append((esc(words), number(found[name]), "" if relative is None else number(relative, form=".3g")))
    if "averaged_energy_norm_relative" in found:
        rows.append(("discretisation, estimated from averaged stresses, energy norm", "", number(found["averaged_energy_norm_relative"], form=".3g")))
    if "effectivity" in found:
        rows.append(("estimated over exact (effectivity)", number(found["effectivity"]), ""))
    facets = [(esc(name), number(piece["pressure_error_estimate"], form=".3g")) for name, piece in run.summary["contact"].get("by_piece", {}).items()
              if (piece.get("pressure_error_estimate") or 0.0) > 1e-6]
    markup = table(("error", "value", "relative"), rows, numeric=(1, 2)) if rows else ""
    if facets:
        markup += table(("piece of contact", "relative"), facets, numeric=(1,), long=(0,),
                        caption="Estimated error of the pressure due to straight elements on curved sides, relative to its largest value.")
    said = bound_sentence(run)
    markup += f'<p id="bound_sentence">{esc(said)}</p>\n' if said else ""
    if "estimated_energy_norm" not in found and not bound_of(run):
        markup += ("<p>For a better estimate use <code>--set \"Output/Error Estimate=true\"</code>, or run again with half the mesh size and compare the "
                   "stresses.</p>\n")
    return markup


def cost(run):
    phases = run.summary["phases"]
    most = max((phase.get("max") or 0.0 for phase in phases.values()), default=0.0) or 1.0
    rows = []
    for name, phase in phases.items():
        width = 100.0 * (phase.get("max") or 0.0) / most
        rows.append((esc(name), *(number(phase.get(key), form=".3g") for key in ("min", "avg", "max")), f'<span class="bar" style="width: {width:.1f}%"></span>'))
    whole = run.summary.get("seconds")
    if whole is not None:
        rows.append(("<strong>total</strong>", "", "", number(whole, form=".3g"), ""))
    markup = ('<div class="wide"><table><caption>Seconds by phase, over all ranks.</caption><thead><tr><th>phase</th><th class="n">least</th>'
              '<th class="n">mean</th><th class="n">largest</th><th></th></tr></thead><tbody>\n' +
              "".join(f'<tr><td>{a}</td><td class="n">{b}</td><td class="n">{c}</td><td class="n">{d}</td><td class="bars">{e}</td></tr>\n'
                      for a, b, c, d, e in rows) + "</tbody></table></div>\n")
    summary = run.summary
    facts = [("ranks", number(summary.get("ranks"))), ("subdomains", number(summary.get("subdomains"))), ("unknowns", number(summary.get("dofs"))),
             ("unknowns on the interface", number(summary.get("interface_dofs")))]
    for key, words in (("peak_memory_mb", "peak memory, largest rank [MB]"), ("solver_data_mb", "data read per PCG iteration, largest rank [MB]")):
        if summary.get(key, {}).get("max") is not None:
            facts.append((words, number(summary[key]["max"], form=".3g")))
    if summary.get("preconditioner", {}).get("coarse_size") is not None:
        facts.append(("coarse unknowns", number(summary["preconditioner"]["coarse_size"])))
    seconds = summary.get("auxiliary", {}).get("iteration_seconds")
    if seconds is not None:
        facts.append(("seconds per PCG iteration", number(seconds, form=".3g")))
    return markup + table(("", ""), facts, numeric=(1,))


def provenance(run):
    summary = run.summary
    versions = dict(summary["versions"])
    rows = [("Command", f"<code>{esc(shlex.join(summary.get('command_line', [])))}</code>"), ("Scene", esc(summary.get("scene", ""))),
            ("Folder", esc(run.folder.resolve())), ("Written", f"{run.written:%Y-%m-%d %H:%M:%S} (time of summary.json)"),
            ("Suture", f"{esc(versions.pop('suture', ''))}, commit {esc(versions.pop('commit', ''))}"), ("Mesh hash", esc(summary.get("mesh_hash", ""))),
            ("Ranks", number(summary.get("ranks"))), ("Libraries", esc(", ".join(f"{name} {version}" for name, version in sorted(versions.items()))))]
    markup = table(("", ""), [(f"<strong>{name}</strong>", cell) for name, cell in rows], long=(1,))
    if run.fields is not None and run.fields.scene:
        markup += f"<details><summary>The scene file</summary><pre>{esc(run.fields.scene)}</pre></details>\n"
    return markup
