"""The last field that was prepared, asked about things as they are now."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.live import TouchedPoint, checked
from scene2hap.propagation.protocol import PropagationField
from scene2hap.scene.pose import Pose
from scene2hap.session.reach import Reach

Gains = NDArray[np.float64]
Point = tuple[float, float, float]


class LastField:
    """A `LiveField` made of one that was prepared for a moment that may be over.

    Hands are taken to the places of the object where they would have been then; sources that it knows nothing of are
    not heard; and while it is not current, what nothing leads to any more is silent, whatever the field says.

    Parameters: then : where objects were when it was prepared; now : where an object is; reach : what hangs together
    now; is_current : whether the field tells of things as they are.
    """

    most = math.inf

    def __init__(
        self,
        field: PropagationField,
        then: Mapping[str, Pose],
        now: Callable[[str], Pose],
        source_ids: tuple[str, ...],
        n_bands: int,
        reach: Reach,
        is_current: Callable[[], bool],
    ) -> None:
        self.source_ids = source_ids
        self._field, self._then, self._now = field, then, now
        self._reach, self._is_current = reach, is_current
        self._shape = (len(source_ids), n_bands)
        # Columns of the answer, and those of the field that go there; None if they are the same.
        self._columns = None if tuple(field.source_ids) == source_ids else _shared(source_ids, field.source_ids)

    def strongest(self, hands: Sequence[Sequence[TouchedPoint]]) -> Gains:
        """See `LiveField`."""
        touched = [touch for hand in hands for touch in hand]
        if not touched:
            return np.zeros((len(hands), *self._shape))
        gains = checked(self._answers(touched), (len(touched), len(self._field.source_ids), self._shape[1]))
        if self._columns is not None:
            here, there = self._columns
            found, gains = gains, np.zeros((len(touched), *self._shape))
            gains[:, here] = found[:, there]
        if not self._is_current():
            for row, (object_id, _) in zip(gains, touched, strict=True):
                for stranger in self._reach.strangers(object_id):
                    row[stranger] = 0.0
        return gains if all(len(hand) == 1 for hand in hands) else self._largest(gains, hands)

    def _answers(self, touched: Sequence[TouchedPoint]) -> Gains:
        """What the field says of each touch; it is asked once for each object."""
        if len({object_id for object_id, _ in touched}) == len(touched):
            each = [self._field.attenuation(name, self._points_then(name, [point_m])) for name, point_m in touched]
            return np.concatenate(each)
        rows: dict[str, list[int]] = {}
        for row, (object_id, _) in enumerate(touched):
            rows.setdefault(object_id, []).append(row)
        found = [
            self._field.attenuation(object_id, self._points_then(object_id, [touched[row][1] for row in own]))
            for object_id, own in rows.items()
        ]
        gains = np.concatenate(found)
        order = [row for own in rows.values() for row in own]
        return gains if order == sorted(order) else gains[np.argsort(order)]

    def _points_then(self, object_id: str, points_m: list[Point]) -> list[Point]:
        now, then = self._now(object_id), self._then.get(object_id)
        if then is now or then is None or then == now:
            return points_m
        return [(x, y, z) for x, y, z in then.to_world(now.to_own(points_m)).tolist()]

    def _largest(self, gains: Gains, hands: Sequence[Sequence[TouchedPoint]]) -> Gains:
        largest, begin = np.zeros((len(hands), *self._shape)), 0
        for row, hand in zip(largest, hands, strict=True):
            if hand:
                np.maximum.reduce(gains[begin : begin + len(hand)], axis=0, out=row)
            begin += len(hand)
        return largest


def _shared(ours: Sequence[str], theirs: Sequence[str]) -> NDArray[np.intp]:
    """Where the ids that both have are in ours, and where in theirs (2, n)."""
    column = {source_id: i for i, source_id in enumerate(ours)}
    pairs = [(column[x], there) for there, x in enumerate(theirs) if x in column]
    return np.array(pairs, dtype=np.intp).reshape(-1, 2).T
