"""Names that differ only in numbers share one label in a crowded plot, e.g. "roller_*_outer"."""
import re

CROWD = 24  # number of names above which a plot is crowded


def pattern(text):
    return re.sub(r"\d+", "*", text)


def families(names, total=None):
    """{label: names}, in the order of the names. `total`: number of all names in the plot, if there are others."""
    names = list(names)
    if (len(names) if total is None else total) <= CROWD:
        return {name: [name] for name in names}
    members = {}
    for name in names:
        members.setdefault(pattern(name), []).append(name)
    return {label if len(own) > 1 else own[0]: own for label, own in members.items()}
