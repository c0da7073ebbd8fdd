"""*COUPLING with *DISTRIBUTING or *KINEMATIC, and *RIGID BODY: conditions at reference nodes."""
import numpy as np

from .cards import numbers_in
from .conditions import LETTERS
from .geometry import integrals
from .steps import amount, vectors

ALL = {0, 1, 2, 3, 4, 5}


class Coupled:
    """Sides that a reference node moves or loads"""

    def __init__(self, card, kind, node, rows, title):
        self.card, self.kind, self.node, self.rows, self.title = card, kind, node, rows, title
        self.turning, self.motions = (node, 3), set(ALL)  # (node, first rotation) that has the rotations; coupled motions


class Couplings:
    def __init__(self, cards, solids, conditions, findings):
        self.solids, self.sets, self.conditions, self.findings = solids, solids.sets, conditions, findings
        self.all = []
        current = None
        for card in cards:
            if card.keyword == "COUPLING":
                current = self._read(card, card.options.get("SURFACE", ""), "SURFACE")
            elif card.keyword in ("DISTRIBUTING", "KINEMATIC"):
                if current is not None:
                    self._specify(current, card)
                    current = None
            elif card.keyword == "RIGIDBODY":
                self._read_rigid(card)
        self.nodes = {coupled.node for coupled in self.all} | {coupled.turning[0] for coupled in self.all}

    def _read(self, card, name, kind):
        reference = self.sets.members("NSET", card.options.get("REFNODE", ""), card.scope, card.place)
        rows = self._rows(card, name, kind)
        if not reference or rows is None:
            return None
        self.all.append(Coupled(card, kind, reference[0], rows, name))
        return self.all[-1]

    def _rows(self, card, name, kind):
        if kind == "NSET":
            sides, nodes = [], self.sets.members("NSET", name, card.scope, card.place)
        else:
            sides, nodes = self.sets.surface_named(name, card.scope, card.place)
        rows, faults = self.solids.rows_of_surface(sides, nodes)
        for fault in faults:
            self.findings.leave(card.place, f"{card.title}, '{name}': {fault}")
        if not len(rows):
            self.findings.leave(card.place, f"{card.title}: '{name}' has no side of the solid elements")
            return None
        return rows

    def _specify(self, coupled, card):
        coupled.kind = card.keyword
        dofs = set()
        for place, words in card.rows:
            numbers = [int(value) for value in numbers_in(words[:2], place, self.findings) if value is not None]
            if numbers:
                dofs |= set(range(numbers[0] - 1, numbers[-1]))
        coupled.motions = dofs or set(ALL)

    def _read_rigid(self, card):
        if "NSET" not in card.options and "TIENSET" not in card.options:
            self.findings.leave(card.place, f"{card.title}: only with NSET=<node set>")
            return
        coupled = self._read(card, card.options.get("NSET") or card.options["TIENSET"], "NSET")
        if coupled is not None:
            coupled.kind = "KINEMATIC"
            if "ROTNODE" in card.options:
                turning = self.sets.members("NSET", card.options["ROTNODE"], card.scope, card.place)
                coupled.turning = (turning[0], 0) if turning else coupled.turning

    def add(self, forces, displacements):
        for coupled in self.all:
            loads = self._at(coupled, forces)
            motions = self._at(coupled, displacements)
            if coupled.kind == "DISTRIBUTING":
                self._add_distributed(coupled, loads, motions)
            elif coupled.kind == "KINEMATIC":
                self._add_kinematic(coupled, loads, motions)
            else:
                self.findings.leave(coupled.card.place, f"{coupled.card.title} without *KINEMATIC or *DISTRIBUTING")

    def _at(self, coupled, track):
        """Values of the three translations and three rotations, or forces and moments, of a reference node"""
        node, first = coupled.turning
        keys = [(coupled.node, dof) for dof in (1, 2, 3)] + [(node, first + dof) for dof in (1, 2, 3)]
        return {k: track.values[key] for k, key in enumerate(keys) if key in track.values}

    def _add_distributed(self, coupled, loads, motions):
        """Force and moment at the reference node as tractions with the same resultants."""
        card, mesh = coupled.card, self.solids.mesh
        if motions:
            self.findings.leave(card.place, f"{card.title}: prescribed motion of the reference node {coupled.node[1]} of a *DISTRIBUTING coupling")
        if not any(np.any(values) for values in loads.values()):
            return
        if self.solids.model == "Axisymmetric" or mesh.dimension == 2 and any(k in (2, 3, 4) and np.any(values) for k, values in loads.items()):
            self.findings.leave(card.place, f"{card.title}: loads out of the plane, or in an axisymmetric model")
            return
        group = self.solids.group(coupled.title, coupled.rows)
        centroid = integrals(mesh, coupled.rows)[2]
        arm = np.zeros(3)
        arm[:mesh.dimension] = np.array(self.solids.deck.nodes[coupled.node])[:mesh.dimension] - centroid
        zero = np.zeros_like(next(iter(loads.values())))
        force = np.array([loads.get(k, zero) for k in range(3)])
        moment = np.array([loads.get(3 + k, zero) for k in range(3)]) + np.cross(arm, force, axis=0)
        scale = np.abs(force).max() * np.ptp(mesh.points, axis=0).max() + np.abs(moment).max()
        self.findings.change(card.place, f"{card.title}: the load of node {coupled.node[1]} is a traction on '{group}' with the same force "
                                         "and moment")
        self._write(f"force on {coupled.title}", "Force", dict(enumerate(force[:mesh.dimension])), group)
        moment[np.abs(moment) < 1e-12 * scale] = 0.0
        if mesh.dimension == 3:
            self._write(f"moment on {coupled.title}", "Moment", dict(enumerate(moment)), group)
        elif moment[2].any():
            value, factors = amount(moment[2])
            self.conditions.add(f"moment on {coupled.title}", "Moment", factors, Group=group, Value=[value])

    def _write(self, name, type_, parts, group):
        for members, factors in vectors(parts):
            if any(members.values()):
                self.conditions.add(name, type_, factors, Group=group, Value=self.conditions.vector(members))

    def _add_kinematic(self, coupled, loads, motions):
        """A reference node that cannot rotate and has given translations prescribes the displacements of the sides."""
        card, dimension = coupled.card, self.solids.mesh.dimension
        rotations = (3, 4, 5) if dimension == 3 else (5,)
        turns = [k for k in rotations if k not in motions or np.any(motions[k])]
        free = [k for k in range(dimension) if k in coupled.motions and k not in motions]
        loaded = any(np.any(values) for values in loads.values())
        if loaded or turns or free:
            what = "a load" if loaded else "a rotation" if turns else f"a free translation in {LETTERS[free[0]]}"
            self.findings.leave(card.place, f"{card.title}: {what} of the reference node {coupled.node[1]}; only given translations without rotation")
            return
        group = self.solids.group(coupled.title, coupled.rows)
        parts = {k: motions[k] for k in range(dimension) if k in coupled.motions}
        for members, factors in vectors(parts):
            order = sorted(members)
            where = {} if len(order) == dimension else {"Components": "".join(LETTERS[k] for k in order)}
            self.conditions.add(coupled.title, "Displacement", factors, Group=group, **where, Value=[members[k] for k in order])
