"""*TRANSFORM: local axes of nodes, in which *BOUNDARY and *CLOAD give their values."""
import dataclasses

import numpy as np

SAME = 1e-9  # sine of the angle between equal directions


@dataclasses.dataclass(frozen=True)
class Direction:
    """
    Direction of a support, constant or about an axis, as in a scene.

    along   Direction, Radius or Circumference
    vector  the direction, or that of the axis
    origin  a point of the axis, or None
    """
    along: str
    vector: tuple
    origin: tuple = None

    def parameters(self, dimension):
        found = {}
        if self.along != "Direction":
            found = {"Along": self.along, "Axis Point": list(self.origin)[:dimension]}
        if self.along == "Direction" or dimension == 3:
            found["Direction"] = list(self.vector)[:dimension]
        return found


class NodeSystem:
    """Axes at any place: rectangular, or cylindrical about a line"""

    def __init__(self, card, axes, origin=None):
        self.card, self.axes, self.origin = card, axes, origin  # rows of `axes`: the axes; cylindrical: the last is that of the cylinder

    def at(self, point):
        """Axes as rows; None: on the axis of a cylindrical system"""
        if self.origin is None:
            return self.axes
        away = np.asarray(point) - self.origin
        radius = away - (away @ self.axes[2]) * self.axes[2]
        length = np.linalg.norm(radius)
        if length <= SAME * np.linalg.norm(away) or length == 0:
            return None
        radius /= length
        return np.array([radius, np.cross(self.axes[2], radius), self.axes[2]])

    def direction(self, k):
        """Direction of axis k of a support"""
        if self.origin is None or k == 2:
            return Direction("Direction", tuple(self.axes[k].tolist()))
        return Direction(("Radius", "Circumference")[k], tuple(self.axes[2].tolist()), tuple(self.origin.tolist()))


def cleaned(axes):
    """Axes without components at round-off"""
    axes[np.abs(axes) < 1e-14] = 0.0
    return axes


def read_system(card, motion, findings):
    """NodeSystem of a *TRANSFORM; None after a finding"""
    kind = card.option("TYPE", "R")
    values = [value or 0.0 for _, row in card.numbers(findings) for value in row]
    if kind not in ("R", "C"):
        findings.leave(card.place, f"{card.title}, TYPE={kind}: only rectangular and cylindrical axes; values at these nodes are left out")
        return None
    if len(values) < 6:
        findings.error(card.place, f"{card.title}: expected two points, found {len(values)} numbers")
        return None
    first, second = np.array(values[:3]), np.array(values[3:6])
    if kind == "C":
        if motion:
            first, second = motion.moved(first), motion.moved(second)
        axis = second - first
        if not np.linalg.norm(axis):
            findings.error(card.place, f"{card.title}: the two points of the axis are the same")
            return None
        axis = axis / np.linalg.norm(axis)
        return NodeSystem(card, cleaned(np.array([[0, 0, 0], [0, 0, 0], axis], dtype=float)), first)
    if motion:
        first, second = motion.turned(first), motion.turned(second)
    third = np.cross(first, second)
    if not np.linalg.norm(third) > SAME * np.linalg.norm(first) * np.linalg.norm(second):
        findings.error(card.place, f"{card.title}: the two points and the origin are on a line")
        return None
    axes = [first, np.cross(third, first), third]
    return NodeSystem(card, cleaned(np.array([axis / np.linalg.norm(axis) for axis in axes])))


