"""A quiet sweep on each hand of a sink in turn, and its latency at an input that hears it."""

from __future__ import annotations

import math
import time
from contextlib import nullcontext
from dataclasses import asdict
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from scene2hap.cli.console import Console
from scene2hap.devices import SINKS, loopback_latency
from scene2hap.devices.protocol import ActuatorSink, Block, SinkEvent, SinkFormat, has_clock
from scene2hap.errors import ConfigError, DeviceError
from scene2hap.haptics import ActuatorProfile
from scene2hap.render.safety import SafetyLayer
from scene2hap.session.mix.output import LONGEST_FADE_OUT_S

RATE_HZ = 48000
SWEEP_HZ = (40.0, 400.0)
SWEEP_S, PAUSE_S = 2.0, 0.5
LEVEL_DB = -20.0
"""Level of the sweep, a tenth of full scale [dB]."""
MEASURED = (
    "from the call that rendered the sweep's first sample to the hand-over of the block in which the input heard it, "
    "by normalised cross-correlation with the sweep"
)


def sweep(spec: object, hands: tuple[str, ...], console: Console, *, listen_to: str | None = None) -> dict[str, Any]:
    """Play the sweep on each hand in turn. Returns the sink's counts, and with `listen_to` the latencies at an input.

    `listen_to` is an input's name or index, or "" to search for a loop-back. Raises: ConfigError, DeviceError.
    """
    sink = cast("ActuatorSink", SINKS.build(spec))
    if listen_to is not None and not has_clock(sink):
        raise ConfigError(f"--loop-back cannot hear --sweep {spec!r}, which plays nothing; sweep a sound card.")
    problems: list[str] = []

    def note(event: SinkEvent) -> None:
        if event.kind != "connected":
            problems.append(event.message)
            console.warn(event.message)

    if hasattr(sink, "on_event"):
        sink.on_event = note
    sweeps = _Sweeps(len(hands))
    with _recorder(listen_to, len(hands)) as recorder:
        latency_s = _play(sink, sweeps, hands, console, tail_s=0.0 if recorder is None else loopback_latency.LONGEST_S)
    stats = sink.stats
    if not stats.frames:
        reason = problems[-1] if problems else f"{type(sink).__name__} took none."
        raise DeviceError(f"no sample of the sweep reached a device: {reason.removesuffix(' Trying again.')}")
    latency = "" if latency_s is None else f", latency {1e3 * latency_s:.0f} ms"
    console.say(f"swept {', '.join(hands)}: {stats.frames} frames, {stats.underruns} underruns{latency}")
    outcome: dict[str, Any] = {"frames": stats.frames, "underruns": stats.underruns, "latency_s": latency_s}
    if recorder is not None:
        outcome["loop_back"] = _measured(recorder.recording(), sweeps.requested_at_s, hands, console)
    return outcome


def _recorder(listen_to: str | None, n_hands: int) -> loopback_latency.Recorder | nullcontext[None]:
    if listen_to is None:
        return nullcontext()
    card = loopback_latency.find_input(int(listen_to) if listen_to.isdigit() else listen_to or None)
    return loopback_latency.Recorder(card, RATE_HZ, max(2, n_hands))


def _play(
    sink: ActuatorSink, sweeps: _Sweeps, hands: tuple[str, ...], console: Console, *, tail_s: float
) -> float | None:
    """Play the sweeps, and on a sink with a clock `tail_s` more. Returns the latency that the sink reports [s]."""
    safety = SafetyLayer(ActuatorProfile(), RATE_HZ, len(hands), watchdog_s=0.5 if has_clock(sink) else None)
    sink.open(SinkFormat(RATE_HZ, hands))
    try:
        sink.start(safety.guard(sweeps))
        if has_clock(sink):
            _keep_fed(safety, PAUSE_S)
            for hand in hands:
                console.say(f"  {hand}: {SWEEP_HZ[0]:g} to {SWEEP_HZ[1]:g} Hz at {LEVEL_DB:g} dB")
                _keep_fed(safety, SWEEP_S + PAUSE_S)
            _keep_fed(safety, tail_s)
        else:
            n_frames = round((PAUSE_S + len(hands) * (SWEEP_S + PAUSE_S)) * RATE_HZ)
            sink.pull(n_frames)  # type: ignore[attr-defined]  # no clock
        return sink.stats.latency_s
    finally:
        safety.release()
        if has_clock(sink):
            safety.silent.wait(LONGEST_FADE_OUT_S)
        sink.stop()
        sink.close()


