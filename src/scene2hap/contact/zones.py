"""Boxes in rows, of which one after the other is moved and asked which it meets; and how wide they are drawn."""

from __future__ import annotations

import numpy as np

from scene2hap.compiled import compiled
from scene2hap.contact.vectors import Triple

Room = tuple[Triple, Triple]
"""Lowest and highest corners [m] of a box around a body, which it has not left."""

NOWHERE = (np.inf, -np.inf)
"""Corners of a box that meets none."""


@compiled
class Zones:
    """Axis-parallel boxes by their lowest and highest corners, `low` and `high`, both (3, n) [m]."""

    def __init__(self) -> None:
        self.low, self.high = (np.full((3, 64), value) for value in NOWHERE)

    def put(self, row: int, low: Triple, high: Triple) -> None:
        """Move the box of a row; a new row follows the last."""
        if row == self.low.shape[1]:
            self.low, self.high = (
                np.concatenate([array, np.full_like(array, value)], axis=1)
                for array, value in zip((self.low, self.high), NOWHERE, strict=True)
            )
        self.low[:, row], self.high[:, row] = low, high

    def meeting(self, row: int) -> list[int]:
        """The other rows whose boxes meet that of a row, touching included."""
        x, y, z = (self.low <= self.high[:, row, None]) & (self.high >= self.low[:, row, None])
        found: list[int] = np.flatnonzero(x & y & z).tolist()
        if row in found:
            found.remove(row)
        return found


@compiled
def room_around(low: Triple, high: Triple, skin_m: float, before: Room, up_axis: int) -> Room:
    """A box drawn that much too wide, and level as much wider still where the one before was."""
    near, far = skin_m, 2 * skin_m
    lows, highs = [x - near for x in low], [x + near for x in high]
    for k in (0, 3 - up_axis):
        lows[k] = max(min(lows[k], before[0][k]), low[k] - far)
        highs[k] = min(max(highs[k], before[1][k]), high[k] + far)
    return (lows[0], lows[1], lows[2]), (highs[0], highs[1], highs[2])
