"""The interactive view in headless Chromium: what it draws and finds under the pointer, against the fields of the run. For report_view.py.

    import view_in_browser  # after harness.arguments()
"""
import html
import json
import re
import shutil
import subprocess

import h5py
import harness
import matplotlib
import numpy as np
from harness import SLOWER, check
from suture_plot_parts.run import RunFolder


def near(expected, slack):
    return lambda found: found is not None and np.shape(found) == np.shape(expected) and bool(np.all(np.abs(np.asarray(found) - expected) <= slack))


def browser():
    return next((path for path in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if path), None)


CHROMIUM = ("--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars",
            "--window-size=1100,900", "--virtual-time-budget=20000")


def started(page, *more):
    """Headless Chromium on a file."""
    return subprocess.run([browser(), *CHROMIUM, f"--user-data-dir={harness.options.work / 'browser'}", *more, page.resolve().as_uri()], capture_output=True,
                          text=True, timeout=200 * SLOWER)


def on_paper(folder):
    started(folder / "report.html", "--no-pdf-header-footer", f"--print-to-pdf={folder / 'report.pdf'}")
    pages = re.findall(rb"/Type\s*/Page\b", (folder / "report.pdf").read_bytes())
    check("browser: printed pages", len(pages), lambda count: 3 <= count <= 6)


def driven(folder, script):
    """Runs a script in the page in headless Chromium, opened as a file. `say(key, value)` returns a value."""
    page = folder / "driven.html"
    text = (folder / "report.html").read_text(encoding="utf-8")
    page.write_text(text.replace("</body>", '<pre id="driven"></pre><script>//<![CDATA[\n(() => { const found = {}, say = (key, value) => { found[key] = value; };\n'
                                 "try { const view = window.sutureView;\n" + script + "\n} catch (problem) { say('problem', String(problem.stack)); }\n"
                                 "document.getElementById('driven').textContent = JSON.stringify(found); })();\n//]]></script></body>"), encoding="utf-8")
    done = started(page, "--dump-dom")
    found = re.search(r'<pre id="driven">(.*?)</pre>', done.stdout, re.S)
    check("Chromium ran the page", bool(found and found.group(1)), True)
    return json.loads(html.unescape(found.group(1))) if found and found.group(1) else {}


SCRIPT = """
const event = (name, value, kind) => {
  const element = view.element(name);
  if (typeof value === 'boolean') element.checked = value; else element.value = value;
  element.dispatchEvent(new Event(kind));
};
const pixels = () => {
  view.draw();
  const gl = view.renderer.getContext(), size = [gl.drawingBufferWidth, gl.drawingBufferHeight], all = new Uint8Array(4 * size[0] * size[1]);
  gl.readPixels(0, 0, size[0], size[1], gl.RGBA, gl.UNSIGNED_BYTE, all);
  return { size, all };
};
const ink = () => {
  const { all } = pixels(), colours = new Set();
  let count = 0;
  for (let i = 0; i < all.length; i += 4) if (all[i] < 250 || all[i + 1] < 250 || all[i + 2] < 250) {
    ++count;
    colours.add(all[i] << 16 | all[i + 1] << 8 | all[i + 2]);
  }
  return [4 * count / all.length, colours.size];
};
const onScreen = (x, y, z) => {  // of an undeformed point, in pixels of the canvas
  const place = new THREE.Vector3(x, y, z).project(view.camera);
  return [0.5 * (1 + place.x) * view.canvas.clientWidth, 0.5 * (1 - place.y) * view.canvas.clientHeight];
};
const colourAt = (x, y) => {
  const { size, all } = pixels(), ratio = size[0] / view.canvas.clientWidth;
  const i = 4 * (Math.floor(x * ratio) + size[0] * (size[1] - 1 - Math.floor(y * ratio)));
  return Array.from(all.slice(i, i + 3));
};
say('ready', view.root.className);
say('shape', [view.canvas.width / view.canvas.height, view.canvas.clientWidth / view.canvas.clientHeight]);
say('network', performance.getEntriesByType('resource').length);
say('ink', ink());
say('frame', view.frame);
event('enlargement', 0, 'input');
say('enlargement', view.shared.enlargement.value);
event('field', 'von_mises', 'change');
view.element('from-z').click();
say('top', [[2.5, 2.5], [7.5, 5]].map(([x, y]) => view.pick(...onScreen(x, y, 10))));
say('beside', view.pick(3, 3));
// The part below, with its body hidden.
const box = view.root.querySelector('input[data-body="1"]');
box.checked = false;
box.dispatchEvent(new Event('change'));
say('hidden', [[2.5, 2.5], [7.5, 5]].map(([x, y]) => view.pick(...onScreen(x, y, 5))));
box.checked = true;
box.dispatchEvent(new Event('change'));
// Contact pressure, drawn without shading.
event('field', 'pressure', 'change');
say('pressure', [[5, 5], [2.5, 5], [9, 9]].map(([x, y]) => ({ at: [x, y], found: view.pick(...onScreen(x, y, 5)), colour: colourAt(...onScreen(x, y, 5)), range: view.range })));
say('legend', Array.from(view.element('legend').querySelectorAll('.stop')).map(stop => stop.textContent));
// A section: its area, its values at the corners of the elements, and nothing of the part that is cut away.
event('field', 'von_mises', 'change');
event('level', 0.5, 'input');
event('axis', 0, 'change');
let area = 0;
const corners = [];
for (const part of view.parts) {
  const of = part.section.geometry.attributes, p = of.position.array, v = of.value.array;
  for (let i = 0; i < p.length; i += 9) {
    const [a, b, c] = [0, 3, 6].map(k => new THREE.Vector3(p[i + k], p[i + k + 1], p[i + k + 2]));
    area += 0.5 * b.sub(a).cross(c.sub(a)).length();
  }
  for (let i = 0; i < v.length; ++i) corners.push([p[3 * i], p[3 * i + 1], p[3 * i + 2], v[i], part.number]);
}
say('area', area);
say('corners', corners);
view.element('from-x').click();
say('cut', [view.pick(...onScreen(5, 2.5, 2.5)), view.cut]);
event('axis', -1, 'change');
say('uncut', view.pick(...onScreen(10, 2.5, 2.5)));
// The load steps.
if (view.data.frames.length > 1) {
  event('frame', 0, 'input');
  say('first', [view.frame, view.element('frame-name').textContent, Array.from(view.shifts.slice(0, 30))]);
  event('frame', view.data.frames.length - 1, 'input');
  say('last', Array.from(view.shifts.slice(0, 30)));
}
event('largest', 50, 'change');
say('range', view.range);
"""


