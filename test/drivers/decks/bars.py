"""Small decks of bars, their conversion and solution, and entries of the scenes."""
import xml.etree.ElementTree as xml

import h5py
import harness
import numpy as np
from grids import listed
from harness import check, forked, run

MATERIAL = "*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.\n*DENSITY\n2.\n*EXPANSION\n1.E-3\n"
ELEMENTS = {"2": [(0, 0), (1, 0), (1, 1), (0, 1)], "3": [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]}


class Bar:
    """`count` square cells in a row along x from `begin`, of the size `size`; node labels from `first` + 1"""

    def __init__(self, count, begin=0.0, first=0, size=1.0, y=0.0, dimension=3):
        self.nodes, self.elements, label = {}, {}, {}
        for cell in range(count):
            corners = []
            for corner in ELEMENTS[str(dimension)]:
                at = (corner[0] + cell, *corner[1:])
                if at not in label:
                    label[at] = first + len(label) + 1
                    self.nodes[label[at]] = [begin + size * at[0], y + size * at[1], *(size * z for z in at[2:]), 0.0][:3]
                corners.append(label[at])
            self.elements[first + cell + 1] = corners

    def at(self, x):
        return [label for label, point in self.nodes.items() if abs(point[0] - x) < 1e-9]

    def text(self, set_, type_="C3D8I"):
        nodes = "".join(f"{label}, {', '.join(map(repr, map(float, point)))}\n" for label, point in self.nodes.items())
        return "*NODE\n" + nodes + f"*ELEMENT, TYPE={type_}, ELSET={set_}\n" + "".join(listed([e, *n]) for e, n in self.elements.items())


def nset(name, labels):
    return f"*NSET, NSET={name}\n" + listed(labels)


def bar_deck(step, model="", bar=None, type_="C3D8I", section="", support="*BOUNDARY\nleft, 1, 3\n"):
    bar = bar or Bar(4)
    ends = nset("left", bar.at(0)) + nset("right", bar.at(4)) + nset("all", list(bar.nodes))
    return (bar.text("E", type_) + ends + MATERIAL + f"*SOLID SECTION, ELSET=E, MATERIAL=M\n{section}" + model + support
            + "*STEP\n*STATIC\n" + step + "*END STEP\n")


def convert(name, text, *words):
    source = harness.options.work / f"{name}.inp"
    source.write_text(text)
    return forked(harness.options.convert, source, "--scene", source.parent / f"{name}.xml", "--force", *words)


def solved(name, text, *words):
    """(points, displacements) of a deck's scene, console output of the conversion; None after a failure"""
    work = harness.options.work
    code, said = convert(name, text)
    check(f"{name}: exit code of suture_convert", (code, said if code else ""), (0, ""))
    if code:
        return None, said
    code, log = run(harness.options.solve, 1, work / f"{name}.xml", "--output", work / name, *words)
    check(f"{name}: exit code of suture_solve", (code, log if code else ""), (0, ""))
    if code:
        return None, said
    last = sorted((work / name).glob("fields_*.vtkhdf"))[-1]
    with h5py.File(last) as file:
        return (file["VTKHDF/Points"][:], file["VTKHDF/PointData/Displacement"][:]), said


def end_of(name, text, expected, component=0, x=4.0, left=False):
    """Checks the mean displacement of the section at x of a bar."""
    fields, said = solved(name, text)
    if fields is None:
        return
    points, u = fields
    mean = u[np.abs(points[:, 0] - x) < 1e-9][:, component].mean()
    check(f"{name}: displacement {mean:.6g} of {expected:.6g}", abs(mean - expected) < 1e-6 * abs(expected), True)
    check(f"{name}: lists what it does not take over", "not taken over" in said, left)


def scene(name):
    return xml.parse(harness.options.work / f"{name}.xml").getroot()


def entry(root, *path):
    for name in path:
        root = next((child for child in root if child.get("name") == name), None)
        if root is None:
            return None
    return root.get("value") if root.tag == "Parameter" else root
