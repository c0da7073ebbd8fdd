"""Decks in several dialects, each with loads and contact, generated from grids. Each sample has a deck for CalculiX and one in its own dialect.

samples.py NAME [--ccx]   prints a deck
"""
import sys

import numpy as np
from grids import Grid, PlaneGrid, listed

STEEL = "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n"
# Stiff contact of CalculiX: penetrations are far below the displacements.
HARD = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{stiffness}\n"


def near(value, other):
    return abs(value - other) < 1e-9


def prints(contacts, forces="foot"):
    """Output requests of CalculiX that the comparison reads"""
    text = f"*NODE PRINT, NSET=probes\nU\n*NODE PRINT, NSET={forces}, TOTALS=ONLY\nRF\n"
    return text + "".join(f"*CONTACT PRINT, SLAVE={slave}, MASTER={master}\nCF\n" for slave, master in contacts)


def probes_text(labels):
    return "*NSET, NSET=probes\n" + listed(labels)


def press(ccx):
    """Abaqus with parts: a block, turned by 90 degrees, is pressed onto a plate and then pushed; friction, two steps, an amplitude."""
    plate = Grid((6, 6, 2), (0, 0, 0), (24, 24, 6), "hex20")
    block = Grid((4, 4, 4), (0, 0, 0), (8, 10, 12), "hex20")

    def turned(point):  # by 90 degrees about z: (x, y) -> (-y, x); then moved
        return np.array([17 - point[1], 8 + point[0], 6 + point[2]])

    top, low, upper, side = plate.layer(2, 1), block.layer(2, 0), block.layer(2, 1), block.layer(1, 1)
    steps = """*STEP
*STATIC
0.5, 1.
*DSLOAD
{upper}, P, 40.
{prints}*END STEP
*STEP
*STATIC
0.2, 1.
*DSLOAD{amplitude}
{side}, P, 12.
{prints}*END STEP
"""
    if ccx:
        offset, first = plate.next_node - 1, plate.next_element - 1
        points = {label + offset: turned(point) for label, point in block.points.items()}
        text = "*NODE, NSET=Nall\n" + plate.nodes_text() + "".join(f"{n}, {x:.12g}, {y:.12g}, {z:.12g}\n" for n, (x, y, z) in points.items())
        text += "*ELEMENT, TYPE=C3D20, ELSET=PLATE\n" + plate.elements_text()
        text += "*ELEMENT, TYPE=C3D20, ELSET=BLOCK\n" + "".join(listed([e + first, *(n + offset for n in nodes)]) for e, nodes in block.elements.items())
        for name, labels, face in (("M", top, "S2"), ("S", [e + first for e in low], "S1"), ("UPPER", [e + first for e in upper], "S2"),
                                   ("SIDE", [e + first for e in side], "S5")):
            text += f"*SURFACE, NAME={name}\n" + "".join(f"{e}, {face}\n" for e in labels)
        text += "*NSET, NSET=foot\n" + listed(plate.nodes_where(lambda x, y, z: z == 0))
        text += probes_text([n + offset for n in block.nodes_where(lambda x, y, z: z in (0, 12) and x in (0, 8))]
                            + plate.nodes_where(lambda x, y, z: near(z, 6) and near(x, 12)))
        text += STEEL + "*SOLID SECTION, ELSET=PLATE, MATERIAL=STEEL\n*SOLID SECTION, ELSET=BLOCK, MATERIAL=STEEL\n"
        text += "*SURFACE INTERACTION, NAME=SI\n" + HARD.format(stiffness="2.e7") + "*FRICTION\n0.5, 2.e6\n"
        text += "*CONTACT PAIR, INTERACTION=SI, TYPE=SURFACE TO SURFACE\nS, M\n*BOUNDARY\nfoot, 1, 3\n"
        text += "*AMPLITUDE, NAME=LATE\n0., 0., 0.5, 0.5, 1., 1.\n"
        return text + steps.format(upper="UPPER", side="SIDE", amplitude=", AMPLITUDE=LATE", prints=prints([("S", "M")]))
    return f"""*Heading
** Job name: press
Block pressed onto a plate
*Preprint, echo=NO, model=NO
*Part, name=Plate
*Node
{plate.nodes_text()}*Element, type=C3D20
{plate.elements_text()}*Elset, elset=Set-1, generate
 1, {plate.next_element - 1}, 1
** Section: steel
*Solid Section, elset=Set-1, material=Steel
,
*End Part
*Part, name=Block
*Node
{block.nodes_text()}*Element, type=C3D20
{block.elements_text()}*Elset, elset=Set-1, generate
 1, {block.next_element - 1}, 1
*Solid Section, elset=Set-1, material=Steel
,
*End Part
*Assembly, name=Assembly
*Instance, name=Plate-1, part=Plate
*End Instance
*Instance, name=Block-1, part=Block
 17., 8., 6.
 17., 8., 6., 17., 8., 7., 90.
*End Instance
*Surface, type=ELEMENT, name=m_Surf
_m_Surf_S2, S2
*Elset, elset=_m_Surf_S2, internal, instance=Plate-1
{listed(top)}*Elset, elset=_s_Surf_S1, internal, instance=Block-1
{listed(low)}*Surface, type=ELEMENT, name=s_Surf
_s_Surf_S1, S1
*Elset, elset=_upper_S2, internal, instance=Block-1
{listed(upper)}*Surface, type=ELEMENT, name=upper
_upper_S2, S2
*Elset, elset=_side_S5, internal, instance=Block-1
{listed(side)}*Surface, type=ELEMENT, name=side
_side_S5, S5
*Nset, nset=foot, instance=Plate-1
{listed(plate.nodes_where(lambda x, y, z: z == 0))}*End Assembly
*Amplitude, name=Late
 0., 0., 0.5, 0.5, 1., 1.
*Material, name=Steel
*Elastic
210000., 0.3
*Surface Interaction, name=IntProp-1
1.,
*Friction, slip tolerance=0.005
 0.5,
*Surface Behavior, pressure-overclosure=HARD
*Contact Pair, interaction=IntProp-1, type=SURFACE TO SURFACE
s_Surf, m_Surf
*Boundary
foot, ENCASTRE
{steps.format(upper="upper", side="side", amplitude=", amplitude=Late", prints="*Output, field, variable=PRESELECT" + chr(10))}"""


