"""Prepared fields, evaluated for the present poses.

The newest field may cover only the objects near the hands. For the others the last field of all objects is used.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache

import numpy as np

from scene2hap.common.arrays import Floats, Indices
from scene2hap.compiled import compiled
from scene2hap.propagation.live import LiveField, TouchedPoint
from scene2hap.propagation.protocol import PropagationField, checked_gains
from scene2hap.scene.geometry import Vector
from scene2hap.scene.pose import Pose
from scene2hap.session.fields.worker import PreparedField
from scene2hap.session.present_scene.reach import Reach


class LastField:
    """A `LiveField` from a field that was prepared for an earlier scene state.

    A touch is evaluated at the same point of the object, at the pose that the object had in that state. Sources unknown
    to the field are silent. While the field is outdated, sources without a path to the touched object are silent too.

    Parameters: then : poses for which the field was prepared; now : returns the present pose of an object; reach : the
    present groups of connected objects; is_current : whether the field was prepared for the present state,
    or does not depend on paths.
    """

    most: float = math.inf

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
        self._columns = _shared(source_ids, tuple(field.source_ids))

    def strongest(self, hands: Sequence[Sequence[TouchedPoint]]) -> Floats:
        """See `LiveField`."""
        touched = [touch for hand in hands for touch in hand]
        if not touched:
            return np.zeros((len(hands), *self._shape))
        answers, rows = self._answers(touched)
        is_current, sources = self._is_current(), self._reach.sources
        among = [None if is_current else sources(object_id) for object_id, _ in touched]
        gains = put_together(answers, rows, self._columns, among, self._shape)
        return gains if all(len(hand) == 1 for hand in hands) else self._largest(gains, hands)

    def _answers(self, touched: Sequence[TouchedPoint]) -> tuple[list[Floats], list[list[int]]]:
        """Evaluate the field once for each object. Returns the values and, for each object, the rows of its touches."""
        rows: dict[str, list[int]] = {}
        for row, (object_id, _) in enumerate(touched):
            rows.setdefault(object_id, []).append(row)
        answers, (n_sources, n_bands) = [], (len(self._field.source_ids), self._shape[1])
        for object_id, own in rows.items():
            points = self._points_then(object_id, [touched[row][1] for row in own])
            answers.append(checked_gains(self._field.attenuation(object_id, points), (len(own), n_sources, n_bands)))
        return answers, list(rows.values())

    def _points_then(self, object_id: str, points_m: list[Vector]) -> Floats:
        now, then, points = self._now(object_id), self._then.get(object_id), np.array(points_m, dtype=np.float64)
        return points if then is now or then is None or then == now else then.to_world(now.to_own(points))

    def _largest(self, gains: Floats, hands: Sequence[Sequence[TouchedPoint]]) -> Floats:
        largest, begin = np.zeros((len(hands), *self._shape)), 0
        for row, hand in zip(largest, hands, strict=True):
            if hand:
                np.maximum.reduce(gains[begin : begin + len(hand)], axis=0, out=row)
            begin += len(hand)
        return largest


@compiled
def put_together(
    answers: Sequence[Floats],
    rows: Sequence[Sequence[int]],
    columns: tuple[Indices, Indices],
    among: Sequence[frozenset[int] | None],
    shape: tuple[int, int],
) -> Floats:
    """Join the results of several queries into rows (n, *shape).

    Parameters: answers : one per query, (n_own, n_theirs, n_bands); rows : the rows of each query; columns : the shared
    sources, as columns of the result and of the queries; among : for each row the columns of the result that may be
    other than 0, None for all.
    """
    gains, (ours, theirs) = np.zeros((len(among), *shape)), columns
    for found, own in zip(answers, rows, strict=True):
        for row, one in zip(own, found, strict=True):
            gains[row, ours] = one[theirs]
    for one, sources in zip(gains, among, strict=True):
        if sources is not None:
            one[[column for column in range(shape[0]) if column not in sources]] = 0.0
    return gains


@lru_cache(maxsize=64)
def _shared(ours: tuple[str, ...], theirs: tuple[str, ...]) -> tuple[Indices, Indices]:
    """Columns of the shared ids: in `ours`, and in `theirs`."""
    column = {source_id: i for i, source_id in enumerate(ours)}
    pairs = [(column[x], there) for there, x in enumerate(theirs) if x in column]
    here, there = np.array(pairs, dtype=np.intp).reshape(-1, 2).T.copy()
    return here, there


class FieldInUse:
    """A `LiveField` of the newest prepared fields. It reports touches, so that touched objects are prepared first.

    Parameters: as_now : makes a live field of a prepared one; note : called with the touches. Call `use` first.
    """

    most: float = math.inf

    def __init__(
        self,
        source_ids: tuple[str, ...],
        as_now: Callable[[PreparedField], LiveField],
        note: Callable[[Sequence[TouchedPoint]], None],
    ) -> None:
        self.source_ids = source_ids
        self._as_now, self._note = as_now, note
        self._of_whole: PreparedField | None = None

    def use(self, newest: PreparedField, whole: PreparedField) -> None:
        """Use the newest field, which may not cover all objects, and a field that covers the others."""
        if self._of_whole is not whole:
            self._whole, self._of_whole = self._as_now(whole), whole
        self._newest = self._whole if newest is whole else self._as_now(newest)
        self._covers = newest.covers

    def strongest(self, hands: Sequence[Sequence[TouchedPoint]]) -> Floats:
        """See `LiveField`."""
        touched = [touch for hand in hands for touch in hand]
        self._note(touched)
        covers = self._covers
        if covers is None or all(object_id in covers for object_id, _ in touched):
            return self._newest.strongest(hands)
        new = [[touch for touch in hand if touch[0] in covers] for hand in hands]
        old = [[touch for touch in hand if touch[0] not in covers] for hand in hands]
        gains: Floats = np.fmax(self._newest.strongest(new), self._whole.strongest(old))
        return gains
