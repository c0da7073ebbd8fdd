"""Input files of CalculiX and Abaqus (.inp): nodes, elements, sets and surfaces; deck/ reads the rest for a scene."""
import pathlib

from .deck.cards import read_cards
from .deck.findings import Findings
from .deck.generators import written_out
from .deck.model import Model
from .deck.parts import Assembly
from .deck.sets import Sets


def side_sets(sets, place):
    """Vertices of the sides of each surface, by its name"""
    for key in sets.entries["SURFACE"]:
        sides, nodes = sets.surface(key)
        yield sets.title(key), [[place[node] for node in sets.nodes_of_side(side)] for side in sides], [place[node] for node in nodes]


def read(path):
    """\\return Foreign; \\throws ConvertError with all errors"""
    findings = Findings(pathlib.Path(path))
    assembly = Assembly(written_out(read_cards(findings.path, findings), findings), findings)
    findings.stop()
    model = Model(assembly, findings)
    sets = Sets(model, findings)
    mesh, place, number = model.foreign()
    for key in sets.entries["ELSET"]:
        mesh.add_to(mesh.groups, sets.title(key), [number[one] for one in sets.of("ELSET", key) if one in number])
    for scope, name in assembly.instances.items():
        mesh.add_to(mesh.groups, name, [at for key, at in number.items() if key[0] == scope])
    for key in sets.entries["NSET"]:
        mesh.add_to(mesh.node_sets, sets.title(key), [place[one] for one in sets.of("NSET", key)])
    for name, sides, nodes in side_sets(sets, place):
        if sides:
            mesh.side_sets[name] = sides
        if nodes:
            mesh.add_to(mesh.node_sets, name, nodes)
    findings.stop()
    passed = sorted({element.type for element in model.elements.values() if element.kind is None})
    mesh.remarks += [f"elements of the type {name} left out" for name in passed]
    mesh.remarks += findings.texts(findings.left)
    return mesh
