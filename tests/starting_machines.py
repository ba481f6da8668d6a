"""Recordings of machines that start and stop, made from formulas, so that what they show is known.

v(t) = a(t) (sum_k sin(k phi(t)) / k + noise) + room noise,     phi' = 2 pi f s(t)
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap import AudioClip
from sound_draws import coloured_noise

Signal = NDArray[np.float64]

RATE_HZ = 16_000

RISES: dict[str, Callable[[Signal], Signal]] = {
    "motor": lambda x: x * (2 - x),
    "linear": lambda x: x,
    "half a cosine": lambda x: np.sin(np.pi / 2 * x) ** 2,
    "coast": lambda x: x**2,
}
"""Speed over the share x of a start; a stop is one backwards, so that the last is a coast-down."""


class Take(NamedTuple):
    """A recording (n,), and what it was made of: speed (n,) and amplitude (n,) re steady running."""

    samples: Signal
    speed: Signal
    amplitude: Signal

    @property
    def clip(self) -> AudioClip:
        """As a clip."""
        return AudioClip((0.2 * self.samples / np.abs(self.samples).max()).astype(np.float32), RATE_HZ)


def machine(
    *,
    start_s: float = 0.0,
    stop_s: float = 0.0,
    rise: str = "motor",
    fall: str = "coast",
    spins: bool = True,
    frequency_hz: float = 120.0,
    n_harmonics: int = 4,
    hiss_db: float = -20.0,
    room_db: float = -35.0,
    steady_s: float = 5.0,
    quiet_s: float = 1.0,
    seed: int = 0,
) -> Take:
    """A machine in a room; it starts and stops where a time is given. What spins has the force of an unbalance, s^2.

    Parameters: hiss_db : its noise re its tones, which comes up with them; room_db : of the room, which stays [dB].
    """
    rng = np.random.default_rng(seed)
    begin = quiet_s if start_s else 0.0
    end = begin + start_s + steady_s
    n = round((end + stop_s + (quiet_s if stop_s else 0.0)) * RATE_HZ)
    t = np.arange(n) / RATE_HZ
    rising = RISES[rise](np.clip((t - begin) / start_s, 0, 1)) if start_s else np.ones(n)
    falling = RISES[fall](np.clip((end + stop_s - t) / stop_s, 0, 1)) if stop_s else np.ones(n)
    way = np.minimum(rising, falling)
    amplitude = way**2 if spins else way
    speed = way if spins else np.ones(n)
    phase = 2 * np.pi * np.cumsum(frequency_hz * speed) / RATE_HZ
    tones = np.sum([np.sin(k * phase + rng.uniform(0, 6)) / k for k in range(1, n_harmonics + 1)], axis=0)
    tones /= np.sqrt(np.mean(tones**2))
    hiss, room = (unit(coloured_noise(rng, n, 1.0)) * 10 ** (level / 20) for level in (hiss_db, room_db))
    return Take((tones + hiss) * amplitude + room, speed, amplitude)


def unit(x: Signal) -> Signal:
    """With an rms of 1."""
    return np.asarray(x / np.sqrt(np.mean(x**2)))
