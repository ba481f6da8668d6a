"""What BLAS threads cost: a session of the demo kitchen with one, and with as many as BLAS starts by itself.

python benchmarks/blas_threads.py [--updates N]

Each row is a new process. `wait_prepared`, and `update` with a touch that moves in each frame at 90 Hz, are measured by
wall time: alone on the machine, and beside busy processes, as beside a game.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import statistics
import subprocess
import sys
import tempfile
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from scene2hap import HapticBundle, HapticSession, Touch, bake
from scene2hap.common import blas_threads
from scene2hap.demo import kitchen_path

KINDS = ("infinite_plate", "modal_plate", "mass_spring_damper", "auto")
FRAME_S = 0.011
VARIABLES = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")


def measured(bundle: HapticBundle, kind: str, n_updates: int) -> tuple[float, float]:
    """Time of preparation [s], and median time of an update [s]."""
    start = time.perf_counter()
    session = HapticSession(bundle, config={"propagation": {"kind": kind}})
    session.wait_prepared()
    prepared_s = time.perf_counter() - start
    places = [(item.id, item.bounds_m.mean(axis=0)) for item in bundle.snapshot.objects]
    taken = []
    for i in range(n_updates):
        object_id, (x, y, z) = places[i // 20 % len(places)]
        touch = Touch("left", object_id, (float(x), float(y), float(z) + 1e-4 * (i % 20)))
        start = time.perf_counter()
        session.update({}, [touch])
        taken.append(time.perf_counter() - start)
        time.sleep(FRAME_S)
    return prepared_s, statistics.median(taken)


@contextmanager
def busy_processes(number: int) -> Iterator[None]:
    """Run processes that compute without end."""
    processes = [multiprocessing.Process(target=_spin, daemon=True) for _ in range(number)]
    for process in processes:
        process.start()
    try:
        yield
    finally:
        for process in processes:
            process.terminate()
            process.join()


def _spin() -> None:
    while True:
        pass


def in_a_process(folder: Path, kind: str, n_updates: int, *, is_one: bool) -> tuple[float, float]:
    environment = {name: value for name, value in os.environ.items() if name not in VARIABLES}
    command = [sys.executable, __file__, "--child", str(folder), kind, str(n_updates), str(int(is_one))]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    prepared_s, update_s = map(float, done.stdout.split())
    return prepared_s, update_s


def child(folder: str, kind: str, n_updates: str, is_one: str) -> None:
    warnings.simplefilter("ignore")
    if not int(is_one):
        blas_threads.set_threads = lambda library, n_threads: None
    print(*measured(HapticBundle.load(folder), kind, int(n_updates)))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--updates", type=int, default=300)
    parser.add_argument("--child", nargs=4, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.child:
        child(*arguments.child)
        return
    n_cores = os.cpu_count() or 1
    print("| model | other programs | prepared [s]: one thread | BLAS's own | update [ms]: one thread | BLAS's own |")
    print("|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        saved = Path(folder, "kitchen.bundle")
        bake(kitchen_path()).save(saved)
        for per_core, beside in ((0, "none"), (1, "one busy process per core"), (3, "three busy processes per core")):
            with busy_processes(per_core * n_cores):
                for kind in KINDS:
                    one = in_a_process(saved, kind, arguments.updates, is_one=True)
                    own = in_a_process(saved, kind, arguments.updates, is_one=False)
                    cells = f"{one[0]:.2f} | {own[0]:.2f} | {1e3 * one[1]:.2f} | {1e3 * own[1]:.2f}"
                    print(f"| {kind} | {beside} | {cells} |", flush=True)


if __name__ == "__main__":
    main()