def strip(ccx):
    """CalculiX, flat: two strips with different expansion, tied with meshes that do not match, are heated and bend."""
    lower = Grid((10, 2, 2), (0, 0, 0), (50, 4, 2), "hex20")
    upper = Grid((14, 3, 2), (0, 0, 2), (50, 4, 4), "hex20", lower.next_node, lower.next_element)
    tie = [f"{e}, S1" for e in upper.layer(2, 0)], [f"{e}, S2" for e in lower.layer(2, 1)]
    free = lower.nodes_where(lambda x, y, z: near(x, 50) and z == 0) + upper.nodes_where(lambda x, y, z: near(x, 50) and near(z, 4))
    text = "** two tied strips\n*NODE, NSET=Nall\n" + lower.nodes_text() + upper.nodes_text()
    text += "*ELEMENT, TYPE=C3D20, ELSET=Elow\n" + lower.elements_text() + "*ELEMENT, TYPE=C3D20, ELSET=Ehigh\n" + upper.elements_text()
    text += "*NSET, NSET=foot\n" + listed(lower.nodes_where(lambda x, y, z: x == 0)) + probes_text(free)
    text += "*SURFACE, NAME=Sslave\n" + "\n".join(tie[0]) + "\n*SURFACE, NAME=Smaster\n" + "\n".join(tie[1]) + "\n"
    text += "*MATERIAL, NAME=BRASS\n*ELASTIC\n105000., 0.34\n*EXPANSION, ZERO=20.\n1.9E-5\n*MATERIAL, NAME=INVAR\n*ELASTIC\n140000., 0.29\n"
    text += "*EXPANSION, ZERO=20.\n1.2E-6\n*SOLID SECTION, ELSET=Elow, MATERIAL=BRASS\n*SOLID SECTION, ELSET=Ehigh, MATERIAL=INVAR\n"
    text += "*TIE, NAME=T1, POSITION TOLERANCE=0.01\nSslave, Smaster\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNall, 20.\n"
    text += "*BOUNDARY\nfoot, 1, 3\n*STEP\n*STATIC\n*TEMPERATURE\nNall, 120.\n"
    return text + prints([]) + "*NODE FILE\nU, NT\n*EL FILE\nS\n*END STEP\n"


