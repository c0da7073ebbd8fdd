"""*PART, *INSTANCE and *ASSEMBLY: one list of cards, each in the scope of its instance, and the positions of the instances."""
import dataclasses

import numpy as np

from .cards import numbers_in
from .findings import nearest

FRAMES = ("PART", "ENDPART", "ASSEMBLY", "ENDASSEMBLY", "INSTANCE", "ENDINSTANCE")


def rotation_about(first, second, degrees):
    """Matrix of the rotation about the axis from `first` to `second`."""
    axis = (second - first) / np.linalg.norm(second - first)
    angle = np.radians(degrees)
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * (cross @ cross)


class Motion:
    """Position of an instance: x -> rotation x + shift."""

    def __init__(self, rotation=None, shift=None):
        self.rotation = np.eye(3) if rotation is None else rotation
        self.shift = np.zeros(3) if shift is None else shift

    def moved(self, points):
        return points @ self.rotation.T + self.shift

    def turned(self, directions):
        return np.asarray(directions) @ self.rotation.T


def motion_of(card, findings):
    """From the data lines of *INSTANCE: a translation, then two points of an axis and an angle."""
    rows = [[value or 0.0 for value in numbers_in(words, place, findings)] for place, words in card.rows if any(words)]
    motion = Motion()
    if rows:
        motion.shift = np.array((rows[0] + [0.0] * 3)[:3])
    if len(rows) > 1:
        if len(rows[1]) < 7:
            findings.error(card.rows[1][0], f"expected two points of the axis and an angle, found {len(rows[1])} numbers")
            return motion
        first, second = np.array(rows[1][:3]), np.array(rows[1][3:6])
        if not np.any(first != second):
            findings.error(card.rows[1][0], "the two points of the axis of rotation are the same")
            return motion
        turn = rotation_about(first, second, rows[1][6])
        motion = Motion(turn, turn @ (motion.shift - first) + first)
    return motion


class Assembly:
    """
    cards      all cards, those of a part once for each of its instances
    instances  scope (upper-case name) -> name as in the file
    motions    scope -> Motion
    """

    def __init__(self, cards, findings):
        self.cards, self.instances, self.motions, self.findings = [], {}, {}, findings
        self.parts, self.titles = {}, {}
        part = instance = None
        for card in cards:
            if card.keyword == "PART":
                part = self._part(card)
            elif card.keyword == "INSTANCE":
                instance = self._instance(card)
            elif card.keyword == "ENDPART":
                part = None
            elif card.keyword == "ENDINSTANCE":
                instance = None
            elif card.keyword in FRAMES:
                continue
            elif part is not None:
                self.parts[part].append(card)
            else:
                self.cards.append(dataclasses.replace(card, scope=instance or ""))
        if not self.instances:  # parts without an assembly
            for name, own in self.parts.items():
                self._place(name, self.titles[name], own, Motion())

    def _part(self, card):
        name = card.option("NAME")
        if not name:
            self.findings.error(card.place, "*PART without NAME=<name>")
        if name in self.parts:
            self.findings.error(card.place, f"there are two parts '{card.options['NAME']}'")
        self.parts[name], self.titles[name] = [], card.options.get("NAME", "part")
        return name

    def _instance(self, card):
        name, part = card.option("NAME"), card.option("PART")
        if not name:
            self.findings.error(card.place, "*INSTANCE without NAME=<name>")
        if part not in self.parts:
            self.findings.error(card.place, f"no such part '{card.options.get('PART', '')}'" + nearest(part, self.titles.values()))
        if name in self.instances:
            self.findings.error(card.place, f"there are two instances '{card.options['NAME']}'")
        self._place(name, card.options.get("NAME", name), self.parts.get(part, []), motion_of(card, self.findings))
        return name

    def _place(self, scope, name, cards, motion):
        self.instances[scope], self.motions[scope] = name, motion
        self.cards += [dataclasses.replace(card, scope=scope) for card in cards]
