"""Campaigns on analysis, loops and selection: random sounds of known kind, and how often the guarantees hold.

python stress/audio.py [frequency] [loops] [chopped] [choice] [--seed 0] [--draws N]

frequency : 1,000 tones of 15 to 500 Hz with a second partial at -6 dB, 2.5 s, noise in 20-1000 Hz at 10 dB below;
    for recorded hums, the strongest third octave of a bank of Butterworth filters confirms the octave.
loops : 300 clips, a quarter each of recordings, noises, tones and beats, through every converter in turn; the wrap of
    the loop is compared with percentiles of 200 places inside the clip (`tests/support/seam_judge.py`).
chopped : a test of that comparison: 1,500 tones and 1,500 noises, each cut once at random; 1 to 8 tones in a hundred
    are continuous at the cut by chance.
choice : 200 draws of a recorded hum among the other recordings and eight synthesized decoys
    (`tests/support/sound_draws.py`).
Recordings are read from ../shared/audio beside the repository. Without them, their part is skipped with a message.
"""

from __future__ import annotations

import argparse
import platform
import sys
import time
from collections import defaultdict
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.signal import butter, sosfiltfilt

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from scene2hap.audio import analysis
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.conversion import convert_clip
from scene2hap.audio.felt_component import felt_component_of
from scene2hap.audio.levels import sensation_level_db
from scene2hap.audio.loops.seam_search import find_seam
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.seam import apply_seam
from scene2hap.audio.select import explain_choice
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.haptics import ActuatorProfile
from seam_judge import judge
from sound_draws import (
    HUMS,
    Signal,
    chopped,
    hum_among_decoys,
    hum_in_noise,
    loop_clip,
    recordings,
)

LEVEL_DB = sensation_level_db(0.3)
KINDS = ("recording", "noise", "tone", "beat")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "campaigns", nargs="*", metavar="CAMPAIGN", help="frequency, loops, chopped, choice; all by default"
    )
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--draws", type=int, help="instead of 1,000, 300, 1,500 and 200")
    arguments = parser.parse_args()
    print(f"Python {platform.python_version()}, {platform.machine()}, seed {arguments.seed}")
    real = recordings()
    if not real:
        print("no recordings beside the repository: only synthesized sounds")
    for name in arguments.campaigns or CAMPAIGNS:
        begin = time.perf_counter()
        CAMPAIGNS[name](real, arguments.seed, arguments.draws)
        print(f"({time.perf_counter() - begin:.0f} s)\n")


def frequency(real: dict[str, tuple[Signal, int]], seed: int, draws: int | None) -> None:
    errors = []
    for i in range(draws or 1000):
        truth, x, rate = hum_in_noise(np.random.default_rng([seed, i]))
        errors.append(abs(analysis.dominant_frequency_hz(x, rate) - truth))
    print(
        f"dominant frequency, {len(errors)} draws: median error {np.median(errors):.4f} Hz, largest {max(errors):.4f}"
    )
    for name in sorted(HUMS & set(real)):
        x, rate = real[name]
        print(
            f"  {name}: {analysis.dominant_frequency_hz(x, rate):.2f} Hz; "
            f"strongest third octave {strongest_third_octave_hz(x, rate):.1f} Hz"
        )


def strongest_third_octave_hz(x: Signal, rate: int) -> float:
    """Centre of the third octave, 12.5 to 800 Hz, with most energy; by Butterworth band-passes, not by a spectrum."""
    centres = 10 ** np.arange(1.1, 2.91, 0.1)
    energies = []
    for centre in centres:
        band = butter(2, (centre * 10**-0.05, centre * 10**0.05), "bandpass", fs=rate, output="sos")
        energies.append(np.sum(sosfiltfilt(band, x - x.mean()) ** 2))
    return float(centres[np.argmax(energies)])


