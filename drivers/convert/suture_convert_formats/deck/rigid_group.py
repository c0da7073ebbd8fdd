"""A group of sides and nodes that follows, or is loaded by, a reference point."""
import dataclasses

import numpy as np

ALL = frozenset(range(6))  # three translations, three rotations


@dataclasses.dataclass
class RigidGroup:
    """
    *COUPLING, *KINEMATIC COUPLING or *RIGID BODY, as the deck gives it.

    title      of the card, for messages
    name       of the surface or set
    kind       KINEMATIC: the group moves as a rigid body with the reference point, in the coupled directions; DISTRIBUTING: loads of the point
               are distributed to the group; RIGID: as KINEMATIC, of all nodes of a *RIGID BODY; empty: neither was given
    reference  key of the reference node
    turning    (key of the node, its first degree of freedom) that has the rotations
    rows       boundary sides of the mesh all of whose nodes belong to the group
    nodes      nodes of the mesh that belong to the group
    point      position of the reference node in the assembly [length]
    coupled    numbers of the coupled motions: 0 to 2 translations along x, y, z; 3 to 5 rotations about them
    motions    prescribed translations [length] and rotations [rad] of the point: number -> values at the times of the scene
    loads      forces [force] and moments [force x length] on the point, likewise
    limit      why no scene can represent it, as far as known from its cards; empty: nothing
    reason     how the scene represents it, or why it does not
    """
    title: str
    place: object
    name: str
    kind: str
    reference: tuple
    turning: tuple
    rows: np.ndarray
    nodes: list
    point: list
    coupled: frozenset = ALL
    motions: dict = dataclasses.field(default_factory=dict)
    loads: dict = dataclasses.field(default_factory=dict)
    limit: str = ""
    reason: str = ""

    @property
    def is_loaded(self):
        return any(np.any(values) for values in self.loads.values())
