"""Damaged input for every reader of foreign data: only scene2hap's errors, in bounded time and memory, finite numbers.

python stress/hostile_files.py [--minutes 10] [--seed 0] [--readers "GLB" "bundle" ...] [--seconds 10]

A case damages one to three places of a small valid input (bytes, text, or values within a valid container), or replaces
a file by something that is no such file. A child process reads the result and uses it, with limits on its processor
time and on its memory. A case fails if another error than scene2hap's escapes, if an error does not name the file, is
longer than a page or shows the key in the input, if a warning of numpy is raised, if a number that is not finite is
accepted, or if a limit is exceeded. Prints a table, lists the failures, each with the command that repeats it, and
exits with 1 if there are any. Needs fork (POSIX).
"""

from __future__ import annotations

import argparse
import collections
import dataclasses
import enum
import gc
import itertools
import math
import os
import platform
import random
import resource
import shutil
import signal
import sys
import tempfile
import time
import traceback
import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).parents[1]))

import numpy as np

from scene2hap.errors import Scene2HapError
from stress.hostile.damage import damage, odd_file
from stress.hostile.readers import KEY, READERS, Reader
from stress.restarted_child import Child

LONGEST_MESSAGE = 3000
MOST_VALUES = 200_000
WARNED = (RuntimeWarning, DeprecationWarning, FutureWarning, ResourceWarning)
Outcome = tuple[str, str]


class TooSlow(BaseException):
    """The processor time is used up; not an Exception, so that no `except Exception` catches it."""


def numbers_not_finite(value: object) -> Iterator[str]:
    """Yield where a result holds numbers that are not finite. Fields of dataclasses and of models are searched."""
    waiting: list[tuple[str, object]] = [("result", value)]
    seen: set[int] = set()
    for _ in range(MOST_VALUES):
        if not waiting:
            return
        place, one = waiting.pop()
        if isinstance(one, float) and not math.isfinite(one):
            yield f"{place} is {one}"
        elif isinstance(one, np.ndarray):
            if one.dtype.kind == "f" and not np.isfinite(one).all():
                yield f"{place} has numbers that are not finite"
        elif isinstance(one, Mapping):
            waiting += [(f"{place}.{key}"[-120:], item) for key, item in one.items()]
        elif isinstance(one, list | tuple | set | frozenset):
            waiting += [(f"{place}[{i}]"[-120:], item) for i, item in enumerate(itertools.islice(one, 10_000))]
        elif not isinstance(one, str | bytes | int | enum.Enum | type | None) and id(one) not in seen:
            seen.add(id(one))
            names = [field.name for field in dataclasses.fields(one)] if dataclasses.is_dataclass(one) else ()
            names = names or tuple(getattr(type(one), "model_fields", ()))
            waiting += [(f"{place}.{name}"[-120:], getattr(one, name, None)) for name in names]


def prepare(reader: Reader, whole: Path, folder: Path, rng: random.Random) -> tuple[str, list[Path]]:
    """Copy an intact input and damage it. Returns what was done, and the damaged files."""
    shutil.copytree(whole, folder, symlinks=True)
    done, damaged = [], []
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        pattern = rng.choice(reader.damaged)
        files = sorted(path for path in folder.glob(pattern) if path.is_file() and not path.is_symlink())
        if not files:
            continue
        path = rng.choice(files)
        damaged.append(path)
        if reader.opens_files and rng.random() < 0.03:
            done.append(f"{odd_file(path, rng)} for {path.name}")
            break
        done.append(f"{damage(path, rng)} of {path.name}")
    return ", ".join(done), damaged


def read_one(reader: Reader, path: Path, damaged: list[Path], seconds: float) -> Outcome:
    """Read a damaged input. Returns ("read" or the name of the error, the failure or "")."""

    def ring(*_: object) -> None:
        raise TooSlow

    signal.signal(signal.SIGPROF, ring)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    shown = ""
    try:
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            try:
                result = reader.read(path)
            finally:
                signal.setitimer(signal.ITIMER_PROF, 0)
        wrong = next(numbers_not_finite(result), "")
        outcome = "read", f"not finite: {wrong}" if wrong else ""
        shown = "".join(str(one.message) for one in told if issubclass(one.category, UserWarning))
    except Scene2HapError as error:
        message = str(error)
        shown = message + "".join(traceback.format_exception(error))
        names = [one.name for one in damaged] + [path.name, str(path), path.stem]
        fault = ""
        if len(message) > LONGEST_MESSAGE:
            fault = f"a message of {len(message)} characters: {message[:100]}"
        elif reader.names_file and not any(name in message for name in names):
            fault = f"the message names no file: {message[:200]}"
        elif len(message) < 15:
            fault = f"the message says little: {message}"
        outcome = type(error).__name__, fault
    except TooSlow:
        return "slow", f"more than {seconds:g} s of processor time"
    except BaseException as error:
        where = [one for one in traceback.extract_tb(error.__traceback__) if "scene2hap/" in one.filename]
        last = f"{where[-1].filename.split('scene2hap/')[-1]}:{where[-1].lineno}" if where else "?"
        return "foreign", f"{type(error).__name__} at {last}: {str(error)[:150]}"
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    raw = next((one for one in told if issubclass(one.category, WARNED)), None)
    if raw is not None and not outcome[1]:
        where_raised = f"{raw.filename.split('site-packages/')[-1]}:{raw.lineno}"
        outcome = outcome[0], f"{raw.category.__name__} at {where_raised}: {str(raw.message)[:120]}"
    if KEY in shown:
        outcome = outcome[0], "the key is shown"
    return outcome