def nodes_of(folder, name="NodalVonMises"):
    with h5py.File(folder / "fields_0005.vtkhdf") as file:
        return file["VTKHDF/Points"][:], file[f"VTKHDF/PointData/{name}"][:]


def in_browser(folder):
    """The last of six load steps of the blocks."""
    found = driven(folder, SCRIPT)
    check("browser: no problem", (found.get("problem"), found.get("ready")), (None, "ready"))
    if "range" not in found:
        return
    check("browser: the image is not distorted", found["shape"][0], near(found["shape"][1], 0.01))
    check("browser: nothing is loaded", found["network"], 0)
    check("browser: the canvas is not blank", found["ink"], lambda ink: 0.05 < ink[0] < 0.9 and ink[1] > 50)
    check("browser: the last load step comes first", found["frame"], 5)
    check("browser: deformation slider", found["enlargement"], 0)
    points, mises = nodes_of(folder)

    def at(*place):
        return sorted(mises[np.abs(points - place).max(axis=1) < 1e-9].tolist())

    largest = mises.max()
    for place, pick in zip(((2.5, 2.5, 10), (7.5, 5, 10)), found["top"]):
        check(f"browser: stress at {place}", (pick["name"], pick["value"]), lambda pair, place=place: pair[0] == "upper" and abs(pair[1] - at(*place)[0]) < 0.02 * largest)
    check("browser: beside the bodies", found["beside"], None)
    lower = [pick["name"] for pick in found["hidden"]]
    check("browser: a hidden body shows the one below", lower, ["lower", "lower"])
    run = RunFolder(folder)
    table, pressure = matplotlib.colormaps["viridis"], run.contact.point_data["ContactPressure"]
    for probe in found["pressure"]:
        place = np.array([*probe["at"], 5.0])
        check(f"browser: contact under {probe['at']}", probe["found"]["name"], "joint")
        value, (low, high) = probe["found"]["value"], probe["range"]
        node = np.flatnonzero(np.abs(run.contact.points - place).max(axis=1) < 1e-9)
        if len(node):
            check(f"browser: pressure at {probe['at']}", value, near(pressure[node[0]], 0.03 * pressure.max()))
        colour = 255 * np.array(table((value - low) / (high - low))[:3])
        check(f"browser: colour at {probe['at']}", np.array(probe["colour"], dtype=float), near(colour, 4.0))
    ends = [float(text.replace("\u2212", "-")) for text in (found["legend"][0], found["legend"][-1])]
    check("browser: ends of the legend", ends, near([0.0, pressure.max()], 6e-4 * pressure.max()))
    check("browser: area of the section", found["area"], near(100.0, 1e-2))
    compared = 0
    for x, y, z, value, _ in found["corners"]:
        known = at(round(x / 2.5) * 2.5, round(y / 2.5) * 2.5, round(z / 2.5) * 2.5) if abs(y / 2.5 - round(y / 2.5)) + abs(z / 2.5 - round(z / 2.5)) < 1e-3 else []
        if known:
            compared += 1
            if min(abs(value - one) for one in known) > 1e-3 * largest:
                check(f"browser: section at {(x, y, z)}", value, known)
    check("browser: values of the section that are those of nodes", compared > 50, True)
    pick, cut = found["cut"]
    check("browser: the cut", (cut["axis"], cut["level"], pick["name"]), lambda cut: cut[0] == 0 and abs(cut[1] - 5) < 1e-3 and cut[2] == "lower")
    check("browser: stress on the section", pick["value"], near(at(5, 2.5, 2.5)[0], 0.03 * largest))
    check("browser: without the cut", found["uncut"]["value"], near(at(10, 2.5, 2.5)[0], 0.03 * largest))
    frame, name, first = found["first"]
    check("browser: first load step", (frame, name), (0, "load step 1 of 6, t = 0.5"))
    scale = max(map(abs, found["last"]))
    check("browser: its displacements are a sixth of the last", 6 * np.array(first), near(np.array(found["last"]), 2e-3 * scale))
    check("browser: scale", found["range"], near([0.0, 50.0], 1e-9))
