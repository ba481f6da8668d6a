"""Our contacts beside MuJoCo's own on 100 boxes that fall into a heap, and what either costs per step.

OMP_NUM_THREADS=1 python benchmarks/falling_boxes.py [n_steps]

The tolerance is matched: MuJoCo's geoms have a margin of half of it each, ours is stated. A pair whose distance is
within 0.1 mm of the tolerance may be told either way.
"""

from __future__ import annotations

import sys
import time

import mujoco
import numpy as np

from scene2hap import Box, DominantSurface, Pose, SceneObject, SceneSnapshot
from scene2hap.contact.graph import ContactGraph

N_BOXES, TOLERANCE_M, EDGE_M = 100, 0.004, 1e-4


def model_of(sizes: np.ndarray, places: np.ndarray) -> mujoco.MjModel:
    bodies = "".join(
        f'<body name="b{i:03d}" pos="{" ".join(map(str, at))}"><freejoint/>'
        f'<geom type="box" size="{" ".join(map(str, size / 2))}" margin="{TOLERANCE_M / 2}" gap="{TOLERANCE_M / 2}"/>'
        "</body>"
        for i, (size, at) in enumerate(zip(sizes, places, strict=True))
    )
    floor = f'<geom name="floor" type="box" size="3 3 0.05" pos="0 0 -0.05" margin="{TOLERANCE_M / 2}"/>'
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="0.002"/><worldbody>{floor}{bodies}</worldbody></mujoco>'
    )


def main() -> None:
    n_steps = int(sys.argv[1]) if len(sys.argv) > 1 else 600
    rng = np.random.default_rng(5)
    sizes = rng.uniform(0.06, 0.2, (N_BOXES, 3))
    cell = np.stack(np.meshgrid(np.arange(5), np.arange(5), np.arange(4), indexing="ij"), -1).reshape(-1, 3)
    places = (cell - [2, 2, 0]) * 0.28 + [0, 0, 0.3] + rng.uniform(-0.03, 0.03, (N_BOXES, 3))
    model = model_of(sizes, places)
    data = mujoco.MjData(model)
    names = ["floor", *(f"b{i:03d}" for i in range(N_BOXES))]
    plate = DominantSurface(Pose(), 0.1, 0.1, 0.1)
    objects = [SceneObject("floor", "floor", Pose((0, 0, -0.05)), Box((6.0, 6.0, 0.1)), plate)]
    objects += [
        SceneObject(name, name, Pose(tuple(at)), Box(tuple(size)), plate)
        for name, at, size in zip(names[1:], places.tolist(), sizes.tolist(), strict=True)
    ]
    graph = ContactGraph(SceneSnapshot("heap", "z", tuple(objects)), tolerance_m=TOLERANCE_M)
    same, theirs, ours, n_pairs = 0, [], [], 0
    for _ in range(n_steps):
        mujoco.mj_step(model, data)
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        start = time.thread_time()
        mujoco.mj_collision(model, data)
        theirs.append(time.thread_time() - start)
        start = time.thread_time()
        poses = {
            name: Pose((x, y, z), (b, c, d, a))
            for name, (x, y, z), (a, b, c, d) in zip(
                names[1:], data.xpos[1:].tolist(), data.xquat[1:].tolist(), strict=True
            )
        }
        graph.update(poses)
        ours.append(time.thread_time() - start)
        told = {}
        for a, b, distance in zip(*data.contact.geom.T.tolist(), data.contact.dist.tolist(), strict=True):
            pair = tuple(sorted((names[a], names[b])))
            told[pair] = min(distance, told.get(pair, np.inf))
        edge = {pair for pair, distance in told.items() if distance > TOLERANCE_M - EDGE_M}
        found = set(graph.junctions)
        edge |= {pair for pair in found - told.keys() if max(graph.junctions[pair].weights) < 0.01}
        same += (found - edge) == (told.keys() - edge)
        n_pairs += len(told)
    print(
        f"{n_steps} steps, {n_pairs / n_steps:.0f} pairs: the same in {100 * same / n_steps:.1f} %; mj_collision "
        f"{1e3 * np.median(theirs):.3f} ms, ours with poses {1e3 * np.median(ours):.2f} ms: "
        f"{np.median(ours) / np.median(theirs):.0f} times."
    )


if __name__ == "__main__":
    main()
