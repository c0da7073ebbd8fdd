"""Scenes as dictionaries, with the names and nesting of a scene file."""
import decimal
import numbers
import os
from xml.sax.saxutils import quoteattr

import numpy

from .meshes import Mesh


def _listed(value, where):
    """Type and text of a list of numbers or texts."""
    parts = [_value(part, "%s, entry %d" % (where, number)) for number, part in enumerate(value, 1)]
    kinds = {kind for kind, _ in parts}
    if kinds == {"int", "double"}:
        kinds = {"double"}
    if "string" in kinds and kinds <= {"string", "int", "double"}:
        kinds = {"string"}  # expressions, including constant ones
    if len(kinds) > 1 or kinds & {"bool"} or any(kind.startswith("Array") for kind in kinds):
        raise TypeError("%s: a list must contain only numbers or only texts" % where)
    for number, (kind, text) in enumerate(parts, 1):
        depth = 0
        for letter in text if kind == "string" else "":
            depth += (letter == "{") - (letter == "}")
            if depth < 0 or (letter == "," and depth == 0):
                break
        else:
            if depth == 0 and text.strip():
                continue
        raise ValueError("%s, entry %d: '%s' cannot be an entry of a list, since it is empty, or has a comma or a single brace" % (where, number, text))
    return "Array(%s)" % (kinds.pop() if kinds else "int"), "{%s}" % ", ".join(text for _, text in parts)


def _value(value, where):
    """Type and text of a parameter, as in a scene file."""
    if isinstance(value, numpy.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, (bool, numpy.bool_)):
        return "bool", "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return "int", str(int(value))
    if isinstance(value, (numbers.Real, decimal.Decimal)):
        return "double", repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return "string", os.fspath(value)
    if isinstance(value, (list, tuple, range, numpy.ndarray)):
        return _listed(value, where)
    raise TypeError("%s: a parameter must be a bool, number, text, list of these or dictionary, not %s" % (where, type(value).__name__))


def _lines(name, entries, depth, where):
    indent = "  " * depth
    yield "%s<ParameterList name=%s>" % (indent, quoteattr(name))
    for key, value in entries.items():
        place = "%s/%s" % (where, key) if where else str(key)
        if isinstance(value, Mesh):
            if place != "Mesh":
                raise TypeError("%s: a suture.Mesh belongs in Mesh" % place)
            value = {"Generator": "Given"}
        if isinstance(value, dict):
            yield from _lines(str(key), value, depth + 1, place)
        elif value is not None:
            kind, text = _value(value, place)
            yield "%s  <Parameter name=%s type=\"%s\" value=%s/>" % (indent, quoteattr(str(key)), kind, quoteattr(text))
    yield "%s</ParameterList>" % indent


def to_xml(scene):
    """Text of the scene file for a dictionary. Entries of None are left out."""
    return "\n".join(_lines("Suture", scene, 0, "")) + "\n"


def mesh_of(scene):
    """The suture.Mesh of a dictionary, or None."""
    mesh = scene.get("Mesh")
    return mesh if isinstance(mesh, Mesh) else None


def _flat(values, where):
    """Pairs of path and value of nested dictionaries."""
    for key, value in values.items():
        path = "%s/%s" % (where, key) if where else str(key)
        if isinstance(value, dict):
            yield from _flat(value, path)
        else:
            yield path, value


def assignments(values):
    """Parameters to change as assignments of --set: {"Outer Solver/Tolerance": 1e-10}, or nested, {"Outer Solver": {"Tolerance": 1e-10}}."""
    return ["%s=%s" % (path, _value(value, path)[1]) for path, value in _flat(values or {}, "")]
