"""Speeds of landings that a session finds, against the true ones, as a table in Markdown.

python benchmarks/closing_speeds.py

A cup falls on a table, or a hand strikes the table with it: a stroke of least jerk over 25 cm in 0.4 s that the table
ends at half, three quarters or nine tenths of its way, while the hand slows down. Frames are of unequal length, from
0.7 to 1.3 of the mean, and positions have Gaussian noise. With a sound card the clock is that of its blocks.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable

import numpy as np

from scene2hap import Box, HapticSession, Pose, SceneObject, SceneSnapshot, Touch, bake

G, REST_S = 9.81, 0.3
FALLS_M = (0.005, 0.01, 0.02, 0.03, 0.05, 0.1, 0.3, 1.0)
ENDS = (0.5, 0.75, 0.9)
STROKE_M, STROKE_S = 0.25, 0.4
TOP_M, RESTS_M = 0.7, 0.76
RATES_HZ = (30, 60, 90, 120, 240)
CASES = (
    ("exact positions", 0.0, 1),
    ("noise of 0.3 mm", 3e-4, 1),
    ("noise of 1 mm", 1e-3, 1),
    ("0.3 mm, blocks of 512 samples", 3e-4, 512),
)

Height = Callable[[float], float]


def fall(height_m: float) -> tuple[Height, float, float]:
    """Height over the table by time, the time of the landing [s], and its speed [m/s]."""
    lands_s = math.sqrt(2 * height_m / G)
    return lambda t: height_m - G / 2 * min(max(t, 0.0), lands_s) ** 2, lands_s, G * lands_s


def stroke(end: float) -> tuple[Height, float, float]:
    """The same for a stroke that the table ends at a share of its way."""
    shares = np.linspace(0.0, 1.0, 100_001)
    done = float(shares[np.searchsorted(shares**3 * (10 - 15 * shares + 6 * shares**2), end)])

    def height_m(t: float) -> float:
        s = min(max(t / STROKE_S, 0.0), done)
        return STROKE_M * (end - s**3 * (10 - 15 * s + 6 * s * s))

    return height_m, done * STROKE_S, 30 * STROKE_M / STROKE_S * (done * (1 - done)) ** 2


def session() -> HapticSession:
    table = SceneObject("wooden table", pose=Pose((0.0, TOP_M / 2, 0.0)), geometry=Box((1.2, TOP_M, 0.8)))
    cup = SceneObject("ceramic cup", pose=Pose((0.0, RESTS_M, 0.0)), geometry=Box((0.08, 0.12, 0.08)))
    scene = SceneSnapshot.build([table, cup])
    return HapticSession(scene, bake(scene))


def speeds(motion: tuple[Height, float, float], rate_hz: float, noise_m: float, block: int, n: int) -> list[float]:
    """Speed of the first landing of each of n motions that made one [m/s]."""
    (height_m, lands_s, _), found = motion, []
    for seed in range(n):
        rng, made, at_sample = np.random.default_rng(seed), session(), 0
        times = np.cumsum(rng.uniform(0.7, 1.3, math.ceil((REST_S + lands_s + 0.3) * rate_hz)) / rate_hz)
        for time_s in times.tolist():
            made.render((stamp := int(time_s * 48_000) // block * block) - at_sample)
            at_sample = stamp
            x, y, z = rng.normal(0.0, noise_m, 3).tolist()
            pose = Pose((x, RESTS_M + height_m(time_s - REST_S) + y, z))
            made.update({"ceramic cup": pose}, [Touch("left", "wooden table", (0.2, TOP_M, 0.0))])
            if made.impacts:
                found.append(made.impacts[-1].speed_m_s)
                break
    return [speed for speed in found if speed is not None]


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--draws", type=int, default=4, help="motions of each kind and rate of frames")
    given = parser.parse_args()
    motions = {f"fall of {100 * height_m:g} cm": fall(height_m) for height_m in FALLS_M}
    motions |= {f"stroke, ended at {100 * end:g} %": stroke(end) for end in ENDS}
    rates = ", ".join(map(str, RATES_HZ))
    print(f"Mean and standard deviation of found over true speed, over frames at {rates} Hz, and the share found.\n")
    print("| motion | true [m/s] | " + " | ".join(name for name, _, _ in CASES) + " |")
    print("|---" * (2 + len(CASES)) + "|")
    for name, motion in motions.items():
        cells = []
        for _, noise_m, block in CASES:
            found = [x / motion[2] for hz in RATES_HZ for x in speeds(motion, hz, noise_m, block, given.draws)]
            share = len(found) / (given.draws * len(RATES_HZ))
            cells.append(f"{np.mean(found):.2f} ± {np.std(found):.2f}, {100 * share:.0f} %" if found else "-")
        print(f"| {name} | {motion[2]:.2f} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
