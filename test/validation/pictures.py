"""Pictures of validation runs: computed pressure along the contact line and analytic curve."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import curves  # noqa: E402
import figures  # noqa: E402


def draw(picture, runs, path):
    """Draws an entry of "pictures" (validate.py) into the file `path`; `runs` by case name."""
    figure, axes = plt.subplots(figsize=(7, 4.2), dpi=100)
    marks = iter("o+x^vs*d")
    name = picture.get("x", "x")
    low, high, force = math.inf, -math.inf, 0.0
    for label, case in picture["runs"].items():
        c = figures.contact(runs[case]["output"])
        x = curves.along(c, name)
        low, high, force = min(low, x.min()), max(high, x.max()), c.point["ContactForce"].sum()
        axes.plot(x, c.point["ContactPressure"], next(marks), markersize=4, label=label, fillstyle="none", linestyle="none")
    if "curve" in picture:
        options = dict(picture.get("options", {}))
        if options.get("force") == "computed, half":
            options["force"] = 2 * force
        x = np.linspace(low, high, 801)
        axes.plot(x, getattr(curves, picture["curve"])(x, **options), "k-", linewidth=0.9, label=picture.get("label", picture["curve"]))
    axes.set_xlabel({"angle": "angle, degrees", "arc": "along the line"}.get(name, name))
    axes.set_ylabel("contact pressure")
    if "limits" in picture:
        axes.set_ylim(*picture["limits"])
    axes.grid(alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(path)
    plt.close(figure)
