"""Loads and prescribed displacements at the load step that a picture shows."""
import ast
import math
import re

import numpy as np

from .units import vector

FUNCTIONS = {name: getattr(math, name) for name in ("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "sqrt")}
FUNCTIONS |= {"ln": math.log, "log10": math.log10, "log2": math.log2, "abs": abs, "min": min, "max": max, "sign": lambda x: (x > 0) - (x < 0)}
OPERATORS = {ast.Add: lambda a, b: a + b, ast.Sub: lambda a, b: a - b, ast.Mult: lambda a, b: a * b, ast.Div: lambda a, b: a / b, ast.Pow: lambda a, b: a**b}
COMPARISONS = {ast.Lt: lambda a, b: a < b, ast.LtE: lambda a, b: a <= b, ast.Gt: lambda a, b: a > b, ast.GtE: lambda a, b: a >= b,
               ast.Eq: lambda a, b: a == b, ast.NotEq: lambda a, b: a != b}
SCALED = ("Displacement", "Mean Displacement", "Traction", "Pressure", "Force", "Point Force", "Moment", "Body Force", "Gravity", "Rotation", "Preload",
          "Temperature", "Initial Stress", "Initial Strain", "Rigid Group")


def time_shown(run):
    """Time of the load step whose fields are drawn; None without load steps, and before the scene is solved."""
    times = run.steps.get("time", []) if run.steps else []
    if not len(times):
        return None
    return float(times[-1 if run.step is None else run.step - 1])


def factor_at(run, name, time):
    """The factor of a condition at a time; None if it is unknown."""
    steps = run.parameter("Load Steps", default={})
    given = (steps.get("Factors") or {}).get(name, "1")
    if isinstance(given, (int, float)):
        return float(given)
    if isinstance(given, list) or str(given).strip().startswith("{"):
        values = given if isinstance(given, list) else [float(part) for part in str(given).strip().strip("{}").split(",")]
        times = steps.get("Times", [])
        return float(np.interp(time, [0.0, *times], [0.0, *values])) if len(values) == len(times) else None
    constants = {key: value for key, value in run.parameter("Constants", default={}).items() if isinstance(value, (int, float))}
    try:
        return evaluated(str(given), {"t": time, "pi": math.pi, "_pi": math.pi, **constants})
    except (ValueError, KeyError, SyntaxError, ZeroDivisionError, OverflowError, TypeError):
        return None


def evaluated(text, values):
    """Value of an expression in the language of the scene. \\throws ValueError, KeyError, SyntaxError  for unknown parts"""
    text = re.sub(r"\^", "**", text.replace("&&", " and ").replace("||", " or "))
    parts = re.fullmatch(r"([^?]*)\?(.*):([^:]*)", text)
    if parts:
        text = f"({parts[2]}) if ({parts[1]}) else ({parts[3]})"
    return float(value_of(ast.parse(text.strip(), mode="eval").body, values))


def value_of(node, values):
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        return node.value
    if isinstance(node, ast.Name):
        return values[node.id]
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        return OPERATORS[type(node.op)](value_of(node.left, values), value_of(node.right, values))
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.UAdd)):
        return (-1 if isinstance(node.op, ast.USub) else 1) * value_of(node.operand, values)
    if isinstance(node, ast.Compare) and len(node.ops) == 1 and type(node.ops[0]) in COMPARISONS:
        return COMPARISONS[type(node.ops[0])](value_of(node.left, values), value_of(node.comparators[0], values))
    if isinstance(node, ast.BoolOp):
        found = [bool(value_of(part, values)) for part in node.values]
        return all(found) if isinstance(node.op, ast.And) else any(found)
    if isinstance(node, ast.IfExp):
        return value_of(node.body if value_of(node.test, values) else node.orelse, values)
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS and not node.keywords:
        return FUNCTIONS[node.func.id](*(value_of(argument, values) for argument in node.args))
    raise ValueError(f"cannot evaluate {ast.dump(node)}")


def stated(run, condition):
    """The condition in words; with load steps, its value at the step that is drawn."""
    words = condition.sentence(short=True)
    time = time_shown(run)
    if time is None or condition.type not in SCALED:
        return words
    factor = factor_at(run, condition.name, time)
    if factor is None:
        return f"{words}, times its factor at t = {time:g}"
    if abs(factor - 1.0) < 1e-12 or not condition.value or condition.expressions:
        return words if abs(factor - 1.0) < 1e-12 else f"{words}, times {factor:.4g} at t = {time:g}"
    whole = vector(condition.value)
    now = vector([factor * value if abs(factor * value) > 1e-12 * max(abs(v) for v in condition.value) else 0.0 for value in condition.value])
    return words.replace(whole, now, 1) + f" at t = {time:g} ({factor:.4g} times {whole})".replace("-", "\u2212")
