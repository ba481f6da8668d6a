"""Sinks with a clock of their own."""

from __future__ import annotations

from scene2hap.devices.protocol import ActuatorSink


def has_clock(sink: ActuatorSink) -> bool:
    """Return True if a sink requests blocks by its own clock; False for one that is pulled, or a group of such sinks.

    Only with a clock can a watchdog notice that a game is late.
    """
    parts: tuple[ActuatorSink, ...] = getattr(sink, "sinks", ())
    return any(map(has_clock, parts)) if parts else not hasattr(sink, "pull")
