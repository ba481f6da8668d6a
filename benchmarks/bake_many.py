"""Time to bake many scenes in one process and in worker processes, as a table in Markdown.

python benchmarks/bake_many.py [--scenes 24] [--seed 0]

Scenes are variations of the demo kitchen and, if they are beside the project, of other authors' kitchens and rooms. A
variation has a random half of the objects, somewhat displaced. Every run starts without files, and the runs of each
round are in a new random order. Bundles of all runs must be equal. Two independent programs at once, each with half of
the scenes, show the upper bound of the machine. Processor time is the sum over all processes of a run, their start
included; other programs on the machine change it less than they change the wall time.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from importlib.util import find_spec
from multiprocessing import get_context
from pathlib import Path
from unittest.mock import patch

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from others import SCENES
from scene2hap import ManyReport, Pose, SceneSnapshot, bake_many, load_scene
from scene2hap.demo import kitchen_path

RUNS = (
    "this process",
    "processes:1",
    "processes:2",
    "a pool of one",
    "a pool of two",
    "Dask, one worker",
    "Dask, two workers",
    "two programs",
)
"""The pools and Dask are external executors, whose workers use one thread each."""

KEEP_MEMORY = {"MALLOC_TRIM_THRESHOLD_": str(1 << 27), "MALLOC_MMAP_THRESHOLD_": str(1 << 25)}
"""Environment of Dask's workers, as docs/many-scenes.md recommends, so that the C library reuses freed memory.

Dask sets the trim threshold to 64 KiB. If it is set to any value, the C library no longer adapts the mmap threshold,
which stays at 128 KiB. Each larger array is then mapped from the system, page by page, and returned to it.
"""


def write_variations(folder: Path, n: int, seed: int) -> list[Path]:
    """Write n scene JSON files. Returns their paths."""
    files = [kitchen_path(), *sorted(SCENES.glob("composed_*/*.glb"))]
    originals = [load_scene(path) for path in files]
    for i in range(n):
        rng = np.random.default_rng([seed, i])
        scene = originals[i % len(originals)]
        chosen = [item for item in scene.objects if rng.random() < 0.5] or list(scene.objects[:1])
        moved = [replace(item, pose=_moved(item.pose, rng)) for item in chosen]
        text = SceneSnapshot(f"{scene.name}_{i}", scene.up_axis, tuple(moved)).to_json()
        (folder / f"scene_{i:04d}.json").write_text(text)
    return sorted(folder.glob("*.json"))


def _moved(pose: Pose, rng: np.random.Generator) -> Pose:
    x, y, z = np.asarray(pose.position_m) + rng.uniform(-0.02, 0.02, 3) * (1, 0, 1)
    return Pose((float(x), float(y), float(z)), pose.rotation_xyzw)


def digest(folder: Path) -> str:
    """Digest of all bundles."""
    found = hashlib.sha256()
    for path in sorted(folder.glob("*.bundle/**/*")):
        if path.is_file():
            found.update(str(path.relative_to(folder)).encode() + path.read_bytes())
    return found.hexdigest()


def baked(scenes: list[Path], folder: Path, run: str) -> ManyReport:
    """Bake with one of the executors."""
    if run.startswith("a pool"):
        with ProcessPoolExecutor(1 if run.endswith("one") else 2, mp_context=get_context("spawn")) as pool:
            return bake_many(scenes, folder, executor=pool)
    if run.startswith("Dask"):
        import dask
        from distributed import Client, LocalCluster

        n_workers = 1 if "one" in run else 2
        with (
            # Dask's nannies also set variables in this process, which workers of later runs would inherit.
            patch.dict(os.environ, KEEP_MEMORY),
            dask.config.set({"distributed.worker.profile.enabled": False}),
            LocalCluster(n_workers=n_workers, threads_per_worker=1, dashboard_address=None) as cluster,
            Client(cluster) as client,
        ):
            return bake_many(scenes, folder, executor=client.get_executor())
    if run == "two programs":
        program = "import sys; from scene2hap import bake_many; bake_many(sys.argv[2:], sys.argv[1])"
        halves = [scenes[0::2], scenes[1::2]]
        both = [subprocess.Popen([sys.executable, "-c", program, str(folder), *map(str, half)]) for half in halves]
        assert [one.wait() for one in both] == [0, 0]
        return ManyReport([])
    return bake_many(scenes, folder, executor=None if run == "this process" else run)


def processor_s() -> float:
    """Processor time [s] of this process and of all its children that have ended."""
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=24)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--runs", nargs="+", choices=RUNS, metavar="RUN", help=f"of: {', '.join(RUNS)}")
    arguments = parser.parse_args()
    runs = arguments.runs or RUNS
    if find_spec("distributed") is None:
        runs = [run for run in runs if not run.startswith("Dask")]
    with tempfile.TemporaryDirectory() as place:
        (Path(place) / "scenes").mkdir()
        scenes = write_variations(Path(place) / "scenes", arguments.scenes, arguments.seed)
        times: dict[str, list[float]] = {run: [] for run in runs}
        processor: dict[str, list[float]] = {run: [] for run in runs}
        made = set()
        order = np.random.default_rng(arguments.seed)
        for turn in range(arguments.rounds):
            for k in order.permutation(len(runs)):
                folder = Path(place) / f"{turn}-{k}"
                begun, used = time.perf_counter(), processor_s()
                report = baked(scenes, folder, runs[k])
                times[runs[k]].append(time.perf_counter() - begun)
                processor[runs[k]].append(processor_s() - used)
                assert not report.failed, report.failed[0].error
                made.add(digest(folder))
    one = statistics.median(times["a pool of one"])
    print(
        f"{arguments.scenes} scenes, seed {arguments.seed}, {os.cpu_count()} processors; bundles "
        f"{'equal in all runs' if len(made) == 1 else 'DIFFER'}\n"
    )
    print(
        "| executor | time [s], median | scenes a minute | against one worker of one thread | processor time [s] |\n"
        "|---|---|---|---|---|"
    )
    for run, found in times.items():
        middle, used = statistics.median(found), statistics.median(processor[run])
        print(f"| {run} | {middle:.1f} | {60 * arguments.scenes / middle:.0f} | {one / middle:.2f} | {used:.1f} |")
    here, workers = (
        resource.getrusage(who).ru_maxrss / 1024 for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )
    print(f"\nMost memory: {here:.0f} MB in this process, {workers:.0f} MB in the largest worker.")


if __name__ == "__main__":
    main()
