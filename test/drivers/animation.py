#!/usr/bin/python3
"""suture_plot --animation: number of frames and their durations, bodies that move by the displacements of frames.csv, measured in pixels, in 2D
and 3D; the report; bounded memory; clear errors.

    animation.py --solve suture_solve --plot suture_plot --input DIR --work DIR --mpirun "..."
"""
import base64
import csv
import json
import os
import re
import resource
import shutil
from pathlib import Path

import numpy as np
from harness import SANITIZED, arguments, check, finish, forked, run, setting
from PIL import Image

options = arguments("--solve", "--plot", "--input")
INPUT, HERE = Path(options.input), Path(__file__).parent


def solved(name, scene, *more):
    folder = options.work / name
    check(f"{name}: exit code of the run", run(options.solve, 1, scene, "--output", folder, *more)[0], 0)
    return folder


def animated(folder, *more):
    """Exit code and output."""
    code, text = forked(options.plot, folder, "--animation", *more)
    check(f"{folder.name} {' '.join(map(str, more))}: no traceback", "Traceback" in text, False)
    return code, text


def frames_of(path):
    """(images as arrays, durations in milliseconds)"""
    images, durations = [], []
    with Image.open(path) as animation:
        for number in range(animation.n_frames):
            animation.seek(number)
            durations.append(animation.info["duration"])
            images.append(np.asarray(animation.convert("RGB")).astype(int))
    return images, durations


def bodies(image):
    """Pixels of bodies: coloured ones, up to the first gap between columns, beyond which is the colour bar."""
    coloured = np.ptp(image, axis=2) > 40
    used = np.flatnonzero(coloured.any(axis=0))
    gap = np.flatnonzero(np.diff(used) > 5)
    coloured[:, used[gap[0]] + 1 if len(gap) else None:] = False
    return coloured


