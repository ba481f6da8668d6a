"""Time and memory to prepare a floor with many objects on it, as a table in Markdown (docs/figures/propagation.md).

OMP_NUM_THREADS=1 python benchmarks/many_contacts.py [--crates 10 60 120 200] [--seconds 120]

Crates of 0.45 m with four contacts each stand on a wooden floor of 12 m, beside a washing machine and a refrigerator. A
hand touches the floor. Each session has a process of its own. Times are until its fields are prepared, memory is the
peak beyond that of the scene and its bundle.
"""

from __future__ import annotations

import argparse
import resource
import subprocess
import sys
import time
import warnings

from scene2hap import Box, HapticSession, Pose, SceneObject, SceneSnapshot, Touch, bake

MODELS = ("modal_plate", "auto", "mass_spring_damper", "infinite_plate")


def thing(name: str, size: tuple[float, float, float], x: float, z: float, bottom_m: float = 0.0) -> SceneObject:
    return SceneObject(name, pose=Pose((x, bottom_m + size[1] / 2, z)), geometry=Box(size))


def room(n_crates: int) -> SceneSnapshot:
    floor = thing("wooden floor", (12.0, 0.1, 12.0), 0.0, 0.0, -0.1)
    sources = [thing("washing machine", (0.6, 0.85, 0.6), 5.0, 5.0), thing("refrigerator", (0.6, 1.8, 0.6), -5.0, 5.0)]
    places = [(-5.5 + 0.6 * (k % 18), -5.5 + 0.8 * (k // 18)) for k in range(n_crates)]
    crates = [thing(f"wooden crate {k}", (0.45, 0.45, 0.45), x, z) for k, (x, z) in enumerate(places)]
    return SceneSnapshot.build([floor, *sources, *crates])


def peak_mb() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def prepare(kind: str, n_crates: int, impacts: bool, seconds: float) -> None:
    """Print one cell of the table."""
    warnings.simplefilter("ignore")
    scene = room(n_crates)
    bundle, touches = bake(scene), [Touch("left", "wooden floor", (0.1, 0.0, 0.1))]
    before_mb, begin = peak_mb(), time.perf_counter()
    with HapticSession(scene, bundle, {"propagation": kind, "impacts": impacts}) as session:
        session.update({}, touches)
        is_ready = session.wait_prepared(seconds)
        took = time.perf_counter() - begin
        shown = f"{took:.1f} s" if is_ready else f"over {seconds:.0f} s"
        print(f"{shown}, {(peak_mb() - before_mb) / 1000:.1f} GB", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--crates", type=int, nargs="+", default=[10, 60, 120, 200])
    parser.add_argument("--seconds", type=float, default=120.0, help="longest wait for one session (120)")
    parser.add_argument("--one", nargs=3, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.one:
        kind, n_crates, impacts = given.one
        prepare(kind, int(n_crates), impacts == "impacts", given.seconds)
        return
    print("| kind | impacts |" + "".join(f" {n} crates |" for n in given.crates))
    print("|---|---|" + "---|" * len(given.crates))
    for impacts in ("no", "impacts"):
        for kind in MODELS:
            command = [sys.executable, __file__, "--seconds", str(given.seconds), "--one", kind]
            cells = [
                subprocess.run([*command, str(n), impacts], capture_output=True, text=True, check=True).stdout.strip()
                for n in given.crates
            ]
            print(f"| `{kind}` | {'no' if impacts == 'no' else 'yes'} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