def bolt(ccx, shortening=None):
    """PrePoMax: a quarter of a square bolt, tied to a sleeve at its nut, clamps it by 3 kN, or by a given shortening of the bolt."""
    def is_bolt(c):
        return (c[0] < 4 and c[1] < 4) or c[2] < 6 or c[2] > 24

    bolt_ = Grid((4, 4, 10), (0, 0, 0), (8, 8, 30), "hex20", keep=is_bolt)
    sleeve = Grid((4, 4, 6), (0, 0, 6), (8, 8, 24), "hex20", bolt_.next_node, bolt_.next_element, keep=lambda c: c[0] > 4 or c[1] > 4)
    outside = [lambda c: c[0] > 4 or c[1] > 4][0]
    head = [e for e, cell in bolt_.cell_of.items() if cell[2] == 8 and outside(bolt_.place([2 * c + 1 for c in cell]))]
    nut = [e for e, cell in bolt_.cell_of.items() if cell[2] == 1 and outside(bolt_.place([2 * c + 1 for c in cell]))]
    cut = [e for e, cell in bolt_.cell_of.items() if cell[2] == 5]
    reference = sleeve.next_node
    sets = {"Nut_on_sleeve": (nut, "S2"), "Sleeve_bottom": (sleeve.layer(2, 0), "S1"), "Head_on_sleeve": (head, "S1"),
            "Sleeve_top": (sleeve.layer(2, 1), "S2"), "Cut": (cut, "S1"), "Side": (sleeve.layer(0, 1), "S4")}
    everything = {**bolt_.points, **sleeve.points}
    symmetric = {k: [n for n, p in everything.items() if p[k] == 0] for k in (0, 1)}
    foot = bolt_.nodes_where(lambda x, y, z: z == 0)
    probes = sleeve.nodes_where(lambda x, y, z: z in (6, 24) and near(x, y)) + bolt_.nodes_where(lambda x, y, z: near(z, 30) and near(x, y))
    text = "**\n** Heading +++++++++++++++++++++++++++++++++++++++++++++++++\n**\n*Heading\nHash: pre, Date: 11/28/2026, Unit system: MM_TON_S_C\n"
    text += "**\n** Nodes\n**\n*Node\n" + bolt_.nodes_text() + sleeve.nodes_text() + f"{reference}, 0., 0., 15.\n"
    text += "*Element, Type=C3D20, Elset=Bolt\n" + bolt_.elements_text() + "*Element, Type=C3D20, Elset=Sleeve\n" + sleeve.elements_text()
    text += "*Nset, Nset=Internal_Foot\n" + listed(foot) + "*Nset, Nset=Internal_X\n" + listed(symmetric[0]) + "*Nset, Nset=Internal_Y\n" + listed(symmetric[1])
    text += probes_text(probes).replace("NSET", "Nset") + f"*Nset, Nset=Pull\n{reference}\n"
    for name, (labels, face) in sets.items():
        text += f"*Elset, Elset=Internal_{name}_{face}\n" + listed(labels) + f"*Surface, Name={name}, Type=Element\nInternal_{name}_{face}, {face}\n"
    text += "*Elset, Elset=Internal_Selection-1_Solid_Section-1\nBolt,\nSleeve\n*Material, Name=S235\n*Density\n7.8E-09\n*Elastic\n210000, 0.28\n"
    text += "*Solid section, Elset=Internal_Selection-1_Solid_Section-1, Material=S235\n"
    text += "*Surface interaction, Name=Hard\n*Surface behavior, Pressure-overclosure=Linear\n1E+07\n"
    text += "*Contact pair, Interaction=Hard, Type=Surface to surface\nHead_on_sleeve, Sleeve_top\n*Tie, Name=Thread\nNut_on_sleeve, Sleeve_bottom\n"
    text += f"*Pre-tension section, Surface=Cut, Node={reference}\n0, 0, -1\n"
    supports = "Internal_Foot, 3, 3, 0\n*Boundary\nInternal_X, 1, 1, 0\n*Boundary\nInternal_Y, 2, 2, 0\n"
    output = prints([("Head_on_sleeve", "Sleeve_top")], "Internal_Foot")
    if shortening:
        return text + f"*Boundary\n{supports}*Step\n*Static\n1., 1.\n*Boundary\nPull, 1, 1, {shortening}\n{output}*End step\n"
    if ccx:  # CalculiX needs closed contact before it takes a force
        text += f"*Step\n*Static\n1., 1.\n*Boundary\n{supports}*Boundary\nPull, 1, 1, 0.005\n*End step\n"
        return text + f"*Step\n*Static\n1., 1.\n*Boundary, Op=New\n{supports.replace('*Boundary', '*Boundary, Op=New')}*Cload\nPull, 1, 3000.\n{output}*End step\n"
    return text + f"*Boundary\n{supports}*Step\n*Static\n1., 1.\n*Cload\nPull, 1, 3000.\n{output}*End step\n"


