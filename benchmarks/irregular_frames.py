"""Landings that a session finds in frames of irregular length, as a table in Markdown.

python benchmarks/irregular_frames.py

A hand puts a cup down or shakes it over a table by 1 to 6 m/s2, or the cup falls on the table. The frames are at 60,
72, 90 and 120 Hz, and some are irregular:
- late: every fifth frame misses a refresh of the display;
- stalls: two a second, of 50 to 120 ms;
- half rate: the headset halves its rate of frames and doubles it again;
- blocks: the clock is that of a sound card with blocks of 512 samples;
- uneven calls: the game calls `update` up to a fifth of a frame early or late;
- physics: 50 Hz, shown without interpolation;
- physics and stalls: both.
"""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from cup_over_table import G, Shown, fall, landings_of, put_down, shaken

RATES_HZ = (60, 72, 90, 120)
FALLS_M = (0.02, 0.03, 0.05, 0.1, 0.3, 1.0)
KINDS = ("even", "late", "stalls", "half rate", "blocks", "uneven calls", "physics", "physics and stalls")


def frames(kind: str, hz: int, lasts_s: float, rng: np.random.Generator) -> Shown:
    """Time of the shown pose and of the clock for each frame [s]."""
    n = math.ceil(lasts_s * hz)
    lengths = np.full(n, 1 / hz)
    if kind == "late":
        lengths *= np.where(rng.random(n) < 0.2, 2, 1)
    if kind.endswith("stalls"):
        lengths = np.where(rng.random(n) < 2 / hz, rng.uniform(0.05, 0.12, n), lengths)
    if kind == "half rate":
        lengths *= 1 + np.repeat(np.arange(n) % 2, rng.integers(5, 30, n))[:n]
    clock = np.cumsum(lengths) - rng.uniform(0, 1 / hz)
    clock = clock[clock < lasts_s]
    shown = clock
    if kind == "blocks":
        clock = np.floor(clock * 48_000 / 512) * 512 / 48_000
    if kind == "uneven calls":
        clock = clock + rng.uniform(-0.2, 0.2, len(clock)) / hz
    if kind.startswith("physics"):
        shown = np.floor(shown * 50 + rng.random()) / 50
    return list(zip(shown.tolist(), clock.tolist(), strict=True))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=25, help="motions of each kind and rate of frames")
    given = parser.parse_args()
    n, draws = given.draws * len(RATES_HZ), [(hz, seed) for hz in RATES_HZ for seed in range(given.draws)]
    print(
        f"{n} motions in each cell. Of hands: how many landed. Of falls: the share that was found, none twice, and the"
    )
    print("mean and the least of the found over the true speed.\n")
    print("| motion | " + " | ".join(KINDS) + " |")
    print("|---" * (1 + len(KINDS)) + "|")
    for name, motion in (("put down", put_down), ("shaken", shaken)):
        cells = []
        for kind in KINDS:
            n_landed = 0
            for hz, seed in draws:
                rng = np.random.default_rng((seed, hz))
                height_m, lasts_s = motion(rng)
                n_landed += bool(landings_of(height_m, frames(kind, hz, lasts_s, rng)))
            cells.append(str(n_landed))
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)
    for fall_m in FALLS_M:
        falls_s, cells = math.sqrt(2 * fall_m / G), []
        for kind in KINDS:
            ratios = []
            for hz, seed in draws:
                rng = np.random.default_rng((seed, hz))
                held_s = float(rng.uniform(0.1, 0.6))
                shown = frames(kind, hz, held_s + falls_s + 0.3, rng)
                found = landings_of(fall(fall_m, held_s), shown)
                if len(found) > 1:
                    raise SystemExit(f"a fall of {fall_m} m landed {len(found)} times: {kind}, {hz} Hz, seed {seed}")
                ratios += [one.speed_m_s / (G * falls_s) for one in found]
            cells.append(f"{100 * len(ratios) / n:.3g} %, {np.mean(ratios):.2f}, {min(ratios):.2f}")
        print(f"| fall of {100 * fall_m:g} cm | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
