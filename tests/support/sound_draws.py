"""Random sounds of known kind, for long campaigns and for the short tests derived from them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.signal import butter, sosfilt

from others import RECORDINGS
from scene2hap.audio.clip import AudioClip, Credit
from scene2hap.audio.files import read_clip

Signal = NDArray[np.float64]
Draw = tuple[str, Signal, int]
"""Kind, samples, sample rate [Hz]."""

HUMS = {"fridge_hum_kitchen.wav", "oven_hum.wav", "computer_fan_hum.wav", "washing_machine_rinse.wav"}
RATES = (44_100, 48_000)


def recordings() -> dict[str, tuple[Signal, int]]:
    """The recordings in `../shared` by file name; empty if they are absent."""
    paths = sorted(path for path in RECORDINGS.glob("*.*") if path.suffix in (".wav", ".ogg"))
    clips = {path.name: read_clip(path) for path in paths}
    return {name: (clip.samples.astype(float), clip.sample_rate_hz) for name, clip in clips.items()}


def coloured_noise(rng: np.random.Generator, n: int, slope: float) -> Signal:
    """Gaussian noise with power proportional to f^-slope above 10 Hz: 0 white, 1 pink, 2 brown; unit RMS."""
    spectrum = np.fft.rfft(rng.standard_normal(n))
    f = np.fft.rfftfreq(n, 1 / 48_000)
    x = np.fft.irfft(spectrum * np.maximum(f, 10.0) ** (-slope / 2) * (f > 0), n)
    return np.asarray(x / x.std())


def band_noise(rng: np.random.Generator, n: int, rate: int, low_hz: float, high_hz: float) -> Signal:
    """Gaussian noise within a band, sharply cut; unit RMS."""
    spectrum = np.fft.rfft(rng.standard_normal(n))
    f = np.fft.rfftfreq(n, 1 / rate)
    x = np.fft.irfft(spectrum * ((f >= low_hz) & (f <= high_hz)), n)
    return np.asarray(x / x.std())


def loop_clip(
    kind: str, rng: np.random.Generator, real: Mapping[str, tuple[Signal, int]]
) -> tuple[str, Signal, int, float]:
    """A 1-10 s clip to loop: "recording", "noise", "tone" or "beat". Returns name, samples, rate, pitch [Hz] or 0."""
    rate = int(rng.choice(RATES))
    n = round(rng.uniform(1.0, 10.0) * rate)
    t = np.arange(n) / rate
    frequency = float(np.exp(rng.uniform(np.log(20.0), np.log(500.0))))
    phase = rng.uniform(0, 2 * np.pi, 2)
    if kind == "recording":
        name = str(rng.choice(sorted(real)))
        x, rate = real[name]
        n = round(rng.uniform(1.0, len(x) / rate) * rate)
        start = int(rng.integers(0, len(x) - n + 1))
        return name, x[start : start + n], rate, 0.0
    if kind == "noise":
        colour = str(rng.choice(["white", "pink", "brown", "band"]))
        if colour == "band":
            return colour, 0.1 * band_noise(rng, n, rate, 20.0, 1000.0), rate, 0.0
        return colour, 0.1 * coloured_noise(rng, n, {"white": 0.0, "pink": 1.0, "brown": 2.0}[colour]), rate, 0.0
    if kind == "tone":
        x = np.sin(2 * np.pi * frequency * t + phase[0])
        if rng.random() < 0.5:
            x += 0.5 * np.sin(4 * np.pi * frequency * t + phase[1])
        return kind, 0.3 * x, rate, frequency
    beat_hz = rng.uniform(0.5, 8.0)
    x = np.sin(2 * np.pi * frequency * t + phase[0]) + rng.uniform(0.2, 1.0) * np.sin(
        2 * np.pi * (frequency + beat_hz) * t + phase[1]
    )
    return "beat", 0.3 * x, rate, 0.0


def chopped(x: Signal, rng: np.random.Generator) -> Signal:
    """Cut half to all of a clip, from a random start, without a fade."""
    length = int(rng.uniform(0.5, 1.0) * len(x))
    start = int(rng.integers(0, len(x) - length + 1))
    return x[start : start + length]


def hum_in_noise(rng: np.random.Generator) -> tuple[float, Signal, int]:
    """A 15-500 Hz tone with a second partial at -6 dB in 20-1000 Hz noise, 10 dB SNR, 2.5 s. Returns pitch, x, rate."""
    rate = int(rng.choice(RATES))
    t = np.arange(round(2.5 * rate)) / rate
    frequency = float(rng.uniform(15.0, 500.0))
    phase = rng.uniform(0, 2 * np.pi, 2)
    x = np.sin(2 * np.pi * frequency * t + phase[0]) + 10 ** (-6 / 20) * np.sin(4 * np.pi * frequency * t + phase[1])
    noise = band_noise(rng, len(t), rate, 20.0, 1000.0) * x.std() * 10 ** (-10 / 20)
    return frequency, x + noise, rate


def hum_among_decoys(
    rng: np.random.Generator, real: Mapping[str, tuple[Signal, int]], hums: Collection[str] = HUMS
) -> tuple[str, list[AudioClip]]:
    """The title of a recorded hum, and candidates in random order: the hum, decoys and recordings of other sounds."""

    def clip(title: str, x: Signal, rate: int) -> AudioClip:
        return AudioClip(x / max(1.0, float(np.abs(x).max())), rate, Credit(title, "somebody", "CC0-1.0"))

    hum = str(rng.choice(sorted(set(hums) & set(real))))
    x, rate = real[hum]
    n = round(rng.uniform(2.6, len(x) / rate) * rate)
    start = int(rng.integers(0, len(x) - n + 1))
    candidates = [clip(hum, 10 ** rng.uniform(-2, 0) * x[start : start + n], rate)]
    candidates += [clip(name, *real[name]) for name in sorted(set(real) - set(hums))]
    candidates += [clip(*decoy) for decoy in decoys(rng).values()]
    return hum, [candidates[i] for i in rng.permutation(len(candidates))]


def decoys(rng: np.random.Generator) -> dict[str, Draw]:
    """Wrong results of a search for a hum, each 3 to 6 s: title -> draw."""
    makers: dict[str, Callable[[np.random.Generator, Signal, int], Signal]] = {
        "clicks": _clicks,
        "pings": _pings,
        "decay": _decay,
        "silence": _silence,
        "speech": _speech,
        "hiss": _hiss,
        "codec hiss": _codec_hiss,
        "hum, too short": _short,
    }
    found: dict[str, Draw] = {}
    for title, make in makers.items():
        rate = int(rng.choice((16_000, 22_050, 44_100, 48_000)))
        t = np.arange(round(rng.uniform(3.0, 6.0) * rate)) / rate
        found[title] = (title, 10 ** rng.uniform(-2, 0) * make(rng, t, rate), rate)
    return found


def _clicks(rng: np.random.Generator, t: Signal, rate: int) -> Signal:
    period = rng.uniform(0.15, 1.0)
    ring = rng.uniform(200, 2000)
    floor = 10 ** rng.uniform(-5, -2) * rng.standard_normal(len(t))
    return np.sin(2 * np.pi * ring * t) * np.exp(-(t % period) / rng.uniform(0.002, 0.02)) + floor


def _pings(rng: np.random.Generator, t: Signal, rate: int) -> Signal:
    """Two strokes of a bell, far apart in digital silence, so that most frames are zero."""
    x = np.zeros(len(t))
    f = rng.uniform(200, 900)
    for begin in (0.05, t[-1] - 0.2):
        since = t - begin
        x += np.where(since >= 0, np.sin(2 * np.pi * f * since) * np.exp(-np.maximum(since, 0) / 0.01), 0.0)
    return np.where(np.abs(x) < 1e-4, 0.0, x)


def _decay(rng: np.random.Generator, t: Signal, rate: int) -> Signal:
    f = rng.uniform(50, 500)
    return np.sin(2 * np.pi * f * t) * np.exp(-t / rng.uniform(0.3, 2.0)) + 1e-3 * rng.standard_normal(len(t))


def _silence(rng: np.random.Generator, t: Signal, rate: int) -> Signal:
    return np.zeros(len(t)) if rng.random() < 0.5 else np.round(rng.uniform(-1, 1, len(t))) / 32768


def _speech(rng: np.random.Generator, t: Signal, rate: int) -> Signal:
    """Voiced bursts, three to five a second, of varying pitch, with quiet noise."""
    pitch = rng.uniform(90, 220) * (1 + 0.1 * np.sin(2 * np.pi * rng.uniform(0.3, 1.0) * t))
    phase = 2 * np.pi * np.cumsum(pitch) / rate
    voice = sum(np.sin(k * phase) / k for k in range(1, 12))
    syllables = np.maximum(0.0, np.sin(2 * np.pi * rng.uniform(3.0, 5.0) * t + rng.uniform(0, 6))) ** 0.5
    return voice * syllables + 10 ** rng.uniform(-4, -2) * rng.standard_normal(len(t))


def _hiss(rng: np.random.Generator, t: Signal, rate: int) -> Signal:
    return rng.standard_normal(len(t))


def _codec_hiss(rng: np.random.Generator, t: Signal, rate: int) -> Signal:
    """Noise after a lossy codec: nothing above 16 kHz, or above 90 % of half the rate."""
    cut = min(16_000.0, 0.45 * rate)
    return np.asarray(sosfilt(butter(10, cut, fs=rate, output="sos"), rng.standard_normal(len(t))))


def _short(rng: np.random.Generator, t: Signal, rate: int) -> Signal:
    """A pure tone of 1 to 2 s between silence."""
    x = np.sin(2 * np.pi * rng.uniform(50, 200) * t)
    begin = 0.3
    return np.where((t > begin) & (t < begin + rng.uniform(1.0, 2.0)), x, 0.0)
