"""Describes the scene in words, from its resolved parameters."""
import numpy as np

from .families import CROWD, families
from .grid import WORDS
from .units import vector

MODELS = {
    "Plane Strain": "plane strain: no out-of-plane strain (long bodies)",
    "Plane Stress": "plane stress: no out-of-plane stress (thin sheets)",
    "Axisymmetric": "axisymmetric: bodies of revolution about the axis x = 0; forces are those of the whole circle",
    "Solid": "solid: three dimensions"
}
# Types of conditions that are supports; all others are loads.
SUPPORTS = ("Displacement", "Bilateral", "Elastic Support", "Mean Displacement")
MOTIONS = ("Motion x", "Motion y", "Motion z", "Rotation x", "Rotation y", "Rotation z")  # that a Rigid Group may prescribe
PARTIAL = ("Displacement", "Mean Displacement")  # may prescribe some components


def as_list(value):
    return [] if value is None else list(value) if isinstance(value, (list, tuple)) else [str(value)]


class Condition:
    """A boundary condition or load of the scene."""

    def __init__(self, run, name, given):
        self.run, self.name, self.given = run, name, given
        self.type = str(given.get("Type", ""))
        self.groups = as_list(given.get("Group"))
        self.body = given.get("Body")
        value = given.get("Value")
        self.value = value if isinstance(value, list) or value is None else [value]
        self.components = given.get("Components", "All") if self.type in PARTIAL else "All"
        if self.type == "Displacement" and (given.get("Direction") or given.get("Along")):
            self.components = str(given.get("Along", "Direction"))  # one component, not along x, y or z
        self.expressions = {key.replace("Expression", "").strip(): text for key, text in given.items() if key.startswith("Expression")}
        self.motions = {name: given[name] for name in MOTIONS if name in given}
        if self.type == "Rigid Group" and given.get("Force"):
            self.value = as_list(given["Force"])
        self.support = self.type in SUPPORTS or (self.type == "Rigid Group" and self.value is None)

    @property
    def unit(self):
        length, force, stress = self.run.units
        return {"Displacement": length, "Rigid Group": force, "Mean Displacement": length, "Preload": force, "Traction": stress, "Pressure": stress, "Force": force, "Point Force": force,
                "Moment": f"{force} {length}", "Body Force": f"{force}/{length}³", "Initial Stress": stress,
                "Gravity": f"{length}/time²", "Rotation": "1/time"}.get(self.type, "")

    @property
    def at_point(self):
        """True if it acts on the node at a point."""
        return self.type in ("Point Force", "Displacement") and bool(self.given.get("Point"))

    @property
    def direction(self):
        """Vector in 2D or 3D, or None; if the values are functions, the resultant."""
        dimension = self.run.dimension
        if self.value is not None and len(self.value) >= dimension:
            found = self.value
        elif self.components == "Direction" and self.value:
            found = self.value[0] * self.axes_at(np.zeros((1, dimension)))[0]
        elif self.components in ("x", "y", "z") and self.value:
            found = [self.value[0] if axis == self.components else 0.0 for axis in "xyz"]
        elif self.expressions and self.type != "Displacement":
            found = self.resultant
        else:
            return None
        return None if found is None else np.array(found[:dimension], dtype=float)

    def axes_at(self, points):
        """Unit vectors at points along the only component that a support holds; None: it holds several, or the normal one"""
        dimension = self.run.dimension
        if self.components in ("x", "y", "z"):
            return np.tile(np.eye(3)["xyz".index(self.components)][:dimension], (len(points), 1))
        if self.components not in ("Direction", "Radius", "Circumference"):
            return None
        axis = np.zeros(3)
        given = self.given.get("Direction") or [0.0, 0.0, 1.0]
        axis[:len(given)] = np.array(given, dtype=float) / np.linalg.norm(given)
        if self.components == "Direction":
            return np.tile(axis[:dimension], (len(points), 1))
        away = np.zeros((len(points), 3))
        away[:, :dimension] = np.asarray(points)[:, :dimension] - np.array(self.given.get("Axis Point") or [0.0] * dimension, dtype=float)
        radius = away - np.outer(away @ axis, axis)
        radius /= np.maximum(np.linalg.norm(radius, axis=1), 1e-300)[:, None]
        return (radius if self.components == "Radius" else np.cross(axis, radius))[:, :dimension]

    @property
    def resultant(self):
        return self.run.summary.get("reactions", {}).get("conditions", {}).get(self.name, {}).get("force")

    def amount(self):
        """Values with their unit, e.g. (0, -5) MPa."""
        unit = f" {self.unit}" if self.unit else ""
        if self.type == "Bilateral":
            return "zero normal displacement, free to slide"
        if self.type == "Elastic Support":
            per = f"{self.run.stress_unit}/{self.run.length_unit}"
            return ", ".join(f"{what.lower()} {vector(self.given[what])} {per}" for what in ("Normal Stiffness", "Tangential Stiffness")
                             if self.given.get(what))
        if self.type == "Rigid Group":
            return self._rigid()
        if self.type == "Random Load":
            return f"amplitude {vector(self.given.get('Amplitude', 0))} {self.run.force_unit}"
        if self.expressions and self.components in ("Direction", "Radius", "Circumference"):
            return f"{self._component()} = {self.expressions.get('', '')}{unit}"
        if self.expressions:
            acting = {axis: text for axis, text in self.expressions.items() if text.strip() != "0"} or self.expressions
            return ", ".join((f"{axis}: " if axis else "") + text for axis, text in acting.items()) + unit
        if self.value is None:
            return ""
        if self.components in ("Direction", "Radius", "Circumference"):
            return f"{self._component()} = {vector(self.value)}{unit}"
        if self.components != "All":
            return f"u_{self.components} = {vector(self.value)}{unit}"
        if self.type == "Displacement" and not any(self.value):
            return "held: u = 0"
        extra = f", about {vector(self.given['Point'])}" if self.type == "Rotation" and self.given.get("Point") else ""
        return vector(self.value) + unit + extra

    def _rigid(self):
        """A rigid group in words: its point, its prescribed motions, force and moment."""
        length, force, _ = self.run.units
        parts = [f"rigid about {vector(self.given.get('Point', []))}"]
        parts += [f"{name[0].lower() + name[1:]} {vector(value)} {length if name.startswith('Motion') else 'rad'}" for name, value in self.motions.items()]
        if self.value is not None:
            parts.append(f"force {vector(self.value)} {force}")
        if self.given.get("Moment"):
            parts.append(f"moment {vector(as_list(self.given['Moment']))} {force} {length}")
        return ", ".join(parts)

    def _component(self):
        """Name of the only component that a support with a direction holds"""
        if self.components == "Direction":
            return f"u along {vector(self.given['Direction'])}"
        about = [f"through {vector(self.given['Axis Point'])}"] if self.given.get("Axis Point") else []
        about += [f"along {vector(self.given['Direction'])}"] if self.given.get("Direction") else []
        return f"{'radial' if self.components == 'Radius' else 'tangential'} u about the axis {' '.join(about) or 'through the origin'}"

    def place(self, short=False):
        """\\param short  abbreviates long lists of groups by families"""
        if self.at_point:
            return f"at {vector(self.given.get('Point', []))}"
        if self.groups:
            return ", ".join(families(self.groups, CROWD + 1) if short and len(self.groups) > 6 else self.groups)
        return f"body {self.body}" if self.body else "all bodies"

    @property
    def factor(self):
        """The factor over load steps as given: an expression in t, or values at the times; None without load steps."""
        steps = self.run.parameter("Load Steps", default={})
        if not steps.get("Times"):
            return None
        return str(steps.get("Factors", {}).get(self.name, "1"))

    def sentence(self, short=False):
        return f"{self.name}: {self.type}, {self.amount()}, {'on ' if self.groups else ''}{self.place(short)}"


