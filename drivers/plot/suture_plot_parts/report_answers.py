"""The answers of a run: extremes, safety factors, loads and supports with their forces, contacts with theirs."""
from .html import esc, number, table, vector
from .stresses import taken_at
from .units import scaled
from .words import conditions, contacts

EXTREMES = (("displacement", "largest displacement"), ("von_mises", "largest von Mises stress"), ("tension", "largest tension"),
            ("compression", "largest compression"), ("pressure", "largest contact pressure"))


ROUND_OFF = 1e-9  # of the largest force, below which a component counts as zero


def readable(value, unit):
    """The value in a multiple of its unit that is easy to read, if there is one, and in the unit of the scene."""
    factor, name = scaled(unit, abs(value))
    if name == unit:
        return number(value, unit)
    return f'{factor * value:.4g} {esc(name)}'.replace("-", "\u2212", 1) + f' <span class="soft">({number(value, unit)})</span>'


def force_of(found, largest):
    """A force of summary.json without components at round-off."""
    force = found.get("force")
    return vector(None if force is None else [0.0 if part is not None and abs(part) < ROUND_OFF * largest else part for part in force])


def largest_force(run):
    found = run.summary.get("reactions", {})
    return max((abs(part) for kind in ("conditions", "contacts") for one in found.get(kind, {}).values() for part in one.get("force") or [] if part is not None),
               default=0.0)


def place(found):
    return f"({', '.join(number(x) for x in found['place'])})" if found.get("place") else ""


def key_figures(run):
    cards = []
    for name, words in EXTREMES:
        found = run.summary.get("extremes", {}).get(name)
        if not found or found.get("value") is None:
            continue
        if name == "tension" and found["value"] < 0:
            words = "largest principal stress: no tension"
        if name == "compression" and found["value"] > 0:
            words = "smallest principal stress: no compression"
        where = f"{found['contact']}" if found.get("contact") else found.get("body", "")
        at = f" at {place(found)}" if found.get("place") else ""
        cards.append(f'<div id="extreme_{name}"><div class="name">{esc(words)}</div><div class="value">{readable(found["value"], found.get("unit", ""))}</div>'
                     f'<div class="where">{esc(where)}{at}</div></div>')
    if not cards:
        return ""
    where = "where the bodies are at the end" if run.moving else "on the undeformed bodies"
    return f'<div class="figures">{"".join(cards)}</div>\n<p class="soft">Stresses {esc(taken_at(run))}; positions {where}.</p>\n'


def safety(run):
    """Least safety factor of each body with a strength; below 1 the linear elastic answer does not hold there."""
    found = run.summary.get("safety") or {}
    rows = []
    for body, least in (found.get("bodies") or {}).items():
        factor, step = least.get("factor"), least.get("step")
        kind = "soft" if factor is None else "fails" if factor < 1 else "holds"
        words = "no load" if factor is None else "EXCEEDED: the linear elastic answer is not valid there" if factor < 1 else "not exceeded"
        rows.append([esc(body), number(factor) if factor is not None else "", f'<span class="{kind}">{words}</span>', esc(least.get("material") or ""),
                     esc(least.get("criterion") or ""), place(least) + (f", load step {number(step)}" if step is not None else "")])
    if not rows:
        return ""
    note = f"Strength over stress, {found['stresses']}." if found.get("stresses") else "Strength over stress."
    return "<h3>Safety factors</h3>\n" + table(("body", "least factor", "strength", "material", "criterion", "at"), rows, caption=note, numeric=(1,),
                                               long=(0, 2, 3), key="safety_factors")


def loads_and_supports(run):
    """All conditions with their factors over load steps, and the forces that they exert."""
    given, found = conditions(run), run.summary.get("reactions", {}).get("conditions", {})
    if not given:
        return "<h3>Loads and supports</h3>\n<p>None.</p>\n"
    factors, forces = any(c.factor is not None for c in given), bool(found) and run.good
    rows = []
    for c in given:
        row = [esc(c.name), esc(c.type), esc(c.amount()), esc(c.place(short=True))]
        if factors:
            row.append(esc(c.factor))
        if forces:
            row.append(force_of(exerted(found, c.name), largest_force(run)) if c.name in found else "")
        rows.append(row)
    head = ["name", "type", "value", "where", *(["factor over time"] if factors else []), *([f"force on the bodies [{run.force_unit}]"] if forces else [])]
    times = run.parameter("Load Steps", "Times", default=[])
    said = ""
    if factors and times:
        listed = ", ".join([f"{time:g}" for time in times] if len(times) <= 8 else [f"{times[0]:g}", f"{times[1]:g}", "\u2026", f"{times[-1]:g}"])
        said = f"Load steps end at t = {listed}. Values in braces are factors at these times, linear between them." + (" Forces at the end." if forces else "")
    return "<h3>Loads and supports</h3>\n" + table(head, rows, caption=said, long=(0, 2, 3, 4) if factors else (0, 2, 3))