def blocks(ccx):
    """Gmsh: C3D10 with surface elements as names of faces; an orthotropic block on a steel base under its weight and a rotation."""
    base = Grid((4, 4, 1), (0, 0, 0), (40, 40, 10), "tet10")
    block = Grid((2, 2, 2), (10, 10, 10), (30, 30, 30), "tet10", base.next_node, base.next_element)
    facets, first = {}, block.next_element
    for name, grid, condition in (("foot", base, lambda x, y, z: z == 0), ("base_top", base, lambda x, y, z: near(z, 10)),
                                  ("block_bottom", block, lambda x, y, z: near(z, 10)), ("load", block, lambda x, y, z: near(z, 30))):
        facets[name] = grid.facets(condition, first)
        first += len(facets[name])
    probes = block.nodes_where(lambda x, y, z: near(z, 30) and near(x, y)) + base.nodes_where(lambda x, y, z: near(z, 10) and near(x, y))
    text = "*Heading\n blocks.inp\n*NODE\n" + base.nodes_text() + block.nodes_text() + "******* E L E M E N T S *************\n"
    if not ccx:
        for number, own in enumerate(facets.values(), 5):
            text += f"*ELEMENT, type=CPS6, ELSET=Surface{number}\n" + "".join(listed([e, *nodes]) for e, nodes in own.items())
    text += "*ELEMENT, type=C3D10, ELSET=Volume1\n" + base.elements_text() + "*ELEMENT, type=C3D10, ELSET=Volume2\n" + block.elements_text()
    if not ccx:
        for name, own in facets.items():
            text += f"*ELSET,ELSET={name}\n" + listed(list(own))
    text += "*ELSET,ELSET=base\n" + listed(list(base.elements)) + "*ELSET,ELSET=block\n" + listed(list(block.elements))
    for name, grid, condition in (("base_top", base, lambda x, y, z: near(z, 10)), ("block_bottom", block, lambda x, y, z: near(z, 10)),
                                  ("load", block, lambda x, y, z: near(z, 30))):
        sides = grid.tet_sides(condition)
        text += f"*SURFACE, NAME=S_{name}\n" + ("".join(f"{e}, {side}\n" for e, side in sides) if ccx or name == "load" else f"{name}, SPOS\n")
    text += "*NSET, NSET=foot\n" + listed(base.nodes_where(lambda x, y, z: z == 0))
    text += "*NSET, NSET=Nx\n" + listed(block.nodes_where(lambda x, y, z: near(x, 10) and near(y, 20) or near(x, 30) and near(y, 20) or near(x, 20) and near(y, 20)))
    text += probes_text(probes) + "*MATERIAL, NAME=steel\n*DENSITY\n7.8E-9\n*ELASTIC\n210000., 0.3\n"
    text += "*MATERIAL, NAME=laminate\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n30000., 12000., 8000., 0.3, 0.25, 0.2, 5000., 4000.,\n3000.\n*DENSITY\n1.9E-9\n"
    text += "*ORIENTATION, NAME=turned\n1., 1., 0., -1., 1., 0.\n"
    text += "*SOLID SECTION, ELSET=base, MATERIAL=steel\n*SOLID SECTION, ELSET=block, MATERIAL=laminate, ORIENTATION=turned\n"
    text += "*SURFACE INTERACTION, NAME=SI\n" + HARD.format(stiffness="1.e7") + "*FRICTION\n0.4, 1.e6\n"
    text += "*CONTACT PAIR, INTERACTION=SI, TYPE=SURFACE TO SURFACE\nS_block_bottom, S_base_top\n*BOUNDARY\nfoot, 1, 3\n"
    text += "*STEP\n*STATIC\n*DLOAD\nbase, GRAV, 9810000., 0., 0., -1.\nblock, GRAV, 9810000., 0., 0., -1.\n"
    text += "base, CENTRIF, 4.e5, 20., 20., 0., 0., 0., 1.\nblock, CENTRIF, 4.e5, 20., 20., 0., 0., 0., 1.\n*DSLOAD\nS_load, P, 0.5\n"
    return text + prints([("S_block_bottom", "S_base_top")]) + "*END STEP\n"


