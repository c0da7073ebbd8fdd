"""Names that differ in numbers only: in a crowded picture they share one label, "roller_*_outer"."""
import re

CROWD = 24  # with more names than this in a picture


def pattern(text):
    return re.sub(r"\d+", "*", text)


def families(names, total=None):
    """{label: names}, in the order of the names. `total`: number of all names in the picture, if there are others."""
    names = list(names)
    if (len(names) if total is None else total) <= CROWD:
        return {name: [name] for name in names}
    members = {}
    for name in names:
        members.setdefault(pattern(name), []).append(name)
    return {label if len(own) > 1 else own[0]: own for label, own in members.items()}
