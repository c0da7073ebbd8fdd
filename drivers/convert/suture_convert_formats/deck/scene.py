"""The scene file: XML with the lists of Suture, and what was not taken over as a comment."""
from xml.sax.saxutils import quoteattr

from .contact import SOFT


def text_of(value):
    return repr(float(value)) if isinstance(value, (int, float)) else str(value)


class Writer:
    def __init__(self):
        self.lines, self.depth = [], 0

    def comment(self, lines):
        safe = [line.replace("--", "- -").rstrip("-") for line in lines]
        if len(safe) == 1:
            self._put(f"<!-- {safe[0]} -->")
            return
        self._put("<!-- " + safe[0])
        for line in safe[1:]:
            self._put("     " + line)
        self.lines[-1] += " -->"

    def begin(self, name):
        self._put(f"<ParameterList name={quoteattr(name)}>")
        self.depth += 1

    def end(self):
        self.depth -= 1
        self._put("</ParameterList>")

    def put(self, name, value):
        if isinstance(value, list):
            kind, text = "Array(double)", "{" + ", ".join(map(text_of, value)) + "}"
        elif isinstance(value, bool):
            kind, text = "bool", str(value).lower()
        elif isinstance(value, (int, float)):
            kind, text = "double", text_of(value)
        else:
            kind, text = "string", str(value)
        self._put(f'<Parameter name={quoteattr(name)} type="{kind}" value={quoteattr(text)}/>')

    def _put(self, line):
        self.lines.append("  " * self.depth + line)

    def __str__(self):
        return "\n".join(self.lines) + "\n"


def material_name(section, sections):
    """Name of the material of a section; one entry for each orientation of an orthotropic material"""
    title, orientation = section.material_key
    others = {other.material_key for other in sections if other.material_key[0] == title}
    return title if len(others) == 1 or orientation is None else f"{title} {orientation[1].lower()}"


def write_materials(out, sections, used, needed):
    out.begin("Materials")
    written = set()
    for number in used:
        section = sections[number]
        name, material = material_name(section, sections), section.material
        if name in written:
            continue
        written.add(name)
        out.begin(name)
        if material.moduli is None:
            out.put("Young Modulus", material.young)
            out.put("Poisson Ratio", material.poisson)
        else:
            out.put("Type", "Orthotropic")
            out.begin("Orthotropic")
            out.put("Young Moduli", material.moduli)
            out.put("Poisson Ratios", material.ratios)
            out.put("Shear Moduli", material.shear)
            if section.axes:
                out.put("Axis 1", section.axes[0])
                out.put("Axis 2", section.axes[1])
                if section.axes[2]:
                    out.put("Angle", section.axes[2])
            out.end()
        if material.density is not None:
            out.put("Density", material.density)
        if material.expansion is not None or any(sections[other].material is material for other in needed):
            out.put("Thermal Expansion", material.expansion or 0.0)
        out.end()
    out.end()


def write_bodies(out, solids, found):
    out.begin("Bodies")
    for name, (main, regions) in zip(solids.bodies, found):
        out.begin(name)
        out.put("Material", material_name(solids.sections.all[main], solids.sections.all))
        if regions:
            out.begin("Regions")
            for group, section in regions.items():
                out.begin(group)
                out.put("Group", group)
                out.put("Material", material_name(solids.sections.all[section], solids.sections.all))
                out.end()
            out.end()
        out.end()
    out.end()


def write_conditions(out, conditions):
    out.begin("Boundary Conditions")
    for condition in conditions.all:
        out.begin(condition.name)
        out.put("Type", condition.type)
        for name, value in condition.values.items():
            out.put(name, value)
        out.end()
    out.end()


def write_steps(out, conditions, times):
    if len(times) < 2:
        return
    out.begin("Load Steps")
    out.put("Times", times.tolist())
    factors = [condition for condition in conditions.all if condition.factors]
    if factors:
        out.begin("Factors")
        for condition in factors:
            out.put(condition.name, "{" + ", ".join(map(text_of, condition.factors)) + "}")
        out.end()
    out.end()


def write_contacts(out, contacts):
    if not contacts.all:
        return
    out.begin("Contact")
    names = set()
    for contact in contacts.all:
        name, count = contact.name, 1
        while name in names:
            count += 1
            name = f"{contact.name} {count}"
        names.add(name)
        out.begin(name)
        out.put("Side A", contact.side_a)
        out.put("Side B", contact.side_b)
        if contact.law != "Frictionless":
            out.put("Law", contact.law)
        if contact.law == "Coulomb":
            out.begin("Coulomb")
            out.put("Coefficient", text_of(contact.coefficient))
            out.end()
        if contact.softened:
            write_overclosure(out, contact.overclosure)
        if contact.gap is not None:
            out.put("Initial Gap", text_of(contact.gap))
        out.end()
    out.end()


def write_overclosure(out, law):
    name = SOFT[law.kind]
    out.put("Pressure Overclosure", name)
    out.begin(name)
    if name == "Linear":
        out.put("Stiffness", law.stiffness)
    elif name == "Exponential":
        out.put("Pressure At Zero Clearance", law.pressure)
        out.put("Clearance At Zero Pressure", law.clearance)
    else:
        out.put("Pressures", [row[0] for row in law.table])
        out.put("Overclosures", [row[1] for row in law.table])
    out.end()


def summary(findings):
    """Lines that say what was not taken over, changed, or is without influence"""
    lines = []
    for title, some in (("not taken over", findings.left), ("changed", findings.changed), ("without influence on the answer", findings.aside)):
        if some:
            lines += [f"{title}:"] + [f"  {line}" for line in findings.texts(some)]
    return lines


def write(deck, title, units, mesh_file, solids, found, conditions, contacts, times, needed, findings):
    out = Writer()
    out.comment([f"From {deck.name} by suture_convert. Units are named, not converted." if units else f"From {deck.name} by suture_convert."]
                + summary(findings))
    out.begin("Suture")
    out.put("Title", title or deck.stem)
    out.put("Model", solids.model)
    out.put("Units", units or "length, force, stress")
    out.begin("Mesh")
    out.put("File", mesh_file)
    out.end()
    write_bodies(out, solids, found)
    used = sorted({number for main, regions in found for number in [main, *regions.values()]})
    write_materials(out, solids.sections.all, used, needed)
    write_conditions(out, conditions)
    write_steps(out, conditions, times)
    write_contacts(out, contacts)
    out.end()
    return str(out)
