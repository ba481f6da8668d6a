"""Time of a frame in scene2hap and in a plain version of the paper's loop, as tables in Markdown.

OMP_NUM_THREADS=1 python benchmarks/paper_loop.py [n_frames] [--defaults] [--seed N]

`--defaults` measures default settings (any number of contacts) instead, in three rooms drawn from a seed, which is new
in each run. It also prints the mean time of a frame for pairs of meshes, for other work on contacts, and for the rest
of the session. The other tables limit `ExponentialPlate` to two contacts, as in the paper's loop.

The plain loop does the following once per frame. It compares each bounding box with all others and builds a networkx
graph. It follows all paths of up to two contacts from every touch to every source, depth first, and computes one
exponential (of 20 bands) per path. It is compared with `HapticSession.update` as a game calls it, and with scene2hap's
parts alone (graph, paths, gains). All get the same frames of the same room (`busy_room`), in turns. Times are medians
of processor time, so that other programs disturb them little.

The 99th percentile over the median is given only for sessions. All frames are run in several passes, each by a new
session. The values are those of the middle pass, of the best and of the worst pass, and of the least time of each frame
in any pass. The last one leaves out disturbances by other programs.
"""

from __future__ import annotations

import argparse
import gc
import math
import os
import platform
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise

import networkx as nx
import numpy as np
from busy_room import BusyRoom, busy_room, floor_room, furnished_room, shelf_room

from scene2hap import Bands, HapticSession, Plate, Pose, Touch
from scene2hap.contact.broad_phase import BroadPhase
from scene2hap.contact.graph import ContactGraph
from scene2hap.contact.mesh_distance import MeshPair
from scene2hap.propagation.bands.band_rms import BandRms
from scene2hap.propagation.paths.live_law import LiveLaw, LivePaths
from scene2hap.session.gains.audibility import Audibility
from scene2hap.session.mix.loop_mixers import LoopMixers

Clock = Callable[[], float]

BANDS = Bands.third_octaves(10, 1000)
N_HOPS = 2
TOLERANCE_M = 0.004
_IN_A_ROW = 50
_N_PASSES = 11


class PaperLoop:
    """The paper's loop in plain code."""

    def __init__(self, room: BusyRoom) -> None:
        self.ids = [item.id for item in room.scene.objects]
        self.row = {name: i for i, name in enumerate(self.ids)}
        self.corners = [np.unique(item.geometry.mesh.vertices_m, axis=0) for item in room.scene.objects]
        bounds = np.array([item.bounds_m for item in room.scene.objects])
        self.low, self.high = bounds[:, 0].copy(), bounds[:, 1].copy()
        omega = 2 * np.pi * np.sqrt(np.prod(BANDS.widths_hz(), axis=1))
        self.k = {}
        for name, haptics in room.bundle.objects.items():
            m, h = haptics.material, haptics.estimated_size_m[2]
            assert m is not None
            stiffness = m.youngs_modulus_pa * h**3 / (12 * (1 - m.poisson_ratio**2))
            self.k[name] = (m.density_kg_m3 * h * omega**2 / stiffness) ** 0.25
        self.sources = list(room.bundle.loops)

    def update(self, moved: dict[str, Pose], touches: Sequence[Touch]) -> np.ndarray:
        for name, pose in moved.items():
            points = pose.to_world(self.corners[self.row[name]])
            self.low[self.row[name]], self.high[self.row[name]] = points.min(axis=0), points.max(axis=0)
        graph = self.graph()
        gains = np.zeros((2, len(self.sources), BANDS.n_bands))
        for hand, touch in enumerate(touches):
            for path in nx.all_simple_paths(graph, touch.object_id, set(self.sources), cutoff=N_HOPS):
                here, loss = np.asarray(touch.point_m), np.zeros(BANDS.n_bands)
                for a, b in pairwise(path):
                    there = graph.edges[a, b]["point"]
                    loss = loss + self.k[a] * np.linalg.norm(there - here)
                    here = there
                row = self.sources.index(path[-1])
                gains[hand, row] = np.maximum(gains[hand, row], np.exp(-loss))
        return gains

    def graph(self) -> nx.Graph[str]:
        low, high = self.low - TOLERANCE_M / 2, self.high + TOLERANCE_M / 2
        meet = ((low[:, None] <= high) & (high[:, None] >= low)).all(axis=2)
        graph: nx.Graph[str] = nx.Graph()
        graph.add_nodes_from(self.ids)
        for i, j in np.argwhere(np.triu(meet, 1)):
            point = (np.maximum(low[i], low[j]) + np.minimum(high[i], high[j])) / 2
            graph.add_edge(self.ids[i], self.ids[j], point=point)
        return graph