def rings(ccx):
    """Mixed: axisymmetric rings, the inner one heated and pressed at its end; sets of sets in any order, an *INCLUDE, elements that are not solid."""
    inner = PlaneGrid((4, 10), (10, 0), (16, 20), 1, 1)
    outer = PlaneGrid((5, 7), (16, 2), (26, 18), inner.next_node, inner.next_element)
    contact = [e for e, c in inner.cell_of.items() if c[0] == 3], [e for e, c in outer.cell_of.items() if c[0] == 0]
    foot, base = inner.nodes_where(lambda x, y, z: y == 0), outer.nodes_where(lambda x, y, z: near(x, 26) and near(y, 10))
    nodes = "*NODE, NSET=Nall\n" + "".join(f"{n}, {x:.12g}, {y:.12g}, 0.\n" for grid in (inner, outer) for n, (x, y, z) in grid.points.items())
    sets = "*ELSET, ELSET=Eall\nEIN, EOUT\n" if not ccx else ""
    text = "*HEADING\nrings\n" + (nodes if ccx else "*INCLUDE, INPUT=rings_nodes.inc\n") + sets
    text += "*ELEMENT, TYPE=CAX8, ELSET=EIN\n" + "".join(listed([e, *n]) for e, n in inner.elements.items())
    text += "*ELEMENT, TYPE=CAX8, ELSET=EOUT\n" + "".join(listed([e, *n]) for e, n in outer.elements.items())
    if not ccx:
        text += f"*ELEMENT, TYPE=SPRINGA, ELSET=SPR\n9001, {base[0]}, {foot[0]}\n"
    text += "*SURFACE, NAME=SIN\n" + "".join(f"{e}, S2\n" for e in contact[0]) + "*SURFACE, NAME=SOUT\n" + "".join(f"{e}, S4\n" for e in contact[1])
    text += "*NSET, NSET=foot\n" + listed(foot) + "*NSET, NSET=low\n" + listed(outer.nodes_where(lambda x, y, z: near(y, 2)))
    text += "*NSET, NSET=Nin\n" + listed(list(inner.points))
    text += probes_text(outer.nodes_where(lambda x, y, z: near(x, 26)) + inner.nodes_where(lambda x, y, z: near(x, 10)))
    text += "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*EXPANSION\n1.2E-5\n"
    text += ("*SOLID SECTION, ELSET=Eall, MATERIAL=STEEL\n" if not ccx else "*SOLID SECTION, ELSET=EIN, MATERIAL=STEEL\n*SOLID SECTION, ELSET=EOUT, MATERIAL=STEEL\n")
    text += "*SURFACE INTERACTION, NAME=SI\n" + HARD.format(stiffness="5.e7")
    text += "*CONTACT PAIR, INTERACTION=SI, TYPE=SURFACE TO SURFACE\nSOUT, SIN\n*BOUNDARY\nfoot, 2, 2\nlow, 2, 2\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNall, 0.\n"
    ends = [e for e, c in inner.cell_of.items() if c[1] == 9]
    text += "*STEP\n*STATIC\n*TEMPERATURE\nNin, 80.\n*DLOAD\n" + "".join(f"{e}, P3, 60.\n" for e in ends)
    return text + prints([("SOUT", "SIN")]) + "*END STEP\n"


def rings_nodes():
    text = rings(True)
    return text[text.index("*NODE"):text.index("*ELEMENT")]


