#!/usr/bin/python3
"""Pictures of bodies that move far: rings and sections where the bodies are, side groups on the drawn bodies; panels of rigid groups in steps.png.

    moving_pictures.py --solve suture_solve --plot suture_plot --input DIR --work DIR --mpirun "..."
"""
import csv
import json
import math
import sys
from pathlib import Path

from harness import arguments, check, finish, forked, run

options = arguments("--solve", "--plot", "--input")
sys.path.insert(0, str(Path(options.plot).resolve().parent))

import matplotlib  # noqa: E402
import numpy as np  # noqa: E402
from picture_faults import faults  # noqa: E402
from suture_plot_parts.pictures import pictures  # noqa: E402
from suture_plot_parts.run import RunFolder  # noqa: E402
from suture_plot_parts.steps import steps_figure  # noqa: E402

HERE = Path(__file__).parent


def solved(name, scene):
    folder = options.work / name
    check(f"{name}: exit code of the run", run(options.solve, 1, scene, "--output", folder)[0], 0)
    return folder


def drawn(folder):
    """{name: picture}, with labels that cover nothing."""
    found = {picture.name: picture for picture in pictures(RunFolder(folder))}
    for name, picture in found.items():
        check(f"{folder.name}, {name}: labels", faults(picture.figure), [])
    return found


def words(figure):
    return " | ".join(text.get_text().replace("\n", " ") for text in figure.findobj(matplotlib.text.Text) if text.get_text())


def rings(figure):
    return [np.array([float(values[0]) for values in line.get_data()]) for line in figure.findobj(matplotlib.lines.Line2D) if line.get_gid() == "marked"]


def moved(run_):
    return run_.fields.points + run_.fields.point_data["Displacement"]


def groups_on_drawn_bodies(name, run_):
    """Each end of a side is a node of the drawn mesh."""
    size = np.ptp(run_.fields.points, axis=0).max()
    off = {group: np.linalg.norm(rows.reshape(-1, 1, 3) - run_.fields.points, axis=2).min(axis=1).max()
           for group, rows in run_.fields.side_groups.items() if len(rows)}
    check(f"{name}: side groups on the drawn bodies", [group for group, distance in off.items() if distance > 1e-9 * size], [])


# In 2D: the ring of the largest stress is on the element that has it.
block = solved("sliding_block", Path(options.input) / "sliding_block" / "sliding_block.xml")
found, folder = drawn(block), RunFolder(block)
grid = folder.fields.moved(moved(folder))
(place,) = rings(found["von_mises"].figure)
nearest = np.argmin(np.hypot(*(grid.centroids - place).T))
largest = folder.summary["extremes"]["von_mises"]["value"]
check("2D: ring of the largest stress", abs(grid.cell_data["VonMises"][nearest] / largest - 1), lambda part: part < 1e-9)
check("2D: far from where it is drawn", np.hypot(*(folder.fields.centroids[nearest] - place)), lambda way: way > 1.9)
(x0, x1) = found["von_mises"].figure.axes[0].get_xlim()
check("2D: all of both bodies is in the picture", x0 < moved(folder)[:, 0].min() and x1 > moved(folder)[:, 0].max(), True)
groups_on_drawn_bodies("2D", folder)

# In 3D: the default section is through the largest pressure, and contains the line of the contact.
space = solved("sliding_block_3d", HERE / "sliding_block_3d.xml")
found, folder = drawn(space), RunFolder(space)
text = words(found["von_mises_cut"].figure)
check("3D: the section passes through the contact", "contact, closed" in text, True)
check("3D: where the block is", found["von_mises_cut"].caption, lambda caption: "bodies where they are" in caption)
places = moved(folder)
block_points = places[folder.fields.point_data["Displacement"][:, 0] > 1.0]
outline = np.concatenate([line.get_segments() for line in found["von_mises_cut"].figure.findobj(matplotlib.collections.LineCollection)
                          if line.get_zorder() == 4]).reshape(-1, 2)
on_top = outline[outline[:, 1] > 0.5]
check("3D: the block in the section", (on_top[:, 0].min() >= block_points[:, 0].min() - 1e-6, on_top[:, 0].max() <= block_points[:, 0].max() + 1e-6),
      (True, True))
groups_on_drawn_bodies("3D", folder)

