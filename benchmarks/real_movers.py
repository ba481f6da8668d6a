"""Time of a whole `HapticSession.update` in real scenes while objects move, as a table in Markdown.

OMP_NUM_THREADS=1 python benchmarks/real_movers.py SCENE[:UNIT_M] [...] [--passes 3] [--worst 5] [--only ID]

Each scene is baked with the default backends and played by a default session in 20 bands, with one hand on each of the
two objects that touch most others. Every object up to 1 m long is a mover. A mover is pushed about its place, carried
through the room at 0.4 m above its place, and lifted and dropped; then five movers at once do so, for several draws.

Times are the calling thread's processor time, garbage collection included, the least of several passes for each frame.
`--worst` lists the movers with the slowest frames, `--profile` prints a profile of these frames. For a file in other
units, append a colon and the unit [m], as in room.glb:0.1.
"""

from __future__ import annotations

import argparse
import cProfile
import math
import pstats
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from scene2hap import (
    Bands,
    HapticBundle,
    HapticSession,
    Pose,
    SceneObject,
    SceneSnapshot,
    SceneWarning,
    Touch,
    bake,
    load_scene,
)
from scene2hap.contact.graph import ContactGraph

MOVABLE_M, N_FRAMES, LIFT_M, STEP_M = 1.0, 240, 0.4, 1.5 / 90
Path3 = Callable[[SceneObject, int], tuple[float, float, float]]
"""Function of a mover and a frame number i. Returns the offset [m] from the mover's place: two level axes, and up."""


def pushed(item: SceneObject, i: int) -> tuple[float, float, float]:
    """Offset along an ellipse of 6 x 4 cm, up to 1.3 mm a frame."""
    return 0.03 * math.sin(0.02 * math.pi * i), 0.02 * math.cos(0.02 * math.pi * i) - 0.02, 0.0


def dropped(item: SceneObject, i: int) -> tuple[float, float, float]:
    """Offset when lifted by 0.3 m and dropped, twelve times, at a slightly different place each time."""
    k, phase = divmod(i, 20)
    height = 0.03 * phase if phase < 10 else 0.3 * (1 - ((phase - 10) / 6) ** 2) if phase < 16 else 0.0
    return 0.004 * k, 0.003 * k, height


def carried_through(scene: SceneSnapshot) -> Path3:
    """Path through the middle of the room at 1.5 m/s and 90 frames a second, to and fro between the walls."""
    flat = (0, 2) if scene.up_axis == "y" else (0, 1)
    bounds = np.array([item.bounds_m for item in scene.objects])
    low, high = bounds[:, 0].min(axis=0), bounds[:, 1].max(axis=0)
    middle, half = ((low + high) / 2)[list(flat)], 0.45 * (high - low)[list(flat)]

    def offset(item: SceneObject, i: int) -> tuple[float, float, float]:
        start = np.clip((np.mean(item.bounds_m, axis=0)[list(flat)] - middle) / half, -1, 1) * half
        way = -start if np.linalg.norm(start) > 0.1 else half
        span = 2 * float(np.linalg.norm(way))
        gone = STEP_M * i % (2 * span)
        u, v = (way / np.linalg.norm(way) * (gone if gone < span else 2 * span - gone)).tolist()
        return u, v, LIFT_M

    return offset


