"""The accuracy of a run: bound of the energy error in a sentence and as rows, the meshes of an adaptive run as a table."""
import math

from .accuracy import ORDERS, Levels, has_levels, is_energy, per_cent, rough, rounded_up, seconds_in_words
from .html import esc, number, table

LIMITS = {"unknowns": "the run ended at its largest number of unknowns", "memory": "the next mesh does not fit into the memory",
          "time": "the run ended at its time limit", "levels": "the run ended at its largest number of meshes", "mesh": "the mesh cannot be refined further", "solution": "the next mesh has no valid solution",
          "quantity": "the exact value is infinite or zero"}
PARTS = (("total", "total, energy norm"), ("discretisation", "\u2003of it: mesh"), ("algebraic", "\u2003of it: solver"),
         ("oscillation", "\u2003of it: oscillation of loads"))


def bound_of(run):
    return run.summary.get("bound") or {}


def at_most(bound):
    """The relative error of a bound in words."""
    relative = bound["relative"]
    if relative < 1e-6:
        return "below 0.0001 %"  # round-off
    return f"at most {per_cent(rounded_up(relative))}" if bound.get("strict") else f"about {per_cent(relative)}"


def bound_sentence(run):
    """The bound of the error, or the estimate with its reasons; "" for a run without."""
    bound = bound_of(run)
    if bound.get("relative") is None:
        return ""
    if bound.get("strict"):
        return f"The error is {at_most(bound)} of the energy norm: a strict upper bound, without unknown constants."
    reasons = "; ".join(bound.get("reasons") or [])
    return f"The error is {at_most(bound)} of the energy norm: an estimate, not a strict bound{f', because: {reasons}' if reasons else ''}."


def bound_rows(run):
    """[(words, value, relative)] of the bound, and of the energy that it brackets."""
    bound = bound_of(run)
    kind = "strict bound" if bound.get("strict") else "estimate"
    rows = [(esc(f"{words}: {kind}" if key == "total" else words), number(bound[key]),
             number(bound["relative"], form=".3g") if key == "total" and bound.get("relative") is not None else "")
            for key, words in PARTS if bound.get(key) is not None]
    if bound.get("strict") and bound.get("energy_lower") is not None and bound.get("energy_upper") is not None:
        lower, upper = bound["energy_lower"], bound["energy_upper"]
        # So many digits that the two differ.
        apart = (upper - lower) / max(abs(lower), abs(upper)) if upper > lower else 1.0
        form = f".{min(max(6, 2 - math.floor(math.log10(apart))), 15)}g"
        rows.append((esc("exact energy lies between"), f"{number(lower, form=form)} and {number(upper, form=form)}", ""))
    return rows


def quantity_in_words(accuracy):
    return "energy error" if is_energy(accuracy) else f"error of {accuracy['quantity']}"


def accuracy_sentence(run):
    """What an adaptive run has reached, with which effort, and what uniform refinement would have cost."""
    accuracy, levels = run.summary["accuracy"], Levels(run.summary["accuracy"])
    reached, requested, limit = (accuracy.get(key) for key in ("reached", "requested", "limit"))
    words = quantity_in_words(accuracy)
    if reached is None:
        said = f"The {words} is not known."
    else:
        size = f"at most {per_cent(rounded_up(reached))}" if accuracy.get("strict") else f"about {per_cent(reached)} (an estimate)"
        meshes = f"the last of {len(levels.unknowns)} meshes" if len(levels.unknowns) > 1 else "the first mesh"
        said = (f"The {words} is {size}, reached with {levels.unknowns[-1]:,.0f} unknowns on {meshes}, in {seconds_in_words(levels.spent[-1])}"
                f"{' altogether' if len(levels.unknowns) > 1 else ''}.")
    if limit and requested is not None:
        said += f" The requested {per_cent(requested, 3)} was not reached: {LIMITS.get(limit, f'limit: {limit}')}."
    if levels.uniform_unknowns and levels.uniform_seconds:
        order = f" of {ORDERS[levels.order]} order" if levels.order in ORDERS else ""
        said += (f" A uniform mesh{order} would need about {rough(levels.uniform_unknowns)} unknowns and "
                 f"{seconds_in_words(levels.uniform_seconds)} for the same error (predicted).")
    return said


def levels_table(run):
    accuracy = run.summary["accuracy"]
    levels = accuracy["levels"]
    has_estimate, has_value = (any(level.get(key) is not None for level in levels) for key in ("estimate", "value"))
    rows = []
    for place, level in enumerate(levels):
        row = [number(place + 1), esc(level.get("refinement", "")), number(level.get("elements")), number(level.get("unknowns"))]
        row += [number(level.get("value"), form=".6g")] * has_value
        row += [number(level.get("error"), form=".3g"), "strict bound" if level.get("strict") else "estimate"]
        row += [number(level.get("energy_error"), form=".3g")] * has_value + [number(level.get("estimate"), form=".3g")] * has_estimate
        rows.append((*row, number(level.get("outer")), number(level.get("iterations")), number(level.get("seconds"), form=".3g")))
    head = ["mesh", "made by", "elements", "unknowns", *["value"] * has_value, "error, relative", "", *["energy error"] * has_value,
            *["from recovered stresses"] * has_estimate, "outer iterations", "PCG", "seconds"]
    kind = "in the energy norm, relative to the solution" if is_energy(accuracy) else f"of {accuracy['quantity']}"
    numeric = tuple(place for place, name in enumerate(head) if place not in (1, head.index("")))
    return table(tuple(head), rows, numeric=numeric, long=(1,), key="levels",
                 caption=f"Error {kind}. Seconds: mesh, solution and bound of one level.")


def accuracy_section(run, picture):
    """Sentence, picture and table of an adaptive run. `picture`: markup"""
    return f'<p id="accuracy_sentence">{esc(accuracy_sentence(run))}</p>\n{picture}{levels_table(run)}'


