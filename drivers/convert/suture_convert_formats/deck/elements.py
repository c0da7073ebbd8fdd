"""Element types of a deck and the numbers of their sides."""
import re

from ..cells import CELLS, vertices_of

SOLID = r"(C3D|DC3D|AC3D|SC)"
PLANE = {"CPS": "Plane Stress", "CPE": "Plane Strain", "CPEG": "Plane Strain", "CAX": "Axisymmetric"}
FAMILY = r"(CPS|CPE|CPEG|CAX|CGAX|M3D|R3D|SFM3D|S|STRI|DC2D|DCAX|AC2D)"  # plane, axisymmetric, membranes, shells, heat
KINDS = [(SOLID + r"4(?!\d)", "tetra"), (SOLID + r"10(?!\d)", "tetra10"), (SOLID + r"8(?!\d)", "hexahedron"), (SOLID + r"20(?!\d)", "hexahedron20"),
         (SOLID + r"27(?!\d)", "hexahedron27"), (SOLID + r"6(?!\d)", "wedge"), (SOLID + r"5(?!\d)", "pyramid"), (SOLID + r"\d", "solid"),
         (r"T[23]D2|R2D2|RAX2|SAX1|DC1D2|B[23][13](?!\d)", "line"), (r"T[23]D3|B[23]2|SAX2", "line3"),
         (FAMILY + r"3(?!\d)", "triangle"), (FAMILY + r"6(?!\d)|STRI65", "triangle6"), (FAMILY + r"4(?!\d)", "quad"),
         (FAMILY + r"8(?!\d)", "quad8"), (FAMILY + r"9(?!\d)", "quad9")]
# Vertices of the sides S1, S2, ... of solids.
SIDES = {"tetra": [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)], "wedge": [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)],
         "hexahedron": [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)],
         "pyramid": [(0, 1, 2, 3), (0, 4, 1), (1, 4, 2), (2, 4, 3), (3, 4, 0)]}


def kind_of(name):
    """meshio's name of an element such as CPE4R; letters for the integration follow the number of nodes"""
    return next((kind for pattern, kind in KINDS if re.match(pattern, name)), None)


def model_of(name):
    """Model of a plane element; None: not a plane solid element"""
    found = re.match(r"(CPEG|CPE|CPS|CAX)\d", name)
    return PLANE[found[1]] if found else None


def dimension_of(kind):
    """3, 2 or 1; 0: unknown"""
    return CELLS[kind].dimension if kind in CELLS else 1 if kind in ("line", "line3") else 0


def sides_of(kind):
    """Local vertices of each side of an element."""
    edges = range(vertices_of(kind)) if kind.startswith(("triangle", "quad")) else ()
    return SIDES.get(kind.rstrip("0123456789"), [(k, (k + 1) % len(edges)) for k in edges])
