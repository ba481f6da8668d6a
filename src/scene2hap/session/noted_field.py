"""The newest field, which may tell of what hands touched and of nothing else, and the last one that tells of all."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.live import LiveField, TouchedPoint


class NotedField:
    """A `LiveField` that notes what is touched, so that this is prepared first.

    Parameters: newest : tells of what it `covers`, None for all; whole : tells of the rest; note : is told what is
    touched.
    """

    def __init__(
        self,
        newest: LiveField,
        covers: Collection[str] | None,
        whole: LiveField,
        note: Callable[[Sequence[TouchedPoint]], None],
    ) -> None:
        self.source_ids, self.most = newest.source_ids, max(newest.most, whole.most)
        self._newest, self._covers, self._whole, self._note = newest, covers, whole, note

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
