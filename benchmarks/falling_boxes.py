"""Contacts of scene2hap and of MuJoCo for 100 boxes that fall into a heap, and the time per step of each.

OMP_NUM_THREADS=1 python benchmarks/falling_boxes.py [n_steps]

The boxes fall into a tray, 1 m wide, and come to rest in a heap; three phases of equal length are listed. Both programs
use the same tolerance. MuJoCo (4.0) lists pairs that are nearer than the sum of both geoms' gaps, so each gap is half
the tolerance; scene2hap has a setting. A pair whose distance is within 0.1 mm of the tolerance counts as equal.

MuJoCo lists contacts twice. Its routine for two boxes drives the simulation and is the reference for time. Its general
routine runs in a second model, of the same boxes as convex meshes. The two differ in some steps. If only scene2hap or
only the routine for boxes reports a pair, `mj_geomDistance` decides. Times are medians of processor time.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterable
from itertools import product

import mujoco
import numpy as np

from scene2hap import Box, DominantSurface, Pose, PoseTable, SceneObject, SceneSnapshot
from scene2hap.contact.graph import ContactGraph

N_BOXES, TOLERANCE_M, EDGE_M = 100, 0.004, 1e-4
PHASES = ("falling", "heaping up", "at rest")
# Floor and four walls: half edges and middles [m].
TRAY = {
    "floor": ((0.6, 0.6, 0.05), (0.0, 0.0, -0.05)),
    "wall0": ((0.05, 0.6, 0.4), (-0.55, 0.0, 0.401)),
    "wall1": ((0.05, 0.6, 0.4), (0.55, 0.0, 0.401)),
    "wall2": ((0.499, 0.05, 0.4), (0.0, -0.55, 0.401)),
    "wall3": ((0.499, 0.05, 0.4), (0.0, 0.55, 0.401)),
}
CORNERS = np.array(list(product((-1.0, 1.0), repeat=3)))


def numbers(values: Iterable[object]) -> str:
    return " ".join(map(str, values))


def model_of(sizes: np.ndarray, places: np.ndarray, turns: np.ndarray, kind: str) -> mujoco.MjModel:
    """MuJoCo model of tray and boxes. kind : "box", or "mesh" for the same boxes as convex meshes."""
    meshes = []

    def geom(name: str, half: np.ndarray, at: str = "") -> str:
        meshes.append(f'<mesh name="{name}" vertex="{numbers((CORNERS * half).ravel())}"/>')
        shape = f'type="box" size="{numbers(half)}"' if kind == "box" else f'type="mesh" mesh="{name}"'
        return f'<geom name="{name}" {shape} {at} gap="{TOLERANCE_M / 2}"/>'

    still = "".join(geom(name, np.array(half), f'pos="{numbers(at)}"') for name, (half, at) in TRAY.items())
    bodies = "".join(
        f'<body pos="{numbers(at)}" quat="{numbers(turn)}"><freejoint/>{geom(f"b{i:03d}", size / 2)}</body>'
        for i, (size, at, turn) in enumerate(zip(sizes, places, turns, strict=True))
    )
    assets = "".join(meshes) if kind == "mesh" else ""
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="0.002"/><asset>{assets}</asset><worldbody>{still}{bodies}</worldbody></mujoco>'
    )


def scene_of(sizes: np.ndarray) -> SceneSnapshot:
    plate = DominantSurface(Pose(), 0.1, 0.1, 0.1)
    objects = [
        SceneObject(name, name, Pose(at), Box(tuple(2 * edge for edge in half)), plate)
        for name, (half, at) in TRAY.items()
    ]
    objects += [
        SceneObject(f"b{i:03d}", "box", Pose((0, 0, i + 5.0)), Box(tuple(size)), plate)
        for i, size in enumerate(sizes.tolist())
    ]
    return SceneSnapshot("heap", "z", tuple(objects))


def listed_by(data: mujoco.MjData, names: list[str]) -> dict[tuple[str, str], float]:
    """Least distance [m] of each pair in MuJoCo's list."""
    listed: dict[tuple[str, str], float] = {}
    for a, b, distance in zip(*data.contact.geom.T.tolist(), data.contact.dist.tolist(), strict=True):
        pair = (names[a], names[b]) if names[a] < names[b] else (names[b], names[a])
        listed[pair] = min(distance, listed.get(pair, np.inf))
    return listed


