#!/usr/bin/python3
"""suture_plot on 3D runs, without a display: all pages with legible labels, the largest values that they report, and clear errors.

    space_pictures.py --plot suture_plot --work DIR --mpirun "..."
"""
import json
import os
import re
import subprocess
import sys
import warnings
from pathlib import Path

from harness import arguments, check, finish, forked

options = arguments("--plot")
sys.path.insert(0, str(Path(options.plot).resolve().parent))
os.environ.pop("DISPLAY", None)

import matplotlib.image  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import space_scenes  # noqa: E402
from picture_faults import faults, shape  # noqa: E402
from suture_plot_parts.pictures import pictures  # noqa: E402
from suture_plot_parts.run import RunFolder  # noqa: E402
from suture_plot_parts.space.cells import CELLS, FACES  # noqa: E402

NAMES = ["scene", "mesh", "deformation", "von_mises", "von_mises_cut", "principal_stress", "contact"]


def words(figure):
    """All texts of a figure, including legends and colour bars."""
    return " | ".join(text.get_text().replace("\n", " ") for text in figure.findobj(matplotlib.text.Text) if text.get_text())


def reported(text, before):
    """The number after the given words."""
    found = re.search(re.escape(before) + r" ([-\u2212]?[0-9.e+-]+)", text)
    return float(found.group(1).replace("\u2212", "-")) if found else None


def agrees(expected):
    return lambda found: found is not None and abs(found - expected) <= 5.1e-4 * abs(expected)


def drawn(name, folder, pages, **more):
    """Checks the labels of all pages. \\return words by page"""
    said = {}
    for page in pictures(RunFolder(folder), **more):
        check(f"{name}, {page.name}: labels", faults(page.figure), [])
        if page.name.startswith(("scene", "contact")):
            # The column of a narrow contact surface is wide enough for its title.
            check(f"{name}, {page.name}: shape", [fault for fault in shape(page) if page.name == "scene" or "title" not in fault], [])
        said[page.name] = words(page.figure)
        plt.close(page.figure)
    check(f"{name}: pages", list(said), pages)
    return said


def blocks():
    folder = options.work / "blocks"
    space_scenes.blocks(folder, CELLS[12].faces, n=4)
    run = RunFolder(folder)
    said = drawn("blocks", folder, NAMES)
    mises, principal = run.fields.point_data["NodalVonMises"], run.fields.point_data["NodalPrincipalStress"]
    check("blocks: largest von Mises stress", reported(said["von_mises"], "largest von Mises"), agrees(mises.max()))
    # x = 10, y = 0 and z = 10 are visible from (1, -1.4, 0.9).
    seen = (run.fields.points == [10, 0, 10]).any(axis=1)
    check("blocks: largest von Mises stress on the sides that are seen", reported(said["von_mises"], "largest visible"), agrees(mises[seen].max()))
    check("blocks: the page reports that it is hidden", "hidden, or inside" in said["von_mises"], True)
    check("blocks: largest tension", reported(said["principal_stress"], "largest tension"), agrees(principal.max()))
    check("blocks: largest compression", reported(said["principal_stress"], "largest compression"), agrees(principal.min()))
    check("blocks: largest displacement", reported(said["deformation"], "largest"),
          agrees(np.linalg.norm(run.fields.point_data["Displacement"], axis=1).max()))
    # The default plane passes through nodes, where its largest stress occurs.
    at = run.contact.points[np.argmax(run.contact.point_data["ContactPressure"]), 0]
    check("blocks: largest on the cut", reported(said["von_mises_cut"], "mm, largest"), agrees(mises[run.fields.points[:, 0] == at].max()))
    check("blocks: contact lines on the cut", all(name in said["von_mises_cut"] for name in ("contact, open", "contact, closed")), True)
    contact = run.contact.point_data
    check("blocks: largest pressure", reported(said["contact"], "pressure, largest"), agrees(contact["ContactPressure"].max()))
    check("blocks: largest gap", reported(said["contact"], "gap, largest"), agrees(contact["Gap"].max()))
    check("blocks: open pairs", f"{np.count_nonzero(contact['Active'] == 0)} of {len(contact['Active'])} pairs open" in said["contact"],
          True)
    given = run.summary["parameters"]
    expected = [*given["Contact"], *given["Bodies"], *given["Boundary Conditions"]]
    check("blocks: conditions, contacts and bodies are named", [name for name in expected if f"| {name} |" not in f"| {said['scene']} |"],
          [])
    check("blocks: own weight is drawn through the bodies", "(not drawn)" in said["scene"], False)
    expected = [f"{body}_{s}" for body in ("lower", "upper") for s in (0, 1, 3)]
    check("blocks: subdomains are named", [name for name in expected if name not in said["mesh"]], [])
    said = drawn("blocks from behind", folder, NAMES, view=(-1.0, 0.2, -0.4), cut=(2, 2.5))
    check("another view is reported", "seen from (\u22121, 0.2, \u22120.4)" in said["mesh"], True)
    check("another plane: largest in it", reported(said["von_mises_cut"], "mm, largest"), agrees(mises[run.fields.points[:, 2] == 2.5].max()))
    check("another plane: without contact lines", "contact, " in said["von_mises_cut"], False)


