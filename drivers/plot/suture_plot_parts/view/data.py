"""The data of the interactive view: geometry, displacements and fields of a 3D run, within a given size."""
import numpy as np

from ..units import scaled
from .faces import ContactFaces
from .frames import Frames, chosen_steps, fields_of_bodies, fields_of_contacts
from .pack import integers, scale_of, size, text
from .solid import Reduced, Solid, faces_of

MOST_TRIANGLES = 200000  # that a telephone still turns smoothly
# Attempts, best first: cells for true sections, largest number of load steps, largest number of triangles.
PLANS = [(inside, steps, MOST_TRIANGLES) for steps in (40, 20, 10) for inside in (True, False)] + \
        [(False, steps, MOST_TRIANGLES) for steps in (5, 1)] + [(False, steps, triangles) for triangles in (100000, 50000, 20000) for steps in (5, 1)]


def view_data(run, room, factor=1.0):
    """The data as an object for JSON with at most `room` characters of numbers, or None if the run has no surface or the room does not suffice.

    \\param factor  enlargement of the displacements at first
    """
    whole = {}
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
        if size_of(solid, fields, 1 if chosen is None else len(chosen)) <= room:
            return packed(run, solid, fields, Frames(run, chosen), factor, isinstance(solid, Reduced))
    return None


def size_of(solid, fields, frames):
    """Characters of the numbers, to within a few."""
    points, wide = len(solid.points), 4 if len(solid.points) > 65535 else 2
    cells = sum(len(own) for own, _ in solid.cells.values()) or len(solid.owners)
    nodes = sum(vertices.size for _, vertices in solid.cells.values())
    fixed = size(6 * points) + size(3 * wide * len(solid.triangles)) + size(4 * len(solid.owners)) + size(2 * wide * len(solid.creases)) + \
        size(wide * nodes) + size(6 * cells)
    return fixed + frames * (size(6 * points) + sum(size(2 * (points if field.place == "point" else cells)) for field in fields))


def packed(run, solid, fields, frames, factor, reduced):
    grid = run.fields
    names = grid.names.get("Bodies") or [f"body {k + 1}" for k in range(int(grid.cell_data["Body"].max()) + 1)]
    body = grid.cell_data["Body"].astype(int)
    cells = np.unique(np.concatenate([solid.owners, *(own for own, _ in solid.cells.values())]))
    place = np.full(grid.count, -1)
    place[cells] = np.arange(len(cells))
    points = scale_of([solid.points])
    readers = [lambda p, c: p["Displacement"][()], *(field.read for field in fields)]
    found = frames.read("fields", readers)
    moved = [solid.at(frame[0]) for frame in found]
    return {
        "title": run.title, "state": run.state_of_answer.strip(), "length": run.length_unit, "bodies": names, "enlargement": factor, "frames": frames.labels,
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
    """The contact surfaces with their fields, or None."""
    fields = fields_of_contacts(run)
    faces = ContactFaces(run.contact) if fields else None
    if faces is None or not len(faces.triangles):
        return None
    names = list(run.parameter("Contact", default={}))
    names += [f"contact {k}" for k in range(len(names), int(faces.contacts.max()) + 1)]
    points = scale_of([faces.points])
    found = frames.read("contact", [lambda p, c: p["Displacement"][()], *(field.read for field in fields)])
    return {
        "names": names, "points": {**points.words(), "data": text(points.codes(faces.points))}, "triangles": integers(faces.triangles),
        "starts": np.searchsorted(faces.contacts, np.arange(len(names) + 1)).tolist(), "displacement": coded([faces.at(frame[0]) for frame in found]),
        "fields": [coded_field(field, [faces.at(frame[k + 1]) for frame in found]) for k, field in enumerate(fields)]
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
