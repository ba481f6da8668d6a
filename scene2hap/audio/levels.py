"""Sensation levels: decibels over the threshold of touch, and the level for a given intensity.

The level of several components follows from the sum of their energies, each relative to its own threshold T(f)
(`audio.threshold`; Pacinian corpuscles integrate, practically without critical bands):

L = 10 lg sum_k (a_k / 10^(T(f_k) / 20))^2      a_k [-] amplitude of the component at f_k, re full scale

All levels here depend on the convention of `audio.threshold` that full scale is 45 dB over the threshold at 250 Hz.
"""

from __future__ import annotations

import math

import numpy as np
import scipy
from numpy.typing import ArrayLike

from scene2hap.audio.actuators import response_db
from scene2hap.audio.analysis import dominant_frequency_hz
from scene2hap.audio.clip import Samples
from scene2hap.audio.threshold import TACTILE_RANGE_HZ, threshold_db
from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.errors import AudioError
from scene2hap.haptics import ActuatorProfile

FULL_LEVEL_DB = 31.0
"""Sensation level of a source of intensity 1; assumed: it fits below full scale, with head-room, from 140 Hz on."""
LEVEL_PER_DECADE_DB = 17.0
"""Level difference for a factor of ten in intensity [dB]. Felt strength grows with amplitude to the power 0.89
(Verrillo 1970), which would give 22 dB. Touch has a range of 45 dB, hearing of 100 dB, so that compression is usual
(2:1 after Merchel and Altinsoy). With 17 dB, the faintest example of the scale, a refrigerator's hum of 0.1, has 14 dB,
which is still felt after 12 dB of attenuation. There are two level JNDs between a ringing phone (0.5) and a washing
machine (1)."""
TACTILE_HEADROOM_DB = 6.0
"""Peak of the tactile loop of a source of full intensity, below full scale [dB]: two such sources add up to full scale
(within 0.02 dB)."""
FAINTEST_PEAK_DB = -60.0
"""Peak below which a sound counts as the noise of a recording, which must not be felt [dB re full scale]."""

LEFT_PEAK_DB = -40.0
"""Peak of a vibration relative to its sound [dB]. If it is below this, and below `FAINTEST_PEAK_DB`, the converter has
left only the noise of the recording (assumed)."""

NOTHING_DB = -120.0
"""Level below which there are only rounding errors [dB]."""


def is_noise(sound_peak: float, touch_peak: float, *, is_chosen: bool = False) -> bool:
    """Return True if the peaks [-] show that a sound, or its vibration, is only the noise of a recording.

    Parameters: is_chosen : the vibration is made of a component that the analysis of the whole sound chose, which is no
    noise, however weak it is.
    """
    faintest = 10 ** (FAINTEST_PEAK_DB / 20)
    is_left_over = touch_peak < min(faintest, sound_peak * 10 ** (LEFT_PEAK_DB / 20))
    return sound_peak < faintest or (is_left_over and not is_chosen)


def sensation_level_db(intensity: float) -> float:
    """Return the planned sensation level of a source of this intensity, for a hand on it [dB].

    Raises: AudioError: the intensity is not above 0, or is more than 1.
    """
    checked = checks.number("intensity", intensity, "-", above=0.0, at_most=1.0, error=AudioError)
    return FULL_LEVEL_DB + LEVEL_PER_DECADE_DB * math.log10(checked)


def drive_db(frequencies_hz: ArrayLike, level_db: ArrayLike, actuator: ActuatorProfile) -> Floats:
    """Return the amplitude that a sine needs on an actuator for a sensation level [dB re full scale]."""
    return threshold_db(frequencies_hz) + np.asarray(level_db, dtype=np.float64) - response_db(actuator, frequencies_hz)


def felt_spectrum(
    samples: ArrayLike, sample_rate_hz: float, actuator: ActuatorProfile | None = None
) -> tuple[Floats, Floats]:
    """Return frequencies (n_bins,) [Hz] and, at each, (a_k / threshold)^2 (n_bins,) [-] of a loop (n_samples,).

    No window is applied, since a loop is periodic. The range is 10 to 1000 Hz.
    """
    x = np.asarray(samples, dtype=np.float64)
    f = np.fft.rfftfreq(len(x), 1.0 / sample_rate_hz).astype(np.float64)
    inside = (f >= TACTILE_RANGE_HZ[0]) & (f <= min(TACTILE_RANGE_HZ[1], 0.5 * sample_rate_hz))
    f = f[inside]
    amplitude = 2.0 * np.abs(scipy.fft.rfft(x)[inside]) / len(x)
    return f, amplitude**2 * 10 ** (over_threshold_db(f, actuator) / 10)


def felt_level_db(samples: ArrayLike, sample_rate_hz: float, actuator: ActuatorProfile | None = None) -> float:
    """Return the sensation level of a loop (n_samples,) [dB]; minus infinity if nothing is felt."""
    return sum_db(felt_spectrum(samples, sample_rate_hz, actuator)[1])


def most_felt_hz(samples: ArrayLike, sample_rate_hz: float, actuator: ActuatorProfile | None = None) -> float:
    """Return the frequency of a loop's peak that is farthest over the threshold of touch [Hz].

    It is not always the strongest: at 35 Hz touch needs six times the amplitude that it needs at 84 Hz.
    Raises: AudioError: as `analysis.dominant_frequency_hz`.
    """
    return dominant_frequency_hz(samples, sample_rate_hz, weight_db=lambda f: over_threshold_db(f, actuator))


def over_threshold_db(f: Floats, actuator: ActuatorProfile | None = None) -> Floats:
    """Return the level at which full scale is felt at frequencies (n,) [dB over the threshold of touch]."""
    return (response_db(actuator, f) if actuator else 0.0) - threshold_db(f)


def sum_db(felt: Floats) -> float:
    """Return the sensation level of components (n,), each as `felt_spectrum` gives it [dB]."""
    total = float(felt.sum())
    return 10.0 * math.log10(total) if total > 0.0 else -math.inf


def at_level(
    samples: Samples, sample_rate_hz: float, level_db: float, actuator: ActuatorProfile, peak: float
) -> Samples:
    """Scale a loop (n_samples,) to a sensation level, or to a peak of `peak` if that is less.

    Raises: AudioError: no component of the loop can be felt.
    """
    now_db = felt_level_db(samples, sample_rate_hz, actuator)
    if now_db < NOTHING_DB:
        raise AudioError("the tactile signal is silent between 10 and 1000 Hz. Choose another sound or converter.")
    gain = min(10 ** ((level_db - now_db) / 20), peak / float(np.abs(samples).max()))
    return np.asarray(samples * gain, dtype=np.float32)
