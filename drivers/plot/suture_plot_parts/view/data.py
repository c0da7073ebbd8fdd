"""The data of the interactive view: geometry, displacements and fields of a 3D run, within a given size."""
import numpy as np

from ..units import scaled
from .faces import ContactFaces
from .frames import Frames, SameMesh, chosen_steps, fields_of_bodies, fields_of_contacts
from .pack import integers, scale_of, size, text
from .solid import Reduced, Solid, faces_of
from .turns import turns_of

MOST_TRIANGLES = 200000  # that a telephone still turns smoothly
# Attempts, best first: cells for true sections, largest number of load steps, largest number of triangles.
PLANS = [(inside, steps, MOST_TRIANGLES) for steps in (40, 20, 10) for inside in (True, False)] + \
        [(False, steps, MOST_TRIANGLES) for steps in (5, 1)] + [(False, steps, triangles) for triangles in (100000, 50000, 20000) for steps in (5, 1)]


def view_data(run, room, factor=1.0):
    """The data as an object for JSON with at most `room` characters of numbers, or None if the run has no surface or the room does not suffice.

    \\param factor  enlargement of the displacements at first
    """
    whole, same = {}, SameMesh(run)
    fields = fields_of_bodies(run)
    for inside, steps, most in PLANS:
        if inside not in whole:
            whole[inside] = Solid(run.fields, inside)
        solid = whole[inside]
        if not len(solid.triangles):
            return None
        if len(solid.triangles) > most:
            solid = Reduced(solid, most, solid.at(np.linalg.norm(run.fields.point_data["Displacement"], axis=1)))
        chosen = chosen_steps(run, steps)
        if run.step is not None and run.step - 1 not in chosen:
            chosen = sorted({*chosen, run.step - 1})
        others = [step for step in chosen or [] if not same(step)]
        chosen = [step for step in chosen if step not in others] if chosen is not None else None
        if size_of(solid, fields, 1 if chosen is None else len(chosen)) + size_of_contacts(run, 1 if chosen is None else len(chosen)) <= room:
            return {**packed(run, solid, fields, Frames(run, chosen), factor, isinstance(solid, Reduced)), "others": bool(others)}
    return None


def size_of(solid, fields, frames):
    """Characters of the numbers, to within a few."""
    points, wide = len(solid.points), 4 if len(solid.points) > 65535 else 2
    cells = sum(len(own) for own, _ in solid.cells.values()) or len(solid.owners)
    nodes = sum(vertices.size for _, vertices in solid.cells.values())
    fixed = size(6 * points) + size(3 * wide * len(solid.triangles)) + size(4 * len(solid.owners)) + size(2 * wide * len(solid.creases)) + \
        size(wide * nodes) + size(6 * cells)
    return fixed + frames * (size(6 * points) + sum(size(2 * (points if field.place == "point" else cells)) for field in fields))


def size_of_contacts(run, frames):
    """Characters of the contact surfaces: about two triangles for each pair."""
    if run.contact is None:
        return 0
    pairs, fields = len(run.contact.points), len(fields_of_contacts(run, run.contact))
    return (frames if run.moving else 1) * size(18 * pairs) + frames * size((6 + 2 * fields) * pairs)


def packed(run, solid, fields, frames, factor, reduced):
    grid = run.fields
    names = grid.names.get("Bodies") or [f"body {k + 1}" for k in range(int(grid.cell_data["Body"].max()) + 1)]
    body = grid.cell_data["Body"].astype(int)
    cells = np.unique(np.concatenate([solid.owners, *(own for own, _ in solid.cells.values())]))
    place = np.full(grid.count, -1)
    place[cells] = np.arange(len(cells))
    points = scale_of([solid.points])
    readers = [lambda p, c: p["Displacement"][()], *(field.read for field in fields)]
    found = frames.read(readers)
    moved = [solid.at(frame[0]) for frame in found]
    low, high = zip(*((place.min(axis=0), place.max(axis=0)) for place in (solid.points, *(solid.points + factor * shift for shift in moved))))
    return {
        "reach": {"low": np.min(low, axis=0).tolist(), "high": np.max(high, axis=0).tolist()}, "turns": turns_of(solid, body, moved, factor),
        "moving": run.moving, "title": run.title, "state": run.state_of_answer.strip(), "length": run.length_unit, "bodies": names, "enlargement": factor, "frames": frames.labels,
        "first": frames.chosen.index(run.step - 1) if frames.chosen and run.step else len(frames.labels) - 1,
        "reduced": reduced, "inside": bool(solid.cells), "points": {**points.words(), "data": text(points.codes(solid.points))},
        "triangles": integers(solid.triangles), "starts": np.searchsorted(body[solid.owners], np.arange(len(names) + 1)).tolist(),
        "owners": integers(place[solid.owners]), "creases": integers(solid.creases), "creaseBodies": integers(solid.crease_bodies),
        "cellBodies": integers(body[cells]),
        "cells": [{"vertices": count, "faces": faces_of(count), "nodes": integers(nodes), "owners": integers(place[own])}
                  for count, (own, nodes) in solid.cells.items()],
        "displacement": coded(moved),
        "fields": [coded_field(field, [solid.at(frame[k + 1]) if field.place == "point" else frame[k + 1][cells] for frame in found])
                   for k, field in enumerate(fields)],
        "contacts": packed_contacts(run, frames)
    }


def packed_contacts(run, frames):
    """The contact surfaces with their fields, or None. `shapes`: one for each frame if the pairs differ, else one for all."""
    grids = frames.contacts()
    faces = [ContactFaces(grid) for grid in grids]
    if not any(len(one.triangles) for one in faces):
        return None
    fields = fields_of_contacts(run, next(grid for grid, one in zip(grids, faces) if len(one.triangles)))
    names = list(run.parameter("Contact", default={}))
    names += [f"contact {k}" for k in range(len(names), max(int(one.contacts.max(initial=-1)) for one in faces) + 1)]
    points = scale_of([one.points for one in faces])

    def values(read):
        """Of each frame, at the points of its faces."""
        return [one.at(np.asarray(read(grid.point_data, grid.cell_data), dtype=float)) if grid is not None else None for one, grid in zip(faces, grids)]

    moved = [found if found is not None else np.zeros((0, 3)) for found in values(lambda p, c: p["Displacement"][()])]
    return {
        "names": names,
        "shapes": [{"points": {**points.words(), "data": text(points.codes(one.points))}, "triangles": integers(one.triangles),
                    "starts": np.searchsorted(one.contacts, np.arange(len(names) + 1)).tolist()}
                   for one in (faces[:1] if all(faces[0].same(one) for one in faces) else faces)],
        "displacement": coded(moved),
        "fields": [coded_field(field, [found if found is not None else np.zeros(0) for found in values(field.read)]) for field in fields]
    }


def coded(frames):
    scale = scale_of(frames)
    return {**scale.words(), "frames": [text(scale.codes(frame)) for frame in frames]}


def coded_field(field, frames):
    """A field with its range, and the unit in which it is shown."""
    known = np.concatenate([frame[np.isfinite(frame)] for frame in frames] or [np.zeros(1)])
    low, high = (float(known.min()), float(known.max())) if len(known) else (0.0, 0.0)
    factor, unit = scaled(field.unit, max(abs(low), abs(high)))
    return {"name": field.name, "label": field.label, "unit": field.unit, "shown": unit, "factor": factor, "place": field.place, "signed": field.signed,
            "reversed": field.reversed_colours, "least": low, "largest": high, **coded(frames)}