class OurLoop:
    """The same frame with scene2hap's parts alone: graph, paths, gains."""

    def __init__(self, room: BusyRoom) -> None:
        self.graph = ContactGraph(room.scene)
        wavenumbers = {
            name: Plate(*haptics.estimated_size_m, haptics.material).wavenumber_per_root_omega
            for name, haptics in room.bundle.objects.items()
            if haptics.material is not None
        }
        self.sources = list(room.bundle.loops)
        self.paths = LivePaths(self.graph, wavenumbers, _crossing, self.sources, N_HOPS)
        self.gains = BandRms(BANDS.edges_hz)

    def update(self, moved: dict[str, Pose], touches: Sequence[Touch]) -> np.ndarray:
        self.graph.update(moved)
        return self.felt(self.lengths(touches))

    def lengths(self, touches: Sequence[Touch]) -> list[list[float]]:
        """Least path cost from each source to each hand; the nearest touch of a hand has the largest gain."""
        by_hand: dict[str, list[tuple[str, tuple[float, float, float]]]] = {}
        for touch in touches:
            by_hand.setdefault(touch.hand, []).append((touch.object_id, touch.point_m))
        return [self.paths.least_costs(touched) for touched in by_hand.values()]

    def felt(self, costs: list[list[float]]) -> np.ndarray:
        return self.gains([cost for row in costs for cost in row]).reshape(len(costs), -1, BANDS.n_bands)


def _crossing(weight: float) -> float:
    return -math.log(weight) / math.sqrt(2 * math.pi * 250.0) if weight > 0 else math.inf


def session_of(room: BusyRoom, max_hops: int | None = N_HOPS) -> HapticSession:
    config = {"propagation": {"kind": "exponential_plate", "max_hops": max_hops}, "bands": BANDS}
    return HapticSession(room.scene, room.bundle, config)


def times_of(steps: Sequence[Callable[[int], object]], n_frames: int, clock: Clock, warm: int = 20) -> np.ndarray:
    """Times (n_steps, n_frames) [s] of the steps, which take turns of `_IN_A_ROW` frames."""
    taken = np.empty((len(steps), warm + n_frames))
    for first in range(0, warm + n_frames, _IN_A_ROW):
        for row, step in enumerate(steps):
            for i in range(first, min(first + _IN_A_ROW, warm + n_frames)):
                start = clock()
                step(i)
                taken[row, i] = clock() - start
    return taken[:, warm:]


def frames_of(room: BusyRoom, n_frames: int) -> list[tuple[dict[str, Pose], list[Touch]]]:
    return [(room.frame(i), room.touches(i)) for i in range(n_frames + 20)]


def compared(n_objects: int, kind: str, n_frames: int) -> None:
    """Print medians, measured in turns, and the 99th percentile over the median of sessions with garbage collection."""
    room = busy_room(n_objects, kind)
    plain, ours, session = PaperLoop(room), OurLoop(room), session_of(room)
    frames = frames_of(room, n_frames)
    few = n_frames if n_objects < 500 else min(n_frames, 60)
    steps = [lambda i, loop=loop: loop.update(*frames[i]) for loop in (plain, session, ours)]
    slow, whole, parts = np.median(times_of(steps, few, time.thread_time), axis=1)
    alone = np.array([alone_in(room, frames, n_frames) for _ in range(_N_PASSES)])
    best, middle, worst = np.percentile([worst_of(one) for one in alone], (0, 50, 100))
    print(
        f"| {n_objects} | {kind} | {1e3 * slow:.3f} | {1e3 * whole:.4f} | {slow / whole:.1f} | {middle:.2f} "
        f"({best:.2f}-{worst:.2f}), {worst_of(alone.min(axis=0)):.2f} | {1e3 * parts:.4f} | {slow / parts:.1f} |"
    )


