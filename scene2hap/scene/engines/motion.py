"""Which objects of a simulation really move: things at rest tremble, and each tremble has contacts looked for anew."""

from __future__ import annotations

import math
from collections.abc import Mapping
from operator import mul

from scene2hap.scene.pose import Pose

AT_REST_M, AT_REST_RAD = 1e-4, 1e-3
"""What an object may move and turn by and still count as at rest (assumed: 0.1 mm, and that at 10 cm from the pivot;
contacts are found to millimetres)."""


def moved(
    now: Mapping[str, Pose], before: Mapping[str, Pose], *, by_m: float = AT_REST_M, by_rad: float = AT_REST_RAD
) -> dict[str, Pose]:
    """The poses among `now` that differ from those `before`, or are new.

    Parameters: by_m, by_rad : what an object may move and turn by and still count as at rest. Keep what counted as
        moved as the next `before`, so that slow motion adds up:

        changed = moved(poses(model, data), known)
        known.update(changed)
        session.update(changed, touches)
    """
    # |q . p| = cos(angle / 2); either sign of a quaternion is the same rotation.
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
