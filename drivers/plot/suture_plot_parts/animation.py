"""animation.gif: the deformed bodies of all load steps, coloured by von Mises stress, with one colour scale and one frame for all."""
from copy import copy

import h5py
import matplotlib
import numpy as np

from .animation_frames import PlaneFrames
from .deformation import is_given, seeming
from .enlarged import enlargement
from .gif import Colours, write_gif
from .grid import Grid
from .picture import Picture
from .space.animation_frames import SpaceFrames
from .style import PlotError, content, rendered
from .view.frames import chosen_steps

MOST_FRAMES = 80
DPI = 90
WHOLE = (2.0, 8.0)  # least and largest length of the animation, in seconds
EACH, SHORTEST, LAST = 0.15, 0.04, 1.0  # seconds: mean length of a frame, least length, length of the last frame
FIELDS = ("Displacement", "NodalVonMises", "VonMises", "Body")


class StepFields:
    """The run with the fields of one load step at a time; steps on the same mesh share what depends on the mesh only."""

    def __init__(self, run):
        self.run = copy(run)
        self.run.fields = copy(run.fields)
        self.run.step = None

    def at(self, step):
        """The run with the fields of a step, from 0; the same object at each call."""
        path = self.run.folder / f"fields_{step:04d}.vtkhdf"
        grid = self.run.fields
        if not path.is_file():
            raise PlotError(f"--animation: '{self.run.folder}' has no {path.name}, the fields of load step {step + 1}")
        try:
            with h5py.File(path, "r") as file:
                root = file["VTKHDF"]
                same = root["Types"].shape == grid.types.shape and root["Points"].shape == grid.points.shape and np.array_equal(root["Points"][:], grid.points)
                if same:
                    grid.point_data, grid.cell_data = ({name: root[group][name][:] for name in FIELDS if name in root[group]}
                                                       for group in ("PointData", "CellData"))
        except (OSError, KeyError, ValueError) as error:
            raise PlotError(f"{path} is not a field file of suture_solve, or is damaged: {error}") from error
        if not same:  # bodies were removed or placed
            self.run.fields = Grid(path)
        return self.run


def check(run):
    """Raises PlotError for a run without load steps or fields."""
    if not len(run.steps.get("time", [])):
        raise PlotError(f"--animation: the run of '{run.folder}' has no load steps")
    if run.fields is None:
        raise PlotError(f"--animation: the run of '{run.folder}' wrote no fields (Output/Fields)")


def animation(run, path, factor=None, view=None):
    """Writes the animation. \\return Picture, or raises PlotError

    \\param factor  enlargement of the displacements; None: that of the scene, by default 1 for bodies that move far
    \\param view    direction towards the viewer of a 3D run, or None
    """
    check(run)
    chosen, fields = chosen_steps(run, MOST_FRAMES), StepFields(run)
    frames = SpaceFrames(run, view) if run.dimension == 3 else PlaneFrames()
    largest = np.argmax([np.linalg.norm(fields.at(step).fields.point_data["Displacement"], axis=1).max(initial=0.0) for step in chosen])
    shown = fields.at(chosen[largest])
    used, limited = enlargement(shown, factor, lambda: frames.gaps(shown))
    for step in chosen:
        frames.add(fields.at(step), used)
    with matplotlib.rc_context({"savefig.dpi": DPI}):
        write_gif(path, pictures(frames, fields, chosen, used), durations(run.steps["time"][chosen]), Colours(matplotlib.colormaps["viridis"]))
    count = len(run.steps["time"])
    some = f" {len(chosen)} of {count} load steps, at equal distances." if len(chosen) < count else ""
    turning = " White lines show how bodies turn." if frames.turning else ""
    return Picture("animation", "animation", f"Von Mises stress {frames.where} over the load steps, with one colour scale.{some}{turning}"
                   f"{seeming(used, limited, is_given(run, factor))}", path=path)


def pictures(frames, fields, chosen, factor):
    """Yields the image of each step, all of the size of the first one."""
    count, cut = len(fields.run.steps["time"]), None
    for step in chosen:
        time = fields.run.steps["time"][step]
        image = rendered(frames.figure(fields.at(step), factor, f"load step {step + 1} of {count}, t = {time:.6g}"))
        if cut is None:
            cut = content(image)
        (top, bottom), (left, right) = cut
        yield image[top:bottom, left:right]


def durations(times):
    """Milliseconds of each frame: in proportion to the time until the next one, but not too short; the last one is held."""
    if len(times) == 1:
        return [1000 * LAST]
    parts = np.diff(times)
    whole = np.clip(EACH * len(parts), *WHOLE)
    return [*(1000 * np.maximum(whole * parts / parts.sum(), SHORTEST)).tolist(), 1000 * LAST]


def note(run):
    """A sentence on load steps that the animation leaves out, if there are any."""
    count = len(run.steps["time"])
    return [f"animation.gif shows {MOST_FRAMES} of {count} load steps, at equal distances"] if count > MOST_FRAMES else []
