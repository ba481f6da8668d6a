"""Time of a session during play, as tables in Markdown; docs/figures/playing.md holds the latest.

OMP_NUM_THREADS=1 python benchmarks/session.py

Times are processor times, the least of many short runs, so that other programs disturb them little. The rows that say
"wall" are wall times, since they measure waiting.
"""

from __future__ import annotations

import argparse
import os
import platform
import time
import warnings
from collections.abc import Callable, Sequence
from importlib.metadata import version
from typing import Any

import numpy as np

from scene2hap import (
    AudioClip,
    Box,
    DominantSurface,
    HapticBundle,
    HapticLoop,
    HapticSession,
    ObjectHaptics,
    Pose,
    SceneObject,
    SceneSnapshot,
    SourceState,
    Touch,
    materials,
)
from scene2hap.propagation.domain import ThinPlateWarning

RATE_HZ = 8000
UPRIGHT = (-(0.5**0.5), 0.0, 0.0, 0.5**0.5)
SEED = 5
FRAME_S = 0.02


class Room:
    """Tables in a row with objects on them, some of which vibrate. y is up."""

    def __init__(self, n_tables: int, n_things: int, n_sources: int) -> None:
        self.objects: list[SceneObject] = []
        self.haptics: dict[str, ObjectHaptics] = {}
        self.tables = [f"table {i}" for i in range(n_tables)]
        self.things = [f"thing {i}" for i in range(n_things)]
        for i, name in enumerate(self.tables):
            self._put(name, (1.4, 0.02, 0.8), (2.0 * i, 0.71, 0.0), "oak")
        for i, name in enumerate(self.things):
            # A fifth are sheets that bend, the rest compact.
            size = (0.3, 0.004, 0.2) if i % 5 == 4 else (0.12, 0.08, 0.1)
            row, column = divmod(i // n_tables, 4)
            at = (2.0 * (i % n_tables) - 0.5 + 0.33 * column, 0.72 + size[1] / 2, -0.3 + 0.25 * row)
            self._put(name, size, at, ("steel", "plastic")[i % 2], vibrates=i < n_sources)
        snapshot = SceneSnapshot("room", "y", tuple(self.objects))
        loops = {name: {"on": tone(60 + 37 * i)} for i, name in enumerate(self.things[:n_sources])}
        self.bundle = HapticBundle(snapshot, "room", self.haptics, loops)

    def _put(self, name: str, size_m: Any, at: Any, material: str, *, vibrates: bool = False) -> None:
        x, y, z = size_m
        surface = DominantSurface(Pose((-x / 2, 0.0, z / 2), UPRIGHT), x, z, y)
        self.objects.append(SceneObject(name, name, Pose(at), Box(size_m), surface))
        states = (SourceState("on", 0.5, "thing on", "thing hum"),) if vibrates else ()
        made_of = materials.lookup(material)
        self.haptics[name] = ObjectHaptics("thing", material, made_of, (x, z, y), "stands there", vibrates, states)

    def session(self, **config: Any) -> HapticSession:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ThinPlateWarning)
            session = HapticSession(self.bundle.snapshot, self.bundle, {"sample_rate_hz": RATE_HZ, **config})
            session.wait_prepared()
            return session


def tone(frequency_hz: float) -> HapticLoop:
    samples = 0.3 * np.sin(2 * np.pi * round(frequency_hz) * np.arange(RATE_HZ) / RATE_HZ)
    clip = AudioClip(samples.astype(np.float32), RATE_HZ)
    return HapticLoop(clip, clip, frequency_hz, frequency_hz)


def best_of(
    work: Callable[[int], object],
    n_each: int = 50,
    n_times: int = 40,
    tidy_up: Callable[[], object] = lambda: None,
) -> float:
    """Processor time per call [s], the least of many short runs; `tidy_up` after a run is not counted."""
    best = np.inf
    for turn in range(n_times):
        begin = time.thread_time()
        for i in range(n_each):
            work(turn * n_each + i)
        best = min(best, (time.thread_time() - begin) / n_each)
        tidy_up()
    return best


def points(n: int, rng: np.random.Generator) -> list[tuple[float, float]]:
    return [(float(x), float(z)) for x, z in zip(rng.uniform(-0.6, 0.6, n), rng.uniform(-0.35, 0.35, n), strict=True)]


