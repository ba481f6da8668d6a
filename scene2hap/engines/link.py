"""A session that follows an engine."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from scene2hap.common import checks
from scene2hap.common.calls import clear_calls
from scene2hap.common.counted import first_of
from scene2hap.engines.adapter import EngineAdapter
from scene2hap.engines.changes import Changes
from scene2hap.errors import ConfigError, SceneError
from scene2hap.scene.objects import Contact
from scene2hap.scene.pose import Pose
from scene2hap.session import HapticFrame, HapticSession, Touch
from scene2hap.session.arguments import given_contacts
from scene2hap.session.frame import given_touches

_T = TypeVar("_T")
_MOST_NAMED = 5
_SCALE_TOLERANCE = 1e-3
"""A smaller relative difference of positions counts as the same unit (assumed: units differ by 1 % or more)."""


@clear_calls
class EngineLink:
    """Pass the changes of an engine since the last frame to a session.

    The engine may have more objects than the session. Objects that are not in the session are ignored until they are
    added.
    Parameters: adapter : the engine; session : of a scene with the engine's ids, started or not.
    Raises: ConfigError: the adapter lacks a method. SceneError: the engine lacks objects of the session, or uses
    another unit.
    """

    def __init__(self, adapter: EngineAdapter, session: HapticSession) -> None:
        if not isinstance(session, HapticSession):
            raise ConfigError(f"session is {checks.described(session)}; it must be a HapticSession.")
        if isinstance(adapter, type):
            raise ConfigError(f"adapter is the class {adapter.__name__}; give an instance of it, {adapter.__name__}().")
        missing = [name for name in ("poses", "touches", "contacts") if not callable(getattr(adapter, name, None))]
        if missing:
            raise ConfigError(f"{type(adapter).__name__} has no method {missing[0]!r}; see EngineAdapter.")
        self._adapter, self._session, self._changes = adapter, session, Changes(session)
        self._steps: list[Any] = []
        _require_same_scene(self._poses(), session)

    def __repr__(self) -> str:
        return f"{type(self).__name__} of {self._session!r}"

    def collect(self) -> None:
        """Keep the contacts of this step of the physics for the next `update`. Call it after each step of a frame.

        The next `update` then reports all contacts of the frame. Those of a ball that bounces or of a finger that taps
        may have ended by then. Without this call, `update` reports those of the last step. Raises: as `update`.
        """
        self._steps.append(self._step())

    def update(self, touches: Sequence[Touch] | None = (), *, at_sample: int | None = None) -> HapticFrame:
        """Update the session. Call this once per frame on the game's thread.

        It passes changed poses, contacts, and the engine's touches together with `touches`. After a refused frame, the
        next frame passes all changes again. Parameters, Raises: as `HapticSession.update`; SceneError: the adapter's
        poses are not valid.
        """
        poses, followed = self._poses(), self._session.object_ids
        steps, self._steps = [*self._steps, self._step()], []

        def is_played(object_id: object) -> bool:
            # An id that is unknown to both engine and session is a mistake, which the session reports.
            return object_id in followed or object_id not in poses

        touched, met = self._reported(steps)
        felt = [one for one in touched if is_played(one.object_id)]
        contacts = None if met is None else [one for one in met if is_played(one.a) and is_played(one.b)]
        try:
            changed = self._changes.of(poses)
            return self._session.update(
                changed, [*given_touches(touches), *felt], contacts=contacts, at_sample=at_sample
            )
        except Exception:
            self._changes.forget()
            raise

    def _step(self) -> Any:
        """Return what the engine reports of the present step, for `_reported`."""
        touches, contacts = given_touches(self._adapter.touches()), self._adapter.contacts()
        return touches, None if contacts is None else given_contacts(contacts)

    def _reported(self, steps: Sequence[Any]) -> tuple[Sequence[Touch], Sequence[Contact] | None]:
        """Return touches and contacts of the steps of a frame: of each pair those of the last step that has any."""
        reports = [contacts for _, contacts in steps if contacts is not None]
        met = _of_steps(reports, lambda one: frozenset((one.a, one.b))) if reports else None
        return _of_steps([touches for touches, _ in steps], lambda one: (one.hand, one.object_id)), met

    def _poses(self) -> Mapping[str, Pose]:
        poses: Any = self._adapter.poses()
        if not isinstance(poses, Mapping):
            raise SceneError(
                f"poses() of {type(self._adapter).__name__} gave {checks.described(poses)}; it must be a mapping of "
                "object ids to poses, as {'mug': Pose(...)}."
            )
        return poses


def _of_steps(steps: Sequence[Sequence[_T]], pair: Callable[[_T], Hashable]) -> Sequence[_T]:
    """Return the touches or contacts of several steps, see `EngineLink._reported`."""
    if len(steps) == 1:
        return steps[0]
    last: dict[Hashable, list[_T]] = {}
    for step in steps:
        of_step: dict[Hashable, list[_T]] = {}
        for one in step:
            of_step.setdefault(pair(one), []).append(one)
        last |= of_step
    return [one for of_pair in last.values() for one in of_pair]


def _require_same_scene(poses: Mapping[str, Pose], session: HapticSession) -> None:
    """Check that the engine has the session's objects, in metres. Raises: SceneError: it does not."""
    here = {item.id: item.pose for item in session.snapshot.objects}
    unknown = sorted(here.keys() - poses.keys())
    if unknown:
        names = first_of([*map(repr, unknown)], _MOST_NAMED)
        raise SceneError(
            f"the engine lacks {len(unknown)} of {len(here)} objects of the session: {names}. Make the session of "
            "the engine's own snapshot, or of a bundle that was baked from it, and give the link the arguments of that "
            "snapshot (group, geom_groups). Objects that the game has taken out: session.remove(id)."
        )
    if not all(isinstance(poses[object_id], Pose) for object_id in here):
        return  # the first update reports it
    ours = np.array([pose.position_m for pose in here.values()])
    theirs = np.array([poses[object_id].position_m for object_id in here])
    ways = np.linalg.norm(ours, axis=1)
    is_off_origin = ways > 0.0
    if not is_off_origin.any():
        return
    scale = float(np.median(np.linalg.norm(theirs, axis=1)[is_off_origin] / ways[is_off_origin]))
    # The simulation may have continued since the snapshot. But moved objects do not keep their proportions.
    keeps = np.isclose(theirs, scale * ours, rtol=1e-6, atol=1e-9).all(axis=1) & is_off_origin
    is_most = np.count_nonzero(keeps) >= max(2, np.count_nonzero(is_off_origin) / 2)
    if is_most and abs(scale - 1) > _SCALE_TOLERANCE:
        raise SceneError(
            f"the engine's positions are {scale:.4g} times those of the session; both must be in metres. Give the link "
            "the unit_m of the snapshot."
        )