class NodalAxes:
    """Systems of nodes; a node without one has the global axes."""

    def __init__(self, cards, solids, findings):
        self.solids, self.findings, self.of = solids, findings, {}
        for card in cards:
            if card.keyword == "TRANSFORM":
                motion = solids.sets.assembly.motions.get(card.scope)
                system = self._in_plane(read_system(card, motion, findings))
                members = solids.sets.members("NSET", card.options.get("NSET", ""), card.scope, card.place)
                self.of.update(dict.fromkeys(members, (system, card)))

    def _in_plane(self, system):
        """A system that a plane model can have, or None after a finding"""
        if system is None or self.solids.mesh.dimension == 3:
            return system
        if abs(system.axes[2][2]) < 1 - SAME:
            why = "axis 3 is not perpendicular to the plane"
        elif system.origin is not None and self.solids.model == "Axisymmetric":
            why = "cylindrical axes in an axisymmetric model"
        else:
            return system
        self.findings.leave(system.card.place, f"{system.card.title}: {why}; values at these nodes are left out")
        return None

    def axes_at(self, key):
        """(axes as rows, system) of a node in local axes; None: global axes, or a system that was not read"""
        system, _ = self.of.get(key, (None, None))
        axes = system.at(self.solids.deck.nodes[key]) if system is not None and key in self.solids.deck.nodes else None
        return None if axes is None else (axes, system)

    def _local(self, track):
        """Node -> number from 0 of its axis -> values, for nodes in local axes"""
        found = {}
        for (key, dof), values in track.values.items():
            if key in self.of and dof <= 3:
                found.setdefault(key, {})[dof - 1] = values
        return found

    def _drop(self, track, nodal, key, parts, why):
        for k in parts:
            source = nodal.source[key, k + 1]
            _, card = self.of[key]
            self.findings.leave(source.place, f"values on '{source.name}' in the axes of {card.title} (line {card.place.line}){why}")
            track.drop((key, k + 1))

    def turn_forces(self, track, nodal):
        """Forces of a track in global axes"""
        for key, parts in self._local(track).items():
            here = self.axes_at(key)
            if here is None:
                self._drop(track, nodal, key, parts, self._why_not(key, here))
                continue
            first = (key, 1 + next(iter(parts)))
            force = sum(np.outer(here[0][k], values) for k, values in parts.items())
            for k in range(3):
                track.copy(first, (key, k + 1), force[k])
                nodal.source[key, k + 1] = nodal.source[first]
            for k in range(3):
                if not np.any(force[k]):
                    track.drop((key, k + 1))

    def supports(self, track, nodal):
        """Takes the displacements in local axes out of a track. \\return list of (node key, component from 0 or Direction, values, Source)"""
        found = []
        for key, parts in self._local(track).items():
            here = self.axes_at(key)
            if here is None or key not in self.solids.node:
                self._drop(track, nodal, key, parts, self._why_not(key, here))
                continue
            of_source = {}
            for k, values in parts.items():
                of_source.setdefault(nodal.source[key, k + 1], {})[k] = values
                track.drop((key, k + 1))
            found += [(key, what, values, source) for source, own in of_source.items() for what, values in self._held(*here, own)]
        return found

    def _why_not(self, key, here):
        if here is not None:
            return ": the node belongs to no solid element"
        return ": they are undefined at a node on the axis" if self.of[key][0] else ""

    def _held(self, axes, system, parts):
        """(component or Direction, values) with the same meaning as values along some axes"""
        dimension = self.solids.mesh.dimension
        parts = {k: values for k, values in parts.items() if np.any(np.abs(axes[k][:dimension]) > SAME)}  # not out of a 2D plane
        zero = not any(np.any(values) for values in parts.values())
        if parts and (zero or system.origin is None):
            span = np.array([axes[k] for k in parts])[:, :dimension]
            inside = [i for i in range(dimension) if abs(np.linalg.norm(span[:, i]) - 1) < SAME]  # global axes in the span
            if len(inside) == len(parts):
                given = np.array([values for values in parts.values()])
                yield from ((i, rounded(span[:, i] @ given)) for i in inside)
                return
        for k, values in parts.items():
            along = np.flatnonzero(np.abs(axes[k]) > 1 - SAME)
            if len(along) and (system.origin is None or k == 2):
                yield int(along[0]), values * np.sign(axes[k][along[0]])
            else:
                against = dimension == 2 and k == 1 and system.origin is not None and axes[2][2] < 0  # in 2D the axis of a scene is z
                yield system.direction(k), -values if against else values


def rounded(values):
    """Values without digits at round-off, so that nodes with equal values are found"""
    scale = np.abs(values).max(initial=0.0)
    return np.round(values / scale, 13) * scale if scale else np.zeros_like(values)