def loops(real: dict[str, tuple[Signal, int]], seed: int, draws: int | None) -> None:
    kinds = KINDS if real else KINDS[1:]
    rows: dict[str, list[tuple[bool, bool]]] = defaultdict(list)
    by_converter: dict[str, list[bool]] = defaultdict(list)
    lengths: list[tuple[float, float]] = []
    converters = CONVERTERS.kinds()
    slowest, phases = 0.0, []
    for i in range(draws or 300):
        kind = kinds[i % len(kinds)]
        rng = np.random.default_rng([seed, i])
        _, x, rate, pitch_hz = loop_clip(kind, rng, real)
        clip = AudioClip(x.astype(np.float32), rate)
        heard = clip.samples.astype(float)
        converter = converters[i // len(kinds) % len(converters)]
        component = felt_component_of(heard, rate, LEVEL_DB, ActuatorProfile())
        context = ConversionContext(intensity=0.3)
        if component is not None:
            context = replace(
                context,
                own_hz=component.frequency_hz,
                target_hz=component.carrier_hz,
                rough_hz=component.rough_hz,
                band_q=component.band_q,
            )
        built: Any = CONVERTERS.build(converter)
        felt = convert_clip(clip, built, context).samples.astype(float)
        begin = time.process_time()
        seam = find_seam(heard, rate, felt)
        slowest = max(slowest, time.process_time() - begin)
        if kind == "tone":
            phases.append(360 * abs((pitch_hz * seam.length / rate + 0.5) % 1.0 - 0.5))
        lengths.append((seam.length / rate, seam.length / len(heard)))
        is_felt_well = judge(apply_seam(felt, seam.fitted(felt)), felt, rate, rng).passes
        by_converter[converter].append(is_felt_well)
        rows[kind].append((judge(apply_seam(heard, seam), heard, rate, rng).passes, is_felt_well))
    everything = [row for kind in rows.values() for row in kind]
    print(f"loops, {len(everything)} clips: share whose wrap is within the steps of the clip")
    print(f"  {'kind':10} {'clips':>5} {'heard':>7} {'felt':>7}")
    for kind, row in (*rows.items(), ("all", everything)):
        heard_share, felt_share = np.mean(row, axis=0)
        print(f"  {kind:10} {len(row):5} {heard_share:7.1%} {felt_share:7.1%}")
    for converter, passed in sorted(by_converter.items()):
        print(f"  {converter:16} {len(passed):3} clips {np.mean(passed):7.1%} felt")
    long = [share for seconds, share in lengths if seconds / share >= 3.0]
    print(f"  a loop takes {np.median([share for _, share in lengths]):.0%} of its clip in the median")
    short = np.mean([seconds < 2.5 for seconds, share in lengths if seconds / share >= 3.0])
    print(f"  of {len(long)} clips of 3 s and more {short:.0%} give loops below 2.5 s")
    print(
        f"  tones wrap within {max(phases):.2f} degrees; slowest search for a shared seam {slowest:.2f} s of processor"
    )


def chopped_loops(real: dict[str, tuple[Signal, int]], seed: int, draws: int | None) -> None:
    print("loops cut at random: share whose wrap exceeds the steps of the clip")
    for number, kind in enumerate(("tone", "noise")):
        noticed = []
        for i in range(draws or 1500):
            rng = np.random.default_rng([seed, i, number])
            _, x, rate, _ = loop_clip(kind, rng, real)
            noticed.append(not judge(chopped(x, rng), x, rate, rng).passes)
        print(f"  {kind:10} {np.mean(noticed):7.1%} of {len(noticed)}")


def choice(real: dict[str, tuple[Signal, int]], seed: int, draws: int | None) -> None:
    if not HUMS & set(real):
        print("choice: no recordings, nothing to choose")
        return
    won: dict[str, list[bool]] = defaultdict(list)
    table = ""
    for i in range(draws or 200):
        title, candidates = hum_among_decoys(np.random.default_rng([seed, i]), real)
        made = explain_choice(candidates)
        won[title].append(made.winner.credit.title == title)
        if not won[title][-1] or not table:
            table = str(made)
    everything = [each for each_hum in won.values() for each in each_hum]
    print(f"choice, {len(everything)} draws: the hum wins in {np.mean(everything):.1%}")
    for title, row in sorted(won.items()):
        print(f"  {title}: {sum(row)} of {len(row)}")
    print("example table (of a draw that the hum lost, if any):")
    print(table)


CAMPAIGNS = {"frequency": frequency, "loops": loops, "chopped": chopped_loops, "choice": choice}

if __name__ == "__main__":
    main()