@dataclass(frozen=True)
class Room:
    """A scene with its bundle, its movers, and the two objects that hands touch."""

    name: str
    scene: SceneSnapshot
    bundle: HapticBundle
    movers: tuple[SceneObject, ...]
    touched: tuple[SceneObject, SceneObject]

    @classmethod
    def read(cls, given: str) -> Room:
        name, _, unit_m = given.partition(":")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            scene = load_scene(name, unit_m=float(unit_m) if unit_m else None)
            bundle = bake(scene)
        movers = tuple(item for item in scene.objects if np.ptp(item.bounds_m, axis=0).max() <= MOVABLE_M)
        graph = ContactGraph(scene)
        first, *others = sorted(scene.objects, key=lambda item: -len(graph.neighbours(item.id)))
        path, second = Path(name), others[0] if others else first
        title = path.parent.name if path.stem in ("scene", "room") else path.stem
        return cls(title, scene, bundle, movers, (first, second))

    def session(self) -> HapticSession:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return HapticSession(self.scene, self.bundle, {"bands": Bands.third_octaves(10, 1000)})

    def frames(self, items: Sequence[SceneObject], path: Path3) -> Iterator[tuple[dict[str, Pose], list[Touch]]]:
        for i in range(N_FRAMES):
            moved = {item.id: self._at(item, path(item, i)) for item in items}
            touches = []
            for hand, item in zip(("left", "right"), self.touched, strict=True):
                low, high = item.bounds_m
                x, y, z = (low + (high - low) * (0.5 + 0.4 * math.sin(0.37 * i))).tolist()
                touches.append(Touch(hand, item.id, (x, y, z)))
            yield moved, touches

    def _at(self, item: SceneObject, offset: tuple[float, float, float]) -> Pose:
        x, y, z = item.pose.position_m
        u, v, h = offset
        at = (x + u, y + h, z + v) if self.scene.up_axis == "y" else (x + u, y + v, z + h)
        return Pose(at, item.pose.rotation_xyzw)


def seconds(room: Room, items: Sequence[SceneObject], path: Path3, n_passes: int) -> NDArray[np.float64]:
    """Least time (n_frames,) [s] of each frame over the passes."""
    least = np.full(N_FRAMES, np.inf)
    session = room.session()
    for _ in range(n_passes):
        session.update({item.id: item.pose for item in items})
        for i, (moved, touches) in enumerate(room.frames(items, path)):
            start = time.thread_time()
            session.update(moved, touches)
            least[i] = min(least[i], time.thread_time() - start)
    return least


def groups(room: Room, n_draws: int, seed: int, *, alone: bool) -> Iterator[tuple[str, list[SceneObject]]]:
    if alone:
        yield from ((item.id, [item]) for item in room.movers)
    elif len(room.movers) > 1:
        rng = np.random.default_rng(seed)
        for draw in range(n_draws):
            rows = rng.permutation(len(room.movers))[:5]
            yield f"five ({draw})", [room.movers[row] for row in rows]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", metavar="SCENE[:UNIT_M]")
    parser.add_argument("--passes", type=int, default=3)
    parser.add_argument("--draws", type=int, default=5, help="draws of five movers")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--worst", type=int, default=3)
    parser.add_argument("--only", help="one mover's id, or 'five'")
    parser.add_argument("--profile", action="store_true")
    args = parser.parse_args()
    warnings.simplefilter("ignore", SceneWarning)  # of hands in the middle of touched objects
    print("| scene | movers | path | p50 [ms] | p99 [ms] | worst [ms] | frames over 1 ms | slowest movers |")
    print("|---|---|---|---|---|---|---|---|")
    for given in args.scenes:
        room = Room.read(given)
        profile = cProfile.Profile(time.thread_time) if args.profile else None
        for alone in (True, False):
            for name, path in {"pushed": pushed, "carried": carried_through(room.scene), "dropped": dropped}.items():
                found = {}
                for who, items in groups(room, args.draws, args.seed, alone=alone):
                    if args.only in (None, who, "five" if not alone else None):
                        if profile:
                            profile.enable()
                        found[who] = 1e3 * seconds(room, items, path, args.passes)
                        if profile:
                            profile.disable()
                if not found:
                    continue
                every = np.concatenate(list(found.values()))
                p50, p99 = np.percentile(every, (50, 99))
                slowest = sorted(found, key=lambda who: -np.percentile(found[who], 99))[: args.worst]
                listed = ", ".join(f"{who} {np.percentile(found[who], 99):.1f}" for who in slowest)
                kind = f"{len(room.movers)} alone" if alone else "five at once"
                print(
                    f"| {room.name} | {kind} | {name} | {p50:.2f} | {p99:.2f} | {every.max():.2f} "
                    f"| {100 * np.mean(every > 1):.1f} % | {listed} |",
                    flush=True,
                )
        if profile:
            pstats.Stats(profile).sort_stats("tottime").print_stats(45)


if __name__ == "__main__":
    main()
