#!/usr/bin/python3
"""suture_plot --scene: pictures of a scene before it is solved. suture_solve --scene-data: its data, on any number of ranks.

    scene_pictures.py --solve suture_solve --plot suture_plot --input DIR --work DIR --mpirun "..."
"""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from harness import SLOWER, arguments, check, finish, run

options = arguments("--solve", "--plot", "--input")
sys.path.insert(0, str(Path(options.plot).resolve().parent))

import h5py  # noqa: E402
import matplotlib  # noqa: E402
import numpy as np  # noqa: E402
from picture_faults import faults  # noqa: E402
from suture_plot_parts.enlarged import gaps_of_outline, limit  # noqa: E402
from suture_plot_parts.scene_data import SceneData  # noqa: E402
from suture_plot_parts.scene_pictures import scene_pictures, unused  # noqa: E402
from suture_plot_parts.space.gaps import gaps_of_surface  # noqa: E402
from suture_plot_parts.space.surface import Surface  # noqa: E402
from suture_plot_parts.step_factors import evaluated, factor_at  # noqa: E402
from suture_plot_parts.words import Condition  # noqa: E402

SCENES = Path(options.input)


def texts(figure):
    return {text.get_text() for text in figure.findobj(matplotlib.text.Text) if text.get_text()}


def data(scene, ranks, *words):
    path = options.work / f"{scene}_{ranks}.vtkhdf"
    code, said = run(options.solve, ranks, SCENES / scene / f"{scene}.xml", "--scene-data", path, *words)
    check(f"{scene}, np{ranks}: data", (code, said.strip()), (0, str(path)))
    return path


def plane_and_space():
    """All side groups are named, as are all conditions, contacts and bodies; no label covers another one."""
    for scene, words in (("bracket", []), ("hertz_sphere", []), ("patch_3d", []), ("bolted_joint_3d", [])):
        scene_data = SceneData(data(scene, 1, *words))
        named, drawn = set(), {}
        for picture in scene_pictures(scene_data):
            if picture.name.startswith("groups"):
                named |= texts(picture.figure)
            else:
                check(f"{scene}, {picture.name}: labels", faults(picture.figure), [])
            drawn[picture.name] = texts(picture.figure)
        check(f"{scene}: pictures", {"scene", "groups"} <= set(drawn), True)
        check(f"{scene}: all sides are named", sorted(set(scene_data.fields.side_groups) - named), [])
        given = [*scene_data.parameter("Boundary Conditions"), *scene_data.parameter("Contact", default={})]
        lacking = [name for name in given if name not in drawn["scene"] and not any(f"{name}:" in text and "not drawn" in text for text in drawn["scene"])]
        check(f"{scene}: loads, supports and contacts are named", lacking, [])


def directions():
    """Supports of one component in any direction: the vectors along which they are drawn, and their values in words."""
    class Run:
        units, dimension = ("mm", "N", "MPa"), 3

    def support(dimension=3, **given):
        run = Run()
        run.dimension = dimension
        return Condition(run, "hold", {"Type": "Displacement", "Group": "bore", **{name.replace("_", " "): value for name, value in given.items()}})

    points = np.array([[1.0, 2.0, 7.0], [4.0, 6.0, -1.0]])
    along = support(Direction=[0.0, 3.0, 4.0], Value=[0.5])
    check("support along a direction", (along.axes_at(points).tolist(), along.direction.tolist(), along.amount()),
          ([[0.0, 0.6, 0.8]] * 2, [0.0, 0.3, 0.4], "u along (0, 3, 4) = 0.5 mm"))
    radial = support(Along="Radius", Direction=[0.0, 0.0, 2.0], Axis_Point=[1.0, 2.0, 0.0], Value=[0.0])
    check("radial support", radial.axes_at(points)[1].tolist(), [0.6, 0.8, 0.0])
    check("radial support in words", radial.amount(), "radial u about the axis through (1, 2, 0) along (0, 0, 2) = 0 mm")
    round_ = support(2, Along="Circumference", Expression="0.1*x")
    check("tangential support", np.abs(round_.axes_at(points) @ [[1.0, 4.0], [2.0, 6.0]]).diagonal().max() < 1e-15, True)
    check("tangential support: anticlockwise", bool(round_.axes_at(points)[0, 1] > 0), True)
    check("tangential support in words", round_.amount(), "tangential u about the axis through the origin = 0.1*x mm")
    check("other supports", [support(**given).axes_at(points) is None for given in ({"Value": [0.0] * 3}, {"Components": "xy", "Value": [0.0] * 2})], [True] * 2)


def ranks():
    """The file does not depend on the number of ranks, even if most of them have no part of the mesh."""
    for scene in ("two_blocks", "patch_3d"):
        one, four = (h5py.File(data(scene, count), "r") for count in (1, 4))
        names = []
        one.visititems(lambda name, item, names=names: names.append(name) if isinstance(item, h5py.Dataset) else None)
        same = [name for name in names if name not in four or not np.array_equal(one[name][()], four[name][()])]
        check(f"{scene}: the same file on 1 and 4 ranks", (same, len(names) > 10), ([], True))


