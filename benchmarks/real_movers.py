"""What a frame costs in which one small thing of a real scene is pushed about, as a table in Markdown.

OMP_NUM_THREADS=1 python benchmarks/real_movers.py SCENE.glb [SCENE.glb ...]

Each of the first small things goes round on an ellipse of 6 x 4 cm about its place, by up to 1.3 mm a frame. Times are
those of the contact graph alone: the least and the median of 120 frames, by the clock.
"""

from __future__ import annotations

import math
import sys
import time
import warnings
from pathlib import Path

import numpy as np

from scene2hap import Pose, SceneObject, load_scene
from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.units import UnitWarning

SMALL_M, MOST, N_FRAMES = 0.5, 4, 120


def pushed(item: SceneObject, i: int, up_axis: str) -> Pose:
    x, y, z = item.pose.position_m
    u, v = 0.03 * math.sin(0.02 * math.pi * i), 0.02 * math.cos(0.02 * math.pi * i)
    moved = (x + u, y, z + v) if up_axis == "y" else (x + u, y + v, z)
    return Pose(moved, item.pose.rotation_xyzw)


def main() -> None:
    print("| scene | thing | triangles | touches | least [us] | median [us] |\n|---|---|---|---|---|---|")
    for path in map(Path, sys.argv[1:]):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UnitWarning)
            scene = load_scene(path)
        graph = ContactGraph(scene)
        small = [item for item in scene.objects if np.ptp(item.bounds_m, axis=0).max() < SMALL_M][:MOST]
        for item in small:
            touches, taken = graph.neighbours(item.id), []
            for i in range(N_FRAMES):
                moved = {item.id: pushed(item, i, scene.up_axis)}
                start = time.perf_counter()
                graph.update(moved)
                taken.append(1e6 * (time.perf_counter() - start))
            graph.update({item.id: item.pose})
            n_triangles = len(item.geometry.mesh.faces)
            print(f"| {path.stem} | {item.id} | {n_triangles} | {', '.join(touches)} ", end="")
            print(f"| {min(taken):.0f} | {np.median(taken):.0f} |", flush=True)


if __name__ == "__main__":
    main()
