"""The waiting time that a server requests in the headers of its reply.

Source: OpenAI, "Rate limits" (x-ratelimit-*) and its Python client (retry-after-ms before retry-after); RFC 9110,
section 10.2.3 (Retry-After).
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from datetime import UTC
from email.utils import parsedate_to_datetime

LONGEST_WAIT_S = 120.0
"""A longer wait counts as a failure, as in OpenAI's client."""

_PART = re.compile(r"(\d+(?:\.\d+)?)(ms|h|m|s)")
_SECONDS = {"ms": 1e-3, "s": 1.0, "m": 60.0, "h": 3600.0}


def stated_wait_s(headers: Mapping[str, str], now_s: float) -> float | None:
    """Return the wait that Retry-After states [s]; None if absent. A date is relative to `now_s` [s since 1970]."""
    milliseconds = _number(headers.get("retry-after-ms"))
    if milliseconds is not None:
        return milliseconds / 1000.0
    retry_after = headers.get("retry-after")
    seconds = _number(retry_after)
    if seconds is not None or retry_after is None:
        return seconds
    try:
        date = parsedate_to_datetime(retry_after)
        if date.tzinfo is None:  # the form of asctime, which is in UTC, too (RFC 9110, section 5.6.7)
            date = date.replace(tzinfo=UTC)
        return max(date.timestamp() - now_s, 0.0)
    except (ValueError, OverflowError):
        return None


def reset_wait_s(headers: Mapping[str, str]) -> float | None:
    """Return the time until all exhausted limits are full again [s]; None if none is exhausted.

    A limit refills evenly and is full after `reset`. Waiting that long gives the same throughput as using each part of
    the limit as it returns.
    """
    waits = [
        _duration_s(headers.get(f"x-ratelimit-reset-{unit}"))
        for unit in ("requests", "tokens")
        if _number(headers.get(f"x-ratelimit-remaining-{unit}")) == 0.0
    ]
    return max((wait for wait in waits if wait is not None), default=None)


def _duration_s(text: str | None) -> float | None:
    """Return the seconds of "1s", "6m0s", "20ms" or a bare number; None for any other text."""
    parts = _PART.findall(text or "")
    if text and "".join(number + unit for number, unit in parts) == text:
        return sum(float(number) * _SECONDS[unit] for number, unit in parts)
    return _number(text)


def _number(text: str | None) -> float | None:
    try:
        value = float(text or "")
    except ValueError:
        return None
    return value if math.isfinite(value) and value >= 0.0 else None
