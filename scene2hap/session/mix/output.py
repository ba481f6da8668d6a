"""Output of a session to its sink, through the safety layer, with a fade at start and stop."""

from __future__ import annotations

import atexit
import contextlib
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.common.printable import quoted
from scene2hap.common.warning import warn_of
from scene2hap.devices import SINKS
from scene2hap.devices.exclusive_use import claim_sink, give_back_sink
from scene2hap.devices.protocol import ActuatorSink, EventCallback, Fill, SinkEvent, SinkFormat, has_clock, parts_of
from scene2hap.errors import ConfigError, DeviceError, SessionError
from scene2hap.render.safety import FADE_OUT_S, SafetyLayer, SafetyStats
from scene2hap.session.config import SessionConfig
from scene2hap.session.frame import HapticFrame

LONGEST_FADE_OUT_S = 0.25
"""Longest time for which `stop` waits until the sink has taken the fade; without its device it may never take it."""

NOT_STARTED = "The sink plays nothing: call start(), or use the session in a `with` block."

_PROBLEMS = ("unavailable", "stalled", "lost", "fault")


class Output:
    """A sink, and the safety layer before it, in the process that made them.

    A forked process has no copy of their threads, and shares the sink's file or device: there an output cannot start,
    and does not stop what plays on in the parent.
    Raises: ConfigError: the sink lacks a method; also the errors of the sink's constructor.
    """

    def __init__(self, sink: ActuatorSink | str | Mapping[str, Any] | None, config: SessionConfig) -> None:
        if isinstance(sink, list | tuple):
            raise ConfigError(f"sink is {checks.described(sink)}; several at once are one TeeSink([...]).")
        if isinstance(sink, os.PathLike) or (isinstance(sink, str) and Path(sink).suffix):
            raise ConfigError(
                f"sink is {quoted(sink)}, a path; give sink=WavSink({str(sink)!r}), and pull from it to write the file."
            )
        built = cast("ActuatorSink", SINKS.build(sink)) if sink is not None else None
        self._pid = os.getpid()
        self.sink: ActuatorSink | None = built
        self._config = config
        self._safety: SafetyLayer | None = None
        self._ended = SafetyStats()
        self._limits: NDArray[np.float64] | None = None
        self._show: Callable[[HapticFrame], None] | None = getattr(built, "show", None)
        self._shown: HapticFrame | None = None
        self._taps: list[_EventTap] = []
        self.is_unused: bool = built is not None
        """Whether a sink is set that was never started."""

    def require_own_process(self) -> None:
        """Raises: SessionError: this is a fork of the process that made the session."""
        if os.getpid() != self._pid:
            raise SessionError(
                f"this session was made in process {self._pid}, and this is its fork {os.getpid()}, which has no "
                "copy of the session's threads. Make another session here, of its bundle, or start processes by "
                "multiprocessing.get_context('spawn') and make the session there."
            )

    @property
    def is_started(self) -> bool:
        """Whether the sink is playing the mix."""
        return self._safety is not None

    @property
    def safety_stats(self) -> SafetyStats:
        """Counters of samples that the safety layer changed since the last start; they stay after a stop."""
        safety = self._safety
        return self._ended if safety is None else safety.stats

    @property
    def untold_problem(self) -> str | None:
        """Why a started sink, or one of several, plays nothing, if no callback of the game got the event; else None."""
        return None if self._safety is None else _first_problem(tap for tap in self._taps if tap.own is None)

    @property
    def why_silent(self) -> str | None:
        """Why the sink plays nothing, in a sentence; None if it plays, or if there is none.

        A problem that the game's own `on_event` has replaced since is not named.
        """
        safety = self._safety
        if safety is None:
            return None if self.sink is None else NOT_STARTED
        problem = _first_problem(self._taps)
        if problem is None and safety.is_late:
            return (
                f"The sink is silent, since no update came for {self._config.watchdog_s:g} s: call it in each frame, "
                "changed or not."
            )
        return problem

    def _listen(self, sink: ActuatorSink) -> None:
        """Note the events of a sink until `_listen_no_more`; those of a part with a callback do not reach its group."""
        self._taps = [_EventTap(x) for x in parts_of(sink) if x is sink or getattr(x, "on_event", None) is not None]
        for tap in self._taps:
            tap.begin()

    def _listen_no_more(self) -> None:
        """Give the sinks their own callbacks back: another session may play on them next."""
        for tap in self._taps:
            tap.end()

    def feed(self, frame: HapticFrame) -> None:
        """Reset the watchdog, and pass the gains to the sink."""
        safety = self._safety  # another thread may stop meanwhile
        if safety is not None:
            safety.feed()
            self.show(frame)

    def hold(self, limits: NDArray[np.float64]) -> None:
        """Hold each channel within a limit (n_hands,) [-], in addition to the actuator's limit."""
        self._limits = limits
        safety = self._safety
        if safety is not None:
            safety.hold(limits)

    def show(self, frame: HapticFrame) -> None:
        """Pass a frame to the sink if it is started and accepts gains."""
        if self._safety is not None and self._show is not None:
            # Computed here: the sink reads the gains in its own thread, while the scene continues to change.
            _ = frame.gains
            self._shown = frame
            self._show(frame)

    def _show_silence(self) -> None:
        """Pass gains of 0 to the sink: a receiver that plays gains gets no samples, and so no fade of the watchdog."""
        if self._shown is not None and self._show is not None:
            self._show(HapticFrame(np.zeros_like(self._shown.gains), self._shown.hands, self._shown.sources))

    def start(self, fill: Fill, hands: Sequence[str]) -> None:
        """Send the samples of `fill` through the safety layer to the sink; does nothing if it is started already.

        A sink that cannot be opened or started is closed again.
        Raises: SessionError: there is no sink; DeviceError: it cannot be opened, or another session uses it.
        """
        if self.sink is None:
            raise SessionError("this session has no sink; give one to HapticSession(..., sink=), or call render.")
        if self._safety is not None:
            return
        rate = self._config.sample_rate_hz
        watchdog_s = self._config.watchdog_s if has_clock(self.sink) else None
        safety = SafetyLayer(
            self._config.actuator,
            rate,
            len(hands),
            watchdog_s=watchdog_s,
            limits=self._limits,
            on_trip=self._show_silence,
        )
        claim_sink(self.sink, self)
        try:
            self._listen(self.sink)
            self.sink.open(SinkFormat(rate, tuple(hands)))
            self.sink.start(safety.guard(fill))
        except BaseException:
            with contextlib.suppress(Exception):  # the first error says what is wrong
                self._release(self.sink, _discard(self.sink))
            raise
        self._safety, self.is_unused = safety, False
        if has_clock(self.sink) or hasattr(self.sink, "abort"):
            # A program may end without `stop`: by an error, by Ctrl-C, or at the end of its code. Called before the
            # sink's own end, which neither fades nor completes a file.
            atexit.register(self._stop_at_exit)

    def stop(self) -> None:
        """Fade out, stop the sink and release it, as at the end of the program; may be called twice."""
        if (sink := self._played_here()) is not None:
            self._fade_out(sink)
            self._release(sink, sink.close)

    def _stop_at_exit(self) -> None:
        try:
            self.stop()
        except DeviceError as error:  # Python would show its traceback
            warn_of(str(error))

    def abort(self) -> None:
        """Stop after a failure. A sink with a method `abort` can then discard a half-written file."""
        if (sink := self._played_here()) is not None:
            if has_clock(sink):
                self._fade_out(sink)
            self._end()
            self._release(sink, _discard(sink))

    def _played_here(self) -> ActuatorSink | None:
        """The sink if it is started and this process made it."""
        return self.sink if self._safety is not None and os.getpid() == self._pid else None

    def _release(self, sink: ActuatorSink, end: Callable[[], None]) -> None:
        """Stop a sink and call `end`, `close` or `abort`, also if it does not stop; then give it back."""
        atexit.unregister(self._stop_at_exit)
        try:
            try:
                sink.stop()
            finally:
                end()
        finally:
            self._listen_no_more()
            give_back_sink(sink, self)

    @contextlib.contextmanager
    def reopened_for(self, hands: Sequence[str], fill: Fill) -> Iterator[None]:
        """Change channels within this context: a started sink is faded out and stopped before, and opened again after.

        Raises: SessionError: the started sink cannot change its channels; also the errors of `start`.
        """
        was_started = self._safety is not None
        if was_started and self.sink is not None and not has_clock(self.sink):
            raise SessionError(
                f"{type(self.sink).__name__} has one channel per hand from its start, so that hands cannot come or go "
                "while it runs. Name all hands when the session is made, or stop it first."
            )
        if was_started:
            self.stop()
        yield
        if was_started:
            self.start(fill, hands)

    def _end(self) -> SafetyLayer | None:
        """Give the safety layer away and keep its counters: it refers to this output, and would be a cycle."""
        safety, self._safety = self._safety, None
        if safety is not None:
            self._ended = safety.stats
        return safety

    def _fade_out(self, sink: ActuatorSink) -> None:
        if (safety := self._end()) is None:
            return
        safety.release()
        if has_clock(sink):
            safety.silent.wait(LONGEST_FADE_OUT_S)
        else:
            # No clock, so the sink must be pulled. A sink that its owner has closed accepts no more samples.
            with contextlib.suppress(DeviceError):
                sink.pull(round(FADE_OUT_S * self._config.sample_rate_hz))  # type: ignore[attr-defined]  # above
        self._ended = safety.stats