def at_rest(kind: str, bands: str) -> tuple[float, float]:
    """Times of an update [s] with two hands and eight sources: hands at rest, and hands that slide over a table."""
    rng = np.random.default_rng(SEED)
    s = Room(2, 16, 8).session(propagation=kind, bands=bands)
    frames = [
        [Touch("left", "table 0", (x, 0.72, z)), Touch("right", "table 1", (2.0 + u, 0.72, w))]
        for (x, z), (u, w) in zip(points(2000, rng), points(2000, rng), strict=True)
    ]
    resting = best_of(lambda i: s.update(touches=frames[0]))
    return resting, best_of(lambda i: s.update(touches=frames[i]))


def fresh_points() -> float:
    """Updates per second of processor time, with a new point on each of five objects in every update."""
    rng = np.random.default_rng(SEED)
    s = Room(5, 20, 2).session()
    frames = [
        [
            Touch(("left", "right")[i % 2], f"table {i}", (2.0 * i + x, 0.72, z))
            for i, (x, z) in enumerate(points(5, rng))
        ]
        for _ in range(2000)
    ]

    return 1 / best_of(lambda i: s.update(touches=frames[i]), tidy_up=lambda: s.render(80))


def moving(kind: str, bands: str, seconds: float) -> dict[str, float]:
    """Measure a game of 50 frames per second, in which five of fifty objects move in every frame."""
    s = Room(5, 45, 8).session(propagation=kind, bands=bands)
    movers = ["thing 1", "thing 12", "thing 23", "thing 24", "thing 30"]
    homes = {name: s.snapshot.object(name).pose.position_m for name in movers}
    walls, processors, latencies, ages = [], [], [], []
    next_s = time.perf_counter()
    for i in range(round(seconds / FRAME_S)):
        shift = 0.03 * np.sin(0.1 * i)
        moved = {name: Pose((x + shift, y, z)) for name, (x, y, z) in homes.items()}
        touches = [
            Touch("left", "table 0", (0.1 + 0.3 * shift, 0.72, 0.1)),
            Touch("right", "table 2", (4.1, 0.72, 0.1 + shift)),
        ]
        begin, begin_cpu = time.perf_counter(), time.thread_time()
        s.update(moved, touches)
        walls.append(time.perf_counter() - begin)
        processors.append(time.thread_time() - begin_cpu)
        stats = s.stats
        latencies.append(stats.field_latency_s)
        ages.append(stats.field_age_s)
        next_s += FRAME_S
        time.sleep(max(0.0, next_s - time.perf_counter()))
    return {
        "update p50 (processor), us": 1e6 * percentile(processors, 50),
        "update p99 (processor), us": 1e6 * percentile(processors, 99),
        "update p99 (wall), us": 1e6 * percentile(walls, 99),
        "change to field in use p50 (wall), ms": 1e3 * percentile(latencies, 50),
        "change to field in use p99 (wall), ms": 1e3 * percentile(latencies, 99),
        "fields": s.stats.fields_prepared,
    }


def percentile(values: Sequence[float], which: float) -> float:
    # The first ten frames are left out: caches are empty.
    return float(np.percentile(values[10:], which))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=10.0, help="length of each moving scene (10)")
    arguments = parser.parse_args()
    warnings.simplefilter("ignore", ThinPlateWarning)
    print("| at rest, 2 hands, 8 sources | hands rest, us | hands slide, us | slide over ExponentialPlate |")
    print("|---|---|---|---|")
    for bands in ("dominant", "third-octaves"):
        law = np.nan
        for kind in ("exponential_plate", "infinite_plate", "modal_plate"):
            resting, gliding = at_rest(kind, bands)
            law = gliding if kind == "exponential_plate" else law
            print(f"| {kind}, {bands} | {1e6 * resting:.0f} | {1e6 * gliding:.0f} | {gliding / law:.1f} |", flush=True)
    print(f"\nFresh points on five objects: {fresh_points():,.0f} updates/s\n", flush=True)
    print("| 50 objects, 5 move in every frame | value |\n|---|---|")
    for kind, bands in (
        ("exponential_plate", "dominant"),
        ("modal_plate", "dominant"),
        ("modal_plate", "third-octaves"),
    ):
        for name, value in moving(kind, bands, arguments.seconds).items():
            print(f"| {kind}, {bands}: {name} | {value:,.0f} |", flush=True)
    load = ", ".join(f"{x:.1f}" for x in os.getloadavg())
    print(f"\nMachine: {platform.system()} {platform.machine()}, {os.cpu_count()} cores, load {load}; Python ", end="")
    print(f"{platform.python_version()}, numpy {version('numpy')}, scipy {version('scipy')}; seed {SEED}.")


if __name__ == "__main__":
    main()
