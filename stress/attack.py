"""The attack table: hostile files, servers, bundles, names and command lines against the command line of scene2hap.

python stress/attack.py [--seed 0] [--families scene_files servers ...] [--cases 100]

Each case runs in a child process with limits on processor time and memory, in a fresh folder with canaries around it.
A case passes if it exits with 0 or with a one-line error of scene2hap. It must show no traceback and no raw control
character, stay within the limits of time and memory, and change nothing outside its folder. The seed decides the cases.
Prints a table of the families, lists failed cases on standard error, and exits with 1 if any case failed. Needs fork
(POSIX).
"""

from __future__ import annotations

import argparse
import importlib
import itertools
import os
import pkgutil
import platform
import sys
import tempfile
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).parents[1]))

from stress.attacks.running import Verdict, run

FAMILIES = (
    "scene_files",
    "scene_sums",
    "servers",
    "bundles",
    "names",
    "command_line",
    "touch_files",
    "sounds",
    "keys",
    "library",
)


def campaign(family: str, seed: int, cases: int, work: Path) -> list[Verdict] | None:
    """Run the first cases of a family. Returns the verdicts, or None if the family has no module."""
    try:
        module = importlib.import_module(f"attacks.{family}")
    except ModuleNotFoundError as missing:
        if missing.name == f"attacks.{family}":
            return None
        raise
    inputs, around = work / family / "inputs", work / family / "around"
    inputs.mkdir(parents=True)
    (around / "beside").mkdir(parents=True)
    (around / "thesis.txt").write_text("years of work")
    (around / "beside" / "bundle.json").write_text("{}")
    verdicts = []
    for attack in itertools.islice(module.attacks(seed, inputs), cases):
        verdicts.append(run(attack, around))
        if verdicts[-1].fault:
            print(f"{family}: {attack.name}: {verdicts[-1].fault}", file=sys.stderr, flush=True)
    return verdicts


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--families", nargs="+", choices=FAMILIES, default=FAMILIES)
    parser.add_argument("--cases", type=int, default=100, help="of each family")
    arguments = parser.parse_args()
    _preload()
    print(f"Python {platform.python_version()}, {platform.machine()}; seed {arguments.seed}")
    print("| family | cases | accepted | refused | raw exceptions | bytes outside | worst s | worst MB | failed |")
    print("|---|---|---|---|---|---|---|---|---|")
    failed: list[Verdict] = []
    for family in arguments.families:
        with tempfile.TemporaryDirectory() as work:
            verdicts = campaign(family, arguments.seed, arguments.cases, Path(work))
        if verdicts is None:
            print(f"| {family} | absent | | | | | | | |")
            continue
        bad = [verdict for verdict in verdicts if verdict.fault]
        failed += bad
        row = (
            len(verdicts),
            sum(verdict.status == 0 for verdict in verdicts),
            sum(verdict.status > 0 and not verdict.fault for verdict in verdicts),
            sum(verdict.is_raw for verdict in verdicts),
            sum(verdict.bytes_outside for verdict in verdicts),
            f"{max((verdict.seconds for verdict in verdicts), default=0.0):.2f}",
            max((verdict.memory_bytes for verdict in verdicts), default=0) >> 20,
            len(bad),
        )
        print(f"| {family} | {' | '.join(map(str, row))} |", flush=True)
    return bool(failed)


def _preload() -> None:
    """Import common modules once, so that forked cases need not import them again."""
    import scene2hap.cli

    commands = (f"scene2hap.cli.{found.name}" for found in pkgutil.iter_modules(scene2hap.cli.__path__))
    for name in (
        *commands,
        "scene2hap.scene.load",
        "scene2hap.scene.formats.gltf.reader",
        "scene2hap.scene.formats.obj",
        "trimesh",
        "PIL",
        "scipy.signal",
    ):
        importlib.import_module(name)
    for name in ("collada", "mujoco"):
        try:
            importlib.import_module(name)
        except ImportError:
            print(f"{name} is not installed; its files are refused with an error message")


if __name__ == "__main__":
    raise SystemExit(main())
