"""The section of the report with the interactive view."""
import json
from pathlib import Path

import matplotlib

from ..html import esc
from ..space.outside import SIGNED
from .data import view_data
from .library import LICENCE, library
from .pack import text

MOST = 10_000_000  # bytes of a report
REST = 100_000  # bytes of everything around sections and numbers
HERE = Path(__file__).parent
STOP = '<span class="stop"></span>'  # a number below the legend


def interactive_view(run, taken, factor):
    """Markup of the view of a 3D run; a sentence if the library is missing; nothing for other runs. `taken`: characters of the other sections;
    `factor`: enlargement of the displacements"""
    if run.dimension != 3 or run.fields is None:
        return ""
    found = library()
    if found is None:
        return ('<p class="soft" id="no_view">Not in this report, since three.js is not installed where it was written. On Debian: '
                "<code>apt-get install libjs-three</code>, then run suture_plot again.</p>\n")
    revision, scripts = found
    own = (HERE / "view.js").read_text(encoding="utf-8")
    data = view_data(run, MOST - REST - taken - len(scripts.encode()) - len(own.encode()), factor)
    if data is None:
        return '<p class="soft" id="no_view">Not in this report: with the view, the file would be too large.</p>\n'
    data["colours"] = {"magnitude": colours(matplotlib.colormaps["viridis"]), "signed": colours(SIGNED)}
    style = (HERE / "view.css").read_text(encoding="utf-8")
    licence = f"<details><summary>three.js, revision {esc(revision)}: licence</summary><pre>{esc(LICENCE)}</pre></details>\n"
    return (f"<style>{style}</style>\n{markup(data)}{note(data)}{licence}"
            f'<script type="application/json" id="view3d_data">{as_json(data)}</script>\n'
            f"{script(f'/* three.js, revision {revision}' + chr(10) + LICENCE + ' */' + chr(10) + scripts)}{script(own)}")


def colours(table):
    """256 rows of red, green, blue."""
    return text((255 * table(range(256))[:, :3] + 0.5).astype("u1"))


def as_json(data):
    """JSON without characters that have a meaning in a page."""
    found = json.dumps(data, allow_nan=False)
    return found.replace("&", "\\u0026").replace("<", "\\u003c").replace(">", "\\u003e")


def script(code):
    """A script element that is valid in HTML and in XML."""
    clean = code.replace("]]>", "]] >").replace("</script", "<\\/script").replace("<!--", "<\\!--")
    return f"<script>//<![CDATA[\n{clean}\n//]]></script>\n"


def slider(name, title, low, high, step, value, more=""):
    return (f'<label><span class="title">{title}</span><input type="range" data-part="{name}" min="{low}" max="{high}" step="{step}" value="{value}"/>'
            f"{more}</label>")


def markup(data):
    fields = [*data["fields"], *(data["contacts"]["fields"] if data["contacts"] else [])]
    chosen = 1 if len(data["fields"]) > 1 else 0
    options = "".join(f'<option value="{field["name"]}"{" selected=" + chr(34) + "selected" + chr(34) if k == chosen else ""}>{esc(field["label"])}</option>'
                      for k, field in enumerate(fields))
    axes = "".join(f'<option value="{k}">{words}</option>' for k, words in ((-1, "no cut"), (0, "across x"), (1, "across y"), (2, "across z")))
    boxes = "".join(f'<label><input type="checkbox" checked="checked" data-body="{k}"/>{esc(name)}</label>' for k, name in enumerate(data["bodies"]))
    count = len(data["frames"])
    steps = ""
    if count > 1:
        steps = (f'<div>{slider("frame", "load step", 0, count - 1, 1, data["first"])}<button type="button" data-part="play">\u25b6 play</button></div>'
                 '<div><output data-part="frame-name"></output></div>')
    buttons = "".join(f'<button type="button" data-part="{name}">{words}</button>' for name, words in
                      (("reset", "oblique"), ("from-x", "from x"), ("from-y", "from \u2212y"), ("from-z", "from z")))
    return (
        '<div id="view3d"><p class="failed"></p>'
        '<div class="stage"><canvas class="scene"></canvas><canvas class="triad" width="120" height="120"></canvas>'
        '<output class="hover" data-part="hover"></output></div>'
        '<div class="legend" data-part="legend"><div data-part="name"></div><canvas width="512" height="8"></canvas>'
        f'<div class="stops">{5 * STOP}</div></div>'
        '<div class="controls">'
        f'<label><span class="title">field</span><select data-part="field">{options}</select></label>'
        '<div><span class="title">scale</span><input type="number" step="any" data-part="least" aria-label="lower end of the scale"/>'
        '<input type="number" step="any" data-part="largest" aria-label="upper end of the scale"/>'
        '<button type="button" data-part="whole-range">all</button></div>'
        f'<div>{slider("enlargement", "deformation", 0, 2, 0.01, 1)}<output data-part="enlargement-name"></output>'
        '<button type="button" data-part="true-scale">\u00d7 1</button></div>'
        f'<div><span class="title">cut</span><select data-part="axis" aria-label="direction of the cut">{axes}</select>'
        '<input type="range" data-part="level" min="0" max="1" step="0.002" value="0.5" aria-label="position of the cut"/><output data-part="cut-name"></output>'
        '<label><input type="checkbox" data-part="other"/>other side</label></div>'
        f'{steps}<div><span class="title">view</span>{buttons}</div><div class="bodies"><span class="title">bodies</span>{boxes}</div></div></div>\n')


def note(data):
    """How to use the view, and what it leaves out."""
    said = ["Drag to rotate, with the right button or two fingers to move, turn the wheel or pinch to zoom; point at a body for its name and value.",
            "Values have 16 bits, displacements are enlarged as the slider shows, and the scale covers all load steps." if len(data["frames"]) > 1 else
            "Values have 16 bits, displacements are enlarged as the slider shows."]
    if data["inside"]:
        said.append("Cuts are linear between the vertices of the elements.")
    else:
        said.append("The inside of the bodies is left out for the size of the file, so cut bodies look hollow, and the scale is that of the surface.")
    if data["others"]:
        said.append("Load steps with other bodies, which were removed or placed later, are left out.")
    if data["moving"]:
        said.append("Cuts are planes of the bodies as drawn, and move with them; contact surfaces are where they are at the end of the step.")
    if data["reduced"]:
        said.append("The surface is coarser than the mesh.")
    return f'<p class="soft">{esc(" ".join(said))}</p>\n<noscript><p>The view needs JavaScript; the pictures below do not.</p></noscript>\n'
