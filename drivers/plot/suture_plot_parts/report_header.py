"""The top of the report: title, fields of the scene, verdict, warnings, and the error in a sentence."""
import re

from .html import esc, number
from .report_accuracy import accuracy_sentence, bound_sentence, has_levels
from .report_run import CHECKS

EXIT = {0: "done", 2: "command line", 3: "input", 4: "numerical", 5: "environment", 70: "internal", 75: "stopped on request"}
FIELDS = ("Project", "Author", "Revision", "Date")
# Notes of a run that report how it was solved. All others may limit what its answers are good for.
ON_THE_SOLUTION = re.compile(r"^t = [^:]*: '|Schur complements|nested start|continues at|; mortar, carried by|is solved exactly, without a further level|relaxation halved|"
                             r"\(\d+ solutions\)$|primal constraints")
MOST_WARNINGS = 8  # that are shown at once


def sentence(text):
    text = text.replace("warning: ", "", 1) if text.startswith("warning: ") else text
    return text[:1].upper() + text[1:] + ("" if text.endswith((".", "!", "?")) else ".")


def split_notes(run):
    """(warnings, notes on the solution) of the run."""
    notes = run.summary.get("notes", [])
    return ([note for note in notes if not ON_THE_SOLUTION.search(note)], [note for note in notes if ON_THE_SOLUTION.search(note)])


def head(run):
    """Title and fields of the header."""
    given = run.parameter("Report", default={})
    fields = [(name, esc(given[name])) for name in FIELDS if given.get(name)]
    fields += [("Computed", f"{run.written:%Y-%m-%d %H:%M}"), ("Program", f"Suture {esc(run.summary['versions'].get('suture', ''))}"),
               ("Model", esc(run.model.lower() if run.model != "Solid" else "3D")), ("Units", esc(run.summary.get("units", "")))]
    listed = "".join(f"<div><dt>{name}</dt><dd>{value}</dd></div>" for name, value in fields)
    return f'<h1>{esc(run.title)}</h1>\n<dl class="fields" id="fields">{listed}</dl>\n'


def banner(run):
    """The verdict in a sentence; for a failed run, why it has no answers."""
    code = run.summary["exit_code"]
    title, words = sentence(run.verdict).rstrip("."), []
    if run.coarse:
        title = "Valid, but the requested accuracy was not reached"
        words += [esc(accuracy_sentence(run)), checked(run), f"Exit code {number(code)} ({EXIT[code]})."]
    elif run.good:
        words.append(checked(run))
    else:
        title += ": this run has no valid result"
        if run.summary.get("failure"):
            words.append(esc(sentence(run.summary["failure"])))
        words.append(f"Exit code {number(code)} ({EXIT.get(code, 'unknown')}). All plots and numbers below refer to this state of the run; do not use them "
                     "as a result.")
    if run.step is not None:
        words.append(f"Plots of fields show {esc(run.words_of_step)}; the numbers are from the last step.")
    return f'<div class="verdict{" coarse" if run.coarse else "" if run.good else " bad"}" id="banner"><strong>{esc(title)}</strong>{" ".join(words)}</div>\n'


def checked(run):
    """How closely the independent checks hold."""
    checks = {name: check for name, check in (run.summary.get("verification") or {}).items()
              if check.get("value") is not None and (check.get("bound") or 0.0) > 0.0}
    if not run.summary.get("verified") or not checks:
        return "The iterations converged; the solution was not verified independently."
    nearest = max(checks, key=lambda name: checks[name]["value"] / checks[name]["bound"])
    share = checks[nearest]["value"] / checks[nearest]["bound"]
    words = CHECKS.get(nearest, (nearest, ""))[0]
    return ("The iterations converged, and an independent computation, which shares no operator with the solver, confirms forces, supports and contact. "
            f"Nearest to its bound: \u201c{esc(words[:1].lower() + words[1:])}\u201d, at {percent(share)} of what is allowed.")


def percent(share):
    return "less than 0.01 %" if share < 1e-4 else f"{100 * share:.2g} %" if share < 0.1 else f"{100 * share:.0f} %"


def error_sentence(run):
    """The bound of the error, or the estimated error and what it rests on."""
    found = run.summary.get("error", {})
    bound = accuracy_sentence(run) if has_levels(run) else bound_sentence(run)
    if bound:
        return f'<p id="error_sentence">{esc(bound)} Stresses at a single point may deviate by more.</p>\n'
    for key, words in (("energy_norm_relative", "Error against the exact solution: {} of the energy norm."),
                       ("estimated_energy_norm_relative", "Estimated error of the mesh: {} of the energy norm, from recovered stresses."),
                       ("averaged_energy_norm_relative", "Estimated error of the mesh: about {} of the energy norm, roughly, from averaged stresses.")):
        if found.get(key) is not None:
            return f'<p id="error_sentence">{words.format(percent(found[key]))} Stresses at a single point may deviate by more.</p>\n'
    return '<p id="error_sentence">The error of the mesh was not estimated.</p>\n'


def warnings(run):
    """Notes that may limit the answers, in amber; the first ones, and the others on demand."""
    found = [f"<li>{esc(sentence(note))}</li>" for note in split_notes(run)[0]]
    if not found:
        return ""
    more = len(found) - MOST_WARNINGS
    others = (f'<details><summary>{number(more)} more</summary><ul>{"".join(found[MOST_WARNINGS:])}</ul></details>'
              f'<p class="printed">{number(more)} more: on the screen, and in summary.json.</p>') if more > 0 else ""
    return (f'<div class="warnings" id="warnings"><strong>{"Warning" if len(found) == 1 else f"{len(found)} warnings"}</strong>'
            f'<ul>{"".join(found[:MOST_WARNINGS])}</ul>{others}</div>\n')
