"""How well each converter preserves recorded sounds, as a table in Markdown.

python benchmarks/recordings.py [SOUND ...] [--actuator flat]

The measure depends on the kind of sound:
- *varies* (the level in 100 ms varies by more than 6 dB, 5th to 95th percentile): correlation of the envelopes of sound
  and vibration; the target is 0.8 or more;
- *steady*: excess of the level range of the vibration over that of the sound [dB]; the target is 3 or less. If its
  strongest component is a line, 15 dB above its surroundings: whether that is felt ("line") or not ("no line"). It is
  felt as itself if no component is felt 3 dB better, or as modulation at its rate with a depth of 0.2 or more. Lines
  within 2.5 dB of the strongest, a just noticeable difference, count as strongest, too. A line in brackets is out of
  reach: above 100 Hz, too fast for modulation, and a sine of it would miss the level by more than 3 dB;
- *events*, if there are any: number of onsets of the sound that are also onsets of the vibration, within 30 ms. At an
  onset the energy in 5 ms is 12 dB above the median of the 50 ms before, and above -30 dB re its peak.
These statistics are independent of the converters' own. Sounds of less than 0.2 s have no range of levels, and silent
ones no level: they are listed without a measure. Without arguments the recordings beside the project are used.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.signal import hilbert, welch

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from others import RECORDINGS
from scene2hap.audio.actuators import actuator_profile, response_db
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.conversion import convert_clip
from scene2hap.audio.felt_component import felt_component_of
from scene2hap.audio.files import read_clip
from scene2hap.audio.levels import drive_db, sensation_level_db
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.audio.threshold import threshold_db
from scene2hap.haptics import ActuatorProfile

INTENSITY, VARIES_DB, LEAST_S = 0.3, 6.0, 0.2
LINE_DB, LEVEL_JND_DB, LEAST_DEPTH = 15.0, 2.5, 0.2
Signal = NDArray[np.float64]


def levels_db(x: Signal, rate: int, step_s: float) -> Signal:
    """Level of each step of `step_s` [dB]."""
    n = round(step_s * rate)
    return np.asarray(10 * np.log10((x[: len(x) // n * n].reshape(-1, n) ** 2).mean(axis=1) + 1e-12))


def range_db(level: Signal) -> float:
    """Range of a level from the 5th to the 95th percentile [dB]."""
    return float(np.subtract(*np.percentile(level, (95, 5))))


def onsets_s(x: Signal, rate: int) -> Signal:
    """Times of onsets [s]."""
    level = levels_db(x, rate, 0.005)
    found: list[int] = []
    for i in range(10, len(level)):
        is_new = not found or i - found[-1] > 6
        if is_new and level[i] > level.max() - 30 and level[i] - np.median(level[i - 10 : i]) > 12:
            found.append(i)
    return 0.005 * np.array(found)


def amplitudes_db(x: Signal, rate: int) -> tuple[Signal, Signal]:
    """Frequencies [Hz] and mean amplitudes of sines [dB] in windows of 2 s."""
    n = min(len(x), 2 * rate)
    f, power = welch(x, rate, "hann", n, 3 * n // 4, 2 * n, detrend="constant", scaling="spectrum")
    return f, 10 * np.log10(2 * power + 1e-30)


def above_around_db(f: Signal, level: Signal, k: int) -> float:
    """Height of a peak above the median of the third octaves around it, or of 12 Hz [dB]."""
    reach = max(0.26 * f[k], 12.0)
    return float(level[k] - np.median(level[np.abs(f - f[k]) <= reach]))


def strongest_lines_hz(heard: Signal, rate: int) -> list[float]:
    """Frequencies of the strongest line and of lines that feel as strong [Hz]; none if the strongest is no line."""
    f, level = amplitudes_db(heard, rate)
    inside = np.flatnonzero((f >= 20.0) & (f <= min(1000.0, 0.45 * rate)))
    k = int(inside[np.argmax(level[inside])])
    if above_around_db(f, level, k) < LINE_DB:
        return []
    is_peak = (level[inside] >= level[inside - 1]) & (level[inside] > level[inside + 1])
    near = inside[is_peak & (level[inside] >= level[k] - LEVEL_JND_DB)]
    return [float(f[k]), *map(float, f[near])]


def is_felt(line_hz: float, felt: Signal, rate: int, actuator: ActuatorProfile) -> bool:
    """True if a line is felt as itself, or as modulation at its rate."""
    f, level = amplitudes_db(felt, rate)
    inside = (f >= 10.0) & (f <= 1000.0)
    sensation = np.where(inside, level + response_db(actuator, f) - threshold_db(f), -300.0)
    near = np.abs(f / line_hz - 1.0) < 0.03
    if sensation[near].max() > sensation.max() - 3.0:
        return True
    envelope = np.abs(hilbert(felt))
    f, depth = amplitudes_db(envelope / envelope.mean(), rate)
    k = int(np.argmax(np.where(near, depth, -300.0)))
    return bool(depth[k] >= 20 * np.log10(LEAST_DEPTH) and above_around_db(f, depth, k) >= LINE_DB)


def line_cell(heard: Signal, felt: Signal, rate: int, actuator: ActuatorProfile) -> str:
    """Part of a cell: whether the strongest line of a steady sound is felt."""
    lines = strongest_lines_hz(heard, rate)
    if not lines:
        return ""
    found = "line" if any(is_felt(line, felt, rate, actuator) for line in lines) else "no line"
    missed_db = float(drive_db(lines[0], sensation_level_db(INTENSITY), actuator)) + 6.0
    return f", ({found})" if lines[0] > 100.0 and missed_db > 3.0 else f", {found}"


def judged(clip: AudioClip, kind: str, actuator: str) -> str:
    """Cell of the table: the measure for this kind of sound."""
    profile, rate = actuator_profile(actuator), clip.sample_rate_hz
    component = felt_component_of(clip.samples, rate, sensation_level_db(INTENSITY), profile)
    assert component is not None
    context = ConversionContext(
        profile,
        INTENSITY,
        own_hz=component.frequency_hz,
        target_hz=component.carrier_hz,
        rough_hz=component.rough_hz,
        band_q=component.band_q,
        band_db=component.band_db,
    )
    heard = clip.samples.astype(np.float64)
    converter: Any = CONVERTERS.build(kind)
    felt = convert_clip(clip, converter, context).samples.astype(np.float64)
    before, after = (levels_db(x, rate, 0.1) for x in (heard, felt))
    if range_db(before) > VARIES_DB:
        cell = f"r {np.corrcoef(10 ** (before / 20), 10 ** (after / 20))[0, 1]:.2f}"
    else:
        cell = f"{range_db(after) - range_db(before):+.1f} dB" + line_cell(heard, felt, rate, profile)
    starts = onsets_s(heard, rate)
    if len(starts) >= 3:
        others = onsets_s(felt, rate)
        kept = sum(bool(len(others)) and np.abs(others - start).min() <= 0.03 for start in starts)
        cell += f", {kept} of {len(starts)}"
    return cell


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("sounds", nargs="*", type=Path)
    parser.add_argument("--actuator", default="flat")
    given = parser.parse_args()
    paths = given.sounds or sorted(path for path in RECORDINGS.glob("*.*") if path.suffix in (".wav", ".ogg"))
    if not paths:
        parser.error(f"no recordings in {RECORDINGS}; name sounds.")  # an empty table would look like a measurement
    kinds = ["auto", *(kind for kind in CONVERTERS.kinds() if kind != "auto")]
    print(f"| sound | kind | {' | '.join(kinds)} |")
    print("|" + "---|" * (len(kinds) + 2))
    for path in paths:
        clip = read_clip(path)
        x = clip.samples - clip.samples.mean()
        if clip.duration_s < LEAST_S or not x.any():
            print(f"| {path.stem} | {'silent' if not x.any() else 'too short'} | {' | '.join('-' for _ in kinds)} |")
            continue
        clip = AudioClip((0.9 * x / np.abs(x).max()).astype(np.float32), clip.sample_rate_hz)
        varies = range_db(levels_db(clip.samples.astype(np.float64), clip.sample_rate_hz, 0.1)) > VARIES_DB
        cells = [judged(clip, kind, given.actuator) for kind in kinds]
        print(f"| {path.stem} | {'varies' if varies else 'steady'} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
