"""How well each converter preserves recorded sounds, as a table in Markdown.

python benchmarks/recordings.py [SOUND ...] [--actuator flat]

The measure depends on the kind of sound:
- *varies* (the level in 100 ms varies by more than 6 dB, 5th to 95th percentile): correlation of the envelopes of sound
  and vibration; the target is 0.8 or more;
- *steady*: excess of the level range of the vibration over that of the sound [dB]; the target is 3 or less;
- *events*, if there are any: number of onsets of the sound that are also onsets of the vibration, within 30 ms. At an
  onset the energy in 5 ms is 12 dB above the median of the 50 ms before, and above -30 dB re its peak.
These statistics are independent of the converters' own. Without arguments the recordings beside the project are used.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from others import RECORDINGS
from scene2hap.audio.actuators import actuator_profile
from scene2hap.audio.anchor import anchor_of
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.conversion import convert_clip
from scene2hap.audio.files import read_clip
from scene2hap.audio.levels import sensation_level_db
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.tactile import CONVERTERS

INTENSITY, VARIES_DB = 0.3, 6.0
Signal = NDArray[np.float64]


def levels_db(x: Signal, rate: int, step_s: float) -> Signal:
    """Level of each step of `step_s` [dB]."""
    n = round(step_s * rate)
    return 10 * np.log10((x[: len(x) // n * n].reshape(-1, n) ** 2).mean(axis=1) + 1e-12)


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


def judged(clip: AudioClip, kind: str, actuator: str) -> str:
    """Cell of the table: the measure for this kind of sound."""
    profile, rate = actuator_profile(actuator), clip.sample_rate_hz
    anchor = anchor_of(clip.samples, rate, sensation_level_db(INTENSITY), profile)
    assert anchor is not None
    context = ConversionContext(
        profile,
        INTENSITY,
        own_hz=anchor.frequency_hz,
        target_hz=anchor.carrier_hz,
        rough_hz=anchor.rough_hz,
        band_q=anchor.band_q,
        band_db=anchor.band_db,
    )
    heard = clip.samples.astype(np.float64)
    felt = convert_clip(clip, CONVERTERS.build(kind), context).samples.astype(np.float64)
    before, after = (levels_db(x, rate, 0.1) for x in (heard, felt))
    if range_db(before) > VARIES_DB:
        cell = f"r {np.corrcoef(10 ** (before / 20), 10 ** (after / 20))[0, 1]:.2f}"
    else:
        cell = f"{range_db(after) - range_db(before):+.1f} dB"
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
        clip = AudioClip((0.9 * x / np.abs(x).max()).astype(np.float32), clip.sample_rate_hz)
        varies = range_db(levels_db(clip.samples.astype(np.float64), clip.sample_rate_hz, 0.1)) > VARIES_DB
        cells = [judged(clip, kind, given.actuator) for kind in kinds]
        print(f"| {path.stem} | {'varies' if varies else 'steady'} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
