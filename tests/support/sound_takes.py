"""Play a session through a real sound server, and judge the recording."""

from __future__ import annotations

import gc
import os
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import get_context
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap import ActuatorProfile, HapticSession, Touch
from scene2hap.devices.soundcard import SoundCardSink
from scene2hap.render.safety import SafetyLayer
from scenes import table_with_two_phones
from sound_server import DEVICE, RATE, SoundServer

CONFIG = {"sample_rate_hz": RATE}
TOUCHES = [Touch("left", "phone", (0.12, 0.73, 0.4)), Touch("right", "table", (1.45, 0.72, 0.4))]
TONES_HZ = (100.0, 160.0)
"""The strongest tone at each hand: left the phone that it touches, right the nearby alarm through the table."""

PERIOD = RATE // 2
"""Length of both loops: half a second."""

SETTLING = RATE // 2
"""Frames after the first sound until fades and filters have settled."""


@dataclass(frozen=True)
class Verdict:
    """`correlation` with `render` and `frequency_hz` per channel, and the largest `residual` against the safe mix.

    `residual` is relative to full scale, over all frames from the end of settling to the stop. A gap, a repetition or a
    shift by one sample anywhere makes it large.
    """

    seconds: float
    correlation: tuple[float, float]
    frequency_hz: tuple[float, float]
    residual: float
    underruns: int


def session_on(sink: SoundCardSink, **config: object) -> HapticSession:
    """The session of every take."""
    return HapticSession(*table_with_two_phones(), {**CONFIG, **config}, sink=sink)


class Game(threading.Thread):
    """The thread of a game: calls `update`, and if wanted makes much garbage, until `kill`."""

    def __init__(self, session: HapticSession, pauses_s: Callable[[int], float], *, allocates: bool = False) -> None:
        super().__init__(daemon=True)
        self._session = session
        self._pauses_s = pauses_s
        self._allocates = allocates
        self._over = threading.Event()
        self.died_at = 0.0
        self.updates = 0

    def run(self) -> None:
        due = time.monotonic()
        kept: list[object] = []
        while not self._over.is_set():
            self.died_at = time.monotonic()
            self._session.update(touches=TOUCHES)
            if self._allocates:
                # Chained lists, so that the garbage collector has work as well.
                kept.append(kept[-1:] + [[float(i)] * 8 for i in range(100)])
                if len(kept) > 50:
                    kept.clear()
            self.updates += 1
            due = max(due + self._pauses_s(self.updates), time.monotonic() - 0.05)
            time.sleep(max(0.0, due - time.monotonic()))

    def kill(self) -> float:
        """End the thread. Returns the time of its last update [s, monotonic]."""
        self._over.set()
        self.join()
        return self.died_at


@contextmanager
def undisturbed() -> Iterator[bool]:
    """Run with real-time priority if the system allows it. Yields whether it does.

    Processes started meanwhile inherit the priority. Without it, other programs may disturb a take.
    """
    try:
        os.sched_setscheduler(0, os.SCHED_RR, os.sched_param(1))
    except (AttributeError, PermissionError):
        yield False
        return
    try:
        yield True
    finally:
        os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))


def take(server: SoundServer, seconds: float, **settings: Any) -> Verdict:
    """Play while a busy game updates at 1 kHz, and judge the recording; settings are the sink's."""
    sink = SoundCardSink(DEVICE, **settings)
    recorder = server.record()
    with session_on(sink) as session:
        assert sink.wait_connected(60.0)
        game = Game(session, lambda _: 0.001, allocates=True)
        game.start()
        time.sleep(seconds + 0.5)
        underruns = sink.stats.underruns
        end = recorder.n_heard
        game.kill()
    return judge(recorder.stop()[:end], underruns)


def judge(heard: NDArray[np.float32], underruns: int = 0) -> Verdict:
    """Compare a recording with the mix of `render`, and with this mix after the safety layer."""
    begin = int(np.flatnonzero(np.abs(heard).max(axis=1) > 1e-3)[0]) + SETTLING
    steady = heard[begin:].astype(np.float64)
    mix, safe = (
        np.tile(_aligned(period, steady), (-(-len(steady) // PERIOD), 1))[: len(steady)] for period in _periods()
    )
    correlation = tuple(float(np.corrcoef(mix[:, c], steady[:, c])[0, 1]) for c in range(2))
    return Verdict(
        len(steady) / RATE,
        (correlation[0], correlation[1]),
        (frequency_hz(steady[:, 0]), frequency_hz(steady[:, 1])),
        float(np.abs(steady - safe).max()),
        underruns,
    )


def frequency_hz(x: NDArray[np.float64]) -> float:
    """Frequency of the strongest tone, from its phase advance over half of the signal."""
    n = len(x) // 2
    window = np.hanning(n)
    first, second = (np.fft.rfft(x[part : part + n] * window) for part in (0, n))
    peak = int(np.argmax(np.abs(first)))
    gained = np.angle(second[peak] * np.conj(first[peak]) * np.exp(-2j * np.pi * peak)) / (2 * np.pi)
    return float((peak + gained) * RATE / n)


def _periods() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """One period of the mix, before and after the safety layer."""
    session = HapticSession(*table_with_two_phones(), CONFIG)
    session.update(touches=TOUCHES)
    mix = session.render(8 * PERIOD)
    safe = SafetyLayer(ActuatorProfile(), RATE, 2).process(mix)
    return mix[-PERIOD:].astype(np.float64), safe[-PERIOD:].astype(np.float64)


def safe_period() -> NDArray[np.float64]:
    """One period (PERIOD, 2) of a take after the safety layer."""
    return _periods()[1]


def _aligned(period: NDArray[np.float64], steady: NDArray[np.float64]) -> NDArray[np.float64]:
    """The period, rotated to the phase of the recording."""
    middle = len(steady) // 2 // PERIOD * PERIOD
    spectrum = np.fft.fft(steady[middle : middle + PERIOD], axis=0) * np.conj(np.fft.fft(period, axis=0))
    shift = int(np.argmax(np.fft.ifft(spectrum, axis=0).real.sum(axis=1)))
    return np.roll(period, shift, axis=0)


def take_alone(seconds: float) -> Verdict:
    """A take in a separate process: in this one, collecting the test suite's garbage would hold the GIL too long."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        return pool.submit(_undisturbed_take, seconds).result()


def _undisturbed_take(seconds: float) -> Verdict:
    gc.freeze()
    with undisturbed(), SoundServer() as server:
        return take(server, seconds)
