"""A session that follows an engine."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap import checks
from scene2hap.engines.adapter import EngineAdapter
from scene2hap.errors import ConfigError, SceneError
from scene2hap.scene.engines.motion import moved
from scene2hap.scene.pose import Pose
from scene2hap.scene.pose_table import PoseTable
from scene2hap.session import HapticFrame, HapticSession, Touch

# As `scene.engines.motion` has them: what an object may move and turn by and still count as at rest.
_BY_M, _BY_RAD = 1e-4, 1e-3
_MOST_NAMED = 5
Floats = NDArray[np.float64]


class EngineLink:
    """Hands a session, in each frame, what changed in an engine since the last.

    Parameters: adapter : the engine; session : of a scene with the engine's ids, started or not.
    Raises: ConfigError: the adapter lacks a method. SceneError: the session has objects that the engine has not.
    """

    def __init__(self, adapter: EngineAdapter, session: HapticSession) -> None:
        if not isinstance(session, HapticSession):
            raise ConfigError(f"session is {checks.described(session)}; it must be a HapticSession.")
        missing = [name for name in ("poses", "touches", "contacts") if not callable(getattr(adapter, name, None))]
        if missing:
            raise ConfigError(f"{type(adapter).__name__} has no method {missing[0]!r}; see EngineAdapter.")
        self._adapter, self._session = adapter, session
        self._known: dict[str, Pose] = {}
        self._table: tuple[tuple[str, ...], Floats, Floats] | None = None
        ids = {item.id for item in session.snapshot.objects}
        unknown = sorted(ids - adapter.poses().keys())
        if unknown:
            names = ", ".join(map(repr, unknown[:_MOST_NAMED])) + (", ..." if len(unknown) > _MOST_NAMED else "")
            raise SceneError(
                f"the engine lacks {len(unknown)} of {len(ids)} objects of the session: {names}. Make the session of "
                "the engine's own snapshot, or of a bundle that was baked from it."
            )

    def update(self, touches: Sequence[Touch] = ()) -> HapticFrame:
        """Once per frame, on the game's thread: poses that changed, contacts, and touches; these come on top of the
        engine's own. Raises: as `HapticSession.update`."""
        felt = [*touches, *self._adapter.touches()]
        return self._session.update(self._changed(self._adapter.poses()), felt, contacts=self._adapter.contacts())

    def _changed(self, poses: Mapping[str, Pose]) -> Mapping[str, Pose]:
        if not isinstance(poses, PoseTable):
            changed = moved(poses, self._known, by_m=_BY_M, by_rad=_BY_RAD)
            self._known.update(changed)
            return changed
        ids, positions, rotations = poses.ids, poses.positions_m, poses.rotations_xyzw
        if self._table is None or self._table[0] != ids:
            self._table = (ids, positions.copy(), rotations.copy())
            return poses
        # What counts as at rest is held against where it was, so that slow motion adds up.
        _, known_positions, known_rotations = self._table
        rows = _moved_rows(positions, rotations, known_positions, known_rotations)
        known_positions[rows], known_rotations[rows] = positions[rows], rotations[rows]
        moves = zip(rows.tolist(), positions[rows].tolist(), rotations[rows].tolist(), strict=True)
        return {ids[row]: Pose((x, y, z), (a, b, c, d)) for row, (x, y, z), (a, b, c, d) in moves}


def _moved_rows(positions: Floats, rotations: Floats, before: Floats, turned: Floats) -> NDArray[np.intp]:
    way = ((positions - before) ** 2).sum(axis=1)
    # |q . p| = cos(angle / 2); either sign of a quaternion is the same rotation.
    turn = np.abs((rotations * turned).sum(axis=1))
    found: NDArray[np.intp] = np.flatnonzero((way > _BY_M**2) | (turn < math.cos(_BY_RAD / 2)))
    return found