def conditions(run):
    return [Condition(run, name, given) for name, given in run.parameter("Boundary Conditions", default={}).items() if isinstance(given, dict)]


class Contact:
    """A contact of the scene, between two sides or a side and an obstacle."""

    def __init__(self, run, name, given):
        self.run, self.name, self.given = run, name, given
        self.side_a, self.side_b = as_list(given.get("Side A")), as_list(given.get("Side B"))
        self.obstacle = given.get("Obstacle", "None")

    def partner(self):
        """Side B, or the obstacle."""
        if self.obstacle == "None":
            return ", ".join(self.side_b)
        of = self.given.get(self.obstacle, {})
        unit = self.run.length_unit
        hollow = "hollow " if of.get("Hollow") else ""
        if self.obstacle in ("Circle", "Ball"):
            return f"rigid {hollow}{self.obstacle.lower()} about {vector(of.get('Centre', []))} {unit}, radius {vector(of.get('Radius', 0))} {unit}"
        if self.obstacle == "Cylinder":
            return (f"rigid {hollow}cylinder about the axis through {vector(of.get('Point', []))} {unit} along {vector(of.get('Axis', []))}, "
                    f"radius {vector(of.get('Radius', 0))} {unit}")
        if self.obstacle in ("Line", "Plane"):
            kind = "half-plane" if self.obstacle == "Line" else "half-space"
            return f"rigid {kind} through {vector(of.get('Point', []))} {unit}, normal {vector(of.get('Normal', []))}"
        if self.obstacle == "Height":
            return f"rigid ground {'above' if of.get('Body Below') else 'below'} {'yz'[self.run.dimension - 2]} = {of.get('Expression', '')}"
        return f"rigid {self.obstacle.lower()}"

    def law(self):
        """The law with its coefficients."""
        law = str(self.given.get("Law", "Frictionless"))
        units = {"Cohesion": self.run.stress_unit, "Bound": self.run.stress_unit}
        said = [f"{name.lower()} {vector(value)}" + (f" {units[name]}" if units.get(name) else "") if value is not True else name.lower()
                for name, value in self.given.get(law, {}).items() if not isinstance(value, dict) and value not in (False, 0, "0", "")]
        return law + (f": {', '.join(said)}" if said else "") + self.overclosure()

    def overclosure(self):
        """The law of a softened contact; "" for a hard one."""
        law = str(self.given.get("Pressure Overclosure", "Hard"))
        if law == "Hard":
            return ""
        of, stress, length = self.given.get(law, {}), self.run.stress_unit, self.run.length_unit
        if law == "Linear":
            said = f"{vector(of.get('Stiffness', 0))} {stress}/{length}"
        elif law == "Exponential":
            said = (f"{vector(of.get('Pressure At Zero Clearance', 0))} {stress} at zero clearance, "
                    f"clearance {vector(of.get('Clearance At Zero Pressure', 0))} {length} at zero pressure")
        else:
            said = f"pressures {vector(of.get('Pressures', []))} {stress} at overclosures {vector(of.get('Overclosures', []))} {length}"
        return f"; softened, {law.lower()}: {said}"

    def initial_gap(self):
        return self.given.get("Initial Gap") or "as drawn"

    def coupling(self):
        wanted = self.given.get("Coupling", "Automatic")
        notes = [note for note in self.run.summary.get("notes", []) if f"'{self.name}'" in note and "mortar" in note]
        return "mortar (nodes do not match)" if notes and wanted == "Automatic" else wanted.lower()


