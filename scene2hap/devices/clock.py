"""Which sinks have a clock of their own."""

from __future__ import annotations

from scene2hap.devices.protocol import ActuatorSink


def has_clock(sink: ActuatorSink) -> bool:
    """Whether a sink takes blocks in its own time; one that waits to be pulled does not, nor do several such together.

    Only with a clock can a watchdog notice that a game is late.
    """
    parts: tuple[ActuatorSink, ...] = getattr(sink, "sinks", ())
    return any(map(has_clock, parts)) if parts else not hasattr(sink, "pull")
