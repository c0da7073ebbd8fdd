"""Nodes and elements of a deck. A node or an element has the key (scope, label); the scope is its instance."""
from typing import NamedTuple

import numpy as np

from ..cells import KINDS as SHAPES
from ..foreign import Foreign
from .elements import dimension_of, kind_of


class Element(NamedTuple):
    kind: object  # meshio's name; None: not converted
    type: str  # as in the deck, upper case
    nodes: tuple  # keys
    place: object


def integers(words, place, findings):
    try:
        return [int(word) for word in words if word]
    except ValueError:
        findings.error(place, f"expected integers, found '{', '.join(words)}'")
        return []


class Model:
    """
    nodes      key -> position, moved to its place in the assembly
    elements   key -> Element
    dimension  3 if there are solid 3D elements, otherwise 2
    """

    def __init__(self, assembly, findings):
        self.assembly, self.findings = assembly, findings
        self.nodes, self.elements = {}, {}
        for card in assembly.cards:
            if card.keyword == "NODE":
                self._read_nodes(card)
            elif card.keyword == "NMAP":
                findings.error(card.place, f"{card.title} moves nodes, which is not supported; write their coordinates out")
        for card in assembly.cards:
            if card.keyword == "ELEMENT":
                self._read_elements(card)
        self.dimension = 3 if any(element.kind and dimension_of(element.kind) == 3 for element in self.elements.values()) else 2

    def _read_nodes(self, card):
        keys, points = [], []
        for place, words in card.rows:
            try:
                label, point = int(words[0]), [float(word) for word in words[1:4] if word]
            except ValueError:
                self.findings.error(place, f"expected a node number and its coordinates, found '{', '.join(words)}'")
                continue
            if len(point) < 2:
                self.findings.error(place, f"node {label} has {len(point)} coordinates; expected two or three")
                continue
            keys.append((card.scope, label))
            points.append(point + [0.0] * (3 - len(point)))
        if points and card.scope:
            points = self.assembly.motions[card.scope].moved(np.array(points)).tolist()
        self.nodes.update(zip(keys, points))

    def _read_elements(self, card):
        name = card.option("TYPE")
        kind = kind_of(name)
        if kind == "solid":
            known = "C3D4, C3D5, C3D6, C3D8, C3D10, C3D20, C3D27"
            self.findings.error(card.place, f"solid elements of the type {name}; known are {known} and their variants")
            return
        if kind is None:
            self._note_labels(card, name)
            return
        numbers = [number for place, words in card.rows for number in integers(words, place, self.findings)]
        each = 1 + SHAPES[kind][1]
        if len(numbers) % each:
            self.findings.error(card.place, f"*ELEMENT, TYPE={name}: {len(numbers)} numbers; expected a multiple of {each}")
            return
        for first in range(0, len(numbers), each):
            label, nodes = numbers[first], tuple((card.scope, node) for node in numbers[first + 1:first + each])
            for node in nodes:
                if node not in self.nodes:
                    self.findings.error(card.place, f"element {label} has the node {node[1]}, which no *NODE defines")
            self.elements[card.scope, label] = Element(kind, name, nodes, card.place)

    def _note_labels(self, card, name):
        """Keeps the labels of elements that are not converted, since sets may contain them."""
        for _, words in card.rows:
            if words[0].isdigit():
                self.elements[card.scope, int(words[0])] = Element(None, name or "no TYPE", (), card.place)

    def foreign(self, keep=lambda key, element: True):
        """The mesh of the elements to keep. \\return Foreign, node key -> its point, element key -> its number"""
        place = {key: at for at, key in enumerate(self.nodes)}
        self.findings.stop()  # elements without their nodes
        mesh = Foreign(list(self.nodes.values()))
        number, by_kind = {}, {}
        for key, element in self.elements.items():
            if element.kind and keep(key, element):
                by_kind.setdefault(element.kind, []).append((key, [place[node] for node in element.nodes]))
        for kind, members in by_kind.items():
            number.update(zip((key for key, _ in members), mesh.add_block(kind, [nodes for _, nodes in members])))
        return mesh, place, number


