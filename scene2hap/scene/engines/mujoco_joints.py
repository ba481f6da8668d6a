"""MuJoCo joints as hinges.

A body with hinge or ball joints alone is held on the drawn body before it, if only welds lie between the two. So is a
body that is welded to one that moves, such as the hand of a robot. Bodies that slide on others touch along their rails;
their contacts, and those of bodies fixed to the world, are found from geometry.

Source: MuJoCo documentation (Google DeepMind), XML reference, `joint`; mjData: xanchor, xaxis.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

import numpy as np

from scene2hap.scene.hinges import hinge_at, welded_at
from scene2hap.scene.objects import Hinge, SceneObject

_WORLD = 0
_BALL, _HINGE = 1, 3


def hinges(model: Any, data: Any, of_body: Mapping[int, SceneObject], unit_m: float) -> dict[str, Hinge]:
    """Return the hinges of objects by id. Poses must be current.

    Parameters: of_body : the objects by the number of their body; unit_m : metres per unit of the model.
    """
    found = {}
    for body, item in of_body.items():
        first, n = int(model.body_jntadr[body]), int(model.body_jntnum[body])
        joints = range(first, first + n)
        before = _held_on(model, body, of_body)
        other = of_body.get(before)
        turns = all(model.jnt_type[joint] in (_BALL, _HINGE) for joint in joints)
        if other is None or not turns or model.body_weldid[body] == _WORLD:
            continue
        if n == 0:
            hinge = welded_at(item, other)
        else:
            axis = np.array(data.xaxis[first]) if n == 1 and model.jnt_type[first] == _HINGE else None
            hinge = hinge_at(item, other, data.xanchor[first] * unit_m, axis)
        if hinge is not None:
            found[item.id] = hinge
    return found


def _held_on(model: Any, body: int, drawn: Collection[int]) -> int:
    """Return the number of the drawn body before a body with welds alone between the two, the world's if none is."""
    parent = int(model.body_parentid[body])
    while parent not in drawn and parent != _WORLD and model.body_jntnum[parent] == 0:
        parent = int(model.body_parentid[parent])
    return parent
