"""Universal files of I-DEAS (.unv), as written by Salome and Gmsh: datasets 2411 (nodes), 2412 (elements) and those of groups."""
import pathlib

from .foreign import ConvertError, Foreign

GROUPS = (2429, 2430, 2432, 2435, 2452, 2467, 2477)
BEAMS = (11, 21, 22, 23, 24)
SHAPES = {1: "triangle", 2: "triangle6", 4: "quad", 5: "quad8"}  # by the last digit of the descriptors 41 to 99
SOLIDS = {111: "tetra", 112: "wedge", 115: "hexahedron", 116: "hexahedron20", 118: "tetra10"}
# Vertices of parabolic solids, whose nodes run around the element layer by layer, as in plane elements.
VERTICES = {"tetra10": (0, 2, 4, 9), "hexahedron20": (0, 2, 4, 6, 12, 14, 16, 18)}


def datasets(path):
    """(number, first line, lines) of each dataset"""
    try:
        lines = pathlib.Path(path).read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError as error:
        raise ConvertError(f"{path}: {error.strerror}") from error
    at = 0
    while at < len(lines):
        if lines[at].strip() != "-1":
            at += 1
            continue
        end = next((i for i in range(at + 1, len(lines)) if lines[i].strip() == "-1"), None)
        if end is None:
            raise ConvertError(f"{path}, line {at + 1}: the dataset does not end; expected a line -1")
        if end > at + 1:
            yield lines[at + 1].strip(), at + 3, lines[at + 2:end]
        at = end + 1


def read(path):
    places, blocks, named, remarks = {}, {}, [], []
    kind_of = {}
    for number, first, lines in datasets(path):
        at = 0
        try:
            if number in ("2411", "781"):
                for at in range(0, len(lines), 2):
                    places[int(lines[at].split()[0])] = [float(x.upper().replace("D", "E")) for x in lines[at + 1].split()[:3]]
            elif number == "2412":
                while at < len(lines):
                    label, descriptor, *_, count = map(int, lines[at].split())
                    at += 2 if descriptor in BEAMS else 1
                    nodes = []
                    while len(nodes) < count:
                        nodes += map(int, lines[at].split())
                        at += 1
                    kind, nodes = element(descriptor, nodes)
                    kind_of[label] = kind
                    blocks.setdefault(kind, []).append((label, nodes))
            elif number.isdigit() and int(number) in GROUPS:
                while at < len(lines):
                    count, name = int(lines[at].split()[7]), lines[at + 1].strip()
                    at += 2
                    words = []
                    while len(words) < 4 * count:
                        words += map(int, lines[at].split())
                        at += 1
                    named.append((name, list(zip(words[0::4], words[1::4]))))
            elif number in ("15", "780", "2417"):
                remarks.append(f"dataset {number} (an older format) left out")
        except (ValueError, IndexError) as error:
            raise ConvertError(f"{path}, line {first + min(at, len(lines) - 1)}: cannot be read as dataset {number} ({error})") from error
    if not places:
        raise ConvertError(f"{path}: no nodes (dataset 2411)")
    order = {label: i for i, label in enumerate(places)}
    mesh = Foreign(list(places.values()))
    mesh.remarks = remarks
    numbers = {}
    for kind, members in blocks.items():
        try:
            rows = [[order[node] for node in nodes] for _, nodes in members]
        except KeyError as error:
            raise ConvertError(f"{path}: dataset 2412: an element has the node {error}, which is missing in dataset 2411") from error
        numbers.update(zip((label for label, _ in members), mesh.add_block(kind, rows)))
    for name, members in named:
        elements = [numbers[tag] for code, tag in members if code == 8 and tag in numbers]
        nodes = [order[tag] for code, tag in members if code == 7 and tag in order]
        if elements:
            mesh.add_to(mesh.groups, name, elements)
        if nodes:
            mesh.add_to(mesh.node_sets, name, nodes)
    return mesh


def element(descriptor, nodes):
    """meshio's kind and node order; nodes of parabolic elements run around: a vertex, the middle of the following side, ..."""
    if descriptor in (11, 21, 22) or (descriptor in BEAMS and len(nodes) == 2):
        return "line", nodes[:2]
    if descriptor in BEAMS:
        return "line3", [nodes[0], nodes[2], nodes[1]]
    kind = SHAPES.get(descriptor % 10) if 41 <= descriptor <= 99 else SOLIDS.get(descriptor)
    if kind in ("triangle6", "quad8"):
        nodes = nodes[0::2] + nodes[1::2]
    if kind in VERTICES:  # the order of the nodes between vertices follows from the geometry
        nodes = [nodes[i] for i in VERTICES[kind]] + [node for i, node in enumerate(nodes) if i not in VERTICES[kind]]
    return kind or f"descriptor {descriptor}", nodes
