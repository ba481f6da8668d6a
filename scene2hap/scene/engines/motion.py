"""Select the objects of a simulation that move by more than numerical noise.

Objects at rest tremble in a simulation, and each moved pose makes the contact graph search for contacts again.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from operator import mul

from scene2hap.scene.pose import Pose

AT_REST_M, AT_REST_RAD = 1e-4, 1e-3
"""Largest motion and rotation of an object at rest. Assumed: 0.1 mm, and 0.1 mm at 10 cm from the pivot; contacts are
found to millimetres."""


def moved(
    now: Mapping[str, Pose], before: Mapping[str, Pose], *, by_m: float = AT_REST_M, by_rad: float = AT_REST_RAD
) -> dict[str, Pose]:
    """Return the poses in `now` that are new, or differ from `before` by more than the bounds.

    Parameters: by_m, by_rad : largest motion [m] and rotation [rad] of an object at rest. Add the returned poses to the
        next `before`, so that slow motion adds up:

        changed = moved(poses(model, data), known)
        known.update(changed)
        session.update(changed, touches)
    """
    # |q . p| = cos(angle / 2), since q and -q are the same rotation.
    at_least = math.cos(by_rad / 2)
    return {
        object_id: pose
        for object_id, pose in now.items()
        if (old := before.get(object_id)) is not pose
        and (
            old is None
            or math.dist(pose.position_m, old.position_m) > by_m
            or abs(sum(map(mul, pose.rotation_xyzw, old.rotation_xyzw))) < at_least
        )
    }
