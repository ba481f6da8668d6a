"""Warning of a game whose first poses begin with w.

A thing that is not turned is (1, 0, 0, 0) with w first, which is upside down with w last.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import islice

import numpy as np

from scene2hap.scene.pose import Pose
from scene2hap.scene.scene_warning import warn_of

_MOST_LOOKED_AT = 100
# |cos| of half of 150 and of 30 degrees: no game turns things by more in a frame (assumed).
_FLIPS, _STAYS = 0.26, 0.966


def warn_if_w_first(moved: Mapping[str, Pose], pose: Callable[[str], Pose], known: Mapping[str, object]) -> None:
    """Warn if all poses turn their objects over, and hardly would if their quaternions began with w.

    Parameters: pose : gives where an object was; known : objects of the scene. Warns: SceneWarning.
    """
    some = [(x, new) for x, new in islice(moved.items(), _MOST_LOOKED_AT) if x in known and isinstance(new, Pose)]
    if not some:
        return
    before = np.array([pose(x).rotation_xyzw for x, _ in some])
    after = np.array([new.rotation_xyzw for _, new in some])
    as_given = np.abs((before * after).sum(axis=1))
    with_w_first = np.abs((before * np.roll(after, -1, axis=1)).sum(axis=1))
    if (as_given < _FLIPS).all() and (with_w_first > _STAYS).all():
        x, new = some[0]
        parts = ", ".join(f"{part:g}" for part in new.rotation_xyzw)
        warn_of(
            f"the first poses turn all {len(some)} moved objects over, as quaternions do that begin with w: "
            f"rotation_xyzw of {x!r} is ({parts}). Make poses by Pose.from_wxyz(position_m, rotation_wxyz)."
        )
