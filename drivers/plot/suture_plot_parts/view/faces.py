"""Contact surfaces of the interactive view."""
import numpy as np

from ..space.cells import FACES, with_centres


class ContactFaces:
    """The faces of all contacts as triangles, sorted by contact. Points are the pairs, and the centres of quadrilaterals between them.

    `grid`: None if there are no pairs
    """

    def __init__(self, grid):
        if grid is None:
            self._centres, self.triangles = [], np.zeros((0, 3), dtype=int)
            self.contacts, self.points = np.zeros(0, dtype=int), np.zeros((0, 3))
            return
        triangles, self._centres, count = [np.zeros((0, 3), dtype=int)], [], len(grid.points)
        for _, _, nodes in grid.blocks:
            shape = FACES[nodes.shape[1]]
            if shape.centre is not None:
                self._centres.append((nodes, shape.centre))
                nodes = np.column_stack([nodes, count + np.arange(len(nodes))])
                count += len(nodes)
            triangles.append(nodes[:, shape.triangles].reshape(-1, 3))
        triangles = np.concatenate(triangles)
        contact = grid.point_data["Line"].astype(int)[triangles[:, 0]]
        order = np.argsort(contact, kind="stable")
        self.triangles, self.contacts = triangles[order], contact[order]
        self.points = self.at(grid.points)

    def same(self, other):
        """Whether both have the same points and triangles."""
        return np.array_equal(self.points, other.points) and np.array_equal(self.triangles, other.triangles) and \
            np.array_equal(self.contacts, other.contacts)

    def at(self, values):
        """Values at the points, from values of the pairs."""
        return with_centres(values.astype(float), self._centres)
