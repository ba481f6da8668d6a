"""The newest field, which may cover touched objects alone, and the last one that covers all objects."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.live import LiveField, TouchedPoint
from scene2hap.session.worker import Prepared


class FieldInUse:
    """A `LiveField` of prepared fields, which are replaced as others are prepared; notes what is touched, so that this
    is prepared first.

    Parameters: as_now : makes a live field of a prepared one; note : called with the touches. `use` comes first.
    """

    most = math.inf

    def __init__(
        self,
        source_ids: tuple[str, ...],
        as_now: Callable[[Prepared], LiveField],
        note: Callable[[Sequence[TouchedPoint]], None],
    ) -> None:
        self.source_ids, self._as_now, self._note = source_ids, as_now, note
        self._prepared: Prepared | None = None

    def use(self, newest: Prepared, whole: Prepared) -> None:
        """Continue with the newest field, which may not cover all objects, and one that covers the others."""
        if self._prepared is not whole:
            self._whole, self._prepared = self._as_now(whole), whole
        self._newest = self._whole if newest is whole else self._as_now(newest)
        self._covers = newest.covers

    def strongest(self, hands: Sequence[Sequence[TouchedPoint]]) -> NDArray[np.float64]:
        """See `LiveField`."""
        touched = [touch for hand in hands for touch in hand]
        self._note(touched)
        covers = self._covers
        if covers is None or all(object_id in covers for object_id, _ in touched):
            return self._newest.strongest(hands)
        new = [[touch for touch in hand if touch[0] in covers] for hand in hands]
        old = [[touch for touch in hand if touch[0] not in covers] for hand in hands]
        gains: NDArray[np.float64] = np.fmax(self._newest.strongest(new), self._whole.strongest(old))
        return gains
