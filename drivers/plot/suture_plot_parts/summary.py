"""Reads summary.json and checks the structure of everything that the report uses."""
import json

from .style import PlotError

NUMBER, COUNT, TEXT, FLAG, NUMBERS = "a number", "a whole number", "a text", "true or false", "a list of numbers"
TEXTS, RANGE = "a list of texts", {"min": NUMBER, "avg": NUMBER, "max": NUMBER}
EXTREME = {"value": NUMBER, "unit": TEXT, "body": TEXT, "contact": TEXT, "place": NUMBERS}
LEVEL = {"unknowns!": COUNT, "elements": COUNT, "error": NUMBER, "strict": FLAG, "seconds": NUMBER, "iterations": COUNT, "outer": COUNT, "energy": NUMBER,
         "refinement": TEXT, "estimate": NUMBER, "value": NUMBER, "energy_error": NUMBER}
FORCE = {"force": NUMBERS, "moment": NUMBERS, "force_error": NUMBER, "force_low": NUMBERS, "force_high": NUMBERS, "not_bounded": TEXT}
# A list in brackets has items of one shape. Required keys are marked with an exclamation mark; "*" matches any name.
SHAPE = {
    "title": TEXT, "scene": TEXT, "units": TEXT, "failure": TEXT, "mesh_hash": TEXT, "converged!": FLAG, "verified": FLAG, "exit_code!": COUNT,
    "elements!": COUNT, "dimension": COUNT, "nodes": COUNT, "dofs": COUNT, "max_displacement": NUMBER, "ranks": COUNT, "subdomains": COUNT, "interface_dofs": COUNT, "seconds": NUMBER,
    "command_line": TEXTS, "notes": TEXTS, "parameters!": {}, "versions!": {"*": TEXT}, "phases!": {"*": RANGE},
    "outer!": {"solver": TEXT, "iterations": COUNT, "pcg_total": COUNT, "residual": NUMBER, "condition": NUMBER},
    "auxiliary": {"iterations": COUNT, "condition": NUMBER, "iteration_seconds": NUMBER},
    "contact!": {"pairs": COUNT, "by_piece": {"*": {"pairs": COUNT, "active": COUNT, "max_pressure": NUMBER, "max_gap": NUMBER,
                                                    "pressure_error_estimate": NUMBER}}},
    "extremes": {"stresses": TEXT, "von_mises": EXTREME, "tension": EXTREME, "compression": EXTREME, "displacement": EXTREME, "pressure": EXTREME},
    "safety": {"stresses": TEXT, "least": NUMBER, "body": TEXT, "bodies!": {"*": {"factor": NUMBER, "material!": TEXT, "criterion": TEXT, "place": NUMBERS,
                                                                           "principal_stresses": NUMBERS, "unit": TEXT, "step": COUNT, "time": NUMBER}}},
    "reactions": {"about": NUMBERS, "conditions": {"*": {"kind": TEXT, "displacement": NUMBER, "displacement_low": NUMBER,
                                                                "displacement_high": NUMBER, **FORCE}},
                  "contacts": {"*": {"bodies": TEXTS, "centre": NUMBERS, "closed": NUMBER, "whole": NUMBER, **FORCE}},
                  "sum": {"force": NUMBERS, "moment": NUMBERS}},
    "equilibrium": {"imbalance": NUMBER}, "verification": {"*": {"value": NUMBER, "bound": NUMBER, "where": TEXT}}, "error": {"*": NUMBER},
    "load_steps": {"count": COUNT, "time": NUMBER, "work": {"external": NUMBER, "stored": NUMBER, "dissipated": NUMBER, "step_error": NUMBER}},
    "bound": {"total": NUMBER, "discretisation": NUMBER, "algebraic": NUMBER, "oscillation": NUMBER, "relative": NUMBER, "strict": FLAG, "reasons": TEXTS,
              "energy_lower": NUMBER, "energy_upper": NUMBER},
    "accuracy": {"requested": NUMBER, "quantity": TEXT, "reached": NUMBER, "strict": FLAG, "limit": TEXT, "levels!": [LEVEL],
                 "uniform": {"order": COUNT, "unknowns": NUMBER, "seconds": NUMBER}},
    "peak_memory_mb": RANGE, "solver_data_mb": RANGE, "preconditioner": {"coarse_size": COUNT}
}


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


FITS = {
    NUMBER: is_number, COUNT: lambda value: isinstance(value, int) and not isinstance(value, bool), TEXT: lambda value: isinstance(value, str),
    FLAG: lambda value: isinstance(value, bool), NUMBERS: lambda value: isinstance(value, list) and all(v is None or is_number(v) for v in value),
    TEXTS: lambda value: isinstance(value, list) and all(isinstance(v, str) for v in value)
}


def faults(value, shape, path=""):
    """Sentences on all mismatches. Null is allowed except for required keys: it represents values that are not finite."""
    if isinstance(shape, list):
        if not isinstance(value, list):
            return [f"{path}: {json.dumps(value)[:40]} instead of a list"]
        return [found for place, item in enumerate(value) for found in faults(item, shape[0], f"{path}.{place}")]
    if not isinstance(shape, dict):
        return [] if FITS[shape](value) else [f"{path}: {json.dumps(value)[:40]} instead of {shape}"]
    if not isinstance(value, dict):
        return [f"{path or 'the whole'}: {json.dumps(value)[:40]} instead of an object with keys"]
    found = []
    for key, inner in shape.items():
        name, needed = key.rstrip("!"), key.endswith("!")
        for own in value if name == "*" else [name]:
            here = f"{path}.{own}" if path else own
            if value.get(own) is not None:
                found += faults(value[own], inner, here)
            elif needed:
                found.append(f"{here}: missing")
    return found


def read_summary(path):
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise PlotError(f"{path} is damaged: {error}") from error
    found = faults(summary, SHAPE)
    if found:
        raise PlotError(f"{path} is damaged or of another program:\n  " + "\n  ".join(found))
    return summary