class _EventTap:
    """Notes the last event of each device of a sink, and passes events on to `own`, the sink's own callback.

    Each start has another one: a game may have put its own callback over the last one, and call that one.
    """

    def __init__(self, sink: ActuatorSink) -> None:
        self._sink: Any = sink  # `on_event` is looked up by name, see ActuatorSink
        self.own: EventCallback | None = getattr(sink, "on_event", None)
        self._events: dict[str, SinkEvent] = {}

    def begin(self) -> None:
        if hasattr(self._sink, "on_event"):
            self._sink.on_event = self._note

    def end(self) -> None:
        if self._is_in_place:
            self._sink.on_event = self.own

    @property
    def problem(self) -> str | None:
        if not self._events or not self._is_in_place:
            return None
        events = list(self._events.values())  # the threads of the sinks add more
        return next((event.message for event in events if event.kind in _PROBLEMS), None)

    @property
    def _is_in_place(self) -> bool:
        return getattr(self._sink, "on_event", None) == self._note

    def _note(self, event: SinkEvent) -> None:
        self._events[event.sink] = event
        if self.own is not None:
            self.own(event)


def _first_problem(taps: Iterable[_EventTap]) -> str | None:
    return next((problem for tap in taps if (problem := tap.problem) is not None), None)


def _discard(sink: ActuatorSink) -> Callable[[], None]:
    """Return the method that ends a failed run: `abort` if the sink has it, else `close`."""
    end: Callable[[], None] = getattr(sink, "abort", sink.close)
    return end
