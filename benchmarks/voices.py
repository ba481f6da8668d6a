"""The synthesizer compared with recordings of the same machines, as a table in Markdown.

python benchmarks/voices.py [--takes 5]

Slow modulation is the standard deviation of the level in 100 ms divided by its mean, in decibels. Harmonics are the
levels in octaves from 40 Hz on, relative to the strongest octave between 20 and 1,280 Hz. Takes of the synthesizer are
averaged as power. Recordings are those beside the project (../shared/audio).
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from others import RECORDINGS
from scene2hap import VibrationDescription
from scene2hap.audio.files import read_clip
from scene2hap.audio.sources.synth import Synthesizer

Signal = NDArray[np.float64]

MACHINES = {
    "fridge_hum_kitchen.wav": ("refrigerator", "on", "refrigerator hums", 0.1, (0.6, 0.6, 1.7)),
    "washing_machine_rinse.wav": ("washing machine", "rinsing", "washing machine rinsing", 0.7, (0.6, 0.6, 0.85)),
    "computer_fan_hum.wav": ("computer fan", "on", "computer fan hums", 0.2, (0.12, 0.12, 0.03)),
    "oven_hum.wav": ("oven", "on", "oven hums", 0.2, (0.6, 0.6, 0.6)),
}
OCTAVES_HZ = (40.0, 80.0, 160.0, 320.0, 640.0)


def modulation_db(x: Signal, rate: int) -> float:
    """Standard deviation of the level in 100 ms divided by its mean [dB]."""
    n = round(0.1 * rate)
    level = np.sqrt((x[: len(x) // n * n].reshape(-1, n) ** 2).mean(axis=1))
    return float(20 * np.log10(level.std() / level.mean()))


def octaves_db(x: Signal, rate: int) -> Signal:
    """Level in the octave above each of `OCTAVES_HZ`, relative to the strongest octave between 20 and 1280 Hz [dB]."""
    power = np.abs(np.fft.rfft(x * np.hanning(len(x)))) ** 2
    f = np.fft.rfftfreq(len(x), 1 / rate)
    found = np.array([power[(f >= low) & (f < 2 * low)].sum() for low in (20.0, *OCTAVES_HZ)])
    return np.asarray(10 * np.log10(found / found.max() + 1e-12)[1:])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--takes", type=int, default=5)
    takes = parser.parse_args().takes
    columns = " | ".join(f"{low:g}-{2 * low:g} Hz" for low in OCTAVES_HZ)
    print(f"Slow modulation, and level by octave [dB]: recording / synthesizer, {takes} seeds\n")
    print(f"| machine | slow modulation | {columns} | furthest off |\n|---|---|" + "---|" * (len(OCTAVES_HZ) + 1))
    for file, (category, state, words, intensity, size) in MACHINES.items():
        recording = read_clip(RECORDINGS / file)
        real = recording.samples.astype(np.float64)
        slow, level = modulation_db(real, recording.sample_rate_hz), octaves_db(real, recording.sample_rate_hz)
        made = []
        for seed in range(takes):
            description = VibrationDescription(category, state, words, words, intensity, size, seed=seed)
            clip = Synthesizer().find(description)[0]
            x = clip.samples.astype(np.float64)
            made.append((modulation_db(x, clip.sample_rate_hz), octaves_db(x, clip.sample_rate_hz)))
        ours = float(10 * np.log10(np.mean([10 ** (one / 10) for one, _ in made])))
        octaves = 10 * np.log10(np.mean([10 ** (one / 10) for _, one in made], axis=0))
        cells = " | ".join(f"{a:.1f} / {b:.1f}" for a, b in zip(level, octaves, strict=True))
        worst = max(abs(slow - ours), *np.abs(level - octaves)[2:])
        print(f"| {category} | {slow:.1f} / {ours:.1f} | {cells} | {worst:.1f} |")


if __name__ == "__main__":
    main()
