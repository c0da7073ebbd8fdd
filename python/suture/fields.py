"""Fields of the whole mesh, gathered from the ranks."""
import numpy


def tensors(stress):
    """The stresses as n x 3 x 3 tensors, from n x 4 (xx, yy, zz, xy) or n x 6 (xx, yy, zz, xy, yz, xz)."""
    all_ = numpy.zeros((len(stress), 3, 3))
    places = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)]
    for column, (i, j) in zip(numpy.asarray(stress).T, places):
        all_[:, i, j] = all_[:, j, i] = column
    return all_


def principal(stress):
    """Principal stresses, n x 3, largest first; NaN where a component is not finite."""
    given = tensors(stress)
    good = numpy.isfinite(given).all(axis=(1, 2))
    values = numpy.full((len(given), 3), numpy.nan)
    values[good] = numpy.linalg.eigvalsh(given[good])[:, ::-1]
    return values


def von_mises(stress):
    """Von Mises stress of each row."""
    given = tensors(stress)
    deviator = given - numpy.trace(given, axis1=1, axis2=2)[:, None, None] / 3 * numpy.eye(3)
    return numpy.sqrt(1.5 * (deviator ** 2).sum(axis=(1, 2)))


class Fields:
    """Nodes and elements of a mesh in the order of their numbers, with the solution.

    At nodes: `coordinates`, `displacement`: nodes x dimension [length]; from fields() also `nodal_stress`: nodes x 4 (xx, yy, zz, xy), in 3D x 6
    (xx, yy, zz, xy, yz, xz), recovered; `nodal_von_mises`; `nodal_principal`: nodes x 3, largest first [stress]; on contact sides that carry
    pairs `pressure` [stress], `gap` [length], `status` (OPEN, SLIP, STICK) and `slip` (nodes x 3 [length]); elsewhere NaN, and -1 for status.
    At centroids of elements: `stress`, `von_mises`. `body`, `subdomain`: number per element, names of bodies in `bodies`; `cells`: node numbers
    of each element, `kinds`: name of its shape."""

    def __init__(self, parts, pairs=None):
        self.bodies = sorted({part["body"] for part in parts})
        nodes = numpy.concatenate([part["nodes"] for part in parts])
        self.nodes, first = numpy.unique(nodes, return_index=True)
        for name in ("coordinates", "displacement", "nodal_stress"):
            if name in parts[0]:
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
        kinds = [kind for part in parts for kind in part["kinds"]]
        self.kinds = [kinds[place] for place in order]
        if pairs is not None:
            self.nodal_von_mises, self.nodal_principal = von_mises(self.nodal_stress), principal(self.nodal_stress)
            self._add_pairs(pairs)

    def _add_pairs(self, pairs):
        count = len(self.nodes)
        self.pressure, self.gap, self.slip = numpy.full(count, numpy.nan), numpy.full(count, numpy.nan), numpy.full((count, 3), numpy.nan)
        self.status = numpy.full(count, -1)
        at = numpy.searchsorted(self.nodes, pairs["node"])
        for name in ("pressure", "gap", "slip", "status"):
            getattr(self, name)[at] = pairs[name]

    def __repr__(self):
        size = numpy.linalg.norm(self.displacement, axis=1)
        return ("<suture.Fields: %d nodes, %d elements, bodies %s; largest displacement %.4g, largest von Mises stress %.4g>"
                % (len(self.nodes), len(self.elements), ", ".join(self.bodies), size.max(initial=0.0), self.von_mises.max(initial=0.0)))


def _part(subdomain, nodal):
    nodes, connectivity = subdomain.nodes, subdomain.connectivity
    part = {"body": subdomain.body, "subdomain": subdomain.id, "nodes": nodes.copy(), "coordinates": subdomain.coordinates.copy(),
            "displacement": subdomain.displacement.copy(), "elements": subdomain.elements.copy(), "stress": subdomain.stress,
            "von_mises": subdomain.von_mises, "cells": [nodes[cell] for cell in numpy.split(connectivity, subdomain.offsets[1:-1])],
            "kinds": subdomain.cells}
    if nodal is not None:
        part["nodal_stress"] = nodal
    return part


def _collected(comm, part, root):
    """The parts of all ranks, on one rank or, for None, on all."""
    return comm.allgather(part) if root is None else comm.gather(part, root=root)


def gather(result, root=0):
    """Displacements of all nodes, and stresses at centroids, on one rank, None on other ranks. Collective."""
    return _fields(result, root, None)


def fields(result, root):
    nodal = result.nodal_stresses()
    pairs = {name: numpy.array(getattr(result.pairs, name)) for name in ("node", "pressure", "gap", "slip", "status")}
    return _fields(result, root, (nodal, result.comm.bcast(pairs, root=0)))


def _fields(result, root, more):
    nodal = more[0] if more else [None] * len(result.subdomains)
    parts = _collected(result.comm, [_part(subdomain, own) for subdomain, own in zip(result.subdomains, nodal)], root)
    return Fields([part for of_rank in parts for part in of_rank], more and more[1]) if parts is not None else None
