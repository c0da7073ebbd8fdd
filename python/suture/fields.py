"""Fields of the whole mesh, gathered from the ranks."""
import numpy


class Fields:
    """Nodes and elements of a mesh in the order of their numbers, with the solution.

    `coordinates`, `displacement`: nodes x dimension [length]; `stress`: elements x 4 (xx, yy, zz, xy), in 3D x 6
    (xx, yy, zz, xy, yz, xz), at centroids; `von_mises`: elements [stress]; `body`, `subdomain`: number per element, names of bodies in
    `bodies`; `cells`: node numbers of each element."""

    def __init__(self, parts):
        self.bodies = sorted({part["body"] for part in parts})
        nodes = numpy.concatenate([part["nodes"] for part in parts])
        self.nodes, first = numpy.unique(nodes, return_index=True)
        for name in ("coordinates", "displacement"):
            setattr(self, name, numpy.concatenate([part[name] for part in parts])[first])
        elements = numpy.concatenate([part["elements"] for part in parts])
        order = numpy.argsort(elements)
        self.elements = elements[order]
        for name in ("stress", "von_mises"):
            setattr(self, name, numpy.concatenate([part[name] for part in parts])[order])
        counts = [len(part["elements"]) for part in parts]
        self.body = numpy.repeat([self.bodies.index(part["body"]) for part in parts], counts)[order]
        self.subdomain = numpy.repeat([part["subdomain"] for part in parts], counts)[order]
        cells = [cell for part in parts for cell in part["cells"]]
        self.cells = [cells[place] for place in order]


def _part(subdomain):
    nodes, connectivity = subdomain.nodes, subdomain.connectivity
    return {"body": subdomain.body, "subdomain": subdomain.id, "nodes": nodes.copy(), "coordinates": subdomain.coordinates.copy(),
            "displacement": subdomain.displacement.copy(), "elements": subdomain.elements.copy(), "stress": subdomain.stress,
            "von_mises": subdomain.von_mises, "cells": [nodes[cell] for cell in numpy.split(connectivity, subdomain.offsets[1:-1])]}


def gather(result, root=0):
    """The fields of the whole mesh on one rank, None on other ranks. Collective."""
    parts = result.comm.gather([_part(subdomain) for subdomain in result.subdomains], root=root)
    return Fields([part for of_rank in parts for part in of_rank]) if parts is not None else None