def turn(axis, degrees):
    """Matrix of a rotation"""
    axis, angle = np.array(axis) / np.linalg.norm(axis), np.radians(degrees)
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def axes(ccx):
    """FreeCAD: a sector of a pipe about an oblique axis, with supports and forces in cylindrical axes."""
    grid, q, origin = Grid((1, 4, 1), (10, 20, 0), (16, 110, 8), "hex20"), turn((1, 1, 0.3), 50), np.array([3.0, -2.0, 1.0])
    places = {n: q @ [p[0] * np.cos(np.radians(p[1])), p[0] * np.sin(np.radians(p[1])), p[2]] + origin for n, p in grid.points.items()}
    sets = {"inside": lambda r, a, z: near(r, 10), "outside": lambda r, a, z: near(r, 16), "begin": lambda r, a, z: near(a, 20),
            "far": lambda r, a, z: near(a, 110), "foot": lambda r, a, z: near(z, 0), "top": lambda r, a, z: near(z, 8)}
    text = "*NODE, NSET=Nall\n" + "".join(f"{n}, {x:.12g}, {y:.12g}, {z:.12g}\n" for n, (x, y, z) in places.items())
    text += "*ELEMENT, TYPE=C3D20, ELSET=Evolumes\n" + grid.elements_text() + "*ELSET,ELSET=Eall\nEvolumes\n"
    text += "".join(f"*NSET,NSET={name}\n" + listed(grid.nodes_where(where)) for name, where in sets.items())
    text += probes_text(grid.nodes_where(lambda r, a, z: near(z, 8))) + "*TRANSFORM, NSET=Nall, TYPE=C\n"
    text += ", ".join(f"{x:.12g}" for x in [*origin, *(origin + 5 * q[:, 2])]) + "\n"
    text += STEEL + "*SOLID SECTION, ELSET=Eall, MATERIAL=STEEL\n*BOUNDARY\nbegin,2\nfar,2\nfoot,3,3,0.\n*STEP\n*STATIC\n"
    text += "*BOUNDARY\ninside,1,1,-0.02\n*CLOAD\noutside,1,40.\ntop,3,25.\n"
    return text + prints([]).replace("NSET=probes\n", "NSET=probes, GLOBAL=YES\n") + "*END STEP\n"


def release(ccx):
    """CalculiX: a block is pressed by a given displacement, then released and loaded by a pressure; frictionless."""
    plate = Grid((4, 4, 1), (0, 0, 0), (16, 16, 4), "hex20")
    block = Grid((2, 2, 2), (4, 4, 4), (12, 12, 10), "hex20", plate.next_node, plate.next_element)
    text = "*NODE\n" + plate.nodes_text() + block.nodes_text() + "*ELEMENT, TYPE=C3D20, ELSET=Plate\n" + plate.elements_text()
    text += "*ELEMENT, TYPE=C3D20, ELSET=Block\n" + block.elements_text()
    for name, labels in (("top", block.layer(2, 1)), ("low", block.layer(2, 0)), ("upper", plate.layer(2, 1))):
        text += f"*ELSET, ELSET={name}\n" + listed(labels)
    text += "*NSET, NSET=foot\n" + listed(plate.nodes_where(lambda x, y, z: z == 0)) + "*NSET, NSET=Hold\n" + listed(block.nodes_where(lambda x, y, z: near(z, 10)))
    text += "*NSET, NSET=Guide\n" + listed(block.nodes_where(lambda x, y, z: near(x, 8) and near(y, 8)))
    text += "*NSET, NSET=Turn\n" + listed(block.nodes_where(lambda x, y, z: near(x, 8) and near(z, 10)))
    text += probes_text(block.nodes_where(lambda x, y, z: near(z, 10))) + "*SURFACE, NAME=S\nlow, S1\n*SURFACE, NAME=M\nupper, S2\n" + STEEL
    text += "*SOLID SECTION, ELSET=Plate, MATERIAL=STEEL\n*SOLID SECTION, ELSET=Block, MATERIAL=STEEL\n*SURFACE INTERACTION, NAME=SI\n"
    text += HARD.format(stiffness="5.e6") + "*CONTACT PAIR, INTERACTION=SI, TYPE=SURFACE TO SURFACE\nS, M\n"
    supports = "foot, 1, 3\nGuide, 1, 2\nTurn, 1\n"
    output = prints([("S", "M")])
    text += f"*BOUNDARY\n{supports}*STEP\n*STATIC\n1., 1.\n*BOUNDARY\nHold, 3, 3, -0.001\n*END STEP\n"
    return text + f"*STEP\n*STATIC\n1., 1.\n*BOUNDARY, OP=NEW\n{supports}*DLOAD\ntop, P2, 60.\n{output}*END STEP\n"


SAMPLES = {"press": press, "strip": strip, "bolt": bolt, "shortened_bolt": lambda ccx: bolt(ccx, 0.01), "blocks": blocks, "rings": rings, "axes": axes,
           "release": release}
INCLUDED = {"rings": {"rings_nodes.inc": rings_nodes}}

if __name__ == "__main__":
    sys.stdout.write(SAMPLES[sys.argv[1]]("--ccx" in sys.argv))
