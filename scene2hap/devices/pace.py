"""Frames that have come due by the wall clock."""

from __future__ import annotations


class Pace:
    """Counts frames at a rate from a start time; after a pause of more than `max_lag_s` [s] the excess is dropped."""

    def __init__(self, rate_hz: float, max_lag_s: float = 0.5) -> None:
        self._rate_hz = rate_hz
        self._max_lag_s = max_lag_s
        self._since_s = 0.0
        self._taken = 0

    def restart(self, now_s: float) -> None:
        """Count from now on."""
        self._since_s = now_s
        self._taken = 0

    def due(self, now_s: float) -> int:
        """Frames that have come due and were not taken."""
        due = int((now_s - self._since_s) * self._rate_hz) - self._taken
        most = int(self._max_lag_s * self._rate_hz)
        if due > most:
            # After a machine has slept, the missed frames must not all come due at once.
            self._taken += due - most
            return most
        return due

    def take(self, n_frames: int) -> None:
        """Count frames as taken."""
        self._taken += n_frames

    def wait_s(self, n_frames: int, now_s: float) -> float:
        """Time until that many frames are due [s], 0 where they are."""
        return max(0.0, self._since_s + (self._taken + n_frames) / self._rate_hz - now_s)
