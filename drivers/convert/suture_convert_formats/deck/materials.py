"""*MATERIAL with *ELASTIC, *EXPANSION and *DENSITY; *SOLID SECTION and *ORIENTATION."""
import dataclasses

import numpy as np

from .elements import dimension_of
from .findings import nearest

SHELLS = ("SHELLSECTION", "MEMBRANESECTION", "BEAMSECTION", "COHESIVESECTION", "SHELLGENERALSECTION")
ORDER = "E1, E2, E3, nu12, nu13, nu23, G12, G13, G23"


@dataclasses.dataclass
class Material:
    """Constants as Suture's parameters; the lists of an orthotropic material are None for an isotropic one."""
    title: str
    place: object
    young: float = None
    poisson: float = None
    moduli: list = None
    ratios: list = None
    shear: list = None
    density: float = None
    expansion: float = None


def first_row(card, findings, least):
    """Numbers of all data lines of a card without dependence on temperature; a table by temperature keeps its first entry."""
    rows = [values for _, values in card.numbers(findings)]
    values = [value or 0.0 for row in rows for value in row]
    if len(values) < least:
        findings.error(card.place, f"{card.title}: expected {least} numbers, found {len(values)}")
        return None
    return values


class Materials:
    """Materials by upper-case name"""

    def __init__(self, cards, findings):
        self.all, self.findings = {}, findings
        current = None
        for card in cards:
            if card.keyword == "MATERIAL":
                current = self._begin(card)
            elif card.keyword in ("ELASTIC", "EXPANSION", "DENSITY"):
                if current is None:
                    findings.error(card.place, f"{card.title} without *MATERIAL before it")
                else:
                    getattr(self, "_" + card.keyword.lower())(current, card)

    def _begin(self, card):
        name = card.option("NAME")
        if not name:
            self.findings.error(card.place, "*MATERIAL without NAME=<name>")
        self.all[name] = Material(card.options.get("NAME", "material"), card.place)
        return self.all[name]

    def named(self, name, place):
        found = self.all.get(name.upper())
        if found is None:
            self.findings.error(place, f"no such material '{name}'" + nearest(name, [one.title for one in self.all.values()]))
        elif found.young is None and found.moduli is None:
            self.findings.error(found.place, f"material '{found.title}' has no *ELASTIC that can be converted; expected isotropic, "
                                             "ENGINEERING CONSTANTS or ORTHO")
        return found

    def _elastic(self, material, card):
        kind = card.option("TYPE", "ISOTROPIC").replace(" ", "")
        if kind in ("ISO", "ISOTROPIC"):
            values = first_row(card, self.findings, 2)
            if values:
                material.young, material.poisson = values[:2]
                self._warn_table(card, 1)
        elif kind in ("ENGINEERINGCONSTANTS", "ENGINEERINGCONSTANT"):
            values = first_row(card, self.findings, 9)
            if values:
                self._set_engineering(material, values[:9])
                self._warn_table(card, 2)
        elif kind in ("ORTHO", "ORTHOTROPIC"):
            values = first_row(card, self.findings, 9)
            if values:
                self._set_stiffness(material, card, values[:9])
                self._warn_table(card, 2)
        else:
            self.findings.leave(card.place, f"{card.title}, TYPE={card.options['TYPE']}")

    def _warn_table(self, card, rows):
        if len(card.rows) > rows:
            self.findings.leave(card.rows[rows][0], f"{card.title}: dependence on temperature; the first values are used")

    @staticmethod
    def _set_engineering(material, values):
        e1, e2, e3, nu12, nu13, nu23, g12, g13, g23 = values
        material.moduli, material.ratios, material.shear = [e1, e2, e3], [nu12, nu23, nu13], [g12, g23, g13]

    def _set_stiffness(self, material, card, values):
        """D1111, D1122, D2222, D1133, D2233, D3333, D1212, D1313, D2323"""
        d11, d12, d22, d13, d23, d33, g12, g13, g23 = values
        stiffness = np.array([[d11, d12, d13], [d12, d22, d23], [d13, d23, d33]])
        if np.linalg.eigvalsh(stiffness).min() <= 0:
            self.findings.error(card.place, f"{card.title}: the matrix of D1111 to D3333 is not positive definite")
            return
        c = np.linalg.inv(stiffness)
        e = 1 / np.diag(c)
        self._set_engineering(material, [*e.tolist(), *(float(v) for v in (-c[0, 1] * e[0], -c[0, 2] * e[0], -c[1, 2] * e[1], g12, g13, g23))])

    def _expansion(self, material, card):
        if card.option("TYPE", "ISO") != "ISO":
            self.findings.leave(card.place, f"{card.title}, TYPE={card.options['TYPE']}")
            return
        values = first_row(card, self.findings, 1)
        if values:
            material.expansion = values[0]
            self._warn_table(card, 1)

    def _density(self, material, card):
        values = first_row(card, self.findings, 1)
        if values:
            material.density = values[0]
            self._warn_table(card, 1)


