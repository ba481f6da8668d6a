"""What a frame costs in which one small thing of a real scene is pushed about or carried, as a table in Markdown.

OMP_NUM_THREADS=1 python benchmarks/real_movers.py SCENE.glb [SCENE.glb ...]

Each of the first small things goes round on an ellipse of 6 x 4 cm about its place, up to 1.3 mm a frame; carried, it
does so 0.4 m higher, through whatever is there. Then up to five are pushed at once, alone and in a session of what was
baked with the default backends, in which two hands go about the two things that touch most others. Times are by the
clock, those of the contact graph or of `HapticSession.update`: the median of 120 frames, each the least of three times
round.
"""

from __future__ import annotations

import math
import sys
import time
import warnings
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import numpy as np

from scene2hap import HapticSession, Pose, SceneObject, SceneSnapshot, Touch, bake, load_scene
from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.units import UnitWarning

SMALL_M, MOST, N_FRAMES, N_ROUNDS, LIFT_M = 0.5, 5, 120, 3, 0.4


def pushed(item: SceneObject, i: int, up_axis: str, lift_m: float) -> Pose:
    x, y, z = item.pose.position_m
    u, v = 0.03 * math.sin(0.02 * math.pi * i), 0.02 * math.cos(0.02 * math.pi * i)
    moved = (x + u, y + lift_m, z + v) if up_axis == "y" else (x + u, y + v, z + lift_m)
    return Pose(moved, item.pose.rotation_xyzw)


def median_us(step: Callable[[int], Callable[[], object]]) -> float:
    """step : prepares frame i, and gives what is to be timed."""
    taken = np.full(N_FRAMES, np.inf)
    for _ in range(N_ROUNDS):
        for i in range(N_FRAMES):
            frame = step(i)
            start = time.perf_counter()
            frame()
            taken[i] = min(taken[i], time.perf_counter() - start)
    return 1e6 * float(np.median(taken))


def of_graph_us(graph: ContactGraph, items: Sequence[SceneObject], up_axis: str, lift_m: float) -> float:
    taken = median_us(lambda i: partial(graph.update, {x.id: pushed(x, i, up_axis, lift_m) for x in items}))
    graph.update({item.id: item.pose for item in items})
    return taken


def of_session_us(scene: SceneSnapshot, graph: ContactGraph, items: Sequence[SceneObject]) -> float:
    session = HapticSession(scene, bake(scene))
    touched = sorted(scene.objects, key=lambda item: -len(graph.neighbours(item.id)))[:2]

    def step(i: int) -> Callable[[], object]:
        moved = {item.id: pushed(item, i, scene.up_axis, 0.0) for item in items}
        touches = []
        for hand, item in zip(session.hands, touched, strict=True):
            low, high = item.bounds_m
            x, y, z = (low + (high - low) * (0.5 + 0.4 * math.sin(0.37 * i))).tolist()
            touches.append(Touch(hand, item.id, (x, y, z)))
        return partial(session.update, moved, touches)

    return median_us(step)


def main() -> None:
    print("| scene | thing | triangles | touches | pushed [us] | carried [us] |\n|---|---|---|---|---|---|")
    for path in map(Path, sys.argv[1:]):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UnitWarning)
            scene = load_scene(path)
        graph = ContactGraph(scene)
        small = [item for item in scene.objects if np.ptp(item.bounds_m, axis=0).max() < SMALL_M][:MOST]
        for item in small:
            touches = ", ".join(graph.neighbours(item.id))
            print(f"| {path.stem} | {item.id} | {len(item.geometry.mesh.faces)} | {touches} ", end="")
            both = (of_graph_us(graph, [item], scene.up_axis, lift_m) for lift_m in (0.0, LIFT_M))
            print("| " + " | ".join(f"{taken:.0f}" for taken in both) + " |", flush=True)
        if len(small) > 1:
            alone, whole = of_graph_us(graph, small, scene.up_axis, 0.0), of_session_us(scene, graph, small)
            print(f"| {path.stem} | {len(small)} at once |  |  | {alone:.0f} |  |")
            print(f"| {path.stem} | the same, `update` |  |  | {whole:.0f} |  |", flush=True)


if __name__ == "__main__":
    main()
