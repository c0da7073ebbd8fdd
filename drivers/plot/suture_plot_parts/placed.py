"""Bodies that move far where they are, as their contacts: for pictures of stresses."""
from copy import copy


def in_place(run):
    """The run with the points of its bodies at the end of the step, where the places in summary.json are; the run itself if displacements are small."""
    if not run.moving:
        return run
    placed = copy(run)
    placed.fields = run.fields.moved(run.fields.points + run.fields.point_data["Displacement"])
    return placed
