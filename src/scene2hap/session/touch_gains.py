"""From touches to gains: what of each source arrives where a hand is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.exponential_plate import ExponentialField
from scene2hap.scene.pose import Pose
from scene2hap.session.config import MAX_GAIN_DB
from scene2hap.session.counts import Counts
from scene2hap.session.field_keeper import Prepared
from scene2hap.session.frame import Touch
from scene2hap.session.law_rows import LawRows, Point
from scene2hap.session.reach import Reach

GREATEST = 10 ** (MAX_GAIN_DB / 20)

Gains = NDArray[np.float64]


class TouchGains:
    """Asks a field about touches, for the sources and objects that are there now; the field may know of others.

    Parameters: reach : what hangs together now; is_current : whether the field tells of things as they are; if not,
    what nothing leads to any more is silenced whatever the field says; skips_unreachable : do not ask the field where
    no source reaches; limit : cap on a gain, None for none.
    """

    def __init__(
        self,
        prepared: Prepared,
        source_ids: Sequence[str],
        n_bands: int,
        reach: Reach,
        counts: Counts,
        *,
        is_current: bool,
        skips_unreachable: bool,
        limit: float | None,
    ) -> None:
        self._field, self._then = prepared.field, prepared.situation.poses
        self._rows = LawRows(prepared.field) if isinstance(prepared.field, ExponentialField) else None
        self._own = {source_id: column for column, source_id in enumerate(source_ids)}
        self._shape = (len(source_ids), n_bands)
        known = tuple(self._field.source_ids)
        shared = [(self._own[x], column) for column, x in enumerate(known) if x in self._own]
        # Columns of the answer, and those of the field that go there; None if they are the same.
        self._columns = None if known == tuple(source_ids) else np.array(shared, dtype=np.intp).reshape(-1, 2).T
        self._reach, self._counts = reach, counts
        self._is_current, self._skips_unreachable = is_current, skips_unreachable
        self._is_capping = limit is not None
        self._limit = GREATEST if limit is None else min(limit, GREATEST)

    def of(self, touches: Sequence[Touch], poses: Mapping[str, Pose]) -> Gains:
        """Gains (n_touches, n_sources, n_bands) [-], capped; 1 on the source itself."""
        asked = touches
        if self._skips_unreachable:
            asked = [touch for touch in touches if self._reach.sources(touch.object_id) is not None]
        if len(asked) == len(touches):
            gains = self._answered(asked, poses)
        else:
            self._counts.unreachable_touches += len(touches) - len(asked)
            gains = np.zeros((len(touches), *self._shape))
            if asked:
                gains[[touches.index(touch) for touch in asked]] = self._answered(asked, poses)
        for i, touch in enumerate(touches):
            if touch.object_id in self._own:
                gains[i, self._own[touch.object_id]] = 1.0
        if self._is_capping:
            self._counts.gains_capped += int(np.count_nonzero(gains > self._limit))
        return np.minimum(gains, self._limit, out=gains)

    def _answered(self, asked: Sequence[Touch], poses: Mapping[str, Pose]) -> Gains:
        object_ids = tuple([touch.object_id for touch in asked])
        # A guest model's NaN must not reach a hand.
        gains: Gains = np.fmax(self._ask(object_ids, [self._point_then(touch, poses) for touch in asked]), 0.0)
        if self._columns is not None:
            here, there = self._columns
            found, gains = gains, np.zeros((len(asked), *self._shape))
            gains[:, here] = found[:, there]
        if not self._is_current:
            for row, object_id in zip(gains, object_ids, strict=True):
                reached = self._reach.sources(object_id)
                row[slice(None) if reached is None else ~reached] = 0.0
        return gains

    def _ask(self, object_ids: tuple[str, ...], points_m: Sequence[Point]) -> Gains:
        if self._rows is not None:
            return self._rows.attenuations(object_ids, points_m)
        if len(set(object_ids)) == 1:
            return self._field.attenuation(object_ids[0], points_m)
        found: Gains | None = None
        for object_id in dict.fromkeys(object_ids):
            places = [i for i, x in enumerate(object_ids) if x == object_id]
            part = self._field.attenuation(object_id, [points_m[i] for i in places])
            if found is None:
                found = np.empty((len(object_ids), *part.shape[1:]))
            found[places] = part
        return np.zeros((0, *self._shape)) if found is None else found

    def _point_then(self, touch: Touch, poses: Mapping[str, Pose]) -> Point:
        """Where the touched place of the object was when the field was prepared."""
        now, then = poses[touch.object_id], self._then.get(touch.object_id)
        if then is now or then is None or then == now:
            return touch.point_m
        x, y, z = then.to_world(now.to_own(touch.point_m)).tolist()
        return (x, y, z)