# A table of rigid groups by hand: a shaft that turns and travels, one that only turns, a slide without rotation, a held group.
COLUMNS = [field["name"] for field in json.loads((HERE.parents[1] / "doc" / "schema" / "rigid_groups.schema.json").read_text())["fields"]]
TIMES = [float(row["time"]) for row in csv.DictReader((block / "steps.csv").open())]
GROUPS = {"shaft": {"displacement_x": 2.0, "displacement_y": -0.5, "rotation_z": -1.5, "fx": 30.0, "fy": -400.0, "mz": 7.0},
          "wheel": {"displacement_x": 1e-16, "rotation_z": 1.25, "fy": 55.0, "mz": -9.0}, "slide, right": {"displacement_y": -3.0, "fy": -80.0, "mz": 11.0},
          "held": {"displacement_x": 1e-17, "rotation_z": 1e-18, "fy": 1000.0, "mz": 20.0}}


def write(rows):
    with open(block / "rigid_groups.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, COLUMNS, restval=0)
        table.writeheader()
        table.writerows(rows)


def panels(folder):
    """{label of the panel: {label of the line: (times, values)}} of rigid groups."""
    figure, left_out = steps_figure(RunFolder(folder))
    check("groups: labels", faults(figure), [])
    check("groups: nothing is left out", left_out, [])
    return {axes.get_ylabel(): {line.get_label(): tuple(map(list, line.get_data())) for line in axes.lines if not line.get_label().startswith("_")}
            for axes in figure.axes if axes.get_ylabel().startswith(("rotation", "travel", "moment", "force on group"))}


(block / "rigid_groups.csv").unlink(missing_ok=True)
check("without the table: no panels", panels(block), {})
write([{"step": number + 1, "time": time, "group": name, **{key: value * (number + 1) / len(TIMES) for key, value in group.items()}}
       for number, time in enumerate(TIMES) for name, group in GROUPS.items()])


def path(largest):
    """From zero at time 0."""
    return [0.0, *TIMES], [0.0, *(largest * (number + 1) / len(TIMES) for number in range(len(TIMES)))]


expected = {"rotation [rad]": {"shaft, z": path(-1.5), "wheel, z": path(1.25)}, "travel [mm]": {"shaft, x": path(2.0), "slide, right, y": path(-3.0)},
            "moment [N mm]": {"shaft, z": path(7.0), "wheel, z": path(-9.0)}, "force on group [N]": {"shaft, y": path(-400.0), "slide, right, y": path(-80.0)}}
found = panels(block)
check("groups: panels", {label: list(lines) for label, lines in found.items()}, {label: list(lines) for label, lines in expected.items()})
check("groups: values", all(math.isclose(a, b, rel_tol=1e-12, abs_tol=1e-12) for label, lines in expected.items() for name, (times, values) in lines.items()
                            for a, b in zip([*times, *values], [part for parts in found.get(label, {}).get(name, ([], [])) for part in parts], strict=True)), True)
(caption,) = [picture.caption for picture in pictures(RunFolder(block)) if picture.name == "steps"]
check("groups: in the caption", "rigid groups" in caption, True)

# The error of a transmission is not zero at the beginning.
transmission = block / "transmission_gear_1_2.csv"
transmission.write_text("step,time,driving,driven,error,driving_load,driven_load\n" +
                        "".join(f"{number + 1},{time},0,0,{0.5 + number},0,0\n" for number, time in enumerate(TIMES)))
figure, left_out = steps_figure(RunFolder(block))
check("transmission: labels", faults(figure), [])
lines = {line.get_label(): tuple(map(list, line.get_data())) for axes in figure.axes if axes.get_ylabel() == "error [rad]" for line in axes.lines
         if not line.get_label().startswith("_")}
check("transmission: panel", lines, {"transmission gear_1_2": (list(TIMES), [0.5 + number for number in range(len(TIMES))])})
transmission.write_text("step,time\n1,1\n")
code, said = forked(options.plot, block)
check("transmission: damaged", (code, "transmission_gear_1_2.csv is damaged" in said, "Traceback" in said), (3, True, False))
transmission.unlink()

good = (block / "rigid_groups.csv").read_text()
for name, text in (("a word", good.replace("30.0", "much", 1).replace("6.0", "much", 1)), ("no column", good.replace("rotation_z", "angle", 1)),
                   ("cut off", good[:len(good) // 2])):
    (block / "rigid_groups.csv").write_text(text)
    code, said = forked(options.plot, block)
    check(f"groups, {name}: damaged", (code, "rigid_groups.csv is damaged" in said, "Traceback" in said), (3, True, False))
finish()
