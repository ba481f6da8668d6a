"""Scene files of a megabyte whose rows are small but add up to large totals: read by `inspect`, then by `bake`.

These cases are the same in every campaign except for their random numbers; `scene_files` draws its cases from the seed.
"""

from __future__ import annotations

import itertools
import random
from collections.abc import Iterator
from pathlib import Path

from stress.attacks import mjcf_sums, node_sums, text_sums
from stress.attacks.attack import Attack

BAKE_SECONDS = 15.0
"""Limit of processor time of a bake, which also infers each object and makes sounds."""
CASES = (*node_sums.CASES, *text_sums.CASES, *mjcf_sums.CASES)


def attacks(seed: int, work: Path) -> Iterator[Attack]:
    """Attacks by every case with `inspect`, then by every case with `bake`."""
    for number, (command, case) in enumerate(itertools.product(("inspect", "bake"), CASES)):
        files = case(random.Random(f"scene_sums/{seed}/{case.__name__}"))
        folder = work / str(number)
        folder.mkdir()
        for file, data in files.items():
            (folder / file).write_bytes(data)
        argv = ("scene2hap", command, str(folder / next(iter(files))))
        if command == "bake":
            yield Attack("scene_sums", f"bake {case.__name__}", (*argv, "-o", "bundle"), seconds=BAKE_SECONDS)
        else:
            yield Attack("scene_sums", f"inspect {case.__name__}", argv)
