"""report.html of a run: answers first, then pictures, then an appendix on model and solution."""
import os
import re

from .html import esc, figure, page
from .report_accuracy import accuracy_section, has_levels
from .report_answers import body_forces, contact_table, key_figures, loads_and_supports, rigid_groups, safety
from .report_header import banner, error_sentence, head, sentence, split_notes, warnings
from .report_run import convergence, cost, error, load_steps, provenance, verdict
from .report_scene import contact_pieces, force_basis, reactions, scene_in_words
from .view.page import interactive_view
from .words import conditions, contacts

WITHOUT = "Not plotted: this run wrote no fields."
# Pictures on paper, the most important first, two per page; all pictures are on the screen.
ON_PAPER = ("scene", "deformation", "von_mises", "safety", "von_mises_zoom", "von_mises_cut", "contact", "accuracy", "steps", "principal_stress")
MOST_ON_PAPER = 6
LARGE = 6_500_000  # bytes of pictures above which they are compressed further, without loss, by a format that older browsers lack
LONG = 22  # conditions and contacts beyond which the answers fill a second page, and paper has two pictures less


class Pictures:
    """The pictures of a run as markup, by section of the report. `most`: number of pictures on paper"""

    def __init__(self, run, pictures, most):
        self.run, self.pictures = run, pictures
        names = {picture.name for picture in pictures}
        self.on_paper = [name for name in ON_PAPER if name in names][:most]
        self.compress = sum(picture.path.stat().st_size for picture in pictures) > LARGE

    def of(self, section):
        return [picture for picture in self.pictures if picture.section == section]

    def on_screen_only(self, section):
        """The class of a section that paper does not have, since it would be a heading without a picture."""
        own = self.of(section)
        return "screen" if own and not any(picture.name in self.on_paper for picture in own) else ""

    def drawn(self, section, otherwise="", names=None):
        """`names`: only these pictures of the section"""
        own = [figure(picture, self.run.title, "" if picture.name in self.on_paper else "screen", self.compress)
               for picture in self.of(section) if names is None or picture.name in names]
        return "".join(own) or f'<p class="soft">{esc(otherwise)}</p>\n'


def answers(run):
    """The first page. The loads, supports and contacts of a failed run are stated, its numbers are not."""
    if not run.good:
        return loads_and_supports(run) + contact_table(run)
    basis = force_basis(run)
    note = f'<p class="soft">Forces: {esc(basis)}.</p>\n' if basis else ""
    return key_figures(run) + error_sentence(run) + safety(run) + loads_and_supports(run) + rigid_groups(run) + contact_table(run) + body_forces(run) + note


def results(run, drawn):
    """[(id, heading, markup, class)]: the pictures of the solution."""
    no_contact = "This scene has no contact." if not run.summary["contact"].get("pairs") else WITHOUT
    found = [("deformation", "Deformed shape", WITHOUT), ("animation", "Animation", None), ("von_mises", "Von Mises stress", WITHOUT),
             ("principal", "Principal stresses", WITHOUT), ("contact", "Contact", no_contact), ("steps", "Load steps", None), ("probes", "Probes", None)]
    own = [("accuracy", "Speed against error", accuracy_section(run, drawn.drawn("accuracy")), "" if run.good else "invalid")] if has_levels(run) else []
    return [(key, heading, drawn.drawn(key, otherwise), " ".join(filter(None, [drawn.on_screen_only(key), "" if run.good else "invalid"])))
            for key, heading, otherwise in found if otherwise is not None or drawn.of(key)] + own


def appendix(run, drawn):
    notes = split_notes(run)[1]
    remarks = ("<h3>Notes of the solver</h3><ul>" + "".join(f"<li>{esc(sentence(note))}</li>" for note in notes) + "</ul>\n") if notes else ""
    pieces = contact_pieces(run)
    return [("scene", "Appendix: model and mesh", scene_in_words(run) + drawn.drawn("mesh", WITHOUT, {"mesh"}), "", "part"),
            ("reactions", "Forces and moments", reactions(run)),
            *([("pieces", "Contact in pieces", pieces)] if pieces else []),
            *([("path", "Load steps of the solver", load_steps(run))] if run.summary.get("load_steps") else []),
            ("verdict", "Independent verification", verdict(run)),
            ("error", "Error", error(run)),
            ("convergence", "Convergence of the solver", convergence(run) + remarks + drawn.drawn("convergence", "No outer iterations in this run.")),
            ("cost", "Cost", cost(run)),
            ("provenance", "Provenance", provenance(run))]


def enlargement_of(pictures):
    """The enlargement of displacements in the pictures, as the caption of the deformed shape states it."""
    captions = [picture.caption for picture in pictures if picture.name == "deformation"]
    found = re.search(r"(?:enlarged|reduced to) ([0-9][0-9.e+-]*)", captions[0]) if captions else None
    return float(found.group(1).rstrip(".")) if found else 1.0


def sections_of(run, pictures):
    long = len(conditions(run)) + 2 * len(contacts(run)) > LONG
    drawn = Pictures(run, pictures, MOST_ON_PAPER - 2 * long)
    first = [("answers", "Answers" if run.good else "Loads, supports and contacts", answers(run)),
             ("mesh", "Parts, loads, supports and contacts" if run.good else "Parts", drawn.drawn("mesh", WITHOUT, {"scene"}))]
    state = [] if run.good else [("state", "State in which the run ended: not a result", key_figures(run) or "<p>Nothing is known.</p>\n", "invalid")]
    others = [*first, *state], [*results(run, drawn), *appendix(run, drawn)]
    view = interactive_view(run, sum(len(section[2]) for part in others for section in part), enlargement_of(pictures))
    shown = [("view", "Interactive view", view, "screen" if run.good else "screen invalid")] if view else []
    return [*others[0], *shown, *others[1]]


def report(run, pictures, path):
    """Writes the page under a temporary name and renames it. \\return path"""
    header = head(run) + banner(run) + warnings(run)
    partial = path.with_name(path.name + ".part")
    partial.write_text(page(run.title, header, sections_of(run, pictures)), encoding="utf-8")
    os.replace(partial, path)
    return path