def default_settings(n_frames: int, seed: int) -> None:
    """Compare sessions over any number of contacts with the plain loop over two, in rooms drawn from the seed."""
    print(f"\nDefault settings, seed {seed}.\n")
    print(
        "| room | objects | plain loop [ms] | HapticSession [ms] | ratio | p99 / median | triangles [ms] "
        "| other contacts [ms] | rest [ms] |\n|---|---|---|---|---|---|---|---|---|"
    )
    for draw in (shelf_room, furnished_room, floor_room):
        for n_objects in (50, 1000):
            room = draw(n_objects, seed)
            plain, session, frames = PaperLoop(room), session_of(room, None), frames_of(room, n_frames)
            few = n_frames if n_objects < 500 else min(n_frames, 40)
            steps = [lambda i, loop=loop, f=frames: loop.update(*f[i]) for loop in (plain, session)]
            slow, whole = np.median(times_of(steps, few, time.thread_time), axis=1)
            alone = np.array([alone_in(room, frames, n_frames, None) for _ in range(3)])
            print(
                f"| {draw.__name__} | {n_objects} | {1e3 * slow:.3f} | {1e3 * whole:.4f} | {slow / whole:.1f} | "
                f"{np.median([worst_of(one) for one in alone]):.2f}, {worst_of(alone.min(axis=0)):.2f} | "
                + " | ".join(f"{1e3 * part:.3f}" for part in parts_of(room, frames))
                + " |",
                flush=True,
            )


def parts_of(room: BusyRoom, frames: Sequence[tuple[dict[str, Pose], list[Touch]]]) -> tuple[float, float, float]:
    """Mean time of a frame [s] for pairs of meshes, for other work on contacts, and for the rest of the session."""
    session, watch = session_of(room, None), Stopwatch()
    for moved, touches in frames[:20]:
        session.update(moved, touches)
    meshes = {name: (MeshPair, name) for name in ("gap", "patch", "drops", "first_drop_m")}
    with watch.watch(**meshes, contacts=(ContactGraph, "update"), session=(HapticSession, "update")):
        for moved, touches in frames[20:]:
            session.update(moved, touches)
    each = {name: spent / (len(frames) - 20) for name, spent in watch.spent.items()}
    return sum(each[name] for name in meshes), each["contacts"], each["session"]


def alone_in(
    room: BusyRoom,
    frames: Sequence[tuple[dict[str, Pose], list[Touch]]],
    n_frames: int,
    max_hops: int | None = N_HOPS,
) -> np.ndarray:
    """Times (n_frames,) [s] of the updates of a new session."""
    session = session_of(room, max_hops)
    return np.asarray(times_of([lambda i: session.update(*frames[i])], n_frames, time.thread_time)[0])


def worst_of(seconds: np.ndarray) -> float:
    """The 99th percentile over the median."""
    return float(np.percentile(seconds, 99) / np.median(seconds))


class Stopwatch:
    """Processor time in methods of classes, without the time of watched methods that they call."""

    def __init__(self) -> None:
        self.spent: dict[str, float] = {}
        self._inner: list[float] = []
        many = 2000
        start = time.thread_time()
        for _ in range(many):
            time.thread_time()
        self._clock_s = (time.thread_time() - start) / many

    @contextmanager
    def watch(self, **methods: tuple[type, str]) -> Iterator[None]:
        """Measure methods within the context, each under the name of its keyword."""
        kept = [(owner, method, getattr(owner, method)) for owner, method in methods.values()]
        for name, (owner, method, call) in zip(methods, kept, strict=True):
            self.spent[name] = 0.0
            setattr(owner, method, self._watched(name, call))
        try:
            yield
        finally:
            for owner, method, call in kept:
                setattr(owner, method, call)

    def _watched(self, name: str, call: Callable[..., object]) -> Callable[..., object]:
        def watched(*args: object, **named: object) -> object:
            self._inner.append(0.0)
            start = time.thread_time()
            found = call(*args, **named)
            taken = time.thread_time() - start
            self.spent[name] += taken - self._clock_s - self._inner.pop()
            if self._inner:
                self._inner[-1] += taken + self._clock_s  # of two readings of the clock, one lies within `taken`
            return found

        return watched


