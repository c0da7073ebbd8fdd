"""*COUPLING with *DISTRIBUTING or *KINEMATIC, *KINEMATIC COUPLING and *RIGID BODY: conditions at reference nodes."""
import numpy as np

from .cards import numbers_in
from .conditions import LETTERS
from .geometry import integrals
from .rigid_group import ALL, RigidGroup
from .steps import amount, vectors

MOTIONS = ("Motion x", "Motion y", "Motion z", "Rotation x", "Rotation y", "Rotation z")
SETS = {"NSET": "NSET", "TIENSET": "NSET", "PINNSET": "NSET", "ELSET": "ELSET"}  # options of *RIGID BODY with the members


class Couplings:
    """
    all    list of RigidGroup
    nodes  keys of their reference nodes
    """

    def __init__(self, cards, solids, conditions, findings):
        self.solids, self.sets, self.conditions, self.findings = solids, solids.sets, conditions, findings
        self.all = []
        current, oriented = None, False
        for card in cards:
            if card.keyword == "COUPLING":
                current = self._read(card, card.options.get("SURFACE", ""), self._of_surface(card))
                oriented = "ORIENTATION" in card.options
            elif card.keyword in ("DISTRIBUTING", "KINEMATIC"):
                if current is None:
                    findings.leave(card.place, f"{card.title} without a *COUPLING that is taken over")
                else:
                    current.kind, current.coupled = card.keyword, self._coupled(card.rows)
                    if oriented and card.keyword == "KINEMATIC" and not current.coupled >= {0, 1, 2}:
                        current.limit = " with ORIENTATION in some directions only"
                    current = None
            elif card.keyword == "KINEMATICCOUPLING":
                self._read_kinematic(card)
            elif card.keyword == "RIGIDBODY":
                self._read_rigid(card)
        self.nodes = {group.reference for group in self.all} | {group.turning[0] for group in self.all}

    def _of_surface(self, card):
        return self.sets.surface_named(card.options.get("SURFACE", ""), card.scope, card.place)

    def _read(self, card, name, members, kind=""):
        """\param members  (sides, nodes) of the deck \return RigidGroup, or None after a finding"""
        reference = self.sets.members("NSET", card.options.get("REFNODE", ""), card.scope, card.place)
        sides, nodes = members
        rows, faults = self.solids.rows_of_surface(sides, nodes)
        for fault in faults:
            self.findings.leave(card.place, f"{card.title}, '{name}': {fault}")
        if not len(rows):
            self.findings.leave(card.place, f"{card.title}: '{name}' has no side of the solid elements")
        if not reference or not len(rows):
            return None
        own = {self.solids.node[node] for node in nodes if node in self.solids.node} | set(rows[:, 2:].ravel().tolist()) - {-1}
        self.all.append(RigidGroup(card.title, card.place, name, kind, reference[0], (reference[0], 3), rows, sorted(own),
                                   self.solids.deck.nodes[reference[0]]))
        return self.all[-1]

    def _coupled(self, rows):
        """Coupled motions from lines of first and last degree of freedom; all without lines"""
        motions = set()
        for place, words in rows:
            numbers = [int(value) for value in numbers_in(words[:2], place, self.findings) if value is not None]
            if numbers:
                motions |= set(range(numbers[0] - 1, numbers[-1]))
        return frozenset(motions) or ALL

    def _read_kinematic(self, card):
        """*KINEMATIC COUPLING: lines of a node set, first and last degree of freedom"""
        by_motions = {}
        for place, words in card.rows:
            motions = self._coupled([(place, words[1:])])
            by_motions.setdefault(motions, ([], []))
            by_motions[motions][0].append(words[0])
            by_motions[motions][1].extend(self.sets.members("NSET", words[0], card.scope, place))
        for motions, (names, nodes) in by_motions.items():
            group = self._read(card, names[0] if len(names) == 1 else f"nodes of line {card.place.line}", ([], nodes), "KINEMATIC")
            if group is not None:
                group.coupled = motions

    def _read_rigid(self, card):
        option = next((option for option in SETS if option in card.options), None)
        if option is None:
            self.findings.leave(card.place, f"{card.title}: only with NSET=<node set> or ELSET=<element set>")
            return
        nodes = self.sets.members(SETS[option], card.options[option], card.scope, card.place)
        if SETS[option] == "ELSET":
            nodes = list(dict.fromkeys(node for key in nodes for node in self.solids.deck.elements[key].nodes))
        group = self._read(card, card.options[option], ([], nodes), "RIGID")
        if group is not None and "ROTNODE" in card.options:
            turning = self.sets.members("NSET", card.options["ROTNODE"], card.scope, card.place)
            group.turning = (turning[0], 0) if turning else group.turning

    def add(self, forces, displacements):
        """Reads values at the reference nodes from the tracks of *CLOAD and *BOUNDARY, and adds the conditions with the same effect."""
        for group in self.all:
            group.loads, group.motions = self._at(group, forces), self._at(group, displacements)
            if group.limit:
                self._leave(group, group.limit)
            elif group.kind == "DISTRIBUTING":
                self._add_distributed(group)
            elif group.kind:
                self._add_rigid(group)
            else:
                self._leave(group, " without *KINEMATIC or *DISTRIBUTING")

    def _leave(self, group, why):
        group.reason = group.title + why
        self.findings.leave(group.place, group.reason)

    @staticmethod
    def _at(group, track):
        """Values of the three translations and three rotations, or forces and moments, of a reference node"""
        node, first = group.turning
        keys = [(group.reference, dof) for dof in (1, 2, 3)] + [(node, first + dof) for dof in (1, 2, 3)]
        return {k: track.values[key] for k, key in enumerate(keys) if key in track.values}

    def _add_distributed(self, group):
        """Force and moment at the reference node as tractions with the same resultants."""
        mesh, loads = self.solids.mesh, group.loads
        if group.motions:
            self._leave(group, f": prescribed motion of the reference node {group.reference[1]} of a *DISTRIBUTING coupling")
        if not group.is_loaded:
            return
        if self.solids.model == "Axisymmetric" or mesh.dimension == 2 and any(k in (2, 3, 4) and np.any(values) for k, values in loads.items()):
            self._leave(group, ": loads out of the plane, or in an axisymmetric model")
            return
        sides = self.solids.group(group.name, group.rows)
        group.reason = f"{group.title}: the load of node {group.reference[1]} is a traction on '{sides}' with the same force and moment"
        self.findings.change(group.place, group.reason)
        self._write_loads(group, sides)

    def _write_loads(self, group, sides):
        """Force and moment at the reference node as tractions on the sides"""
        mesh, loads = self.solids.mesh, group.loads
        centroid = integrals(mesh, group.rows)[2]
        arm = np.zeros(3)
        arm[:mesh.dimension] = np.array(group.point)[:mesh.dimension] - centroid
        zero = np.zeros_like(next(iter(loads.values())))
        force = np.array([loads.get(k, zero) for k in range(3)])
        moment = np.array([loads.get(3 + k, zero) for k in range(3)]) + np.cross(arm, force, axis=0)
        scale = np.abs(force).max() * np.ptp(mesh.points, axis=0).max() + np.abs(moment).max()
        self._write(f"force on {group.name}", "Force", dict(enumerate(force[:mesh.dimension])), sides)
        moment[np.abs(moment) < 1e-12 * scale] = 0.0
        if mesh.dimension == 3:
            self._write(f"moment on {group.name}", "Moment", dict(enumerate(moment)), sides)
        elif moment[2].any():
            value, factors = amount(moment[2])
            self.conditions.add(f"moment on {group.name}", "Moment", factors, Group=sides, Value=[value])

    def _write(self, name, type_, parts, sides):
        for members, factors in vectors(parts):
            if any(members.values()):
                self.conditions.add(name, type_, factors, Group=sides, Value=self.conditions.vector(members))

    def _add_rigid(self, group):
        """A reference node whose motions are all given prescribes the displacements of the sides."""
        dimension, motions = self.solids.mesh.dimension, group.motions
        rotations = (3, 4, 5) if dimension == 3 else (5,)
        free = [k for k in range(dimension) if k in group.coupled and k not in motions] + [k for k in rotations if k not in motions]
        if group.is_loaded or free:
            self._add_free(group)
            return
        own = [k for k in range(dimension) if k in group.coupled]
        if any(np.any(motions[k]) for k in rotations):
            self._add_rotated(group, own, {k: motions[k] for k in [*own, *rotations]})
        else:
            self._add_translated(group, own)

    def _add_free(self, group):
        """A rigid group with free motions or loads; its loads are tractions, which on a rigid group is the same"""
        mesh, axisymmetric = self.solids.mesh, self.solids.model == "Axisymmetric"
        if not group.coupled >= set(range(mesh.dimension)):
            self._leave(group, f": free motions of the reference node {group.reference[1]}, coupled in some directions only")
            return
        if axisymmetric and (group.is_loaded or any(k != 1 and np.any(values) for k, values in group.motions.items())):
            self._leave(group, ": loads, or motions that are not along the axis, in an axisymmetric model")
            return
        kept = (1,) if axisymmetric else (0, 1, 5) if mesh.dimension == 2 else range(6)
        motions = {k: values for k, values in group.motions.items() if k in kept}
        members, factors = self._of_one_amplitude(group, motions)
        if members is None:
            return
        sides = self.solids.group(group.name, group.rows)
        group.reason = f"{group.title}: as Rigid Group '{sides}'"
        given = {MOTIONS[k].replace(" ", "_"): float(members.get(k, 0.0)) for k in motions}
        self.conditions.add(group.name, "Rigid Group", factors, Group=sides, Point=[float(x) for x in group.point[:mesh.dimension]], **given)
        if group.is_loaded:
            self._write_loads(group, sides)

    def _of_one_amplitude(self, group, motions):
        """The motions {number: value} and their factors; (None, None) after a finding if their amplitudes differ"""
        found = vectors(motions) or [({}, None)]
        if len(found) > 1:
            self._leave(group, f": the motions of the reference node {group.reference[1]} have different amplitudes")
            return None, None
        return found[0]

    def _where(self, own):
        return {} if len(own) == self.solids.mesh.dimension else {"Components": "".join(LETTERS[k] for k in own)}

    def _add_translated(self, group, own):
        sides = self.solids.group(group.name, group.rows)
        group.reason = f"{group.title}: as prescribed displacements of '{sides}'"
        for members, factors in vectors({k: group.motions[k] for k in own}):
            order = sorted(members)
            self.conditions.add(group.name, "Displacement", factors, Group=sides, **self._where(order), Value=[members[k] for k in order])

    def _add_rotated(self, group, own, motions):
        """A small rotation: displacements that are linear in the position"""
        members, factors = self._of_one_amplitude(group, motions)
        if members is None:
            return
        sides = self.solids.group(group.name, group.rows)
        group.reason = f"{group.title}: the rotation of node {group.reference[1]} as displacements of '{sides}' that are linear in the position"
        self.findings.change(group.place, group.reason)
        turn = [members.get(3 + k, 0.0) for k in range(3)]
        values = {}
        for k in own:
            after, last = (k + 1) % 3, (k + 2) % 3  # u_k = w_after x_last - w_last x_after
            terms = [repr(members[k])] + [f"{factor!r}*({LETTERS[at]} - {group.point[at]!r})"
                                          for factor, at in ((turn[after], last), (-turn[last], after)) if factor]
            values[f"Expression_{LETTERS[k]}"] = " + ".join(terms)
        self.conditions.add(group.name, "Displacement", factors, Group=sides, **self._where(own), **values)
