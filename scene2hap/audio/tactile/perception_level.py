"""Perception-level translation: loudness and roughness of the sound become intensity and roughness of the vibration.

Every 93 ms, the sound is reduced to two numbers, which are rendered as two sines of 175 and 210 Hz. The sum A of their
amplitudes is felt as intensity. The share S of the upper sine is felt as roughness, since the sines beat at 35 Hz:

    L_a = C sum_k 20 lg(c |X_k|) / L60(f_k)              loudness heard, 25..6400 Hz
    R_a = sum over pairs of spectral peaks of ((x_m x_M)^0.1 / 2) (2 x_m / (x_m + x_M))^3.11
              (exp(-3.5 s d) - exp(-5.75 s d)),  s = 0.24 / (0.0207 f_m + 18.96),  d = |f_1 - f_2|
    I_v = 0.035 sqrt(L_a) R_a^2 - 0.4        R_v = R_a   (games)
    R_v = -28.15 S^2 + 28.3 S + 0.529 I_v + 0.479        R_v = 3.98 sqrt(A) - 25.8 S^2 + 25.5 S + 0.203

x_m <= x_M amplitudes of a pair of peaks, f_m [Hz] its lower frequency, L60 [dB] the 60-phon contour of ISO 226:2003.
Source: J. Lee and S. Choi, "Real-time perception-level translation from audio signals to vibrotactile effects", CHI
2013; equations and constants from the public re-implementation in Sound2Hap (Iris1215/Sound2Hap). Differs: frames have
the same duration at any sample rate, and amplitudes change linearly from frame to frame; in the sources they jump.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy

from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.tactile.oscillator import Oscillator
from scene2hap.audio.tactile.stages import Stage, StageStream
from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.errors import ConfigError

_FRAME_S = 4096 / 44_100
_LOW_HZ, _HIGH_HZ = 175.0, 210.0
_BAND_HZ = (25.0, 6400.0)
_PEAKS_DB = -40.0
_MAX_PEAKS = 64
"""Most peaks of a frame: pairs grow with their square; the strongest 64 include all audible ones (assumed)."""
_LOUDNESS, _AMPLITUDE = 0.065, 1.37
_INTENSITY_GAIN, _INTENSITY_OFFSET = 0.035, 0.4

# ISO 226:2003, equal loudness at 60 phon: frequency [Hz], sound pressure level [dB].
_CONTOUR_HZ = (
    *(25.0, 31.5, 40.0, 50.0, 63.0, 80.0, 100.0, 125.0, 160.0, 200.0, 250.0, 315.0, 400.0, 500.0, 630.0, 800.0),
    *(1000.0, 1250.0, 1600.0, 2000.0, 2500.0, 3150.0, 4000.0, 5000.0, 6300.0),
)
_CONTOUR_DB = (
    *(104.23, 99.08, 94.18, 89.96, 85.94, 82.05, 78.65, 75.56, 72.47, 69.86, 67.53, 65.39, 63.45, 62.05, 60.81, 59.89),
    *(60.01, 62.15, 63.19, 59.96, 57.26, 56.42, 57.57, 60.89, 66.36),
)


@dataclass(frozen=True)
class PerceptionLevel:
    """Turn loudness into intensity and roughness into roughness, as sines of 175 and 210 Hz (Lee and Choi 2013).

    A live signal is delayed by one frame; a loop is not.
    `full_scale` is the amplitude A, in the unit of the source's model, that is rendered as 1; assumed, since that unit
    depends on the actuator for which the model was fitted.
    Raises: ConfigError: `full_scale` is not above 0; or, once the sample rate is known, this rate is below 1 kHz.
    """

    full_scale: float = 4.0

    def __post_init__(self) -> None:
        checks.number("full_scale", self.full_scale, "-", above=0.0, error=ConfigError)

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> StageStream:
        """Start a conversion at a sample rate; the context has no effect."""
        rate = checks.number("sample_rate_hz", sample_rate_hz, "Hz", at_least=1000.0, error=ConfigError)
        return StageStream(_Translation(rate, self.full_scale))


class _Translation(Stage):
    """Delays samples until a frame is full, so that the vibration of a frame plays with its sound."""

    def __init__(self, sample_rate_hz: float, full_scale: float) -> None:
        self._rate_hz = sample_rate_hz
        self._full_scale = full_scale
        self._size = round(_FRAME_S * sample_rate_hz)
        self._frame = np.zeros(self._size)
        self._filled = 0
        self._position = 0
        self._amplitudes = np.zeros(2)
        self._low = Oscillator(_LOW_HZ, sample_rate_hz)
        self._high = Oscillator(_HIGH_HZ, sample_rate_hz)

    def run(self, x: Floats) -> Floats:
        out = []
        while x.size:
            taken = x[: self._size - self._filled]
            self._frame[self._filled : self._filled + len(taken)] = taken
            self._filled += len(taken)
            x = x[len(taken) :]
            if self._filled == self._size:
                out.append(self._rendered(self._size))
        return np.concatenate(out) if out else np.empty(0)

    def rest(self) -> Floats:
        held, self._frame[self._filled :] = self._filled, 0.0
        return self._rendered(held)

    def _rendered(self, n: int) -> Floats:
        target = np.array(amplitudes(self._frame, self._rate_hz)) / self._full_scale
        ramp = np.arange(1, n + 1) / self._size
        glide = self._amplitudes[:, None] + (target - self._amplitudes)[:, None] * ramp
        low = self._low.values(self._position, n)[1]
        high = self._high.values(self._position, n)[1]
        self._amplitudes = target
        self._position += n
        self._filled = 0
        return np.asarray(glide[0] * low + glide[1] * high)


def amplitudes(frame: Floats, sample_rate_hz: float) -> tuple[float, float]:
    """Return the amplitudes of the two sines for a frame (n,) [unit of the model]; 0 if nothing is felt."""
    # The sums are fitted to transforms of 4096 samples.
    magnitude = np.abs(np.fft.rfft(frame)) * (4096 / len(frame))
    f = np.fft.rfftfreq(len(frame), 1.0 / sample_rate_hz).astype(np.float64)
    inside = (f >= _BAND_HZ[0]) & (f <= _BAND_HZ[1])
    f, magnitude = f[inside], magnitude[inside]
    roughness = _roughness(f, magnitude)
    intensity = _INTENSITY_GAIN * math.sqrt(_loudness(f, magnitude)) * roughness**2 - _INTENSITY_OFFSET
    if intensity <= 0.0:
        return 0.0, 0.0
    # Largest roughness that the first parabola in S reaches: its vertex.
    roughness = min(roughness, 28.3**2 / (4 * 28.15) + 0.529 * intensity + 0.479)
    offset = 0.529 * intensity + 0.479 - roughness
    share = (28.3 - math.sqrt(max(0.0, 28.3**2 + 4 * 28.15 * offset))) / (2 * 28.15)
    share = min(max(share, 0.0), 1.0)
    root = (roughness + 25.8 * share**2 - 25.5 * share - 0.203) / 3.98
    total = max(root, 0.0) ** 2
    return total * (1.0 - share), total * share


def _loudness(f: Floats, magnitude: Floats) -> float:
    level_db = 20.0 * np.log10(_AMPLITUDE * magnitude + 1e-12)
    contour_db = np.interp(f, _CONTOUR_HZ, _CONTOUR_DB)
    return max(0.0, _LOUDNESS * float(np.sum(level_db / contour_db)))


def _roughness(f: Floats, magnitude: Floats) -> float:
    level_db = 20.0 * np.log10(magnitude + 1e-12)
    peaks, _ = scipy.signal.find_peaks(level_db, height=level_db.max() + _PEAKS_DB)
    peaks = np.sort(peaks[np.argsort(-level_db[peaks], kind="stable")[:_MAX_PEAKS]])
    one, other = np.triu_indices(len(peaks), 1)
    lower, apart = f[peaks[one]], f[peaks[other]] - f[peaks[one]]
    xs, ys = magnitude[peaks[one]], magnitude[peaks[other]]
    weak, strong = np.minimum(xs, ys), np.maximum(xs, ys)
    s = 0.24 / (0.0207 * lower + 18.96)
    weight = 0.5 * (weak * strong) ** 0.1 * (2.0 * weak / (weak + strong)) ** 3.11
    return float(np.sum(weight * (np.exp(-3.5 * s * apart) - np.exp(-5.75 * s * apart))))