def found_by(graph: ContactGraph) -> dict[tuple[str, str], float]:
    """Weight of each touching pair."""
    arrays = graph.arrays
    ids, rows = arrays.ids, zip(arrays.a.tolist(), arrays.b.tolist(), arrays.weights.tolist(), strict=True)
    return {(ids[a], ids[b]): share for a, b, share in rows}


def different(listed: dict[tuple[str, str], float], found: dict[tuple[str, str], float]) -> set[tuple[str, str]]:
    """Pairs that only one side reports, with a distance more than 0.1 mm from the tolerance."""
    # MuJoCo never reports pairs of two fixed objects.
    found = {pair: share for pair, share in found.items() if not {*pair} <= TRAY.keys()}
    differ = {pair for pair, distance in listed.items() if distance < TOLERANCE_M - EDGE_M} - found.keys()
    return differ | {pair for pair in found.keys() - listed.keys() if found[pair] > 0.01}


def distance_m(model: mujoco.MjModel, data: mujoco.MjData, names: list[str], pair: tuple[str, str]) -> float:
    a, b = (names.index(name) for name in pair)
    return float(mujoco.mj_geomDistance(model, data, a, b, 0.1, None))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("n_steps", type=int, nargs="?", default=3000)
    n_steps = parser.parse_args().n_steps
    rng = np.random.default_rng(5)
    sizes = rng.uniform(0.06, 0.2, (N_BOXES, 3))
    cell = np.stack(np.meshgrid(np.arange(4), np.arange(4), np.arange(7), indexing="ij"), -1).reshape(-1, 3)
    places = (cell[np.argsort(cell[:, 2], kind="stable")][:N_BOXES] - [1.5, 1.5, 0]) * [0.24, 0.24, 0.3]
    places += np.array([0, 0, 0.3]) + rng.uniform(-0.01, 0.01, (N_BOXES, 3))
    turns = rng.normal(size=(N_BOXES, 4))
    model, general = (model_of(sizes, places, turns, kind) for kind in ("box", "mesh"))
    data, beside = mujoco.MjData(model), mujoco.MjData(general)
    names = [model.geom(i).name for i in range(model.ngeom)]
    moving = tuple(names[len(TRAY) :])
    graph = ContactGraph(scene_of(sizes), tolerance_m=TOLERANCE_M)
    theirs, ours, n_pairs, same_boxes, same_meshes = np.zeros((5, n_steps))
    judged = [0, 0]
    for step in range(n_steps):
        mujoco.mj_step(model, data)
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        start = time.thread_time()
        mujoco.mj_collision(model, data)
        between = time.thread_time()
        graph.update(PoseTable(moving, data.xpos[1:], data.xquat[1:, [1, 2, 3, 0]]))
        end = time.thread_time()
        theirs[step], ours[step] = between - start, end - between
        listed, found = listed_by(data, names), found_by(graph)
        n_pairs[step] = len(listed)
        differ = different(listed, found)
        same_boxes[step] = not differ
        for pair in differ:
            judged[(distance_m(model, data, names, pair) <= TOLERANCE_M) == (pair in found)] += 1
        beside.qpos[:] = data.qpos
        mujoco.mj_kinematics(general, beside)
        mujoco.mj_comPos(general, beside)
        mujoco.mj_collision(general, beside)
        same_meshes[step] = not different(listed_by(beside, names), found)
    print("| phase | steps | pairs | same pairs as its general routine, as that for boxes [% of steps] ", end="")
    print("| mj_collision [ms] | scene2hap, with poses [ms] | ratio |\n|---|---|---|---|---|---|---|")
    for name, part in zip((*PHASES, "all"), (*np.array_split(np.arange(n_steps), 3), np.arange(n_steps)), strict=True):
        slow, fast = np.median(ours[part]), np.median(theirs[part])
        print(
            f"| {name} | {len(part)} | {n_pairs[part].mean():.0f} | {100 * same_meshes[part].mean():.1f}, "
            f"{100 * same_boxes[part].mean():.1f} | {1e3 * fast:.3f} | {1e3 * slow:.3f} | {slow / fast:.1f} |"
        )
    print(f"\nPairs reported only by scene2hap or only by the routine for boxes: {sum(judged)}; ", end="")
    print(f"mj_geomDistance agrees with scene2hap on {judged[1]} of them.")


if __name__ == "__main__":
    main()
