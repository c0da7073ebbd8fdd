"""*BOUNDARY on nodes of solid elements: sides all of whose nodes have the same prescribed displacement, and single nodes."""
import numpy as np

from .axes import Direction
from .conditions import LETTERS
from .steps import amount, vectors


class Supports:
    """
    A condition of a scene acts on sides, or on the node at a point; a *BOUNDARY acts on nodes. A node that is not on a side whose nodes are
    all held alike is held by a condition at its point. Displacements are held along a component, a number from 0, or a Direction.
    """

    def __init__(self, track, nodal, axes, solids, conditions, findings):
        self.solids, self.conditions, self.findings = solids, conditions, findings
        self.alike = {}  # (component or Direction, values) -> nodes of the mesh
        self.of_source = {}  # Source -> {(component or Direction, values): nodes}
        for key, along, values, source in axes.supports(track, nodal):
            self._note(key, along, values, source)
        for (key, dof), values in track.values.items():
            if key in solids.node and dof <= solids.mesh.dimension:  # others: reference nodes; solid elements have no rotations
                self._note(key, dof - 1, values, nodal.source[key, dof])
        self.held = {what: set() for what in self.alike}
        for source, parts in self.of_source.items():
            self._add(source, parts)
        self._add_rest()

    def _note(self, key, along, values, source):
        what = (along, tuple(values.tolist()))
        self.alike.setdefault(what, set()).add(self.solids.node[key])
        self.of_source.setdefault(source, {}).setdefault(what, set()).add(self.solids.node[key])

    def _add(self, source, parts):
        groups = {}  # side group -> component -> values
        for what, nodes in parts.items():
            rows = self.solids.rows_with_nodes(nodes)
            if len(rows):
                self._take(what, rows)
                groups.setdefault(self.solids.group(source.name, rows), {})[what[0]] = np.array(what[1])
        for group, components in groups.items():
            self._write(source.name, components, Group=group)

    def _take(self, what, rows):
        nodes = rows[:, 2:]
        self.held[what].update(nodes[nodes >= 0].tolist())

    def _write(self, name, components, **place):
        """\param components  component or Direction -> values \param place  Group, or Body and Point"""
        for along in [along for along in components if isinstance(along, Direction)]:
            value, factors = amount(components.pop(along))
            self.conditions.add(name, "Displacement", factors, **place, **along.parameters(self.solids.mesh.dimension), Value=[value])
        for members, factors in vectors(components):
            if len(members) == self.solids.mesh.dimension:
                self.conditions.add(name, "Displacement", factors, **place, Value=self.conditions.vector(members))
            else:
                order = sorted(members)
                letters = "".join(LETTERS[k] for k in order)
                self.conditions.add(name, "Displacement", factors, **place, Components=letters, Value=[members[k] for k in order])

    def _add_rest(self):
        """Sides between the nodes of several sets, then single nodes."""
        missing = {}
        for what, nodes in self.alike.items():
            rest = nodes - self.held[what]
            if not rest:
                continue
            rows = self.solids.rows_with_nodes(nodes)
            rows = rows[[bool(rest.intersection(row.tolist())) for row in rows[:, 2:]]]
            if len(rows):
                self._take(what, rows)
                group = self.solids.group("held together", rows)
                self._write("held together", {what[0]: np.array(what[1])}, Group=group)
            for source, parts in self.of_source.items():
                alone = (rest & parts.get(what, set())) - self.held[what]
                if alone:
                    missing.setdefault(source, {}).setdefault(what, set()).update(alone)
        for source, parts in missing.items():
            self.hold_nodes(source, parts)

    def hold_nodes(self, source, parts):
        """Nodes that no side holds, one by one: {(component, values): nodes}."""
        of_node = {}  # node -> component -> values
        for (component, values), nodes in parts.items():
            for node in nodes:
                of_node.setdefault(node, {})[component] = np.array(values)
        for node in sorted(of_node):
            self._write(source.name, of_node[node], Body=self.solids.bodies[self.solids.node_body[node]],
                        Point=self.solids.mesh.points[node].tolist()[:self.solids.mesh.dimension])
