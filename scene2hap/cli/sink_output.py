"""The output of a session that a command plays: its sink, and which sources are heard."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from scene2hap.devices.protocol import ActuatorSink, SinkEvent, has_clock
from scene2hap.errors import ConfigError
from scene2hap.session import HapticSession

UPDATE_S = 0.02


class SinkOutput:
    """Output of the mix. `problem` is a message about the sink for the user, "" for none."""

    def __init__(self, sink: object) -> None:
        if not isinstance(sink, ActuatorSink):
            raise ConfigError(f"--sink is {sink!r}; it must be a kind of sink, or JSON with one.")
        self.sink: ActuatorSink = sink
        self.problem: str = ""
        self.has_played: bool = not has_clock(sink)
        self._pull: Callable[[int], object] | None = None if has_clock(sink) else getattr(sink, "pull", None)
        self._taken_s = time.monotonic()
        if getattr(sink, "on_event", self) is None:
            sink.on_event = self.note  # type: ignore[attr-defined]  # looked up by name, see ActuatorSink

    @property
    def why_nothing_played(self) -> str:
        """The sentence that says why no sample reached the actuator."""
        return (self.problem or "the actuator did not start.").removesuffix(" Trying again.")

    def note(self, event: SinkEvent) -> None:
        """Process an event of a sink, in the sink's own thread."""
        is_well = event.kind in ("connected", "resumed")
        self.has_played |= is_well
        self.problem = "" if is_well else event.message

    def take(self, sample_rate_hz: int) -> None:
        """Pull the samples that are due from a sink without a clock, so that a recording is as long as the session."""
        n_frames = int((time.monotonic() - self._taken_s) * sample_rate_hz)
        self._taken_s += n_frames / sample_rate_hz
        if self._pull is not None:
            self._pull(n_frames)


def silence(session: HapticSession, muted: Sequence[str], solo: Sequence[str]) -> None:
    """Mute the sources in `muted`. If `solo` names any sources, play these and mute the others. The rest stays.

    Raises: UnknownObject: an id is not a source; then nothing is muted.
    """
    for source_id in (*muted, *solo):
        session.set_source(source_id)
    for source_id in session.source_ids:
        if source_id in muted or (solo and source_id not in solo):
            session.set_source(source_id, mute=True)
        elif solo:
            session.set_source(source_id, mute=False)
