"""Random motions over a table: no impact for a thing that does not land, one for each landing of a thing that falls.

python stress/landings.py [--seed 0] [--quiet 1000] [--falls 400]

Quiet: a box, a can or a ball rests, slides, rolls, or jitters by 1 mm on the table, in changing directions at up to 1.5
m/s, with sudden stops; half of those that rest or slide jitter as well. None of them may make an impact.
Falls: the same things are dropped from 2 to 80 cm at up to 0.1 m/s sideways, spin about the vertical, and bounce with a
restitution of 0 to 0.8. Times and speeds of their landings are known in closed form. Each landing must make one impact
within three frames, if it is faster than the least speed of docs/impacts.md, the thing fell for 3 frames and 8 mm, and
some frame shows it within 2 cm; any other at most one. Nothing else may make one.

Frames are at 30 to 120 Hz; of quiet motions every tenth misses a refresh. Prints a table in Markdown and each
wrong motion, and exits with 1 if there is any.
"""

from __future__ import annotations

import argparse
import math
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from contact_scenes import box, scene as snapshot_of, thing
from scene2hap import HapticBundle, HapticSession, Pose, TriMesh
from scene2hap.scene.shapes import Box, Geometry
from scene2hap.scene.solids import cylinder, ellipsoid
from scenes import haptics

G, TOP_M, RATES_HZ = 9.81, 0.7, (30, 60, 72, 90, 120)
ROUND_M, HALF_M = 0.04, 0.06
"""Radius of can and ball, and half the height of box and can [m]."""
LATE_FRAMES, LEAST_FRAMES, LEAST_FALL_M, REACH_M = 3, 3, 0.008, 0.02
Frames = list[tuple[float, Pose]]


class Landed(NamedTuple):
    """A landing in closed form: time, speed before and after, and for how long and far the thing fell before."""

    time_s: float
    speed_m_s: float
    rises_m_s: float
    fell_s: float
    fell_m: float


def judged(landings: list[Landed], found_s: list[float], hz: int) -> list[str]:
    """Faults of the impacts at some times, in words."""
    faults, counts = [], [0] * len(landings)
    for time_s in found_s:
        since_s = time_s - (LATE_FRAMES + 0.01) / hz
        just = [i for i, one in enumerate(landings) if since_s <= one.time_s <= time_s + 1e-4]
        if just:  # two bounces may be so near: the one that has none yet, and is faster
            counts[max(just, key=lambda i: (-counts[i], landings[i].speed_m_s))] += 1
        else:
            faults.append(f"an impact at {time_s:.3f} s without a landing")
    for one, n in zip(landings, counts, strict=True):
        if n > 1 or (is_due(one, hz) and not n):
            faults.append(f"{n} impacts of the landing at {one.time_s:.3f} s with {one.speed_m_s:.2f} m/s")
    return faults


def is_due(one: Landed, hz: int) -> bool:
    """Whether a landing must be found; docs/impacts.md: from 0.3 m/s at up to 50 Hz to 0.13 m/s at 120 Hz."""
    least_m_s = min(0.3, 15.5 / hz)
    # A fast bounce may be over between two frames; the nearer one is at most so far from it.
    nearest_m = one.speed_m_s * one.rises_m_s / (one.speed_m_s + one.rises_m_s) / hz
    return (
        one.speed_m_s >= least_m_s
        and nearest_m <= REACH_M
        and one.fell_s >= LEAST_FRAMES / hz
        and one.fell_m >= LEAST_FALL_M
    )


THINGS: dict[str, tuple[Geometry, float]] = {
    "box": (Box((0.08, 2 * HALF_M, 0.08)), HALF_M),
    "can": (TriMesh(cylinder(ROUND_M, HALF_M)[0][:, [1, 2, 0]], cylinder(ROUND_M, HALF_M)[1]), HALF_M),
    "ball": (TriMesh(*ellipsoid((ROUND_M,) * 3)), ROUND_M),
}
"""Geometry, and the height of its middle over the table [m]."""


