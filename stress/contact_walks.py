"""Random walks of contact graphs: each updated graph must be bit-identical to a new graph of the same state.

python stress/contact_walks.py [SCENE ...] [--minutes 60] [--seed N] [--objects 40]

The scenes are rooms of `benchmarks/busy_room.py` with new seeds, equal cubes on a grid, and the given scenes, in turns.
In each walk one or several objects a frame slide, turn, are lifted, dropped, moved elsewhere or tilted; sometimes one
is removed or added again. Prints the numbers of walks, states and different states; exits with 1 if any state differs.
"""

from __future__ import annotations

import argparse
import math
import random
import sys
import time
import warnings
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))

from busy_room import busy_room, floor_room, furnished_room, shelf_room

from scene2hap import Box, Pose, SceneObject, SceneSnapshot, load_scene
from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.objects import with_relative_heights

N_FRAMES = 120
_LARGE_M = 1.5  # Larger objects are moved seldom.


def cubes(seed: int, n_objects: int) -> SceneSnapshot:
    """Equal cubes on a floor, 0 to 6 cm apart, some of them raised by their height."""
    rng = random.Random(seed)
    apart = 0.1 + rng.choice([0.0, 0.01, 0.03, 0.06])
    side = math.ceil(math.sqrt(n_objects))
    floor, item = floor_room(2, seed).scene.objects
    objects, cell = [floor], replace(item, geometry=Box((0.1, 0.1, 0.1)))
    for k in range(n_objects):
        at = ((k % side) * apart, 0.05 + 0.1 * (rng.random() < 0.2), (k // side) * apart)
        objects.append(replace(cell, id=f"cube{k}", name=f"cube{k}", pose=Pose(at)))
    return SceneSnapshot("cubes", "y", with_relative_heights(objects, "y"))


class Walk:
    """A random walk through states of a scene."""

    def __init__(self, scene: SceneSnapshot, rng: random.Random) -> None:
        self.rng, self.up = rng, {"y": 1, "z": 2}[scene.up_axis]
        self.things = {item.id: item for item in scene.objects}
        self.scene, self.gone = scene, dict[str, SceneObject]()
        sizes = {item.id: float(np.ptp(item.bounds_m, axis=0).max()) for item in scene.objects}
        small = [x for x, size in sizes.items() if size < _LARGE_M] or list(sizes)
        self.movers = rng.sample(small, min(len(small), rng.choice([1, 3, 5, 12])))
        if rng.random() < 0.3:
            self.movers.append(rng.choice(list(sizes)))
        self.ways = {x: np.array([rng.gauss(0, 0.004), 0.0, rng.gauss(0, 0.004)]) for x in self.things}
        self.spin = {x: rng.choice([0.0, 0.0, rng.gauss(0, 0.03)]) for x in self.things}
        self.homes = {x: item.pose for x, item in self.things.items()}

    def step(self, graph: ContactGraph) -> None:
        """Move, add or remove objects for one frame."""
        rng, moved, added, removed = self.rng, dict[str, Pose](), list[SceneObject](), list[str]()
        for x in self.movers:
            if x in self.things and rng.random() < 0.9:
                moved[x] = self._pose(x)
        if rng.random() < 0.02 and len(self.things) > 2:
            x = rng.choice(list(self.things))
            removed.append(x)
            moved.pop(x, None)
            self.gone[x] = self.things.pop(x)
        elif rng.random() < 0.03 and self.gone:
            x = rng.choice(list(self.gone))
            added.append(self.gone.pop(x))
            self.things[x] = added[-1]
        for x, pose in moved.items():
            self.things[x] = replace(self.things[x], pose=pose)
        graph.update(moved, added=added, removed=removed)

    def _pose(self, x: str) -> Pose:
        rng, pose = self.rng, self.things[x].pose
        place, level = np.array(pose.position_m), [axis for axis in range(3) if axis != self.up]
        if rng.random() < 0.05:
            self.ways[x] = np.array([rng.gauss(0, 0.004) for _ in range(3)])
            self.ways[x][1] *= rng.choice([0, 0, 1])
        kind = rng.random()
        if kind < 0.9:
            place[level] += self.ways[x][[0, 2]]
            place[self.up] += self.ways[x][1]
        elif kind < 0.94:
            place[self.up] += rng.choice([0.0005, 0.003, -0.003, 0.02, 0.25, -0.25])
        elif kind < 0.96:
            home = self.homes[x]
            return home
        elif kind < 0.98:
            other = rng.choice(list(self.things.values()))
            low, high = other.bounds_m
            place[level] = [rng.uniform(low[axis], high[axis]) for axis in level]
            own_low = self.things[x].bounds_m[0][self.up] - self.things[x].pose.position_m[self.up]
            place[self.up] = rng.choice([low[self.up], high[self.up]]) - own_low + rng.choice([0.0, 0.001, 0.03])
        axis, angle = np.eye(3)[self.up], self.spin[x]
        if rng.random() < 0.01:
            axis, angle = (
                np.array([rng.gauss(0, 1) for _ in range(3)]),
                rng.choice([rng.uniform(-0.3, 0.3), math.pi / 2]),
            )
        a, b, c = (math.sin(angle / 2) * axis / np.linalg.norm(axis)).tolist()
        turn = Pose((0.0, 0.0, 0.0), (a, b, c, math.cos(angle / 2))) if angle else Pose()
        x_m, y_m, z_m = place.tolist()
        turned = turn.compose(Pose((0.0, 0.0, 0.0), pose.rotation_xyzw)).rotation_xyzw if angle else pose.rotation_xyzw
        return Pose((x_m, y_m, z_m), turned)

    def equals_new_graph(self, graph: ContactGraph) -> bool:
        """Whether the graph equals a new graph of the present poses."""
        state = replace(self.scene, objects=tuple(self.things.values()))
        return graph.contacts == ContactGraph(state).contacts


def _given(scene: SceneSnapshot, seed: int) -> SceneSnapshot:
    return scene


def scenes(paths: list[Path], n_objects: int) -> Iterator[tuple[str, Callable[[int], SceneSnapshot]]]:
    """Yield a name and a function that makes the room from a seed."""
    rooms = {
        "busy": lambda seed: busy_room(n_objects, "box", seed).scene,
        "busy meshes": lambda seed: busy_room(n_objects, "mesh", seed).scene,
        "floor": lambda seed: floor_room(n_objects, seed).scene,
        "shelf": lambda seed: shelf_room(n_objects, seed).scene,
        "furnished": lambda seed: furnished_room(n_objects, seed).scene,
        "cubes": lambda seed: cubes(seed, n_objects),
    }
    yield from rooms.items()
    for path in paths:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            scene = load_scene(path)
        yield path.stem, partial(_given, scene)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", type=Path)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**6))
    parser.add_argument("--objects", type=int, default=40)
    wanted = parser.parse_args()
    made, until = dict(scenes(wanted.scenes, wanted.objects)), time.monotonic() + 60 * wanted.minutes
    counts = {name: [0, 0, 0] for name in made}
    seed = wanted.seed
    while time.monotonic() < until:
        for name, make in made.items():
            seed += 1
            rng = random.Random(seed)
            scene = make(seed)
            walk, graph = Walk(scene, rng), ContactGraph(scene)
            counts[name][0] += 1
            for frame in range(N_FRAMES):
                walk.step(graph)
                if frame % 3 == 0:
                    counts[name][1] += 1
                    if not walk.equals_new_graph(graph):
                        counts[name][2] += 1
                        print(f"{name}, seed {seed}, frame {frame}: differs from a new graph", flush=True)
                        break
    for name, (walks, states, different) in counts.items():
        print(f"| {name} | {walks} | {states} | {different} |")
    return int(any(different for _, _, different in counts.values()))


if __name__ == "__main__":
    sys.exit(main())