def child(pipe: Any, folder: Path, seed: int, seconds: float, megabytes: int) -> None:
    """Run cases by reader and number as they arrive; send (damage, outcome, failure, seconds, peak in MB)."""
    resource.setrlimit(resource.RLIMIT_DATA, (megabytes << 20, megabytes << 20))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    case = folder / "case"
    while (wanted := pipe.recv()) is not None:
        name, number = wanted
        reader = READERS[name]
        shutil.rmtree(case, ignore_errors=True)
        path = Path((folder / name / "path").read_text())
        done, damaged = prepare(reader, folder / name / "whole", case, random.Random(f"{seed}/{name}/{number}"))
        pipe.send(done)
        begin = time.process_time()
        outcome, fault = read_one(reader, case / path, damaged, seconds)
        if number % 20 == 0:
            gc.collect()
        peaks = [resource.getrusage(who).ru_maxrss for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
        pipe.send((outcome, fault, time.process_time() - begin, max(peaks) >> 10))


def run_case(process: Child, name: str, number: int) -> tuple[str, str, str, float, int]:
    """Return damage, outcome, failure, processor time [s] and peak memory [MB] until then."""
    replies, end = process.ask((name, number), n_replies=2)
    done = replies[0] if replies else "?"
    if end:
        outcome, _, fault = end.partition(": ")
        return done, outcome, fault, 0.0, 0
    return (done, *replies[1])


@dataclasses.dataclass
class Row:
    """What happened to the cases of one reader."""

    outcomes: collections.Counter[str] = dataclasses.field(default_factory=collections.Counter)
    slowest_s: float = 0.0
    failures: int = 0


def write_inputs(folder: Path, names: list[str]) -> list[str]:
    """Write the intact input of each reader, and read it once. Returns the readers whose format is installed."""
    written = []
    for name in names:
        whole = folder / name / "whole"
        whole.mkdir(parents=True)
        try:
            path = READERS[name].write(whole)
        except (ImportError, KeyError) as missing:  # usd_files is empty without usd-core
            print(f"{name} is left out: {missing}")
            continue
        (folder / name / "path").write_text(str(path.relative_to(whole)))
        shutil.copytree(whole, folder / "case")
        outcome, fault = read_one(READERS[name], folder / "case" / path.relative_to(whole), [path], 60.0)
        shutil.rmtree(folder / "case")
        if outcome != "read" or fault:
            raise SystemExit(f"the intact input of {name} is not read: {outcome} {fault}")
        written.append(name)
    return written


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--readers", nargs="+", choices=READERS, default=list(READERS), metavar="READER")
    parser.add_argument("--seconds", type=float, default=10.0, help="of processor time for one case")
    parser.add_argument("--megabytes", type=int, default=1024, help="of memory for the process that reads")
    parser.add_argument("--case", type=int, nargs="+", help="run only the cases of these numbers, of each reader")
    given = parser.parse_args()
    print(f"Python {platform.python_version()}, {platform.machine()}; seed {given.seed}")
    failures: list[str] = []
    peak = 0
    with tempfile.TemporaryDirectory() as work:
        names = write_inputs(Path(work), given.readers)
        rows = {name: Row() for name in names}
        limits = given.seconds, given.megabytes
        process = Child(child, Path(work), given.seed, *limits, longest_s=12 * given.seconds)
        end = time.monotonic() + 60 * given.minutes
        numbers = itertools.count() if given.case is None else given.case
        for number, name in ((number, name) for number in numbers for name in names):
            if given.case is None and number % READERS[name].every:
                continue
            if given.case is None and time.monotonic() > end:
                break
            done, outcome, fault, seconds, megabytes = run_case(process, name, number)
            rows[name].outcomes[outcome] += 1
            rows[name].slowest_s = max(rows[name].slowest_s, seconds)
            peak = max(peak, megabytes)
            if fault:
                rows[name].failures += 1
                failures.append(f'--seed {given.seed} --readers "{name}" --case {number} ({done}): {outcome}: {fault}')
                print(failures[-1], file=sys.stderr, flush=True)
        process.stop()
    print("| reader | cases | read | refused | slowest s | failed |\n|---|---|---|---|---|---|")
    for name, row in rows.items():
        n, read = row.outcomes.total(), row.outcomes["read"]
        print(f"| {name} | {n} | {read} | {n - read} | {row.slowest_s:.2f} | {row.failures} |")
    total = sum(row.outcomes.total() for row in rows.values())
    print(f"{total} cases, {len(failures)} failed, peak {peak} MB")
    return bool(failures)


if __name__ == "__main__":
    raise SystemExit(main())
