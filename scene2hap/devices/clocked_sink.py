"""Sinks with their own clock."""

from __future__ import annotations

from scene2hap.devices.protocol import ActuatorSink


def has_clock(sink: ActuatorSink) -> bool:
    """Return True if a sink requests blocks by its own clock; False for sinks that are pulled, and for groups of them.

    Only with a clock can a watchdog detect that a game is late.
    """
    parts: tuple[ActuatorSink, ...] = getattr(sink, "sinks", ())
    return any(map(has_clock, parts)) if parts else not hasattr(sink, "pull")
