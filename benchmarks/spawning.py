"""Time on the game's thread for adding and removing copies of a prefab, as a table in Markdown.

OMP_NUM_THREADS=1 python benchmarks/spawning.py
OMP_NUM_THREADS=1 python benchmarks/spawning.py --alive 50 --scene kitchen.glb --seed 2

With a scene, copies are added at free spots of its floor, 20 cm apart, in a random order given by the seed; otherwise
on a single table. Copies are added at 50 Hz and removed some seconds later; the session is rendered between the calls.
A click is the level above 1 kHz in 250 ms, relative to the level of the minute or of these 250 ms, whichever is larger.
"""

from __future__ import annotations

import argparse
import cProfile
import gc
import os
import platform
import pstats
import time
import tracemalloc
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.signal import firwin, oaconvolve

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
    bake,
    load_scene,
    materials,
)
from scene2hap.contact.graph import ContactGraph

SPAWN_HZ, RATE_HZ, N_COLUMNS = 50, 48_000, 20
SIZE_M = (0.1, 0.1, 0.1)
FLAT = (-(0.5**0.5), 0.0, 0.0, 0.5**0.5)


def thing(name: str, size_m: tuple[float, float, float], at_m: tuple[float, float, float]) -> SceneObject:
    """Make a cuboid with y up, whose dominant surface is its top."""
    x, y, z = size_m
    surface = DominantSurface(Pose((-x / 2, 0.0, z / 2), FLAT), x, z, y)
    return SceneObject(name, name, Pose(at_m), Box(size_m), surface)


def bundle_of(item: SceneObject, material: str, frequency_hz: float | None) -> HapticBundle:
    """Make a prefab without inference. It vibrates if a frequency is given."""
    states = () if frequency_hz is None else (SourceState("on", 0.5, "motor", "motor"),)
    haptics = ObjectHaptics(
        item.name, material, materials.lookup(material), item.size_m, "stands", states != (), states
    )
    loops = {}
    if frequency_hz is not None:
        samples = 0.02 * np.sin(2 * np.pi * frequency_hz * np.arange(8000) / 8000)
        clip = AudioClip(samples.astype(np.float32), 8000)
        loops = {item.id: {"on": HapticLoop(clip, clip, frequency_hz, frequency_hz)}}
    return HapticBundle(SceneSnapshot(item.name, "y", (item,)), "", {item.id: haptics}, loops)


def timed(call: Callable[[], object], of: NDArray[np.float64]) -> None:
    """Call a function, and write processor and wall time (2,) [ms] into `of`."""
    wall, own = time.perf_counter(), time.thread_time()
    call()
    of[:] = 1e3 * (time.thread_time() - own), 1e3 * (time.perf_counter() - wall)


