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
from collections.abc import Callable

import numpy as np

from scene2hap import Box, Pose, SceneObject, SceneSnapshot
from scene2hap.contact.graph import ContactGraph
from scene2hap.session.impacts.landings import Landing, Landings

G, TOP_M, RESTS_M, RATES_HZ = 9.81, 0.7, 0.76, (60, 72, 90, 120)
FALLS_M = (0.02, 0.03, 0.05, 0.1, 0.3, 1.0)
KINDS = ("even", "late", "stalls", "half rate", "blocks", "uneven calls", "physics", "physics and stalls")

Height = Callable[[float], float]


def frames(kind: str, hz: int, lasts_s: float, rng: np.random.Generator) -> list[tuple[float, float]]:
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


def put_down(rng: np.random.Generator) -> tuple[Height, float]:
    """Height over the table by time of a stroke of least jerk, and its duration with a rest before and after [s]."""
    height_m, most_m_s2 = float(rng.uniform(0.02, 0.3)), float(rng.uniform(1, 6))
    lasts_s = math.sqrt(10 / math.sqrt(3) * height_m / most_m_s2)

    def at(time_s: float) -> float:
        s = min(max(0.0, (time_s - 0.2) / lasts_s), 1.0)
        return height_m * (1 - s**3 * (10 - 15 * s + 6 * s * s))

    return at, lasts_s + 0.5


def shaken(rng: np.random.Generator) -> tuple[Height, float]:
    """The same of a motion up and down, to 0 to 2 cm over the table."""
    hz, most_m_s2, gap_m = float(rng.uniform(1, 8)), float(rng.uniform(1, 6)), float(rng.uniform(0, 0.02))
    swing_m, end_s = most_m_s2 / (2 * math.pi * hz) ** 2, 0.3 + math.floor(1.5 * hz) / hz

    def at(time_s: float) -> float:
        return gap_m + swing_m * (1 + math.cos(2 * math.pi * hz * (min(max(0.3, time_s), end_s) - 0.3)))

    return at, 2.0


def landings_of(height_m: Height, shown: list[tuple[float, float]]) -> list[Landing]:
    """The landings of the cup, until half a second after the last frame."""
    table = SceneObject("table", pose=Pose((0.0, TOP_M / 2, 0.0)), geometry=Box((1.2, TOP_M, 0.8)))
    cup = SceneObject("cup", pose=Pose((0.0, RESTS_M + height_m(0.0), 0.0)), geometry=Box((0.08, 0.12, 0.08)))
    graph, found, half_m = ContactGraph(SceneSnapshot.build([table, cup])), list[Landing](), {"cup": (0.04, 0.06, 0.04)}
    landings = Landings(
        graph,
        lambda object_id: (0.0, 0.0, 0.0),
        lambda object_id: half_m.get(object_id, (0.6, TOP_M / 2, 0.4)),
        lambda object_id, way: None,
        lambda object_id, other: None,
        1 / 90,
        1,
    )
    rest = [(None, shown[-1][1] + 0.011 * (i + 1)) for i in range(45)]
    for pose_s, time_s in [*shown, *rest]:
        poses = {} if pose_s is None else {"cup": Pose((0.0, RESTS_M + height_m(pose_s), 0.0))}
        landings.begin(poses, time_s)
        graph.update(poses)
        found += landings.look(poses, time_s)
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=25, help="motions of each kind and rate of frames")
    given = parser.parse_args()
    n, draws = given.draws * len(RATES_HZ), [(hz, seed) for hz in RATES_HZ for seed in range(given.draws)]
    print(
        f"{n} motions in each cell: those that landed, or for falls the share found, never twice, and found over true"
    )
    print("speed: mean and least.\n")
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
                found = landings_of(
                    lambda t, h=fall_m, a=held_s, b=falls_s: h - G / 2 * min(max(0.0, t - a), b) ** 2, shown
                )
                if len(found) > 1:
                    raise SystemExit(f"a fall of {fall_m} m landed {len(found)} times: {kind}, {hz} Hz, seed {seed}")
                ratios += [one.speed_m_s / (G * falls_s) for one in found]
            cells.append(f"{100 * len(ratios) / n:.3g} %, {np.mean(ratios):.2f}, {min(ratios):.2f}")
        print(f"| fall of {100 * fall_m:g} cm | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