def others():
    folder = options.work / "ball"
    space_scenes.ball_on_block(folder, CELLS[24].faces, FACES[6].triangles, n=2)
    drawn("ball", folder, NAMES)
    folder = options.work / "pin"
    space_scenes.pin_in_eye(folder, around=8)
    said = drawn("pin", folder, [*NAMES, "contact_2"])
    run = RunFolder(folder)
    check("pin: stresses of the cells only", reported(said["von_mises"], "largest von Mises"), agrees(run.fields.cell_data["VonMises"].max()))
    _, zero, after = said["contact_2"].partition("gap, none")
    check("pin: no colour bar for a zero gap", (bool(zero), "gap [mm]" in after), (True, False))


def alone():
    """One body without contact, displacement and stress, and one long thin body."""
    folder = options.work / "alone"
    zero = lambda n: lambda p: np.zeros((len(p), n))  # noqa: E731
    body = space_scenes.brick(10, (0, 0, 0), (1, 1, 1), (1, 1, 1))
    space_scenes.write_run(folder, [space_scenes.Part("only", body)], zero(3), zero(6))
    drawn("alone", folder, NAMES[:-1])
    folder = options.work / "thin"
    body = space_scenes.brick(12, (0, 0, 0), (100, 1, 1), (40, 1, 1))
    space_scenes.write_run(folder, [space_scenes.Part("beam", body)], lambda p: 1e-4 * p**2 * [0, 0, 1],
                           lambda p: np.repeat(p[:, :1], 6, axis=1))
    drawn("thin", folder, NAMES[:-1])
    folder = options.work / "unknown"
    space_scenes.write_run(folder, [space_scenes.Part("beam", body)], zero(3), lambda p: np.where(p[:, :1] < 50, np.nan, np.ones((1, 6))))
    drawn("partly unknown stresses", folder, NAMES[:-1])


def program():
    folder = options.work / "blocks"
    done = subprocess.run([sys.executable, "-B", "-X", "importtime", options.plot, folder, "--view=1,1,1", "--cut", "y=5"],
                          capture_output=True, text=True)
    check("suture_plot", (done.returncode, "report.html" in done.stdout), (0, True))
    check("no graphics library is loaded", [name for name in ("vtk", "OpenGL", "scipy") if re.search(rf"\| +{name}", done.stderr)], [])
    for name in NAMES:
        image = matplotlib.image.imread(folder / f"{name}.png")
        ink = (image[..., :3].min(axis=2) < 0.9).mean()
        check(f"{name}.png", (min(image.shape[:2]) > 300, 0.01 < ink < 0.95), (True, True))
    page = (folder / "report.html").read_text(encoding="utf-8")
    check("report: all pictures", [name for name in NAMES if f'id="picture_{name}"' not in page], [])
    check("report: model and cells in words", ("solid: three dimensions" in page, "hexahedra of 8 nodes" in page), (True, True))
    for given, code, said in ((["--cut", "x=11"], 3, "--cut x=11 is outside the bodies, which reach from x = 0 to 10"),
                              (["--zoom", "0,1,0,1"], 3, "--zoom is for 2D"),
                              (["--cut", "5"], 2, "not of the form x=0.5"), (["--cut", "x=five"], 2, "not of the form x=0.5"),
                              (["--view", "0,0,0"], 2, "not a direction"), (["--view", "1,2"], 2, "not a direction")):
        found, text = forked(options.plot, folder, *given)
        check(" ".join(given), (found, said in text, "Traceback" in text), (code, True, False))
    summary = json.loads((folder / "summary.json").read_text())
    (folder / "summary.json").write_text(json.dumps({**summary, "dimension": 2}))
    found, text = forked(options.plot, folder, "--view", "1,1,1")
    check("--view of a plane run", (found, "--view and --cut are for 3D runs" in text), (3, True))


warnings.simplefilter("error")  # raw text of a library
plt.rcParams["savefig.dpi"] = 60  # the images are not looked at
for part in (blocks, others, alone):
    part()
program()
finish()
