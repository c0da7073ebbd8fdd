"""*PRE-TENSION SECTION: a force or a shortening of the body that contains the section."""
import numpy as np

from .cards import numbers_in
from .geometry import integrals
from .steps import amount


class Preloads:
    """The section of a deck shortens at one place; Suture shortens the part of the body between its contacts, with the same force."""

    def __init__(self, cards, contacts, solids, conditions, findings):
        self.contacts, self.solids, self.conditions, self.findings = contacts, solids, conditions, findings
        self.sections = {}  # reference node -> (card, body, direction, sign of a tension)
        for card in cards:
            if card.keyword == "PRE-TENSIONSECTION":
                self._read(card)

    def _read(self, card):
        sets = self.solids.sets
        nodes = sets.members("NSET", card.options.get("NODE", ""), card.scope, card.place)
        sides, _ = sets.surface_named(card.options.get("SURFACE", ""), card.scope, card.place)
        elements = [self.solids.element[key] for key, _ in sides if key in self.solids.element]
        if not nodes or not elements:
            if nodes and sides:
                self.findings.error(card.place, f"{card.title}: its surface has no side of a solid element")
            return
        bodies = np.unique(self.solids.body_of[elements])
        if len(bodies) > 1:
            self.findings.error(card.place, f"{card.title}: its surface is on {len(bodies)} bodies; expected one")
            return
        self.sections[nodes[0]] = (card, int(bodies[0]), *self._direction(card, sides))

    def _direction(self, card, sides):
        """Unit vector along the bolt, and the sign of a value that is a tension: a given vector may point into the elements of the surface"""
        outward = sum(self._outward(side) for side in sides)
        direction = outward
        if card.rows:
            values = [value or 0.0 for value in numbers_in(card.rows[0][1], card.rows[0][0], self.findings)]
            direction = np.array((values + [0.0] * 3)[:3])
        dimension = self.solids.mesh.dimension
        if not np.linalg.norm(direction[:dimension]):
            self.findings.error(card.place, f"{card.title}: the normal of the section is zero")
            return np.eye(dimension)[0], 1
        return (direction / np.linalg.norm(direction))[:dimension], -1 if direction @ outward < 0 else 1

    def _outward(self, side):
        """Normal of a side out of its element"""
        points = self.solids.deck.nodes
        corners = np.array([points[node] for node in self.solids.sets.nodes_of_side(side)])
        if len(corners) == 2:
            along = corners[1] - corners[0]
            normal = np.array([along[1], -along[0], 0.0])
        else:
            normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        centre = np.mean([points[node] for node in self.solids.deck.elements[side[0]].nodes], axis=0)
        return normal if normal @ (corners.mean(axis=0) - centre) > 0 else -normal

    def _length(self, card, body, direction):
        """Distance along the bolt between the sides in contacts, which carry its force, and the point in the middle; None: there are none"""
        places = []
        for contact in self.contacts.all:
            for side in (contact.side_a, contact.side_b):
                rows = self.solids.mesh.side_groups[side]
                own = rows[self.solids.body_of[rows[:, 0]] == body]
                if len(own):
                    places.append(integrals(self.solids.mesh, own)[2])
        places.sort(key=lambda place: float(place @ direction))
        length = float((places[-1] - places[0]) @ direction) if places else 0.0
        if length <= 1e-6 * np.ptp(self.solids.mesh.points, axis=0).max():
            name = self.solids.bodies[body]
            self.findings.leave(card.place, f"{card.title}: body '{name}' has no two contacts, as under head and nut, between which the force acts")
            return None
        return length, (places[0] + places[-1]) / 2

    def add(self, forces, displacements):
        """Reads values at the reference nodes from the tracks of *CLOAD and *BOUNDARY."""
        for node, (card, body, direction, sign) in self.sections.items():
            force, shortening = forces.values.get((node, 1)), displacements.values.get((node, 1))
            part = self._length(card, body, direction)
            if part is None:
                continue
            name = self.solids.bodies[body]
            if force is not None and np.any(force):
                self._add_force(card, name, sign * force, forces.removed.get((node, 1)), direction, *part)
            elif shortening is not None and np.any(shortening):
                self._add_shortening(card, name, sign * shortening, direction, *part)
            else:
                self.findings.leave(card.place, f"{card.title}: neither force nor shortening at its node {node[1]}")

    def _add_force(self, card, name, force, removed, direction, length, middle):
        steps = np.flatnonzero(np.abs(np.diff(force)) > 1e-9 * np.abs(force).max()) if len(force) > 1 else []
        if removed is None and len(steps):
            self.findings.leave(card.place, f"{card.title}: the force changes between the steps; the scene keeps the shortening of the first one")
        elif len(force) > 1:
            self.findings.change(card.place, f"{card.title}: the force of the first step gives the shortening, which later steps keep")
        self._note_shortening(card, name)
        value = float(force[np.flatnonzero(force)[0]])
        self.conditions.add(f"preload of {name}", "Preload", None, Body=name, Direction=direction.tolist(), Length=length, Point=middle.tolist(),
                            Value=[value])

    def _note_shortening(self, card, name):
        self.findings.change(card.place, f"{card.title}: body '{name}' is shortened between its contacts, not at one section; the force is the same")

    def _add_shortening(self, card, name, shortening, direction, length, middle):
        """An initial strain with the same shortening of the part between the contacts"""
        value, factors = amount(shortening)
        n = [*direction.tolist(), 0.0][:3]
        strain = -value / length
        parts = {"xx": n[0] * n[0], "yy": n[1] * n[1], "zz": n[2] * n[2], "xy": 2 * n[0] * n[1]}
        if len(direction) == 3:
            parts.update(yz=2 * n[1] * n[2], xz=2 * n[0] * n[2])
        along = " + ".join(f"{float(k)!r}*({letter} - {float(m)!r})" for k, m, letter in zip(direction, middle, "xyz") if k)
        values = {f"Expression_{axes}": f"abs({along}) <= {length / 2!r} ? {float(strain * part)!r} : 0" if part else "0"
                  for axes, part in parts.items()}
        self._note_shortening(card, name)
        self.conditions.add(f"shortening of {name}", "Initial Strain", factors, Body=name, **values)
