"""Describe scenes in other ways, bake them again, and compare the gains: they must not change.

python stress/same_scene.py [SCENE.glb ...] [--minutes 10] [--seed 0] [--least-db 0.05]

The changes are those of `tests/support/same_scene.py`. The scenes are the given ones, with y up and in metres,
and rooms of `benchmarks/busy_room.py`, in turns. Each is baked with the offline lexicon before and after the change, so
that surfaces, masses, contacts and gains are all computed again. Gains below -80 dB count as -80 dB. Prints a line for
each case that differs, with the largest difference, and exits with 1 if there was any.
"""

from __future__ import annotations

import argparse
import random
import sys
import time
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))
sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from busy_room import busy_room, floor_room, furnished_room, shelf_room

from same_scene import CHANGES, Same, described_again
from scene2hap import HapticSession, SceneObject, SceneSnapshot, Touch, bake, load_scene

N_TOUCHES = 60
FLOOR_GAIN = 1e-4
MODELS = ("exponential_plate", "infinite_plate", "modal_plate", "auto")
Touched = list[tuple[str, NDArray[np.float64]]]


def scenes(paths: list[Path], seed: int) -> Iterator[tuple[str, SceneSnapshot]]:
    """Yield the given scenes and new rooms, in turns, without end."""
    rooms = (busy_room, floor_room, furnished_room, shelf_room)
    while True:
        for path in paths:
            yield path.stem, load_scene(path)
        room = rooms[seed % len(rooms)]
        yield f"{room.__name__} {seed}", room(30, seed=seed).scene
        seed += 1


def touches(objects: list[SceneObject], rng: random.Random) -> Touched:
    """Return points inside random triangles."""
    found = []
    for item in rng.choices(objects, k=N_TOUCHES):
        mesh = item.geometry.mesh
        share = np.random.default_rng(rng.randrange(2**32)).dirichlet([1, 1, 1])
        found.append((item.id, item.pose.to_world(share @ mesh.vertices_m[rng.choice(mesh.faces)])))
    return found


def levels_db(same: Same, touched: Touched) -> dict[tuple[str, str], NDArray[np.float64]]:
    """Bake the scene. Returns the levels of all touches (n_touches, n_bands) [dB] by model and new id of the source."""
    scene = SceneSnapshot.build(same.objects, up_axis=same.up_axis)
    bundle, found = bake(scene, {"llm": "lexicon"}), {}
    at = [Touch("left", same.ids(name), same.motion.to_world([point])[0]) for name, point in touched]
    for kind in MODELS:
        model = kind if kind == "auto" else {"kind": kind, "outside_domain": "ignore"}
        config = {"propagation": model, "prepare": "blocking", "gain_limit_db": None}
        with HapticSession(scene, bundle, config) as session:
            session.update()
            gains = session.would_feel(at)
        for column, source in enumerate(session.source_ids):
            found[kind, source] = 20 * np.log10(np.maximum(gains[:, column], FLOOR_GAIN))
    return found


def differences(
    objects: list[SceneObject], change: Callable[[list[SceneObject], random.Random], Same], seed: str, least_db: float
) -> Iterator[str]:
    """Yield a line for each model whose gains differ."""
    touched = touches(objects, random.Random(seed))
    before, same = levels_db(Same(objects), touched), change(objects, random.Random(seed))
    after = levels_db(same, touched)
    for kind in MODELS:
        worst = (0.0, "")
        for source in (source for model, source in before if model == kind):
            renamed = (kind, same.ids(source))
            if renamed not in after:
                yield f"{kind}: {source} is no source any more"
                continue
            by_touch = np.abs(after[renamed] - before[kind, source]).max(axis=1)
            row = int(by_touch.argmax())
            worst = max(worst, (float(by_touch[row]), f"of {source} felt on {touched[row][0]}"))
        if worst[0] > least_db:
            yield f"{kind}: {worst[0]:.2f} dB {worst[1]}"


def main() -> int:
    """Run the campaign. Returns 1 if any case differed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", type=Path, metavar="SCENE")
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--least-db", type=float, default=0.05, help="differences up to this are not printed")
    chosen = parser.parse_args()
    warnings.simplefilter("ignore")
    end, n_cases, n_bad = time.monotonic() + 60 * chosen.minutes, 0, 0
    for name, scene in scenes(chosen.scenes, chosen.seed):
        objects = [described_again(item) for item in scene.objects]
        for change in CHANGES:
            if time.monotonic() > end:
                print(f"{n_cases} cases, {n_bad} differed")
                return int(n_bad > 0)
            lines = list(differences(objects, change, f"{name} {change.__name__} {chosen.seed}", chosen.least_db))
            n_cases, n_bad = n_cases + 1, n_bad + bool(lines)
            for line in lines:
                print(f"{name}, {change.__name__}, {line}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
