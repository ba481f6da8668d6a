"""Contacts by closed forms compared with contacts by triangles, at random poses of objects in real scenes.

python stress/contacts.py SCENE.glb [SCENE.glb ...] [--moves 500] [--seed 0] [--unit-m 0.01]

Objects are pushed, lifted, turned about the vertical, sometimes tilted, and put onto or into others, one at a time. For
each state two new graphs are built: one as usual, one without free space (`contact.free_space`). Prints a line for each
pair whose weights in the two graphs differ by more than 0.02, and totals. The incrementally updated graph must be
bit-identical to the usual new graph; exits with 1 if it differs.
"""

from __future__ import annotations

import argparse
import math
import random
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from unittest import mock

import numpy as np

from scene2hap import Pose, SceneObject, SceneSnapshot, load_scene
from scene2hap.contact.graph import ContactGraph

EQUAL = 0.02
_LARGE_M = 2.0  # Larger objects are not moved.


@contextmanager
def without_free_space() -> Iterator[None]:
    """Disable free space, so that triangles decide all contacts."""
    with mock.patch("scene2hap.contact.body.Stance.upright", None):
        yield


def moved(item: SceneObject, onto: SceneObject, up: int, rng: random.Random) -> Pose:
    """New pose of an object: near the present one, or at a random place over another object."""
    place = np.array(item.pose.position_m)
    level = [axis for axis in range(3) if axis != up]
    if rng.random() < 0.4:
        (low, high), (own_low, _) = onto.bounds_m, item.bounds_m
        for axis in level:
            place[axis] += rng.uniform(low[axis], high[axis]) - own_low[axis]
        height = rng.choice([low[up], high[up], rng.uniform(low[up], high[up])])
        place[up] += height + rng.choice([0.0, 0.001, -0.002, 0.01, 0.05]) - own_low[up]
    else:
        reach = rng.choice([0.005, 0.03, 0.3])
        for axis in level:
            place[axis] += rng.uniform(-reach, reach)
        place[up] += rng.choice([0.0, 0.0, rng.uniform(-0.003, 0.02), rng.uniform(0.0, 0.3)])
    turn = Pose()
    if rng.random() < 0.5:
        angle = rng.choice([math.pi / 2, rng.uniform(-3.0, 3.0)])
        around = np.eye(3)[up]
        if rng.random() < 0.2:
            around, angle = np.array([rng.gauss(0, 1) for _ in range(3)]), rng.uniform(-0.3, 0.3)
        x, y, z = (math.sin(angle / 2) * around / np.linalg.norm(around)).tolist()
        turn = Pose((0.0, 0.0, 0.0), (x, y, z, math.cos(angle / 2)))
    turned = turn.compose(Pose((0.0, 0.0, 0.0), item.pose.rotation_xyzw)).rotation_xyzw
    x, y, z = place.tolist()
    return Pose((x, y, z), turned)


def weights(graph: ContactGraph) -> dict[tuple[str, str], float]:
    return {pair: max(junction.weights) for pair, junction in graph.junctions.items()}


def compared(scene: SceneSnapshot, name: str, n_moves: int, rng: random.Random) -> bool:
    """Whether the incrementally updated graph always equals a new one."""
    up = {"y": 1, "z": 2}[scene.up_axis]
    things = {item.id: item for item in scene.objects}
    small = [item.id for item in scene.objects if np.ptp(item.bounds_m, axis=0).max() < _LARGE_M]
    updated = ContactGraph(scene)
    n_pairs = n_other = n_states = 0
    is_right = True
    for k in range(n_moves):
        which = rng.choice(small)
        pose = moved(scene.object(which), scene.object(rng.choice(list(things))), up, rng)
        things[which] = replace(things[which], pose=pose)
        updated.update({which: pose})
        if k % 5:
            continue
        state = replace(scene, objects=tuple(things.values()))
        built = ContactGraph(state)
        if updated.contacts != built.contacts:
            print(f"{name}, move {k}, {which}: the updated graph differs from a new one")
            is_right = False
        with without_free_space():
            alone = weights(ContactGraph(state))
        found = weights(built)
        n_states, n_pairs = n_states + 1, n_pairs + len(found.keys() | alone.keys())
        for pair in sorted(found.keys() | alone.keys()):
            one, other = found.get(pair, 0.0), alone.get(pair, 0.0)
            if abs(one - other) > EQUAL:
                n_other += 1
                print(f"{name}, move {k}, {pair[0]} - {pair[1]}: weight {one:.3f}, by triangles {other:.3f}")
    print(f"{name}: {n_states} states, {n_pairs} pairs, {n_other} differ by triangles alone", flush=True)
    return is_right


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", type=Path)
    parser.add_argument("--moves", type=int, default=500)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--unit-m", type=float, default=None)
    wanted = parser.parse_args()
    results = []
    for path in wanted.scenes:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            scene = load_scene(path, unit_m=wanted.unit_m)
        results.append(compared(scene, path.stem, wanted.moves, random.Random(wanted.seed)))
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