def contacts(run):
    return [Contact(run, name, given) for name, given in run.parameter("Contact", default={}).items() if isinstance(given, dict)]


def material_words(run, given):
    """[(property, value, unit)] of a material."""
    stress = run.stress_unit
    if given.get("Type", "Isotropic") == "Isotropic":
        found = [("Young's modulus", given.get("Young Modulus"), stress), ("Poisson ratio", given.get("Poisson Ratio"), "")]
    else:
        of = given.get(given["Type"], {})
        found = [("Young's moduli 1, 2, 3", of.get("Young Moduli"), stress), ("Poisson ratios 12, 23, 13", of.get("Poisson Ratios"), ""),
                 ("shear moduli 12, 23, 13", of.get("Shear Moduli"), stress), ("angle of axis 1", of.get("Angle"), "degrees")]
        found += [(name, value, "") for name, value in of.items()
                  if name not in ("Young Moduli", "Poisson Ratios", "Shear Moduli", "Angle") and isinstance(value, (int, float, list))]
    found += [("density", given.get("Density"), ""), ("thermal expansion", given.get("Thermal Expansion"), "")]
    return [(name, value, unit) for name, value, unit in found if value is not None]


def cells_in_words(grid):
    return ", ".join(f"{len(own):,} {WORDS[kind]}" for kind, own, _ in grid.blocks)
