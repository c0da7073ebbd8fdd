"""Sections of the report on the scene and its forces."""
from .html import esc, number, table, vector
from .units import vector as given_vector
from .words import MODELS, cells_in_words, contacts, material_words


def names(values):
    return esc(", ".join(values))


def scene_in_words(run):
    summary = run.summary
    length, force, stress = run.units
    mesh = run.parameter("Mesh", default={})
    source = mesh.get("File") or f"generator {mesh.get('Generator', '')}"
    rows = [("Model", esc(MODELS.get(run.model, run.model))),
            ("Units", f"length {esc(length)}, force {esc(force)}, stress {esc(stress)}"),
            ("Mesh", f"{esc(source)}: {number(summary['elements'])} elements, {number(summary.get('nodes'))} nodes" +
             (f" ({esc(cells_in_words(run.fields))})" if run.fields is not None else ""))]
    constants = {**mesh.get("Constants", {}), **run.parameter("Constants", default={})}
    if constants:
        rows.append(("Constants", esc(", ".join(f"{name} = {given_vector(value)}" for name, value in constants.items()))))
    functions = run.parameter("Functions", default={})
    if functions:
        rows.append(("Functions", esc(", ".join(f"{name} = {value}" for name, value in functions.items()))))
    if contacts(run):
        rows.append(("Coupling of contacts", esc(coupling(run))))
    return table(("", ""), [(f"<strong>{name}</strong>", cell) for name, cell in rows], long=(1,)) + bodies(run) + materials(run)


def bodies(run):
    rows = []
    for name, given in run.parameter("Bodies", default={}).items():
        regions = ", ".join(f"{region.get('Group')}: {region.get('Material')}" for region in given.get("Regions", {}).values())
        count = ""
        if run.fields is not None and name in run.fields.names.get("Bodies", []):
            count = number(int((run.fields.cell_data["Body"] == run.fields.names["Bodies"].index(name)).sum()))
        rows.append((esc(name), esc(given.get("Material", "")) + (f" (regions {esc(regions)})" if regions else ""), count))
    return "<h3>Bodies</h3>\n" + table(("body", "material", "elements"), rows, numeric=(2,), long=(0, 1))


def materials(run):
    rows = []
    for name, given in run.parameter("Materials", default={}).items():
        words = ", ".join(f"{what} {given_vector(value)}" + (f" {unit}" if unit else "") for what, value, unit in material_words(run, given))
        rows.append((esc(name), esc(str(given.get("Type", "Isotropic")).lower()), esc(words)))
    return "<h3>Materials</h3>\n" + table(("material", "law", "values"), rows, long=(0, 2))


def coupling(run):
    """How the sides of contacts are coupled: each way with its contacts."""
    ways = {}
    for contact in contacts(run):
        ways.setdefault(contact.coupling(), []).append(contact.name)
    return "; ".join(f"{way}: {', '.join(own)}" for way, own in ways.items())


def force_basis(run):
    """What the forces of a 2D run refer to."""
    return {"Axisymmetric": "forces of the whole circle; the radial component is a sum of magnitudes", "Solid": ""}.get(run.model, "per unit thickness")