def exerted(found, name):
    """Force of a condition; that of a rigid group is its reaction and the force at its point"""
    at_point = found.get(f"{name}/Force")
    return found[name] if at_point is None else {"force": [a + b for a, b in zip(found[name]["force"], at_point["force"])]}


def rigid_groups(run):
    """Motions of the rigid groups"""
    found = run.summary.get("rigid_groups") or {}
    if not found or not run.good:
        return ""
    rows = [[esc(name), vector(group["point"]), *(force_of({"force": group[key]}, max(map(abs, group[key]))) for key in ("displacement", "rotation"))]
            for name, group in found.items()]
    head = ("rigid group", f"reference point [{run.length_unit}]", f"displacement [{run.length_unit}]", "rotation [rad]")
    return "<h3>Rigid groups</h3>\n" + table(head, rows, long=(0, 1, 2, 3), key="rigid_groups")


def contact_table(run):
    """All contacts with law and coefficients, and the forces that they transmit."""
    given, found = contacts(run), run.summary.get("reactions", {}).get("contacts", {})
    if not given:
        return "<h3>Contacts</h3>\n<p>None.</p>\n"
    forces = bool(found) and run.good
    rows = []
    for c in given:
        row = [esc(c.name), esc(", ".join(c.side_a)), esc(c.partner()), esc(c.law()), esc(c.initial_gap())]
        if forces:
            of = found.get(c.name, {})
            row += [force_of(of, largest_force(run)), closed_share(of)]
        rows.append(row)
    head = ["contact", "side A", "side B or obstacle", "law", "initial gap",
            *([f"force on side B [{run.force_unit}]", "closed"] if forces else [])]
    return "<h3>Contacts</h3>\n" + table(head, rows, long=(0, 1, 2, 3), numeric=(6,) if forces else ())


def closed_share(of):
    if of.get("closed") is None or not of.get("whole"):
        return ""
    return f"{100 * of['closed'] / of['whole']:.0f} %"


def bodies_of(name, contact, given):
    """(first bodies, second): the bodies of sides A and B, or the obstacle."""
    listed = tuple(contact.get("bodies") or [])
    if given is not None and given.obstacle != "None":
        return listed, f"rigid {given.obstacle.lower()}"
    # Sides with several bodies are listed one after the other, without a mark where side B begins.
    return (listed[:1], listed[1]) if len(listed) == 2 else (listed, f"side B of {name}")


def body_forces(run):
    """Sum of the contact forces for each pair of bodies, on the second body."""
    found = run.summary.get("reactions", {}).get("contacts", {})
    given = {c.name: c for c in contacts(run)}
    pairs = {}
    for name, contact in found.items():
        force = contact.get("force")
        if force is None or any(part is None for part in force):
            continue
        first, second = bodies_of(name, contact, given.get(name))
        turned = ((second,), first[0]) if len(first) == 1 else None
        key, sign = (turned, -1.0) if turned in pairs else ((first, second), 1.0)
        names, total = pairs.setdefault(key, ([], [0.0] * len(force)))
        names.append(name)
        total[:] = [a + sign * b for a, b in zip(total, force)]
    rows = [(esc(f"{', '.join(first)} \u2013 {second}"), esc(", ".join(names)), esc(second), force_of({"force": total}, largest_force(run)), number(sum(part * part for part in total)**0.5))
            for (first, second), (names, total) in pairs.items()]
    if not rows or run.model == "Axisymmetric":
        return ""
    head = ("bodies", "contacts", "force on", f"force [{run.force_unit}]", f"magnitude [{run.force_unit}]")
    return "<h3>Contact forces between bodies</h3>\n" + table(head, rows, numeric=(4,), long=(0, 1), key="body_forces")
