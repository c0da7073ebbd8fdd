"""Input files of CalculiX and Abaqus (.inp): nodes, elements, sets and surfaces; everything else is ignored."""
import pathlib
import re

from .cells import KINDS as SHAPES, vertices_of
from .foreign import ConvertError, Foreign

SOLID = r"(C3D|DC3D|AC3D|SC)"
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


def sides_of(kind):
    """Local vertices of each side of an element."""
    edges = range(vertices_of(kind)) if kind.startswith(("triangle", "quad")) else ()
    return SIDES.get(kind.rstrip("0123456789"), [(k, (k + 1) % len(edges)) for k in edges])


def kind_of(name):
    """meshio's name of an element such as CPE4R; letters for the integration follow the number of nodes"""
    return next((kind for pattern, kind in KINDS if re.match(pattern, name)), None)


class Reader:
    def __init__(self, path):
        self.path = path
        self.nodes, self.elements = {}, {}  # by label: coordinates; (kind, labels of nodes)
        self.sets = {"NSET": {}, "ELSET": {}}
        self.surfaces = {}
        self.names = {}  # spelling in the file, since names are case-insensitive
        self.passed = set()

    def fail(self, line, message):
        raise ConvertError(f"{self.path}, line {line}: {message}")

    def called(self, name):
        name = name.strip().strip('"')
        return self.names.setdefault(name.upper(), name)

    def lines(self, path, depth=0):
        """(place, words of a data line or keyword line)"""
        if depth > 20:
            self.fail(0, f"{path} includes itself (*INCLUDE)")
        try:
            text = path.read_text(encoding="utf-8", errors="replace")
        except OSError as error:
            raise ConvertError(f"{path}: {error.strerror}") from error
        held = ""
        for number, line in enumerate(text.splitlines(), 1):
            line = line.strip()
            if not line or line.startswith("**"):
                continue
            line = held + line
            held = ""
            if line.startswith("*") and line.endswith(","):
                held = line
                continue
            if re.match(r"\*\s*INCLUDE", line, re.I):
                target = line.partition("=")[2].strip().strip('"')
                yield from self.lines(path.parent / target, depth + 1)
            else:
                yield number, line

    def read(self):
        keyword, options, data, place = None, {}, [], 0
        for number, line in self.lines(self.path):
            if line.startswith("*"):
                self.close(keyword, options, data, place)
                words = [word.strip() for word in line[1:].split(",")]
                keyword, place, data = words[0].upper().replace(" ", ""), number, []
                options = {k.strip().upper(): v.strip() for k, _, v in (word.partition("=") for word in words[1:])}
            else:
                data.append((number, [word.strip() for word in line.rstrip(",").split(",")]))
        self.close(keyword, options, data, place)
        return self.foreign()

    def close(self, keyword, options, data, place):
        if keyword in ("PART", "INSTANCE", "ASSEMBLY"):
            self.fail(place, f"*{keyword.title()}: parts and instances are not read; write a flat file (in Abaqus: "
                             "mdb.models['...'].setValues(noPartsInputFile=ON)), or read the .inp with CalculiX's cgx and save it again")
        if keyword == "NODE":
            self.read_nodes(options, data)
        elif keyword == "ELEMENT":
            self.read_elements(options, data, place)
        elif keyword in ("NSET", "ELSET"):
            self.read_set(keyword, options, data, place)
        elif keyword == "SURFACE":
            self.read_surface(options, data, place)
        elif keyword in ("NGEN", "NFILL", "NCOPY", "ELGEN", "ELCOPY"):
            self.fail(place, f"*{keyword} generates nodes or elements, which is not supported; write them out")

    def integers(self, number, words):
        try:
            return [int(word) for word in words if word]
        except ValueError:
            self.fail(number, f"expected integers, found '{', '.join(words)}'")

    def read_nodes(self, options, data):
        for number, words in data:
            try:
                label, place = int(words[0]), [float(word) for word in words[1:4] if word]
            except ValueError:
                self.fail(number, f"expected a node number and its coordinates, found '{', '.join(words)}'")
            if len(place) < 2:
                self.fail(number, f"node {label} has {len(place)} coordinates; expected two or three")
            self.nodes[label] = place + [0.0] * (3 - len(place))
            if "NSET" in options:
                self.sets["NSET"].setdefault(self.called(options["NSET"]), []).append(label)

    def read_elements(self, options, data, place):
        name = options.get("TYPE", "").upper()
        kind = kind_of(name)
        if kind is None:
            if data:
                self.passed.add(name or "no TYPE")
            return
        numbers = []
        for number, words in data:
            numbers += self.integers(number, words)
        if kind == "solid":
            self.fail(place, f"solid elements of the type {name}; known are C3D4, C3D5, C3D6, C3D8, C3D10, C3D20, C3D27 and their variants")
        each = 1 + SHAPES[kind][1]
        if len(numbers) % each:
            self.fail(place, f"*ELEMENT, TYPE={name}: {len(numbers)} numbers; expected a multiple of {each}")
        for first in range(0, len(numbers), each):
            label, nodes = numbers[first], numbers[first + 1:first + each]
            for node in nodes:
                if node not in self.nodes:
                    self.fail(place, f"element {label} has the node {node}, which no preceding *NODE defines")
            self.elements[label] = (kind, nodes)
            if "ELSET" in options:
                self.sets["ELSET"].setdefault(self.called(options["ELSET"]), []).append(label)

    def read_set(self, keyword, options, data, place):
        if keyword not in options:
            self.fail(place, f"*{keyword} without {keyword}=<name>")
        members = self.sets[keyword].setdefault(self.called(options[keyword]), [])
        for number, words in data:
            if "GENERATE" in options:
                first, last, *step = self.integers(number, words) + [1]
                members += range(first, last + 1, step[0])
                continue
            for word in filter(None, words):
                if re.fullmatch(r"-?\d+", word):
                    members.append(int(word))
                else:
                    members += self.members(keyword, word, number)

    def members(self, keyword, name, number):
        name = self.called(name)
        if name not in self.sets[keyword]:
            self.fail(number, f"no such {keyword} '{name}' before this line. Known here: {', '.join(sorted(self.sets[keyword])) or 'none'}")
        return self.sets[keyword][name]

    def read_surface(self, options, data, place):
        if "NAME" not in options:
            self.fail(place, "*SURFACE without NAME=<name>")
        name = self.called(options["NAME"])
        for number, words in data:
            if options.get("TYPE", "ELEMENT").upper() == "NODE":
                nodes = [int(words[0])] if words[0].isdigit() else self.members("NSET", words[0], number)
                self.sets["NSET"].setdefault(name, []).extend(nodes)
                continue
            elements = [int(words[0])] if words[0].isdigit() else self.members("ELSET", words[0], number)
            face = re.fullmatch(r"S(\d)", words[1].upper()) if len(words) > 1 else None
            if not face:
                self.fail(number, f"expected a side S1 to S6 of elements, found '{', '.join(words)}'")
            side = int(face[1]) - 1
            for label in elements:
                kind, nodes = self.elements.get(label, (None, []))
                sides = sides_of(kind) if kind else []
                if side >= len(sides):
                    self.fail(number, f"element {label} has no side {words[1]}")
                self.surfaces.setdefault(name, []).append([nodes[k] for k in sides[side]])

    def foreign(self):
        place = {label: at for at, label in enumerate(self.nodes)}
        mesh = Foreign(list(self.nodes.values()))
        number, by_kind = {}, {}
        for label, (kind, nodes) in self.elements.items():
            by_kind.setdefault(kind, []).append((label, [place[node] for node in nodes]))
        for kind, members in by_kind.items():
            number.update(zip((label for label, _ in members), mesh.add_block(kind, [nodes for _, nodes in members])))
        for name, labels in self.sets["ELSET"].items():
            mesh.add_to(mesh.groups, name, [number[label] for label in labels if label in number])
        for name, labels in self.sets["NSET"].items():
            mesh.add_to(mesh.node_sets, name, [place[label] for label in labels if label in place])
        for name, sides in self.surfaces.items():
            mesh.side_sets[name] = [[place[node] for node in side] for side in sides]
        mesh.remarks += [f"elements of the type {name} left out" for name in sorted(self.passed)]
        return mesh


def read(path):
    return Reader(pathlib.Path(path)).read()