@dataclasses.dataclass
class Section:
    """
    title         name of its element set in the file
    set           key of its element set
    material      Material
    axes          axes 1 and 2 and an angle of an orthotropic material, or None
    thickness     of plane elements
    material_key  equal for sections whose elements have the same material and axes
    """
    title: str
    set: tuple
    material: Material
    axes: object
    thickness: float
    place: object
    material_key: tuple = None


class Sections:
    """
    all         sections in their order
    of_element  element key -> number of its section
    of_shell    keys of elements with a section that is not solid
    """

    def __init__(self, cards, model, sets, materials, findings):
        self.all, self.of_element, self.of_shell = [], {}, set()
        self.model, self.sets, self.materials, self.findings = model, sets, materials, findings
        self.orientations = {(card.scope, card.option("NAME")): card for card in cards if card.keyword == "ORIENTATION"}
        for card in cards:
            if card.keyword == "SOLIDSECTION":
                self._add(card)
            elif card.keyword in SHELLS and card.option("ELSET"):
                self.of_shell.update(sets.members("ELSET", card.options["ELSET"], card.scope, card.place))

    def _add(self, card):
        name = card.options.get("ELSET", "")
        members = self.sets.members("ELSET", name, card.scope, card.place)
        material = self.materials.named(card.options.get("MATERIAL", ""), card.place)
        axes = self._axes(card) if "ORIENTATION" in card.options else None
        key = self.sets.key_of("ELSET", name, card.scope)
        if material is None or key is None:
            return
        if material.moduli is None:
            axes = None  # an isotropic material has no axes
        thickness = (card.numbers(self.findings) or [(None, [None])])[0][1][0] or 1.0
        title = self.sets.title(key) if card.scope and len(self.model.assembly.instances) > 1 else self.sets.names[key]
        orientation = (card.scope, card.option("ORIENTATION")) if axes else None
        number = len(self.all)
        self.all.append(Section(title, key, material, axes, thickness, card.place, (material.title, orientation)))
        self.of_element.update((key, number) for key in members if self._may_be_solid(key))
        self.of_shell.update(key for key in members if not self._may_be_solid(key))  # membranes, trusses

    def _may_be_solid(self, key):
        element = self.model.elements[key]
        return element.kind is not None and dimension_of(element.kind) == self.model.dimension

    def _axes(self, card):
        found = self.orientations.get((card.scope, card.option("ORIENTATION"))) or self.orientations.get(("", card.option("ORIENTATION")))
        if found is None:
            known = [one.options.get("NAME", "") for one in self.orientations.values()]
            self.findings.error(card.place, f"no such orientation '{card.options['ORIENTATION']}'" + nearest(card.options["ORIENTATION"], known))
            return None
        if found.option("SYSTEM", "RECTANGULAR") not in ("RECTANGULAR", "R") or found.option("DEFINITION", "COORDINATES") != "COORDINATES":
            self.findings.leave(found.place, f"{found.title}: only SYSTEM=RECTANGULAR by coordinates; the material has its axes along x, y, z")
            return None
        rows = [[value or 0.0 for value in values] for _, values in found.numbers(self.findings)]
        if not rows or len(rows[0]) < 6 or not np.linalg.norm(np.cross(rows[0][:3], rows[0][3:6])):
            self.findings.error(found.place, f"{found.title}: expected two points that define axis 1 and the plane of axes 1 and 2")
            return None
        first, second, origin = np.array(rows[0][:3]), np.array(rows[0][3:6]), np.array((rows[0][6:9] + [0.0] * 3)[:3])
        angle = 0.0
        if len(rows) > 1 and len(rows[1]) > 1 and rows[1][1]:
            if int(rows[1][0]) != 3:
                self.findings.leave(found.rows[1][0], f"{found.title}: rotation about axis {int(rows[1][0])}; only axis 3")
            else:
                angle = rows[1][1]
        motion = self.model.assembly.motions.get(found.scope)
        axes = [first - origin, second - origin]
        return [motion.turned(axis).tolist() if motion else axis.tolist() for axis in axes] + [angle]
