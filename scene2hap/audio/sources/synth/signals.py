"""Building blocks of voices: phases, partials, slow random variation, noise.

t [s] time, f [Hz] frequency, phi [rad] phase, k [-] order of a partial, n number of samples
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

from scene2hap.common.arrays import Floats

SAMPLE_RATE_HZ = 48_000
DURATION_S = 5.0
N_SAMPLES = round(DURATION_S * SAMPLE_RATE_HZ)
REFERENCE_MAINS_HZ = 50.0


@dataclass(frozen=True)
class Take:
    """Parameters of one take of a voice.

    `rng` is the only source of randomness. `drive` 0..1 is the load of the machine: a higher load is brighter and, if
    the speed is not regulated, faster. `size_factor` multiplies the frequencies that depend on the machine's size.
    `mains_hz` is the mains frequency [Hz].
    """

    rng: np.random.Generator
    drive: float = 0.5
    size_factor: float = 1.0
    mains_hz: float = REFERENCE_MAINS_HZ

    def about(self, value: float, spread: float = 0.03) -> float:
        """Return `value` with a random deviation, by default up to 3 % (assumed): no two machines are alike."""
        return value * (1.0 + spread * self.rng.uniform(-1.0, 1.0))

    def shaft_hz(self, nominal_hz: float) -> float:
        """Return the speed of this machine [Hz]: a larger one is slower."""
        return self.about(nominal_hz * self.size_factor)

    def speed_hz(self, nominal_hz: float) -> float:
        """Return an unregulated speed [Hz]: 15 % below nominal when idling, 15 % above at full drive; assumed."""
        return self.shaft_hz(nominal_hz * (0.85 + 0.3 * self.drive))

    def mains_speed_hz(self, nominal_hz: float) -> float:
        """Return the speed of an induction motor [Hz], from its nominal speed at a mains frequency of 50 Hz."""
        return self.shaft_hz(nominal_hz * self.mains_hz / REFERENCE_MAINS_HZ)

    def magnet_hz(self, nominal_hz: float) -> float:
        """Return the frequency of a part that a magnet on the mains moves [Hz]; `nominal_hz` is that at 50 Hz mains.

        It has no deviation: the part moves once or twice in each cycle, in every machine.
        """
        return nominal_hz * self.mains_hz / REFERENCE_MAINS_HZ

    def roll_off(self, n_partials: int, steeper_by: float = 0.0) -> Floats:
        """Return amplitudes k^-slope (n_partials,). The slope is 2.2 when idling and 1.2 at full drive; assumed."""
        return np.asarray(np.arange(1.0, n_partials + 1) ** -(2.2 - self.drive + steeper_by))


def times() -> Floats:
    """Return the time of each sample (n,) [s]."""
    return np.arange(N_SAMPLES) / SAMPLE_RATE_HZ


def phase(frequency_hz: ArrayLike) -> Floats:
    """Return the phase (n,) [rad] of an oscillator at a constant or varying frequency, phi = 2 pi int f dt."""
    f = np.broadcast_to(np.asarray(frequency_hz, dtype=np.float64), N_SAMPLES)
    return np.asarray(2.0 * np.pi * (np.cumsum(f) - f[0]) / SAMPLE_RATE_HZ)


def partials(phi: Floats, amplitudes: Sequence[float] | Floats, rng: np.random.Generator | None = None) -> Floats:
    """Return sum_k a_k cos(k phi + phi_k), k = 1, 2, ...; random phases with an `rng`, a pulse train without."""
    offsets = np.zeros(len(amplitudes)) if rng is None else rng.uniform(0.0, 2.0 * np.pi, len(amplitudes))
    # Each power of a phasor costs one multiplication, each cosine ten.
    turn = np.exp(1j * phi)
    turns = np.ones_like(turn)
    y = np.zeros_like(phi)
    for a, offset in zip(amplitudes, offsets, strict=True):
        turns *= turn
        if a:
            y += a * (np.cos(offset) * turns.real - np.sin(offset) * turns.imag)
    return y


def wander(rng: np.random.Generator, fastest_hz: float = 1.0) -> Floats:
    """Return a slow random variation (n,) within -1..1: eight sinusoids up to `fastest_hz`, at most 5 Hz."""
    knots = np.linspace(0.0, DURATION_S, 1001)
    f = rng.uniform(0.1 * fastest_hz, fastest_hz, (8, 1))
    offsets = rng.uniform(0.0, 2.0 * np.pi, (8, 1))
    return np.asarray(np.interp(times(), knots, np.cos(2.0 * np.pi * f * knots + offsets).mean(axis=0)))


def noise(rng: np.random.Generator, low_hz: float, high_hz: float, tilt_db_per_octave: float = 0.0) -> Floats:
    """Return noise (n,) of unit RMS between two frequencies, whose level falls or rises from octave to octave."""
    f = np.fft.rfftfreq(N_SAMPLES, 1.0 / SAMPLE_RATE_HZ)
    in_band = (f >= low_hz) & (f <= high_hz)
    weight = np.zeros_like(f)
    weight[in_band] = (f[in_band] / low_hz) ** (tilt_db_per_octave / (20.0 * np.log10(2.0)))
    return unit_rms(scipy.fft.irfft(weight * scipy.fft.rfft(rng.standard_normal(N_SAMPLES)), N_SAMPLES))


def ringing(times_s: ArrayLike, strengths: ArrayLike, frequency_hz: float, decay_s: float) -> Floats:
    """Return strokes at given times, each A exp(-t / decay) sin(2 pi f t); their end continues at the beginning."""
    at = np.asarray(times_s, dtype=np.float64) * SAMPLE_RATE_HZ
    strokes = np.bincount(
        np.rint(at).astype(np.int64) % N_SAMPLES, np.broadcast_to(strengths, at.shape), minlength=N_SAMPLES
    )
    t = times()
    response = np.exp(-t / decay_s) * np.sin(2.0 * np.pi * frequency_hz * t)
    return scipy.fft.irfft(scipy.fft.rfft(strokes) * scipy.fft.rfft(response), N_SAMPLES)


def unit_rms(y: Floats) -> Floats:
    """Return the signal with an RMS of 1, so that voices can mix parts by their share."""
    return np.asarray(y / np.sqrt(np.mean(y**2)))


def unit_peak(y: Floats) -> Floats:
    """Return the signal with a peak of 1."""
    return np.asarray(y / np.abs(y).max())
