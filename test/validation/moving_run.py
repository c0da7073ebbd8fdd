"""Results of a run of a random scene whose bodies move far, in the axes and units of the scene."""
import csv
import json
import os


def table(folder, name):
    path = os.path.join(folder, name)
    if not os.path.exists(path):
        return []
    with open(path) as file:
        return list(csv.DictReader(file))


class MovingRun:
    def __init__(self, scene, folder):
        self.scene = scene
        self.rows, self._frames, self._groups = (table(folder, name + ".csv") for name in ("steps", "frames", "rigid_groups"))
        path = os.path.join(folder, "summary.json")
        self.summary = json.load(open(path)) if os.path.exists(path) else {}

    @property
    def times(self):
        return [float(row["time"]) for row in self.rows]

    @property
    def steps(self):
        return range(len(self.rows))

    def force(self, contact, step=-1):
        """Force of a contact on the side that the scene names second."""
        sign = next(c["sign"] for c in self.scene.contacts if c["name"] == contact)
        row = self.rows[step]
        return [sign * x / self.scene.force for x in self.scene.back([float(row["force %s %s" % (contact, axis)]) for axis in "xyz"])]

    def body(self, name, step=-1):
        """Displacement and rotation of a body; in 2D its angle."""
        return self._moved([row for row in self._frames if row["body"] == name][step])

    def group(self, name, step=-1):
        """Displacement and rotation of a driven group."""
        return self._moved([row for row in self._groups if row["group"] == name][step])

    def reaction(self, name, step=-1):
        """Force and moment of the drive on a group."""
        row, scene = [row for row in self._groups if row["group"] == name][step], self.scene
        moment = [float(row["m" + axis]) / scene.force / scene.length for axis in "xyz"]
        return ([x / scene.force for x in scene.back([float(row["f" + axis]) for axis in "xyz"])],
                scene.back(moment) if scene.d == 3 else moment[2])

    def _moved(self, row):
        scene = self.scene
        turn = [float(row["rotation_" + axis]) for axis in "xyz"]
        return ([x / scene.length for x in scene.back([float(row["displacement_" + axis]) for axis in "xyz"])],
                scene.back(turn) if scene.d == 3 else turn[2])
