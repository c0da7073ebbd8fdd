"""A mesh as described by another program, before conversion to a Suture mesh."""
import numpy as np


class ConvertError(Exception):
    """An error in the input: the message names the file, the position and a remedy."""


class Foreign:
    """Points and blocks of elements; elements are numbered from 0 through all blocks.

    points       points x 3 [length]
    blocks       list of (kind, elements x nodes): meshio's kind and node order, point numbers from 0
    groups       name -> numbers of elements of any dimension
    node_sets    name -> numbers of points
    side_sets    name -> vertices of each side: two in 2D, three or four in 3D
    remarks      what was left out
    """

    def __init__(self, points):
        self.points = np.zeros((len(points), 3))
        if len(points):
            points = np.asarray(points, dtype=float)
            self.points[:, :points.shape[1]] = points[:, :3]
        self.blocks, self.groups, self.node_sets, self.side_sets, self.remarks = [], {}, {}, {}, []

    def elements(self):
        return sum(len(nodes) for _, nodes in self.blocks)

    def add_block(self, kind, nodes):
        """\\return numbers of its elements"""
        first = self.elements()
        self.blocks.append((kind, np.asarray(nodes, dtype=np.int64)))
        return np.arange(first, first + len(nodes))

    def add_to(self, sets, name, members):
        members = np.asarray(members, dtype=np.int64)
        sets[name] = np.concatenate([sets[name], members]) if name in sets else members
