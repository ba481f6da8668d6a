"""The number of frames that are due by the wall clock."""

from __future__ import annotations

import time


class FrameClock:
    """Counter of frames at a rate from a start time. After a pause of over `max_lag_s` [s] the excess is dropped.

    `n_pauses` is the number of these pauses so far.
    """

    def __init__(self, rate_hz: float, max_lag_s: float = 0.5) -> None:
        self._rate_hz = rate_hz
        self._max_lag_s = max_lag_s
        self._since_s = 0.0
        self._taken = 0
        self.n_pauses: int = 0

    def restart(self, now_s: float) -> None:
        """Restart the count at a time."""
        self._since_s = now_s
        self._taken = 0

    def due(self, now_s: float) -> int:
        """Return the number of frames that are due and were not taken."""
        due = int((now_s - self._since_s) * self._rate_hz) - self._taken
        most = int(self._max_lag_s * self._rate_hz)
        if due > most:
            # After a machine has slept, the missed frames must not all be due at once.
            self._taken += due - most
            self.n_pauses += 1
            return most
        return due

    def take(self, n_frames: int) -> None:
        """Count frames as taken."""
        self._taken += n_frames

    def wait(self, n_frames: int, timeout_s: float) -> int:
        """Wait at most `timeout_s` [s] until frames are due on `time.monotonic`. Returns their number, 0 if not due."""
        wait_s = self._since_s + (self._taken + n_frames) / self._rate_hz - time.monotonic()
        if wait_s > 0:
            time.sleep(min(wait_s, timeout_s))
        return n_frames if self.due(time.monotonic()) >= n_frames else 0
