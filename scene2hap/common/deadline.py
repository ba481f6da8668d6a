"""The end of a wait that several waits share."""

from __future__ import annotations

import math
import time


class Deadline:
    """A time `timeout_s` [s] from now; never if None."""

    def __init__(self, timeout_s: float | None) -> None:
        self._at_s = math.inf if timeout_s is None else time.monotonic() + timeout_s

    @property
    def left_s(self) -> float | None:
        """Time left [s], at least 0; None without an end."""
        return None if math.isinf(self._at_s) else max(0.0, self._at_s - time.monotonic())