def impacts_of(name: str, frames: Frames) -> list[float]:
    """Times of the frames whose update counts an impact [s]; one for each impact."""
    table = box("table", (1.6, TOP_M, 1.2), (0.0, TOP_M / 2, 0.0))
    scene = snapshot_of(table, thing("thing", THINGS[name][0], frames[0][1]))
    sizes = {"table": (1.6, 1.2, TOP_M), "thing": (0.08, 0.08, 0.12)}
    objects = {one: haptics("oak", size) for one, size in sizes.items()}
    made, found_s = HapticSession(scene, HapticBundle(scene, "", objects, {})), list[float]()
    after = [(frames[-1][0] + 0.02 * (i + 1), None) for i in range(20)]
    for time_s, pose in [*frames, *after]:
        made.render(round(time_s * 48_000) - made.position)
        before = made.stats.impacts
        made.update({} if pose is None else {"thing": pose})
        found_s += [time_s] * (made.stats.impacts - before)
    return found_s


def frame_times(hz: int, lasts_s: float, rng: np.random.Generator, *, late: float = 0.0) -> list[float]:
    lengths = np.where(rng.random(math.ceil(lasts_s * hz)) < late, 2, 1) / hz
    return [float(0.01 + x) for x in np.cumsum(lengths)]


def turned(x: float, y: float, z: float, turn: Rotation) -> Pose:
    a, b, c, d = turn.as_quat().tolist()
    return Pose((x, y, z), (a, b, c, d))


def walk(times: list[float], rng: np.random.Generator) -> np.ndarray:
    """Places (n, 2) of a motion with sudden changes of its speed, within 0.4 m of the middle [m]."""
    steps, velocity = np.zeros((len(times), 2)), np.zeros(2)
    until, at = 0.0, np.zeros(2)
    for i, (before, now) in enumerate(zip([0.0, *times], times, strict=False)):
        if now > until:
            until = now + rng.uniform(0.05, 0.5)
            velocity = rng.uniform(-1.5, 1.5, 2) * (rng.random() < 0.7)
        after = np.clip(at + velocity * (now - before), -0.4, 0.4)
        steps[i], at = after, after
    return steps


def quiet(kind: str, name: str, hz: int, rng: np.random.Generator) -> tuple[list[Landed], Frames]:
    """No landing, and the frames of a motion. kind : "rests", "jitters", "slides" or "rolls"."""
    times = frame_times(hz, 2.0, rng, late=0.1)
    rests_m, n = TOP_M + THINGS[name][1], len(times)
    turn = Rotation.from_rotvec([0.0, rng.uniform(0, 2 * math.pi), 0.0])
    ways = walk(times, rng) if kind in ("slides", "rolls") else np.zeros((n, 2))
    is_shaken = kind == "jitters" or (kind != "rolls" and rng.random() < 0.5)
    shakes = rng.uniform(-1e-3, 1e-3, (n, 3)) if is_shaken else np.zeros((n, 3))
    if kind == "rolls":
        rests_m = TOP_M + ROUND_M
        if name == "can":  # lies along z, and rolls along x
            turn, ways[:, 1] = Rotation.from_rotvec([math.pi / 2, 0.0, 0.0]), 0.0
    before, frames = ways[0], []
    for time_s, (x, z), (dx, dy, dz) in zip(times, ways.tolist(), shakes.tolist(), strict=True):
        if kind == "rolls":
            turn = Rotation.from_rotvec([(z - before[1]) / ROUND_M, 0.0, -(x - before[0]) / ROUND_M]) * turn
            before = (x, z)
        frames.append((time_s, turned(x + dx, rests_m + dy, z + dz, turn)))
    return [], frames


