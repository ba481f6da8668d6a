"""Rate limits of a service, enforced by the client, since the service does not state how long to wait."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable

from scene2hap.errors import BackendUnavailable

PER_MINUTE, PER_DAY = 60, 2000
"""Requests that Freesound allows per token. Source: its documentation, "Throttling"."""
MINUTE_S, DAY_S = 60.0, 86_400.0


class RateLimit:
    """Bounds the number of requests within any minute, and within any day, of this object's life.

    clock : seconds that never run backwards; sleep : waits that many seconds.
    """

    def __init__(
        self,
        clock: Callable[[], float],
        sleep: Callable[[float], object],
        *,
        per_minute: int = PER_MINUTE,
        per_day: int = PER_DAY,
    ) -> None:
        self._clock = clock
        self._sleep = sleep
        self._per_minute = per_minute
        self._per_day = per_day
        self._times: deque[float] = deque(maxlen=per_day)
        self._blocked_until = clock()
        self._lock = threading.Lock()

    def take(self) -> None:
        """Wait until a request may go out, and count it. Raises: BackendUnavailable: the day's requests are used up."""
        with self._lock:
            while (wait_s := self._wait_s(self._clock())) > 0.0:
                self._sleep(wait_s)
            self._times.append(self._clock())

    def block(self, wait_s: float = MINUTE_S) -> None:
        """Block requests for a while, because the service has counted more than this client."""
        self._blocked_until = max(self._blocked_until, self._clock() + wait_s)

    def _wait_s(self, now_s: float) -> float:
        wait_s = self._blocked_until - now_s
        if len(self._times) == self._per_day and now_s - self._times[0] < DAY_S:
            raise BackendUnavailable(
                f"the {self._per_day} requests of a day are used up; bake again tomorrow, what was found is kept.",
                retryable=False,
            )
        if len(self._times) >= self._per_minute:
            wait_s = max(wait_s, self._times[-self._per_minute] + MINUTE_S - now_s)
        return wait_s
