"""Pace: one common pause for all calls to one server.

A rate limit counts all concurrent calls together. If only one call waited as the server requests, the others would use
up the limit as it refills. So all calls wait before they send.
"""

from __future__ import annotations

import asyncio
import time

from scene2hap.common.web import WebReply
from scene2hap.llm.backends.http_errors import failure
from scene2hap.llm.backends.retry_after import LONGEST_WAIT_S, reset_wait_s


class Pace:
    """Earliest time of the next request, from the server's last reply."""

    def __init__(self) -> None:
        self._open_at_s = 0.0

    def __reduce__(self) -> tuple[type[Pace], tuple[()]]:
        return Pace, ()  # the clock of another machine has another zero

    async def wait(self) -> None:
        """Wait until the server accepts requests."""
        while (left_s := self._open_at_s - time.monotonic()) > 0.0:
            await asyncio.sleep(left_s)

    def heed(self, reply: WebReply) -> None:
        """Pause if a reply requests it. A pause that is too long or cannot help is ignored."""
        if reply.ok:
            wait_s = reset_wait_s(reply.headers)
        else:
            problem = failure(reply)
            wait_s = problem.retry_after_s if problem.retryable else None
        if wait_s is not None and wait_s <= LONGEST_WAIT_S:
            self._open_at_s = max(self._open_at_s, time.monotonic() + wait_s)
