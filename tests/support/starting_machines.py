"""Synthetic recordings of machines that start and stop, with known speed and amplitude; and sounds without a start.

v(t) = a(t) (sum_k sin(k phi(t)) / k + noise) + room noise,     phi' = 2 pi f s(t)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap import AudioClip
from scene2hap.audio.run_curve import RunCurve
from sound_draws import coloured_noise

Signal = NDArray[np.float64]

RATE_HZ = 16_000

RISES: dict[str, Callable[[Signal], Signal]] = {
    "motor": lambda x: x * (2 - x),
    "linear": lambda x: x,
    "half a cosine": lambda x: np.sin(np.pi / 2 * x) ** 2,
    "coast": lambda x: x**2,
}
"""Speed over the elapsed share x of a start. A stop is a start in reverse, so "coast" is a coast-down."""


WITHOUT_RUNS = (
    "white",
    "pink",
    "brown",
    "ticks",
    "rings",
    "speech",
    "speech, then a hum",
    "music",
    "one event",
    "a bell that fades for long",
    "revving",
    "a cut file, faded over 50 ms",
    "turned up by 8 dB",
    "a drop in between",
)
"""Names of sounds without a start or a stop."""


class Take(NamedTuple):
    """A recording (n,), and its true speed (n,) and amplitude (n,) re steady running."""

    samples: Signal
    speed: Signal
    amplitude: Signal

    @property
    def clip(self) -> AudioClip:
        """The recording as a clip."""
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
    """A machine in a room; it starts and stops if a time is given. `spins`: its force is that of an unbalance, s^2.

    Parameters: hiss_db : its noise re its tones [dB], which rises with them; room_db : constant room noise [dB].
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
    """Scale a signal to an RMS of 1."""
    return np.asarray(x / np.sqrt(np.mean(x**2)))


def errors(take: Take, curve: RunCurve, begin_s: float) -> tuple[float, float]:
    """The largest error of level [dB], and of speed [-] or NaN, while the machine is within 20 dB of steady running."""
    x = np.linspace(0.0, 1.0, 500)
    at, t = begin_s + x * curve.lasts_s, np.arange(len(take.samples)) / RATE_HZ
    amplitude, speed = np.interp(at, t, take.amplitude), np.interp(at, t, take.speed)
    is_felt = amplitude > 0.1
    level_db = 20 * np.log10(np.maximum(curve.amplitude_at(x), 1e-6)[is_felt] / amplitude[is_felt])
    followed = curve.speed_at(x)
    speed_error = np.nan if followed is None else np.abs(followed[is_felt] / speed[is_felt] - 1).max()
    return float(np.abs(level_db).max()), float(speed_error)


def decay(t: Signal, begin_s: float, per_s: float) -> Signal:
    return np.where(t < begin_s, 0.0, np.exp(-per_s * np.maximum(t - begin_s, 0.0)))


@lru_cache(maxsize=1)  # 14 MB
def without_runs(seed: int) -> Mapping[str, Signal]:
    """Sounds of 8 s without a start or a stop, named as in `WITHOUT_RUNS`. Those of the last seed are kept."""
    rng = np.random.default_rng(seed)
    n = 8 * RATE_HZ
    t = np.arange(n) / RATE_HZ
    room = 0.003 * rng.standard_normal(n)
    hum = np.sin(2 * np.pi * 100 * t)
    syllables = np.interp(t, np.arange(0, 8.3, 0.12), np.maximum(0.0, rng.standard_normal(70)))
    glide = 2 * np.pi * np.cumsum(120 * (1 + 0.2 * np.interp(t, np.arange(0, 8.3, 0.3), rng.standard_normal(28))))
    voice = syllables * np.sum([np.sin(k * glide / RATE_HZ) / k for k in range(1, 12)], axis=0)
    rev = np.interp(t, np.arange(0, 8.5, 0.5), rng.uniform(0.4, 1.0, 17))
    notes = np.sum(
        [
            np.sin(2 * np.pi * 110 * 2 ** (rng.integers(0, 24) / 12) * t) * decay(t, 0.2 * i, rng.uniform(2, 8))
            for i in range(40)
        ],
        axis=0,
    )
    ticks = np.sum([decay(t, i * rng.uniform(0.3, 1.0), 200.0) for i in range(8)], axis=0) * np.sin(2 * np.pi * 300 * t)
    fade = np.clip(np.minimum(t, 8 - t) / 0.05, 0.0, 1.0)
    sounds = {
        "white": rng.standard_normal(n),
        "pink": coloured_noise(rng, n, 1.0),
        "brown": coloured_noise(rng, n, 2.0),
        "ticks": ticks + room,
        "rings": ((t * rng.uniform(0.4, 1.5)) % 1 < 0.5) * hum + room,
        "speech": voice + room,
        "speech, then a hum": np.where(t < 3, 0.5 * voice, hum) + room,
        "music": notes + room,
        "one event": hum * decay(t, rng.uniform(0.2, 3.0), rng.uniform(0.5, 8.0)) + room,
        "a bell that fades for long": hum * np.exp(-t / 2) + 0.01 * room,
        "revving": rev**2 * np.sin(2 * np.pi * np.cumsum(80 * rev) / RATE_HZ) + room,
        "a cut file, faded over 50 ms": fade * (hum + 30 * room),
        "turned up by 8 dB": np.interp(t, (0, 1, 2, 8), (0.4, 0.4, 1, 1)) * coloured_noise(rng, n, 1.0),
        "a drop in between": np.interp(t, (0, 1, 1.5, 2, 2.5, 8), (0.02, 1, 1, 0.02, 1, 1)) * hum + room,
    }
    assert tuple(sounds) == WITHOUT_RUNS
    return MappingProxyType(sounds)