def bounces(height_m: float, restitution: float, begins_s: float) -> list[Landed]:
    """All landings of a dropped thing until it is slower than 5 cm/s, after which it rests."""
    fell_s = math.sqrt(2 * height_m / G)
    found = [Landed(begins_s + fell_s, G * fell_s, restitution * G * fell_s, fell_s, height_m)]
    while (speed := found[-1].rises_m_s) > 0.05:
        again = restitution * speed
        found.append(Landed(found[-1].time_s + 2 * speed / G, speed, again, speed / G, speed**2 / (2 * G)))
    return found


def height_at(time_s: float, landings: list[Landed], restitution: float) -> float:
    """Height over the rest [m] of a thing with these landings."""
    first = landings[0]
    if time_s <= first.time_s:
        return first.fell_m - G / 2 * max(0.0, time_s - (first.time_s - first.fell_s)) ** 2
    last = [one for one in landings if one.time_s < time_s][-1]
    up, t = restitution * last.speed_m_s, time_s - last.time_s
    return max(0.0, up * t - G / 2 * t * t) if last is not landings[-1] else 0.0


def fall(_: str, name: str, hz: int, rng: np.random.Generator) -> tuple[list[Landed], Frames]:
    """Landings of a dropped thing, and its frames."""
    restitution = float(rng.choice([0.0, rng.uniform(0.0, 0.8)]))
    landings = bounces(float(np.exp(rng.uniform(math.log(0.02), math.log(0.8)))), restitution, rng.uniform(0.1, 0.5))
    begins_s, end_s = landings[0].time_s - landings[0].fell_s, landings[-1].time_s
    across, spin = rng.uniform(-0.07, 0.07, 2), float(rng.uniform(-6.0, 6.0))
    frames = []
    for time_s in frame_times(hz, end_s + 0.3, rng):
        moved_s = min(max(0.0, time_s - begins_s), end_s - begins_s)
        y = TOP_M + THINGS[name][1] + height_at(time_s, landings, restitution)
        turn = Rotation.from_rotvec([0.0, spin * moved_s, 0.0])
        frames.append((time_s, turned(float(across[0]) * moved_s, y, float(across[1]) * moved_s, turn)))
    return landings, frames


QUIET = [("rests", name) for name in THINGS] + [("jitters", name) for name in THINGS]
QUIET += [("slides", name) for name in THINGS] + [("rolls", "can"), ("rolls", "ball")]
FALLS = [("falls", name) for name in THINGS]


def faults_of(
    n: int, seed: int, kinds: list[tuple[str, str]], motion: Callable[..., tuple[list[Landed], Frames]]
) -> list[str]:
    """Faults of motions of each kind in turn. Prints a row for each kind."""
    rows = {kind: np.zeros(5, int) for kind in kinds[:n]}
    faults = []
    for i in range(n):
        kind, rng = kinds[i % len(kinds)], np.random.default_rng((seed, i))
        hz = int(rng.choice(RATES_HZ))
        landings, frames = motion(*kind, hz, rng)
        found_s = impacts_of(kind[1], frames)
        wrong = judged(landings, found_s, hz)
        rows[kind] += [1, len(landings), sum(is_due(one, hz) for one in landings), len(found_s), bool(wrong)]
        faults += [f"{' '.join(kind)} {i} at {hz} Hz: {one}" for one in wrong]
    for (does, name), cells in rows.items():
        print(f"| {name} {does} | " + " | ".join(map(str, cells)) + " |", flush=True)
    return faults


def main() -> int:
    """Judge all motions. Returns 1 if one is wrong."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--quiet", type=int, default=1000, help="motions without a landing (1000)")
    parser.add_argument("--falls", type=int, default=400, help="falls (400)")
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    print(f"seed {given.seed}\n\n| motion | drawn | landings | to be found | impacts | wrong |\n" + "|---" * 6 + "|")
    faults = faults_of(given.quiet, given.seed, QUIET, quiet) + faults_of(given.falls, given.seed, FALLS, fall)
    print("\n" + "\n".join(f"* {one}" for one in faults) if faults else "\nno motion is wrong")
    return int(bool(faults))


if __name__ == "__main__":
    raise SystemExit(main())
