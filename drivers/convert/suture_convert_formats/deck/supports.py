"""*BOUNDARY on nodes of solid elements: sides all of whose nodes have the same prescribed displacement, and single nodes."""
import numpy as np

from .conditions import LETTERS
from .steps import vectors


class Supports:
    """
    A condition of a scene acts on sides, or on the node at a point; a *BOUNDARY acts on nodes. A node that is not on a side whose nodes are
    all held alike is held by a condition at its point.
    """

    def __init__(self, track, nodal, solids, conditions, findings):
        self.track, self.nodal, self.solids, self.conditions, self.findings = track, nodal, solids, conditions, findings
        self.alike = {}  # (component, values) -> nodes of the mesh
        self.of_source = {}  # Source -> {(component, values): nodes}
        for (key, dof), values in track.values.items():
            node = solids.node.get(key)
            if node is None or dof > solids.mesh.dimension:
                continue  # reference nodes; solid elements have no rotations
            what = (dof - 1, tuple(values.tolist()))
            self.alike.setdefault(what, set()).add(node)
            self.of_source.setdefault(nodal.source[key, dof], {}).setdefault(what, set()).add(node)
        self.held = {what: set() for what in self.alike}
        for source, parts in self.of_source.items():
            self._add(source, parts)
        self._add_rest()
        self._list_changes()

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
        """\param place  Group, or Body and Point"""
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

    def _list_changes(self):
        """Supports that begin or end in a later step hold over the whole path."""
        first = self.track.steps.all[0] if self.track.steps.all else None
        listed = set()
        for (key, dof), step in self.track.began.items():
            source = self.nodal.source[key, dof]
            if key not in self.solids.node or dof > self.solids.mesh.dimension:
                continue
            if step is not first and (source, "on") not in listed:
                listed.add((source, "on"))
                self.findings.leave(source.place, f"*BOUNDARY on '{source.name}': it begins in step {step.number}; in the scene it holds from the "
                                                  "first step on")
            ended = self.track.removed.get((key, dof))
            if ended and (source, "off") not in listed:
                listed.add((source, "off"))
                self.findings.leave(source.place, f"*BOUNDARY on '{source.name}': it ends in step {ended.number}; in the scene it holds to the end")
