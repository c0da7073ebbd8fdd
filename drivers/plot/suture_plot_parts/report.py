"""report.html: everything about a run on one page."""
import os

from .html import esc, figure, number, page
from .report_run import convergence, cost, error, load_steps, provenance, verdict
from .report_scene import contact_pieces, reactions, scene_in_words
from .stresses import taken_at
from .units import scaled

EXIT = {0: "done", 2: "command line", 3: "input", 4: "numerical", 5: "environment", 70: "internal", 75: "stopped on request"}
EXTREMES = (("von_mises", "largest von Mises stress"), ("tension", "largest tension"), ("compression", "largest compression"),
            ("displacement", "largest displacement"), ("pressure", "largest contact pressure"))


def banner(run):
    summary = run.summary
    code = summary["exit_code"]
    words = [f"Exit code {number(code)} ({EXIT.get(code, 'unknown')})."]
    if summary.get("failure"):
        words.append(esc(sentence(summary["failure"])))
    if not run.good:
        words.append("All plots and numbers below refer to this state of the run.")
    if run.step is not None:
        words.append(f"Plots of fields show {esc(run.words_of_step)}; the numbers are from the last step.")
    notes = "".join(f"<br/>Note: {esc(note if note.endswith('.') else note + '.')}" for note in summary.get("notes", []))
    head = sentence(run.verdict).rstrip(".")
    return f'<div class="verdict{"" if run.good else " bad"}" id="banner"><strong>{esc(head)}</strong>{" ".join(words)}{notes}</div>\n'


def readable(value, unit):
    """The value in the units of the scene, and in a multiple of the unit if that is more readable."""
    factor, name = scaled(unit, abs(value))
    return number(value, unit) + ("" if name == unit else f' <span class="soft">({factor * value:.4g} {esc(name)})</span>'.replace("(-", "(\u2212"))


def sentence(text):
    return text[:1].upper() + text[1:] + ("" if text.endswith((".", "!", "?")) else ".")


def key_figures(run):
    cards = []
    for name, words in EXTREMES:
        found = run.summary.get("extremes", {}).get(name)
        if not found or found.get("value") is None:
            continue
        if name == "tension" and found["value"] < 0:
            words = "largest principal stress: no tension"
        if name == "compression" and found["value"] > 0:
            words = "smallest principal stress: no compression"
        where = f"{found['contact']}" if found.get("contact") else found.get("body", "")
        at = f" at ({', '.join(number(x) for x in found['place'])})" if found.get("place") else ""
        cards.append(f'<div id="extreme_{name}"><div class="name">{esc(words)}</div><div class="value">{readable(found["value"], found.get("unit", ""))}</div>'
                     f'<div class="where">{esc(where)}{at}</div></div>')
    if not cards:
        return ""
    return f'<div class="figures">{"".join(cards)}</div>\n<p class="soft">Stresses {esc(taken_at(run))}; positions on the undeformed bodies.</p>\n'


def report(run, pictures, path):
    """Writes the page under a temporary name and renames it. \\return path"""
    def drawn(section, otherwise):
        own = [figure(picture, run.title) for picture in pictures if picture.section == section]
        return "".join(own) or f'<p class="soft">{esc(otherwise)}</p>\n'

    without = "Not plotted: this run wrote no fields."
    contact = run.summary["contact"]
    sections = [
        ("scene", "Scene", scene_in_words(run)),
        ("mesh", "Mesh, loads, supports and contacts", drawn("mesh", without)),
        ("deformation", "Deformed shape", drawn("deformation", without)),
        ("von_mises", "Von Mises stress", drawn("von_mises", without)),
        ("principal", "Principal stresses", drawn("principal", without)),
        ("contact", "Contact", contact_pieces(run) + drawn("contact", "This scene has no contact." if not contact.get("pairs") else without)),
        ("reactions", "Forces of loads, supports and contacts", reactions(run)),
        ("convergence", "Convergence", convergence(run) + drawn("convergence", "No outer iterations in this run.")),
        ("verdict", "Verdict", verdict(run)),
        ("error", "Error", error(run)),
        ("cost", "Cost", cost(run)),
        ("provenance", "Provenance", provenance(run))]
    if any(picture.section == "probes" for picture in pictures):
        sections.insert(7, ("probes", "Probes", drawn("probes", "")))
    if run.steps:
        sections.insert(7, ("steps", "Load steps", load_steps(run) + drawn("steps", "")))
    header = (f"<h1>{esc(run.title)}</h1>\n<p class=\"soft\">{esc(run.model)}, {number(run.summary['elements'])} elements, "
              f"{number(run.summary.get('dofs'))} unknowns, units {esc(run.summary.get('units', ''))}. Suture {esc(run.summary['versions'].get('suture', ''))}, "
              f"{run.written:%Y-%m-%d %H:%M}.</p>\n{banner(run)}{key_figures(run)}")
    partial = path.with_name(path.name + ".part")
    partial.write_text(page(run.title, header, sections), encoding="utf-8")
    os.replace(partial, path)
    return path
