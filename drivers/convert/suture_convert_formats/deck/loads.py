"""*CLOAD, *DLOAD and *DSLOAD."""
import re

import numpy as np

from .cards import numbers_in
from .geometry import integrals
from .solids import lost
from .steps import amount, vectors

UNIFORM = 1e-5  # relative difference of nodal forces up to which they are those of a uniform traction
AXES = {"BX": 0, "BY": 1, "BZ": 2}


class Loads:
    def __init__(self, steps, nodal, solids, conditions, findings):
        self.steps, self.nodal, self.solids, self.conditions, self.findings = steps, nodal, solids, conditions, findings
        self.sets, self.mesh = solids.sets, solids.mesh
        self.targets = {}

    # Concentrated forces

    def add_point_forces(self, track):
        of_source = {}
        for (key, dof), values in track.values.items():
            node = self.solids.node.get(key)
            if node is None:
                continue
            source = self.nodal.source[key, dof]
            if dof > self.mesh.dimension:
                why = "; nodes of solid elements have no rotations" if 3 < dof < 7 else ""
                self.findings.leave(source.place, f"*CLOAD on '{source.name}': direction {dof}{why}")
                continue
            of_source.setdefault(source, {}).setdefault(node, {})[dof - 1] = values
        for source, nodes in of_source.items():
            if not self._add_uniform(source, nodes):
                for number, (node, parts) in enumerate(nodes.items(), 1):
                    self._add_point_force(source.name + (f" {number}" if len(nodes) > 1 else ""), node, parts)

    def _add_point_force(self, name, node, parts):
        body = self.solids.bodies[self.solids.node_body[node]]
        for members, factors in vectors(parts):
            if any(members.values()):
                place = self.mesh.points[node].tolist()
                self.conditions.add(name, "Point Force", factors, Body=body, Point=place, Value=self.conditions.vector(members))

    def _add_uniform(self, source, nodes):
        """Adds one Force if the nodal forces are those of a uniform traction on sides. \\return whether they are"""
        rows = self.solids.rows_with_nodes(nodes)
        if not len(rows) or len(nodes) < 3:
            return False
        weights, area, _ = integrals(self.mesh, rows, self.solids.model == "Axisymmetric")
        total = {}
        for parts in nodes.values():
            for component, values in parts.items():
                total[component] = total.get(component, 0.0) + values
        scale = max(np.abs(values).max() for values in total.values())
        for node in set(nodes) | set(np.flatnonzero(weights).tolist()):
            for component, sum_ in total.items():
                value = nodes.get(node, {}).get(component, np.zeros(len(self.steps.times)))
                if np.abs(value - sum_ * weights[node] / area).max() > UNIFORM * scale / len(nodes):
                    return False
        group = self.solids.group(source.name, rows)
        for members, factors in vectors(total):
            if any(members.values()):
                self.conditions.add(source.name, "Force", factors, Group=group, Value=self.conditions.vector(members))
        return True

    # Distributed loads

    def add_distributed(self):
        track = self.steps.track(("DLOAD", "DSLOAD"), self._expand, adds=True)
        self._list_overlaps(track)
        found = {}
        for (target, kind, component), values in track.values.items():
            found.setdefault((target, kind), {})[component] = values
        single = {}  # pressures on single elements, by their values: sides
        for (target, kind), parts in found.items():
            place = track.place[target, kind, next(iter(parts))]
            if self._is_label(target) and re.fullmatch(r"P\d", str(kind)):
                single.setdefault((tuple(parts[0].tolist()), track.card[target, kind, 0]), []).append((target, kind))
            else:
                self._add_one(target, kind, parts, place)
        for (values, place), all_ in single.items():
            sides = [(self.targets[target][1][0], int(kind[1]) - 1) for target, kind in all_]
            self._add_sides_of_card(sides, np.array(values), place)

    def _list_overlaps(self, track):
        """Loads of one kind that begin in different steps and share elements: in CalculiX the later one replaces the earlier one there."""
        by_kind = {}
        for (target, kind, component), step in track.began.items():
            if str(kind).startswith("P") and component == 0:
                by_kind.setdefault(kind, {})[target] = step
        for kind, steps in by_kind.items():
            if len(set(steps.values())) < 2:
                continue
            for later, other in sorted(self._overlapping(steps), key=str):
                ended = track.removed.get((other, kind, 0))
                if ended is None or ended.number > steps[later].number:
                    titles = [self.targets[target][0] for target in (later, other)]
                    self.findings.leave(track.place[later, kind, 0], f"load {kind} on '{titles[0]}' shares elements with that on '{titles[1]}' of step "
                                        f"{steps[other].number}: both act there, as in Abaqus; CalculiX replaces the earlier one")

    def _overlapping(self, steps):
        """Pairs (later, earlier) of targets that share elements or sides"""
        owners, pairs = {}, set()
        for target in steps:
            for member in self.targets[target][1]:
                owners.setdefault(member, []).append(target)
        for own in owners.values():
            pairs |= {(later, other) for later in own for other in own if steps[later].number > steps[other].number}
        return pairs

    def add_foundations(self, cards):
        """*FOUNDATION: pressure per normal displacement"""
        for card in cards:
            for place, words in card.rows if card.keyword == "FOUNDATION" else ():
                kind = words[1].upper() if len(words) > 1 else ""
                stiffness = numbers_in(words[2:3], place, self.findings)
                target = self._target(card, words[0], False, place)
                if not re.fullmatch(r"F\d", kind) or not stiffness or not stiffness[0]:
                    self.findings.leave(place, f"{card.title}: {kind or 'no type'} with {len(words) - 2} numbers")
                elif target is not None and (group := self._group(target, kind, place)) is not None:
                    self.conditions.add(f"foundation of {self.targets[target][0]}", "Elastic Support", Group=group, Normal_Stiffness=stiffness[0])

    def _is_label(self, target):
        return target[0] == "ELSET" and target[1] in self.solids.deck.elements and len(self.targets[target][1]) == 1

    def _add_one(self, target, kind, parts, place):
        if isinstance(kind, tuple):
            self._add_rotation(target, kind, parts[0], place)
        elif kind.startswith("P"):
            self._add_pressure(target, kind, parts[0], place)
        elif kind == "TRVEC":
            self._add_vector(target, "Traction", parts, Group=self._group(target, kind, place))
        else:
            self._add_on_bodies(target, "Gravity" if kind == "GRAV" else "Body Force", parts, place)

    def _add_sides_of_card(self, sides, values, place):
        """One pressure for the elements that a card lists one by one"""
        name = f"sides of line {place.line}"
        known = [side for side in sides if side[0] in self.solids.element and side[1] < self._sides_of(side[0])]
        if len(known) < len(sides):
            self.findings.leave(place, f"pressure on {len(sides) - len(known)} of {len(sides)} elements, which have no such side")
        rows = self._found(known, name, place)
        value, factors = amount(values)
        if len(rows) and value:
            self.conditions.add(f"pressure on {name}", "Pressure", factors, Group=self.solids.group(name, rows), Value=[value])

    def _found(self, sides, name, place):
        rows, inside, unknown = self.solids.rows_of(sides)
        if inside + unknown:
            self.findings.leave(place, f"pressure on {name}: {lost(inside, unknown, len(sides))}")
        return rows

    def _expand(self, card):
        for place, words in card.rows:
            kind = words[1].upper().replace(" ", "") if len(words) > 1 else ""
            surface = card.keyword == "DSLOAD"
            numbers = [value or 0.0 for value in numbers_in(words[2:], place, self.findings)]
            target = self._target(card, words[0], surface, place)
            if target is None:
                continue
            if (kind == "P" if surface else re.fullmatch(r"P\d", kind)) and numbers:
                yield (target, kind, 0), numbers[0], place
            elif kind in ("TRVEC", "GRAV") and surface == (kind == "TRVEC") and len(numbers) > 3 and any(numbers[1:4]):
                direction = np.array(numbers[1:4]) / np.linalg.norm(numbers[1:4])
                for k in range(3):
                    yield (target, kind, k), numbers[0] * direction[k], place
            elif kind in AXES and not surface and numbers:
                yield (target, "B", AXES[kind]), numbers[0], place
            elif kind == "CENTRIF" and not surface and len(numbers) > 6 and any(numbers[4:7]):
                yield (target, ("CENTRIF", *numbers[1:7]), 0), numbers[0], place
            else:
                self.findings.leave(place, f"{card.title}: {kind or 'no type'} with {len(numbers)} numbers")

    def _target(self, card, word, surface, place):
        """(title, sides or elements) of a load, by its number in `targets`"""
        kind = "SURFACE" if surface else "ELSET"
        if not surface and not word:
            self.targets["all"] = ("all bodies", list(self.solids.element))
            return "all"
        label = None if surface else self.sets.labelled(word, card.scope)
        key = label or self.sets.key_of(kind, word, card.scope)
        if (kind, key) not in self.targets:
            if surface:
                members = self.sets.surface_named(word, card.scope, place)[0]
            else:
                members = self.sets.members("ELSET", word, card.scope, place)
            if key is None or not members:
                if key is not None:
                    what = "no sides" if surface else "no elements"
                    self.findings.leave(place, f"{card.title} on '{word}': it has {what}")
                return None
            self.targets[kind, key] = (self.sets.title(key) if label is None else f"element {word}", members)
        return (kind, key)

    def _group(self, target, kind, place):
        """Side group of a load; None: it has no side on the boundary"""
        title, members = self.targets[target]
        sides = members
        if target[0] != "SURFACE":
            side = int(kind[1]) - 1
            sides = [(key, side) for key in members if key in self.solids.element and side < self._sides_of(key)]
            if len(sides) < len(members):
                self.findings.leave(place, f"load {kind} on '{title}': {len(members) - len(sides)} of {len(members)} elements have no such side")
        rows = self._found(sides, f"'{title}'", place)
        if not len(rows):
            return None
        return self.solids.group(title if target[0] == "SURFACE" else f"{title} {kind}", rows)

    def _sides_of(self, key):
        from .elements import sides_of

        return len(sides_of(self.solids.deck.elements[key].kind))

    def _add_pressure(self, target, kind, values, place):
        group = self._group(target, kind, place)
        value, factors = amount(values)
        if group is not None and value:
            self.conditions.add(f"pressure on {self.targets[target][0]}", "Pressure", factors, Group=group, Value=[value])

    def _add_vector(self, target, type_, parts, **where):
        if None in where.values():
            return
        for members, factors in vectors(parts):
            if any(members.values()):
                name = f"{type_.lower()} on {self.targets[target][0]}"
                self.conditions.add(name, type_, factors, **where, Value=self.conditions.vector(members))

    def _where(self, target, type_, place):
        """Bodies that consist of the elements of a set: [{}] for all bodies, or [{Body: name}]"""
        title, members = self.targets[target]
        own = np.zeros(len(self.solids.element), dtype=bool)
        own[[self.solids.element[key] for key in members if key in self.solids.element]] = True
        if own.all():
            return [{}]
        found = []
        for body, name in enumerate(self.solids.bodies):
            share = own[self.solids.body_of == body]
            if share.all():
                found.append({"Body": name})
            elif share.any():
                self.findings.leave(place, f"{type_} on '{title}': it contains only a part of body '{name}'")
        return found

    def _add_on_bodies(self, target, type_, parts, place):
        for where in self._where(target, type_, place):
            self._need_density(type_, place, where)
            self._add_vector(target, type_, parts, **where)

    def _need_density(self, type_, place, where):
        if type_ == "Body Force":
            return
        own = self.solids.body_of == self.solids.bodies.index(where["Body"]) if where else slice(None)
        for section in np.unique(self.solids.section_of[own]).tolist():
            material = self.solids.sections.all[section].material
            if material.density is None:
                self.findings.error(place, f"{type_}: material '{material.title}' has no *DENSITY")

    def _add_rotation(self, target, kind, values, place):
        """CENTRIF: the square of the angular velocity; a factor multiplies the forces"""
        point, axis = np.array(kind[1:4]), np.array(kind[4:7])
        value, factors = amount(values)
        if not value:
            return
        speed = np.sqrt(value)
        axisymmetric = self.solids.model == "Axisymmetric"
        along = np.array([0, 1, 0]) if axisymmetric else np.array([0, 0, 1])
        if self.mesh.dimension == 2 and np.linalg.norm(np.cross(axis, along)) > 1e-9 * np.linalg.norm(axis):
            self.findings.leave(place, "CENTRIF about an axis that is not " + ("y" if axisymmetric else "perpendicular to the plane"))
            return
        omega = (speed * axis / np.linalg.norm(axis)).tolist() if self.mesh.dimension == 3 else [float(speed)]
        for where in self._where(target, "Rotation", place):
            self._need_density("Rotation", place, where)
            if not axisymmetric:
                where = {**where, "Point": point[:self.mesh.dimension].tolist()}
            self.conditions.add(f"rotation of {self.targets[target][0]}", "Rotation", factors, **where, Value=omega)