def above(image, length):
    """(pixels of the body above a wide base, pixels per length). `length`: of the base"""
    found = bodies(image)
    width = found.sum(axis=1)
    base = np.flatnonzero(width > 0.97 * width.max())
    columns = np.flatnonzero(found[base[len(base) // 2]])
    upper = found.copy()
    upper[base[0] - 3:] = False  # without the outline of the base
    return upper, (columns[-1] + 1 - columns[0]) / length


def centre(pixels):
    return np.argwhere(pixels).mean(axis=0)[::-1]


def rows_of(folder, table):
    with open(folder / table, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def moves(name, images, folder, body, length, factor=1.0):
    """The body above the base moves to the right by the displacements of frames.csv, to half a pixel."""
    expected = [float(row["displacement_x"]) for row in rows_of(folder, "frames.csv") if row["body"] == body]
    found = [above(image, length) for image in images]
    for number, (pixels, scale) in enumerate(found):
        way, wanted = centre(pixels)[0] - centre(found[0][0])[0], factor * (expected[number] - expected[0]) * scale
        check(f"{name}, frame {number + 1}: moves by {wanted:.2f} pixels", way, lambda way, wanted=wanted: abs(way - wanted) < 0.5)
    check(f"{name}: far enough to be measured", factor * (expected[-1] - expected[0]) * found[0][1], lambda pixels: pixels > 20)


def in_proportion(name, durations, folder):
    """Each frame lasts until the time of the next step, to a hundredth of a second, the last one for a second."""
    parts = np.diff([float(row["time"]) for row in rows_of(folder, "steps.csv")])
    shown, wanted = np.array(durations[:-1]), sum(durations[:-1]) * parts / parts.sum()
    check(f"{name}: durations", (np.abs(shown - wanted).max() <= 10, durations[-1]), (True, 1000))


# A block slides by 2 mm on a base of 12.1 mm.
block = solved("sliding_block", INPUT / "sliding_block" / "sliding_block.xml")
code, text = animated(block)
check("block: suture_plot", (code, "animation.gif" in text), (0, True))
images, durations = frames_of(block / "animation.gif")
check("block: one frame per step", len(images), len(rows_of(block, "steps.csv")))
check("block: two seconds, then the last frame", durations, [500, 500, 500, 500, 1000])
moves("block", images, block, "block", 12.1)
report = (block / "report.html").read_text(encoding="utf-8")
(embedded,) = re.findall(r'<figure id="picture_animation"[^>]*><img src="data:image/gif;base64,([^"]*)"', report)
check("block: in the report", base64.b64decode(embedded), (block / "animation.gif").read_bytes())
least = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss

# 200 load steps: 80 frames, the first and the last step among them, one at a time in memory.
many, count = options.work / "many", 200
many.mkdir()
rows = rows_of(block, "steps.csv")
for step in range(count):
    for kind in ("fields", "contact"):
        (many / f"{kind}_{step:04d}.vtkhdf").symlink_to(block / f"{kind}_{step * 5 // count:04d}.vtkhdf")
with open(many / "steps.csv", "w", newline="", encoding="utf-8") as file:
    table = csv.DictWriter(file, rows[0])
    table.writeheader()
    table.writerows({**rows[0], "step": step + 1, "time": step + 1} for step in range(count))
summary = json.loads((block / "summary.json").read_text())
summary["load_steps"]["count"] = count
(many / "summary.json").write_text(json.dumps(summary))
code, text = animated(many)
check("many: suture_plot", (code, "animation.gif shows 80 of 200 load steps" in text), (0, True))
images, durations = frames_of(many / "animation.gif")
check("many: frames", len(images), 80)
ends = [centre(above(images[place], 12.1)[0])[0] for place in (0, -1)]
way = float([row for row in rows_of(block, "frames.csv") if row["body"] == "block"][-1]["displacement_x"]) * above(images[0], 12.1)[1]
check("many: the first and the last step", ends[1] - ends[0] - way, lambda apart: abs(apart) < 0.5)
check("many: not too short", min(durations), lambda shortest: shortest >= 40)
if not SANITIZED:
    more = (resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss - least) / 1024
    check("many: memory [MB] beyond that of five frames", more, lambda more: more < 40)

# Reduced displacements: half of the way, as the title states.
half = options.work / "half"
check("half: suture_plot", animated(block, "--output", half, "--factor", 0.5)[0], 0)
moves("half", frames_of(half / "animation.gif")[0], block, "block", 12.1, 0.5)

# Without the option: no animation in the report; that of an earlier run is removed.
check("without the option: suture_plot", forked(options.plot, block)[0], 0)
check("without the option: the file stays", ((block / "animation.gif").is_file(), "image/gif" in (block / "report.html").read_text(encoding="utf-8")),
      (True, False))
os.utime(block / "animation.gif", (1.0, 1.0))
forked(options.plot, block)
check("of an earlier run: removed", (block / "animation.gif").exists(), False)

# A roller rolls to the right on a plane of 40 mm; long steps are halved.
roller = solved("roller", INPUT / "roller" / "roller.xml", *setting("Load Steps/Times", "{1, 2, 4, 5, 6}"))
check("roller: suture_plot", animated(roller)[0], 0)
images, durations = frames_of(roller / "animation.gif")
check("roller: one frame per step", len(images), len(rows_of(roller, "steps.csv")))
in_proportion("roller", durations, roller)
moves("roller", images, roller, "roller", 40.0)

# In 3D, seen from the front: a block slides along a base of 16.3 mm and turns by 0.6.
space = solved("sliding_block_3d", HERE / "sliding_block_3d.xml")
check("3D: suture_plot", animated(space, "--view=0,-1,0")[0], 0)
images, durations = frames_of(space / "animation.gif")
check("3D: one frame per step", len(images), 3)
in_proportion("3D", durations, space)
moves("3D", images, space, "block", 16.3)
for number, (image, row) in enumerate(zip(images, [row for row in rows_of(space, "frames.csv") if row["body"] == "block"])):
    pixels, scale = above(image, 16.3)
    angle = float(row["rotation_z"])
    wide = np.ptp(np.flatnonzero(pixels.any(axis=0))) + 1
    check(f"3D, frame {number + 1}: as wide as a square turned by {angle:g}", wide - 4.0 * (np.cos(angle) + np.sin(angle)) * scale,
          lambda apart: abs(apart) < 2.5)
check("3D: in the report", "data:image/gif" in (space / "report.html").read_text(encoding="utf-8"), True)

# Parts of a tunnel are removed between load steps: the mesh of the last step is another one.
tunnel = solved("driven_tunnel", INPUT / "driven_tunnel" / "driven_tunnel.xml")
check("tunnel: suture_plot", animated(tunnel)[0], 0)
images, _ = frames_of(tunnel / "animation.gif")
middles = []
for image in (images[0], images[-1]):
    found = bodies(image)
    rows, columns = (np.flatnonzero(found.any(axis=axis)) for axis in (1, 0))
    row, column = (rows[0] + rows[-1]) // 2, (columns[0] + columns[-1]) // 2
    middles.append(np.count_nonzero(found[row - 3:row + 4, column - 3:column + 4]))
check("tunnel: rock in its middle at first, none at the end", middles, lambda counts: counts[0] > 30 and counts[1] == 0)

# Clear errors.
steady = solved("linear_square", INPUT / "linear_square" / "linear_square.xml")
bare = solved("bare", INPUT / "sliding_block" / "sliding_block.xml", *setting("Output/Fields", "false"))
for name, folder, words in (("no load steps", steady, "--animation: the run of"), ("no fields", bare, "wrote no fields")):
    code, text = animated(folder)
    check(f"{name}: refused before anything is drawn", (code, words in text, any(folder.glob("*.png"))), (3, True, False))
for name, spoil, words in (("a missing step", lambda path: path.unlink(), "has no fields_0002.vtkhdf, the fields of load step 3"),
                           ("a damaged step", lambda path: path.write_bytes(b"none"), "fields_0002.vtkhdf is not a field file")):
    folder = options.work / name.replace(" ", "_")
    shutil.copytree(block, folder)
    spoil(folder / "fields_0002.vtkhdf")
    code, text = animated(folder)
    check(f"{name}: named", (code, words in text, list(folder.glob("animation.gif*"))), (3, True, []))
(block / "animation.gif.part").mkdir()
code, text = animated(block)
check("a file that cannot be written", (code, "animation.gif.part" in text), (5, True))
code, text = forked(options.plot, "--scene", INPUT / "sliding_block" / "sliding_block.xml", "--animation")
check("of a scene", (code, "--animation is for runs" in text), (2, True))
study = options.work / "study"
study.mkdir()
(study / "study.json").write_text("{}")
code, text = forked(options.plot, study, "--animation")
check("of a study", (code, "--animation is for runs" in text), (2, True))
finish()