def surfaces():
    """Areas of the named faces of two blocks, by hand: the faces of both at their joint have the same nodes' places."""
    scene = SceneData(data("press", 1, "--set", "Mesh/Boxes/lower/Cells={4, 4, 2}", "--set", "Mesh/Boxes/upper/Cells={4, 4, 2}"))
    surface = Surface(scene.fields)
    points = surface.at(scene.fields.points)
    body = surface.of_cells("Body")
    for name in scene.fields.side_groups:
        own = surface.of_groups([name])
        a, b, c = (points[surface.triangles[own][:, k]] for k in range(3))
        expected = 1.0 if name.endswith(("top", "bottom")) else 0.5
        check(f"press, {name}: area", 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum(), lambda found, expected=expected: abs(found - expected) < 1e-9)
        check(f"press, {name}: body", {scene.fields.names["Bodies"][k] for k in body[own]}, {name.split("_")[0]})
        scene.fields.group_cells = {}  # as in the fields of a run, which have the places of two vertices only
        check(f"press, {name}: the same faces by their places", np.array_equal(surface.of_groups([name]), own), True)
        scene.fields.group_cells = SceneData(options.work / "press_1.vtkhdf").fields.group_cells
    a, b, c = (points[surface.triangles[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->", 0.5 * np.cross(b - a, c - a), (a + b + c) / 9)
    check("press: volume inside the faces", volume, lambda found: abs(found - 1.0) < 1e-9)
    check("press: bodies", scene.fields.names["Bodies"], list(scene.parameter("Bodies")))


def command():
    """The command: default folder, --set, errors."""
    scene = options.work / "part.xml"
    scene.write_text((SCENES / "two_blocks" / "two_blocks.xml").read_text())
    out = options.work / "drawn"
    code, said = run(options.plot, 1, "--scene", scene, "--output", out, "--set", "Title=Changed title")
    check("suture_plot --scene", (code, sorted(path.name for path in out.iterdir())), (0, ["groups.png", "scene.png"]))
    code, said = run(options.plot, 1, "--scene", scene, "--output", out, "--set", "Contact/joint/Side A=uper")
    check("a wrong name is refused as by suture_solve", (code, "Did you mean" in said), lambda found: found[0] in (2, 3))
    for words, message in ((["--scene", options.work / "none.xml"], "there is no file"), (["--scene", scene, options.work], "is for runs"), ([], "missing"),
                           (["--set", "Title=x", options.work], "needs --scene")):
        code, said = run(options.plot, 1, *words)
        check(f"refused: {message}", (code in (2, 3), message in said), (True, True))
    code, said = run(options.plot, 1, "--scene", scene, "--output", out, "--factor", "3")
    check("--factor is for runs", (code, "for runs" in said), (2, True))
    code, said = run(options.plot, 1, "--scene", data("bracket", 1), "--output", options.work / "from_data")
    check("a data file, and names without use", (code, (options.work / "from_data" / "scene.png").is_file(), unused(SceneData(data("tunnel", 1)))),
          (0, True, ["tunnel_wall"]))


def drawn_by_check():
    """--check makes the pictures of suture_plot --scene, on any number of ranks; no failure of the drawing is one of the check."""
    scene, words = options.work / "checked.xml", ["--set", "Title=Changed title"]
    scene.write_text((SCENES / "two_blocks" / "two_blocks.xml").read_text())
    expected = options.work / "by_plot"
    check("suture_plot --scene", run(options.plot, 1, "--scene", scene, "--output", expected, *words)[0], 0)
    temporary = set(Path(tempfile.gettempdir()).glob("suture_check.*"))
    for ranks in (1, 4):
        out = options.work / f"by_check_{ranks}"
        code, said = run(options.solve, ranks, scene, "--check", "--output", out, *words)
        check(f"--check on {ranks}", (code, f"drawn: {out}/scene.png  {out}/groups.png" in said, sorted(path.name for path in out.iterdir())),
              (0, True, ["groups.png", "scene.png"]))
        check(f"--check on {ranks}: the same pictures", [name for name in ("scene.png", "groups.png") if
                                                         (out / name).read_bytes() != (expected / name).read_bytes()], [])
    out = options.work / "not_drawn"
    given = ["--check", "--output", out, *words]
    to_draw = f"to draw it: suture_plot --scene {scene} --set 'Title=Changed title' --set Output/Folder={out}"
    code, said = run(options.solve, 1, scene, *given, "--no-drawing")
    check("--no-drawing", (code, to_draw in said, out.exists()), (0, True, False))
    code, said = run(options.solve, 1, scene, *given, "--quiet")
    check("--quiet: no drawing", (code, "draw" in said, out.exists()), (0, False, False))
    code, said = run(options.solve, 1, scene, "--output", out, "--no-drawing")
    check("--no-drawing needs --check", (code, "--check" in said), (2, True))
    code, said = run(options.solve, 1, scene, *given, "--set", "Contact/joint/Side A=uper")
    check("a scene with errors is not drawn", (code, out.exists()), (3, False))
    # A copy of suture_solve without suture_plot beside it, then with programs that fail.
    alone = options.work / "alone"
    alone.mkdir()
    copy = shutil.copy(options.solve, alone)
    path = {**os.environ, "PATH": str(alone)}
    for name, script, reason in (("no program", None, "not drawn: suture_plot is neither beside suture_solve nor on the PATH"),
                                 ("a reason", "#!/bin/sh\necho 'suture_plot: modules are missing' >&2; exit 5\n", "not drawn: modules are missing"),
                                 ("a signal", "#!/bin/sh\nkill -9 $$\n", "not drawn: suture_plot did not run"),
                                 ("not a program", "#!/none\n", "not drawn: suture_plot did not run")):
        if script:
            (alone / "suture_plot").write_text(script)
            (alone / "suture_plot").chmod(0o755)
        done = subprocess.run([copy, str(scene), *map(str, given)], capture_output=True, text=True, env=path, timeout=60 * SLOWER)
        check(f"drawing fails, {name}", (done.returncode, reason in done.stdout, to_draw in done.stdout, done.stderr), (0, True, True, ""))
    check("no temporary files are left", set(Path(tempfile.gettempdir()).glob("suture_check.*")) - temporary, set())


def square(low, high, n=8):
    """Anticlockwise outline of a square."""
    t = np.linspace(0, 1, n, endpoint=False)[:, None]
    corner = np.array([[low, low], [high, low], [high, high], [low, high]], dtype=float)
    return np.concatenate([corner[k] + t * (corner[(k + 1) % 4] - corner[k]) for k in range(4)])


def enlargement():
    """Plate with a square hole, whose walls approach each other: by hand."""
    outside, hole = square(-5, 5), square(-1, 1)[::-1]
    starts = np.concatenate([outside, hole])
    ends = np.concatenate([np.roll(outside, -1, axis=0), np.roll(hole, -1, axis=0)])

    def moved(points):
        return np.where(np.abs(points).max(axis=1, keepdims=True) < 2, -0.01 * points * [1, 0], 0.0)

    width, change = gaps_of_outline(starts, ends, moved(starts), moved(ends), True)
    check("hole: its width, in both directions", (width.min(), width.max()), lambda found: abs(found[0] - 2) < 1e-9 and abs(found[1] - 2) < 1e-9)
    check("hole: its walls approach by 0.02", change.min(), lambda found: abs(found + 0.02) < 1e-9)
    check("hole: a fifth of its width stays open", limit(width, change, 1e-3), lambda found: abs(found - 0.8 * 2 / 0.02) < 1e-6)
    # Two squares with a gap of 0.1, which the solution closes to 0.04; then one that it closes.
    for closing, slack, expected in ((0.06, 1e-3, 0.8 * 0.1 / 0.06), (0.1, 1e-3, (0.1 + 1e-3) / 0.1)):
        left, right = square(0, 1), square(0, 1) + [1.1, 0]
        starts, ends = np.concatenate([left, right]), np.concatenate([np.roll(left, -1, axis=0), np.roll(right, -1, axis=0)])
        width, change = gaps_of_outline(starts, ends, np.where(starts[:, :1] > 1.05, [-closing, 0], 0.0), np.where(ends[:, :1] > 1.05, [-closing, 0], 0.0), True)
        check(f"gap closes by {closing}", limit(width, change, slack), lambda found, expected=expected: abs(found - expected) < 1e-6)
    cube = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
    faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    triangles = np.array([[f[0], f[k], f[k + 1]] for f in faces for k in (1, 2)])
    points, both = np.concatenate([cube, cube + [0, 0, 1.5]]), np.concatenate([triangles, triangles + 8])
    width, change = gaps_of_surface(points, np.where(points[:, 2:] > 1.2, [0, 0, -0.05], 0.0), both)
    check("cubes: the gap between them, and its change", (width.min(), width.max(), change.min(), change.max()),
          lambda found: np.allclose(found, (0.5, 0.5, -0.05, -0.05)))


def factors():
    """Factors of load steps, by hand."""
    values = {"t": 0.25, "pi": np.pi, "a": 3.0}
    for text, expected in (("sin(2*pi*t)", 1.0), ("min(t, 1)", 0.25), ("t < 0.5 ? 2*t : a", 0.5), ("a*t^2 + 1", 1.1875), ("t > 0.1 && t < 0.2 ? 1 : 0", 0.0), ("-t^2", -0.0625)):
        check(f"factor {text}", evaluated(text, values), lambda found, expected=expected: abs(found - expected) < 1e-12)
    scene = SceneData(options.work / "bracket_1.vtkhdf")
    scene.fields.parameters["Load Steps"] = {"Times": [0.5, 1.0], "Factors": {"load": [0.5, 2.0], "other": "f(t)"}}
    check("values at times", [factor_at(scene, "load", time) for time in (0.25, 0.5, 0.75)], [0.25, 0.5, 1.25])
    check("no factor; unknown factor", (factor_at(scene, "none", 0.3), factor_at(scene, "other", 0.3)), (1.0, None))


for part in (plane_and_space, directions, ranks, surfaces, command, drawn_by_check, enlargement, factors):
    part()
finish()
