"""Scenes as dictionaries, with the names and nesting of a scene file."""
from xml.sax.saxutils import quoteattr

import numpy


def _value(value, where):
    """Type and text of a parameter, as in a scene file."""
    if isinstance(value, (bool, numpy.bool_)):
        return "bool", "true" if value else "false"
    if isinstance(value, (int, numpy.integer)):
        return "int", str(int(value))
    if isinstance(value, (float, numpy.floating)):
        return "double", repr(float(value))
    if isinstance(value, str):
        return "string", value
    if isinstance(value, (list, tuple, numpy.ndarray)):
        parts = [_value(part, where) for part in value]
        kinds = {kind for kind, _ in parts}
        if kinds == {"int", "double"}:
            kinds = {"double"}
        if "string" in kinds and kinds <= {"string", "int", "double"}:
            kinds = {"string"}  # expressions, including constant ones
        if len(kinds) > 1 or kinds & {"bool"} or any(kind.startswith("Array") for kind in kinds):
            raise TypeError("%s: a list must contain only numbers or only texts" % where)
        return "Array(%s)" % (kinds.pop() if kinds else "string"), "{%s}" % ", ".join(text for _, text in parts)
    raise TypeError("%s: a parameter must be a bool, number, text, list of these or dictionary, not %s" % (where, type(value).__name__))


def _lines(name, entries, depth, where):
    indent = "  " * depth
    yield "%s<ParameterList name=%s>" % (indent, quoteattr(name))
    for key, value in entries.items():
        place = "%s/%s" % (where, key) if where else str(key)
        if isinstance(value, dict):
            yield from _lines(str(key), value, depth + 1, place)
        elif value is not None:
            kind, text = _value(value, place)
            yield "%s  <Parameter name=%s type=\"%s\" value=%s/>" % (indent, quoteattr(str(key)), kind, quoteattr(text))
    yield "%s</ParameterList>" % indent


def to_xml(scene):
    """Text of the scene file for a dictionary. Entries of None are left out."""
    return "\n".join(_lines("Suture", scene, 0, "")) + "\n"


def assignments(values):
    """Parameters to change, {"Outer Solver/Tolerance": 1e-10}, as assignments of --set."""
    return ["%s=%s" % (path, _value(value, path)[1]) for path, value in (values or {}).items()]