def reactions(run):
    summary = run.summary
    found = summary.get("reactions")
    if not found:
        return '<p class="soft">Unknown: the run ended earlier.</p>\n'
    length, force, stress = run.units
    thickness = f", {force_basis(run)}" if force_basis(run) else ""
    conditions, contacts = found.get("conditions", {}), found.get("contacts", {})
    has_errors = any("force_error" in c for c in (*conditions.values(), *contacts.values()))
    error = [f"estimated error [{force}]"] * has_errors
    rows = [(esc(name), esc(c.get("kind", "")), vector(c.get("force")), *[force_error(c)] * has_errors, vector(c.get("moment")))
            for name, c in conditions.items()]
    total = found.get("sum", {})
    rows.append(("<strong>sum</strong>", "", vector(total.get("force")), *[""] * has_errors, vector(total.get("moment"))))
    markup = table(("condition", "kind", f"force on the bodies [{force}]", *error, f"moment [{force} {length}]"), rows,
                   caption=f"In {force} and {force} {length}{thickness}; moments about {given_vector(found.get('about', []))}.", long=(0,))
    rows = [(esc(name), names(c.get("bodies") or []), vector(c.get("force")), *[force_error(c)] * has_errors,
             vector(c.get("moment")), vector(c.get("centre")), closed(c)) for name, c in contacts.items()]
    if rows:
        size = f"{length}²" if run.model in ("Axisymmetric", "Solid") else length
        markup += table(("contact", "bodies", f"force on side B [{force}]", *error, f"moment [{force} {length}]", f"centre [{length}]", f"closed [{size}]"),
                        rows, long=(0,), caption="Resultant of each contact, the centre of its forces, and its closed length or area.")
    markup += bounds_of_forces(conditions, contacts, run.units)
    balance = summary.get("equilibrium", {})
    if "imbalance" in balance:
        markup += f"<p>Loads and reactions balance to {number(balance['imbalance'], form='.3g')}, relative to the loads.</p>\n"
    return markup


def force_error(row):
    return number(row["force_error"], form=".2g") if row.get("force_error") is not None else ""


def known(values):
    """A vector; components without a value are marked."""
    return vector(["?" if value is None else value for value in values])


def bounds_of_forces(conditions, contacts, units):
    """Strict bounds of forces and displacements as a table; "" for a run without."""
    length, force, _ = units
    rows = []
    for kind, all_of in (("condition", conditions), ("contact", contacts)):
        for name, c in all_of.items():
            if "force_low" in c:
                rows.append((esc(name), kind, f"force [{force}]", known(c["force_low"]), known(c["force_high"]), esc(c.get("not_bounded", ""))))
            elif "displacement" in c:
                rows.append((esc(name), kind, f"mean displacement [{length}]", known([c.get("displacement_low")]), known([c.get("displacement_high")]),
                             esc(c.get("not_bounded", ""))))
    if not rows:
        return ""
    return table(("name", "", "quantity", "at least", "at most", "why not bounded"), rows, long=(0, 5), key="bounds",
                 caption="Strict bounds: the exact value, on the polygon (polyhedron) of the mesh, lies between them.")


def closed(contact):
    if contact.get("closed") is None:
        return ""
    return f"{number(contact['closed'])} of {number(contact.get('whole'))}"


def contact_pieces(run):
    """Contacts in the pieces used by the solver."""
    contact = run.summary["contact"]
    rows = [(esc(name), f"{number(piece.get('active'))} of {number(piece.get('pairs'))}", number(piece.get("max_pressure")), number(piece.get("max_gap")))
            for name, piece in contact.get("by_piece", {}).items()]
    if not rows:
        return ""
    head = ("piece", "closed pairs", f"largest pressure [{run.stress_unit}]", f"largest gap [{run.length_unit}]")
    return table(head, rows, numeric=(1, 2, 3), long=(0,)) + friction_of_pieces(run)


def friction_of_pieces(run):
    rows = []
    for name, piece in run.summary["contact"]["by_piece"].items():
        if friction := piece.get("friction"):
            force = ", ".join(number(part) for part in friction["tangential_force"])
            rows.append((esc(name), number(friction["sticking"]), number(friction["slipping"]), number(friction["max_mobilisation"], form=".3g"),
                         number(friction["mean_mobilisation"], form=".3g"), number(friction["dissipated_work"]), force))
    if not rows:
        return ""
    head = ("piece", "stick", "slip", "largest mobilisation", "mean", f"dissipated work [{run.force_unit} {run.length_unit}]",
            f"tangential force on side B [{run.force_unit}]")
    return table(head, rows, numeric=(1, 2, 3, 4, 5, 6), long=(0,),
                 caption="Friction. Mobilisation: tangential force of a pair over the largest that its law allows; mean weighted by the bounds.")
