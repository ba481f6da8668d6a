"""Find contact normals that point the wrong way, as some engines give them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import numpy as np

from scene2hap.scene.objects import Contact, SceneObject
from scene2hap.scene.pose import Pose


def are_reversed(
    contacts: Iterable[Contact], objects: Mapping[str, SceneObject], pose_of: Callable[[str], Pose]
) -> bool | None:
    """Whether all normals point from `b` to `a`. None if fewer than two pairs of objects have normals.

    A normal that points out of `a` points out of the smaller of both objects, or into it if that is `b`. A ring on a
    peg is touched from its inside, so a single pair shows nothing.
    """
    pairs, n_right = set(), 0
    for contact in contacts:
        if contact.normal is None or contact.a not in objects or contact.b not in objects:
            continue
        boxes = [objects[x].geometry.mesh.bounds_m for x in (contact.a, contact.b)]
        a_is_smaller = np.ptp(boxes[0], axis=0).sum() <= np.ptp(boxes[1], axis=0).sum()
        smaller, box = (contact.a, boxes[0]) if a_is_smaller else (contact.b, boxes[1])
        outwards = np.array(contact.point_m) - pose_of(smaller).to_world([box.mean(axis=0)])[0]
        points_out = float(outwards @ contact.normal) > 0
        n_right += points_out == bool(a_is_smaller)
        pairs.add(frozenset((contact.a, contact.b)))
    return None if len(pairs) < 2 else n_right == 0
