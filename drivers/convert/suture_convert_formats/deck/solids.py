"""The mesh of a scene: solid elements, bodies as their connected pieces, materials by section."""
import numpy as np

from ..mesh import Mesh
from .elements import dimension_of, model_of

FORBIDDEN = str.maketrans({"{": "(", "}": ")", ",": "_", '"': "'", "\n": " "})


def clean(name):
    """A name that a list of a scene, {a, b}, may contain"""
    return name.translate(FORBIDDEN).strip() or "unnamed"


def lost(inside, unknown, count):
    """'2 of 9 sides are inside the material'"""
    kinds = (inside, "inside the material"), (unknown, "not on a solid element")
    parts = [f"{some} {'is' if some == 1 else 'are'} {what}" for some, what in kinds if some]
    return f"of {count} sides " + " and ".join(parts)


def components(count, blocks):
    """A number for each point, equal for points that elements connect."""
    number = np.arange(count)
    while True:
        before = number.copy()
        for _, nodes in blocks:
            least = number[nodes].min(axis=1)
            for column in nodes.T:
                np.minimum.at(number, column, least)
        number = number[number]
        if (number == before).all():
            return number


class Solids:
    """
    mesh        Mesh of the elements that have a section
    node        node key -> node of the mesh
    element     element key -> element of the mesh
    body_of     body of each element, as a number
    node_body   body of each node
    bodies      names of the bodies
    model       value of the scene's Model
    section_of  section of each element, as a number in `sections`
    """

    def __init__(self, model, sets, sections, findings):
        self.deck, self.sets, self.sections, self.findings = model, sets, sections, findings
        self._choose_model()
        foreign, place, number = model.foreign(lambda key, element: key in self.sections.of_element and self._is_solid(element))
        if not number:
            findings.error(None, "no solid elements with a *SOLID SECTION; to convert only the mesh, omit --scene; suture_new writes a scene for it")
            findings.stop()
        self.mesh = Mesh(foreign, findings.path)
        self.mesh.groups, self.mesh.remarks = {}, [remark for remark in self.mesh.remarks if "reversed" in remark]
        self.element = {key: int(self.mesh.number[at]) for key, at in number.items()}
        self.node = {key: int(self.mesh.new[at]) for key, at in place.items() if self.mesh.new[at] >= 0}
        self.section_of = np.zeros(len(self.element), dtype=int)
        for key, at in self.element.items():
            self.section_of[at] = sections.of_element[key]
        self._find_bodies()
        self._list_others()

    def _is_solid(self, element):
        if self.deck.dimension == 3:
            return dimension_of(element.kind) == 3
        return model_of(element.type) is not None

    def _choose_model(self):
        if self.deck.dimension == 3:
            self.model = "Solid"
            return
        found = {}
        for key in self.sections.of_element:
            element = self.deck.elements[key]
            if element.kind and model_of(element.type):
                found.setdefault(model_of(element.type), element)
        if len(found) > 1:
            each = ", ".join(f"{name} ({element.type})" for name, element in found.items())
            self.findings.error(next(iter(found.values())).place, f"elements of several models: {each}; expected one")
        self.model = next(iter(found), "Plane Strain")

    def _find_bodies(self):
        number = components(len(self.mesh.points), self.mesh.blocks)
        roots, self.node_body = np.unique(number, return_inverse=True)
        self.node_body = self.node_body.ravel()
        self.body_of = np.concatenate([self.node_body[nodes[:, 0]] for _, nodes in self.mesh.blocks])
        order = self._order(len(roots))
        self.node_body, self.body_of = order[self.node_body], order[self.body_of]
        self.bodies = self._names(len(roots))

    def _order(self, count):
        """New numbers of bodies, in the order of their first elements in the deck"""
        first = {}
        for at in self.element.values():
            first.setdefault(int(self.body_of[at]), len(first))
        return np.array([first[body] for body in range(count)])

    def _names(self, count):
        """Names of the bodies: instance, set of the section, or another element set with the same elements; numbered if shared."""
        members = [set() for _ in range(count)]
        for key, at in self.element.items():
            members[self.body_of[at]].add(key)
        exact = self._exact_names(members)
        names = []
        for body, own in enumerate(members):
            some = next(iter(own))
            instances = {key[0] for key in own}
            instance = self.sets.assembly.instances.get(some[0]) if len(instances) == 1 else None
            names.append(clean(instance or exact.get(body) or self.sections.all[self.sections.of_element[some]].title))
        shared = {name for name in names if names.count(name) > 1}
        counts = {}
        for body, name in enumerate(names):
            if name in shared:
                counts[name] = counts.get(name, 0) + 1
                names[body] = f"{name}_{counts[name]}"
        return names

    def _exact_names(self, members):
        """Body -> name of the best element set with exactly its elements: that of a section, or the last one of the deck"""
        of_sections = {section.set for section in self.sections.all}
        found = {}
        for key in self.sets.entries["ELSET"]:
            own = [one for one in self.sets.of("ELSET", key) if one in self.element]
            if not own:
                continue
            body = int(self.body_of[self.element[own[0]]])
            if len(own) == len(members[body]) and members[body].issuperset(own) and found.get(body, (None, False))[1] <= (key in of_sections):
                found[body] = (self.sets.names[key], key in of_sections)
        return {body: name for body, (name, _) in found.items()}

    def _list_others(self):
        """Elements that are neither in the mesh nor sides of it."""
        facets, without, left = {}, {}, {}
        for key, element in self.deck.elements.items():
            if key in self.element:
                continue
            if element.kind and self._is_solid(element):
                without.setdefault(element.place, [element.type, 0])[1] += 1
            elif element.kind and self.sets.is_facet(element) and key not in self.sections.of_element and key not in self.sections.of_shell:
                facets.setdefault(element.place, []).append(key)
            else:
                left.setdefault(element.place, [element.type, 0])[1] += 1
        for place, (type_, count) in without.items():
            self.findings.error(place, f"{count} elements of the type {type_} have no *SOLID SECTION")
        for place, (type_, count) in left.items():
            self.findings.leave(place, f"{count} element{'s' if count > 1 else ''} of the type {type_}")
        for place, keys in facets.items():
            self._check_facets(place, keys)

    def _check_facets(self, place, keys):
        """Facets are groups of sides; those that are not on the boundary of the solids are not taken over."""
        rows = [[self.node.get(node, -2) for node in self.sets.nodes_of_side((key, None))] for key in keys]
        _, inside, unknown = self.mesh.sides_with(rows)
        if inside + unknown:
            type_ = self.deck.elements[keys[0]].type
            self.findings.leave(place, f"{inside + unknown} elements of the type {type_}, which are not sides of solid elements")

    def rows_of(self, sides):
        """Boundary sides of the mesh for sides (element key, number) of the deck. \\return rows, number of sides inside the material, of others"""
        rows = [[self.node.get(node, -2) for node in self.sets.nodes_of_side(side)] for side in sides]
        return self.mesh.sides_with(rows)

    def rows_with_nodes(self, nodes):
        """Boundary sides all of whose nodes, also those between vertices, are among `nodes` of the mesh"""
        among = np.zeros(len(self.mesh.points) + 1, dtype=bool)  # the last entry means no node
        among[list(nodes)] = True
        among[-1] = True
        return self.mesh.boundary[among[self.mesh.boundary[:, 2:]].all(axis=1)]

    def rows_of_surface(self, sides, nodes):
        """Boundary sides for sides of the deck and for nodes. \\return rows, and sentences about sides and nodes without one"""
        rows, inside, unknown = self.rows_of(sides)
        faults = [lost(inside, unknown, len(sides))] if inside + unknown else []
        own = {self.node[node] for node in nodes if node in self.node}
        if own:
            more = self.rows_with_nodes(own)
            missing = len(own - set(more[:, 2:].ravel().tolist()))
            if missing:
                faults.append(f"{missing} of {len(own)} nodes are not on a side whose nodes all belong to it")
            rows = np.unique(np.vstack([rows, more]), axis=0)
        return rows, faults

    def group(self, name, rows):
        """Adds a side group. \\return its name, which is new unless a group has the same sides"""
        rows = rows[np.lexsort((rows[:, 1], rows[:, 0]))]
        for other, own in self.mesh.side_groups.items():
            if own.shape == rows.shape and (own == rows).all():
                return other
        name = clean(name)
        free, count = name, 1
        while free in self.mesh.side_groups:
            count += 1
            free = f"{name}_{count}"
        self.mesh.side_groups[free] = rows
        return free

    def add_element_groups(self):
        """Groups of bodies, and of regions: \\return for each body its section, and the regions {group: section}"""
        found = []
        for body, name in enumerate(self.bodies):
            own = np.flatnonzero(self.body_of == body)
            self.mesh.groups[name] = own
        for body, name in enumerate(self.bodies):
            own = self.mesh.groups[name]
            kinds, counts = np.unique(self.section_of[own], return_counts=True)
            main = int(kinds[np.argmax(counts)])
            regions = {}
            for section in kinds.tolist():
                if self.sections.all[section].material_key == self.sections.all[main].material_key:
                    continue
                title = group = clean(self.sections.all[section].title)
                count = 1
                while group in self.mesh.groups:
                    count += 1
                    group = f"{title}_{count}"
                self.mesh.groups[group] = own[self.section_of[own] == section]
                regions[group] = section
            found.append((main, regions))
        return found

