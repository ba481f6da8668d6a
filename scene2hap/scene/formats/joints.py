"""The joints of a file as pivots between its bodies.

A body that turns on another is held there, and so is one that is fixed to one that moves. Bodies that do not move have
the contacts that geometry finds, such as all of a shelf's on its wall.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.tree import AuthoredPivot

Motion = Literal["fixed", "turns", "other"]
"""How a joint lets a body move: not at all, about an axis or a point, or otherwise, such as along a slide."""


class Joint(NamedTuple):
    """The joint by which a body is on another, given by its key: how it moves there, a point (3,) of its axis in the
    unit of the scene, and the axis (3,) of length 1, None for a ball."""

    on: str
    motion: Motion
    anchor: NDArray[np.float64] | None = None
    axis: NDArray[np.float64] | None = None


def pivots(joints: Mapping[str, Joint], drawn: Collection[str]) -> Iterator[AuthoredPivot]:
    """Yield the pivots between bodies that have geometry, also across bodies without it that are fixed.

    Parameters: joints : the joint of each body that has one, by the body's key, without rings. A body without a joint
    does not move. drawn : the keys of the bodies with geometry.
    """
    for key, joint in joints.items():
        on = joint.on
        while on not in drawn and on in joints and joints[on].motion == "fixed":
            on = joints[on].on
        if joint.motion == "fixed" and _moves(on, joints):
            yield AuthoredPivot(key, on)
        elif joint.motion == "turns":
            yield AuthoredPivot(key, on, joint.anchor, joint.axis)


def _moves(body: str, joints: Mapping[str, Joint]) -> bool:
    while body in joints and joints[body].motion == "fixed":
        body = joints[body].on
    return body in joints