def split(n_objects: int, kind: str, n_frames: int) -> None:
    """Print the mean processor time of each part of a session's update."""
    room, watch = busy_room(n_objects, kind), Stopwatch()
    session, frames = session_of(room), frames_of(room, n_frames)
    for moved, touches in frames[:20]:
        session.update(moved, touches)
    methods = {
        "broad": (BroadPhase, "update"),
        "narrow": (ContactGraph, "update"),
        "paths": (LivePaths, "least_costs"),
        "gains": (LiveLaw, "at"),
        "worth": (Audibility, "silence"),
        "mixer": (LoopMixers, "set_gains"),
        "rest": (HapticSession, "update"),
    }
    with watch.watch(**methods):
        for moved, touches in frames[20:]:
            session.update(moved, touches)
    each = {name: 1e6 * taken / n_frames for name, taken in watch.spent.items()}
    columns = [each[name] for name in ("broad", "narrow", "paths", "gains")]
    columns += [each["worth"] + each["mixer"], each["rest"]]
    print(f"| {n_objects} | {kind} | " + " | ".join(f"{taken:.0f}" for taken in columns) + " |")


def at_rest(n_objects: int, n_updates: int) -> None:
    """Measure updates with new touch points on five objects, in which nothing moves."""
    room = busy_room(n_objects)
    loop, session = OurLoop(room), session_of(room)
    names = [item.id for item in room.scene.objects[:5]]
    rng = np.random.default_rng(0)
    points = {name: room.scene.object(name).bounds_m for name in names}
    frames = [
        [Touch(("left", "right")[k % 2], x, rng.uniform(points[x][0], points[x][1])) for k, x in enumerate(names)]
        for _ in range(n_updates + 20)
    ]
    ours, whole = times_of(
        [lambda i: loop.update({}, frames[i]), lambda i: session.update({}, frames[i])], n_updates, time.thread_time
    )
    print(
        f"\nAt rest, five fresh touches, {n_objects} objects: through HapticSession {1 / np.median(whole):.0f} "
        f"updates/s, parts {1 / np.median(ours):.0f}."
    )


def growth(n_frames: int) -> None:
    print("\n| objects | contacts, 5 movers [µs] | HapticSession [µs] |\n|---|---|---|")
    rooms = {n: busy_room(n) for n in (100, 1000, 10000)}
    sessions = {n: session_of(room) for n, room in rooms.items()}
    graphs = {n: ContactGraph(room.scene) for n, room in rooms.items()}
    frames = {n: frames_of(room, n_frames) for n, room in rooms.items()}
    gc.freeze()

    def update_of(n: int) -> Callable[[int], object]:
        return lambda i: sessions[n].update(*frames[n][i])

    def move_of(n: int) -> Callable[[int], object]:
        return lambda i: graphs[n].update(frames[n][i][0])

    whole = times_of([update_of(n) for n in rooms], n_frames, time.thread_time)
    part = times_of([move_of(n) for n in rooms], n_frames, time.thread_time)
    for row, n in enumerate(rooms):
        print(f"| {n} | {1e6 * np.median(part[row]):.1f} | {1e6 * np.median(whole[row]):.1f} |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("n_frames", type=int, nargs="?", default=400)
    parser.add_argument("--defaults", action="store_true")
    parser.add_argument("--seed", type=int, default=time.time_ns() % 10**6)
    args = parser.parse_args()
    n_frames = args.n_frames
    print(
        f"Python {platform.python_version()}, numpy {np.__version__}, {platform.machine()}, gc {gc.isenabled()}, ",
        end="",
    )
    print(f"load {os.getloadavg()[0]:.1f}")
    if args.defaults:
        default_settings(n_frames, args.seed)
        return
    print("\n`ExponentialPlate` over at most two contacts.\n")
    print(
        "| objects | meshes | plain loop [ms] | HapticSession [ms] | ratio | p99 / median | parts [ms] | ratio |\n"
        "|---|---|---|---|---|---|---|---|"
    )
    cases = [(n_objects, kind) for kind in ("box", "mesh") for n_objects in (50, 1000)]
    for case in cases:
        compared(*case, n_frames)
    print(
        "\n| objects | meshes | broad [µs] | narrow [µs] | paths [µs] | gains [µs] | mix [µs] | rest [µs] |\n"
        "|---|---|---|---|---|---|---|---|"
    )
    for case in cases:
        split(*case, n_frames)
    at_rest(50, n_frames)
    growth(n_frames)


if __name__ == "__main__":
    main()
