"""Synthetic machine sounds: a property that holds for a recording of such a machine must hold for these as well.

They drift, beat and rattle as machines do, so that no two stretches are equal. Each sound is the same in every run.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np

from scene2hap.audio.clip import AudioClip, Credit
from sound_draws import Signal, band_noise, coloured_noise

RATE_HZ = 48_000
SECONDS = 4.5
_T = np.arange(round(SECONDS * RATE_HZ)) / RATE_HZ

PITCHES_HZ = {"own fridge": 58.7, "own oven": 100.0, "own washing machine": 99.2, "own fan": 41.3}
"""The strongest frequency of each hum. The hums also have partials at multiples of this frequency."""


def _hum(frequency_hz: float, partials: tuple[float, ...], rng: np.random.Generator) -> Signal:
    phases = rng.uniform(0, 2 * np.pi, len(partials))
    return np.asarray(
        sum(
            level * np.sin(2 * np.pi * k * frequency_hz * _T + phase)
            for k, (level, phase) in enumerate(zip(partials, phases, strict=True), start=1)
        )
    )


def _fridge(rng: np.random.Generator) -> Signal:
    return _hum(58.7, (1.0, 0.7, 0.4, 0.2), rng) + 0.15 * coloured_noise(rng, len(_T), 1.0)


def _oven(rng: np.random.Generator) -> Signal:
    return _hum(100.0, (1.0, 0.3, 0.5, 0.1), rng) + 0.02 * coloured_noise(rng, len(_T), 0.0)


def _washing_machine(rng: np.random.Generator) -> Signal:
    """A motor, modulated by a drum that turns once in 0.9 s."""
    drum = 1 + 0.2 * np.sin(2 * np.pi * _T / 0.9)
    return drum * _hum(99.2, (1.0, 0.6, 0.3), rng) + 0.3 * coloured_noise(rng, len(_T), 1.0)


def _fan(rng: np.random.Generator) -> Signal:
    """Mostly air noise, over a weak tone."""
    return _hum(41.3, (1.0, 0.4), rng) + 1.5 * coloured_noise(rng, len(_T), 0.5)


def _saw(rng: np.random.Generator) -> Signal:
    """An engine whose pitch and level rise and fall."""
    rev = 0.5 + 0.5 * np.sin(2 * np.pi * _T / 1.7)
    phase = 2 * np.pi * np.cumsum(70 + 50 * rev) / RATE_HZ
    buzz = sum(np.sin(k * phase) / k for k in range(1, 20))
    return (0.05 + rev) ** 2 * (buzz + 0.5 * band_noise(rng, len(_T), RATE_HZ, 200.0, 6000.0))


def _clock(rng: np.random.Generator) -> Signal:
    """Two ticks a second, each of a different level, over quiet noise."""
    since, number = _T % 0.5, (_T // 0.5).astype(int)
    level = rng.uniform(0.7, 1.0, number[-1] + 1)[number]
    ticks = level * np.sin(2 * np.pi * 900 * since) * np.exp(-since / 0.008)
    return np.asarray(ticks + 1e-3 * coloured_noise(rng, len(_T), 0.0))


_MAKERS: dict[str, Callable[[np.random.Generator], Signal]] = {
    "own fridge": _fridge,
    "own oven": _oven,
    "own washing machine": _washing_machine,
    "own fan": _fan,
    "own saw": _saw,
    "own clock": _clock,
}
OWN_SOUNDS = tuple(_MAKERS)
OWN_HUMS = frozenset(PITCHES_HZ)


@cache
def own_sound(name: str) -> AudioClip:
    """A sound by its name in `OWN_SOUNDS`; its peak is at 0.5."""
    x = _MAKERS[name](np.random.default_rng([7, OWN_SOUNDS.index(name)]))
    return AudioClip(0.5 * x / np.abs(x).max(), RATE_HZ, Credit(name, "made for tests", "CC0-1.0"))