def _keep_fed(safety: SafetyLayer, seconds: float) -> None:
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        safety.feed()
        time.sleep(0.02)


def _measured(
    recording: loopback_latency.Recording, requested_at_s: list[float | None], hands: tuple[str, ...], console: Console
) -> dict[str, Any]:
    """Show each hand's latency in the recording, and return it as JSON values."""
    pattern = _wave(np.arange(round(SWEEP_S * recording.rate_hz)) / recording.rate_hz)
    by_hand: dict[str, Any] = {}
    console.say(f"heard by {recording.device!r}, {MEASURED}:")
    for hand, at_s in zip(hands, requested_at_s, strict=True):
        if at_s is None:
            by_hand[hand] = None
            console.say(f"  {hand}: the sink requested no samples of it")
            continue
        found = loopback_latency.measure_latency(recording, at_s, pattern)
        by_hand[hand] = asdict(found)
        console.say(f"  {hand}: {_sentence(found)}")
    if recording.gaps:
        console.say(f"  the input lost samples {recording.gaps} times; measure again on a quieter machine")
    return {
        "input": recording.device,
        "measured": MEASURED,
        "found_from": loopback_latency.FOUND_FROM,
        "gaps": recording.gaps,
        "hands": by_hand,
    }


def _sentence(found: loopback_latency.Latency) -> str:
    if found.latency_s is None:
        return (
            f"not found: correlation {found.correlation:.2f}, below {loopback_latency.FOUND_FROM:g}; "
            "no loop-back, the wrong input (--loop-back INPUT), or muted"
        )
    return (
        f"{1e3 * found.latency_s:.0f} ms, or up to {1e3 * found.uncertainty_s:.0f} ms less, which is a recorded block; "
        f"correlation {found.correlation:.2f}, {found.gain_db:+.0f} dB, input channel {found.channel}"
    )


class _Sweeps:
    """Silence, then a sweep on each channel in turn; stores the request time of each first sample [s, monotonic].

    The silence lets a sound card reach its steady latency, since it requests its first samples all at once.
    """

    def __init__(self, n_hands: int) -> None:
        self.requested_at_s: list[float | None] = [None] * n_hands
        self._position = 0

    def __call__(self, n_frames: int) -> Block:
        """Return the next block."""
        now = time.monotonic()
        n_hands = len(self.requested_at_s)
        frames = np.arange(self._position, self._position + n_frames)
        self._position += n_frames
        block = np.zeros((n_frames, n_hands), dtype=np.float32)
        for hand in range(n_hands):
            begin = round((PAUSE_S + hand * (SWEEP_S + PAUSE_S)) * RATE_HZ)
            if self._position > begin and self.requested_at_s[hand] is None:
                self.requested_at_s[hand] = now
            block[:, hand] = _wave((frames - begin) / RATE_HZ)
        return block


def _wave(t_s: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a logarithmic sweep from t = 0 to SWEEP_S, with soft edges and silence around it."""
    low, high = SWEEP_HZ
    rate = math.log(high / low)
    t = np.clip(t_s, 0.0, SWEEP_S)
    phase = 2 * math.pi * low * SWEEP_S / rate * np.expm1(rate * t / SWEEP_S)
    edge = np.clip(np.minimum(t, SWEEP_S - t) / 0.05, 0.0, 1.0)
    wave: NDArray[np.float64] = 10 ** (LEVEL_DB / 20) * np.sin(phase) * edge
    return wave