def resident_mib() -> float:
    """Resident memory of this process [MiB]; needs Linux."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


def on_table(n_spots: int) -> tuple[HapticSession, list[Touch], list[Pose]]:
    """Session with a table, a touch on the table, and spots where copies do not touch each other."""
    table = bundle_of(thing("table", (8.0, 0.05, 4.0), (0.0, 0.7, 0.0)), "oak", None)
    session = HapticSession(table.snapshot, table, {"sample_rate_hz": RATE_HZ})
    places = [divmod(n, N_COLUMNS) for n in range(n_spots)]
    spots = [Pose((0.3 * column - 2.9, 0.775, 0.3 * row - 1.4)) for row, column in places]
    return session, [Touch("left", "table", (-1.5, 0.725, -1.2))], spots


def on_floor(path: str, seed: int, fall_m: float = 0.0) -> tuple[HapticSession, list[Touch], list[Pose]]:
    """Session of a scene with y up, a touch on its floor, and spots where a copy touches only the floor, also while it
    falls from a height."""
    scene = load_scene(path)
    session = HapticSession(bake(scene), config={"sample_rate_hz": RATE_HZ})
    floor = next(item for item in scene.objects if "floor" in item.name.lower())
    (x0, _, z0), (x1, top, z1) = floor.bounds_m
    (width, height, depth), spots, graph = SIZE_M, [], ContactGraph(scene)
    column = thing("cup", (width, height + fall_m, depth), (0.0, 0.0, 0.0))
    for x in np.arange(x0 + 0.3, x1 - 0.3, 0.2):
        for z in np.arange(z0 + 0.3, z1 - 0.3, 0.2):
            around = Pose((float(x), top + (height + fall_m) / 2, float(z)))
            graph.update({}, added=[replace(column, pose=around)])
            if graph.neighbours(column.id) == (floor.id,):
                spots.append(Pose((float(x), top + height / 2, float(z))))
            graph.update({}, removed=[column.id])
    np.random.default_rng(seed).shuffle(spots)
    return session, [Touch("left", floor.id, ((x0 + x1) / 2, top, (z0 + z1) / 2))], spots


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--alive", type=int, default=200)
    parser.add_argument("--profile", action="store_true")
    parser.add_argument("--memory", action="store_true", help="trace allocations too, which makes all times longer")
    parser.add_argument("--scene", help="a scene file with y up and a floor")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()

    session, touches, spots = on_floor(given.scene, given.seed) if given.scene else on_table(given.alive)
    prefab = bundle_of(thing("cup", SIZE_M, (0.0, 0.0, 0.0)), "plastic", 120.0)
    n_steps, n_warm, before_mib = round(given.seconds * SPAWN_HZ), 0, 0.0
    n_block = RATE_HZ // SPAWN_HZ
    # Allocated and filled in advance, so that these arrays do not count as growth of memory.
    heard = np.full((n_steps, n_block), np.nan, dtype=np.float32)
    adds, removes, updates = np.full((3, n_steps, 2), np.nan)
    profile = cProfile.Profile()
    # As docs/spawning.md advises: otherwise a full collection visits all objects that the program has loaded.
    gc.collect()
    gc.freeze()
    for n in range(n_steps):
        if n == min(2 * given.alive, n_steps // 2):
            gc.collect()
            if given.memory:
                tracemalloc.start()
            n_warm, before_mib = n, resident_mib()
        # The table is filled row by row; then a new copy takes the place of the removed one.
        pose = spots[n % (len(spots) if given.scene else given.alive)]
        if given.profile:
            profile.enable()
        if n >= given.alive:
            timed(partial(session.remove, f"cup_{n - given.alive}"), removes[n])
        timed(partial(session.spawn, prefab, f"cup_{n}", pose), adds[n])
        timed(partial(session.update, touches=touches), updates[n])
        profile.disable()
        heard[n] = session.render(n_block)[:, 0]
    gc.collect()
    grown_mib = resident_mib() - before_mib
    traced_mib = tracemalloc.get_traced_memory()[0] / 2**20
    print(f"Python {platform.python_version()}, {platform.machine()}, {os.cpu_count()} cores; {n_steps} copies,")
    print(f"{SPAWN_HZ} a second, up to {given.alive} at once\n")
    print("| call | processor p50 [ms] | p99 [ms] | worst [ms] | wall p50 [ms] | p99 [ms] | worst [ms] |")
    print("|---|---|---|---|---|---|---|")
    for name, times in (("spawn", adds), ("remove", removes), ("update after both", updates)):
        own, wall = times[given.alive if times is removes else 0 :].T
        if own.size:
            cells = [f"{x:.2f}" for t in (own, wall) for x in (*np.percentile(t, (50, 99)), t.max())]
            print(f"| {name} | {' | '.join(cells)} |")
    x = heard.ravel().astype(np.float64)
    high = oaconvolve(x, firwin(2801, 940, pass_zero="highpass", window=("kaiser", 10.06), fs=RATE_HZ), mode="same")
    n = RATE_HZ // 4
    parts = [slice(i, i + n) for i in range(n, len(x) - n, n)]
    whole = np.mean(x**2) + 1e-30
    worst = max(
        (10 * np.log10(np.mean(high[p] ** 2) / max(np.mean(x[p] ** 2), whole) + 1e-30) for p in parts), default=-300
    )
    print(f"\nworst click {worst:.0f} dB; resident memory {grown_mib:+.1f} MiB after copy {n_warm}")
    if given.memory:
        print(f"traced growth {traced_mib:+.2f} MiB")
    if given.profile:
        pstats.Stats(profile).sort_stats("tottime").print_stats(22)


if __name__ == "__main__":
    main()
