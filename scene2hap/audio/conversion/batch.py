"""Conversion of many sound files by several processes; one failure does not stop the others."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from scene2hap.audio.conversion.one_file import Conversion, convert, settled
from scene2hap.audio.conversion.writing import FORMATS
from scene2hap.audio.files import READABLE, SUFFIXES
from scene2hap.audio.sensation import LevelWarning
from scene2hap.audio.tactile import DEFAULT_CONVERTER
from scene2hap.common.counted import first_of
from scene2hap.common.files import drafts_of
from scene2hap.common.printable import quoted
from scene2hap.common.worker_processes import as_finished, most_workers, worker_processes
from scene2hap.errors import AudioError, Scene2HapError, unwritable

_MOST_NAMED = 3
_WORTH_BYTES = 1 << 23
"""Bytes of sounds that are worth another process (assumed): 40 s of WAV or 8 min of Ogg, which take 0.3 to 4 s to
convert. A process takes half a second to start."""

Progress = Callable[[str, int, int], None]
"""Called with (file, number of files done, number of all files)."""


@dataclass(frozen=True)
class Failure:
    """A file that was not converted, and the reason."""

    source: Path
    reason: str


@dataclass(frozen=True)
class _Job:
    source: Path
    output: Path


def convert_files(
    sources: Sequence[str | Path],
    output: str | Path,
    *,
    suffix: str = ".wav",
    pictures: bool = False,
    workers: int | None = None,
    progress: Progress | None = None,
    converter: object = DEFAULT_CONVERTER,
    actuator: object = "flat",
    intensity: float = 1.0,
    **settings: Any,
) -> list[Conversion | Failure]:
    """Convert files, and all files in folders, in the order given.

    Parameters:
    output : a file, if there is one source, which is no folder, and this path has a suffix and is no folder; otherwise
        a folder. There, files keep their name and their path below the source folder, with the new `suffix`.
    pictures : draw a PNG beside each output file; workers : number of processes, None for one per processor, but fewer
        for a few short sounds; a script that uses several needs ``if __name__ == "__main__":``; the rest : as for
        `convert`.
    Raises: ConfigError: settings that cannot work. AudioError: there is nothing to convert, or the output is one file
    for several sources. Problems of a single file are returned as a `Failure`.
    """
    settled(converter, actuator, intensity)
    settings |= {"converter": converter, "actuator": actuator, "intensity": intensity}
    jobs, failures = _planned([Path(source) for source in sources], Path(output), suffix)
    if not jobs and not failures:
        given = first_of([quoted(source) for source in sources], _MOST_NAMED) or "an empty list"
        raise AudioError(f"no sound file in {given}. Give {READABLE}, or a folder of them.")
    outcomes: dict[int, Conversion | Failure] = dict(failures)
    tell = progress or (lambda name, done, total: None)
    for index, outcome in _outcomes(jobs, workers, pictures, settings):
        outcomes[index] = outcome
        tell(outcome.source.name, len(outcomes), len(jobs) + len(failures))
    return [outcomes[index] for index in sorted(outcomes)]


def _outcomes(
    jobs: dict[int, _Job], workers: int | None, pictures: bool, settings: dict[str, Any]
) -> Iterator[tuple[int, Conversion | Failure]]:
    n_workers = most_workers(min(workers or _useful_workers(jobs.values(), pictures), len(jobs)))
    if n_workers <= 1:
        for index, job in jobs.items():
            yield index, _convert(job, pictures, settings)
        return
    left = dict(jobs)
    try:
        with worker_processes(n_workers) as pool:
            running = {pool.submit(_convert, job, pictures, settings): index for index, job in jobs.items()}
            for future in as_finished(running):
                index = running[future]
                yield index, _result(future, left.pop(index))
    finally:
        for job in left.values():  # after an interrupt
            _remove_drafts(job)


def _useful_workers(jobs: Iterable[_Job], pictures: bool) -> int:
    n_processors = os.cpu_count() or 1
    if pictures:  # drawing takes longer than a process takes to start
        return n_processors
    n_bytes = sum(os.path.getsize(job.source) for job in jobs if os.path.isfile(job.source))
    return min(n_processors, 1 + n_bytes // _WORTH_BYTES)


def _result(future: Future[Conversion | Failure], job: _Job) -> Conversion | Failure:
    try:
        return future.result()
    except BrokenProcessPool:
        _remove_drafts(job)
        return Failure(
            job.source,
            f"{job.source}: a process died while files were converted. Try with --workers 1; guard a script's entry "
            'with `if __name__ == "__main__":`.',
        )


def _remove_drafts(job: _Job) -> None:
    """Remove what a worker that died has begun to write."""
    with suppress(FileNotFoundError):  # it died before it made the folder
        for litter in drafts_of(job.output):
            litter.unlink(missing_ok=True)


def _convert(job: _Job, pictures: bool, settings: dict[str, Any]) -> Conversion | Failure:
    try:
        job.output.parent.mkdir(parents=True, exist_ok=True)
        picture = job.output.with_suffix(".png") if pictures else None
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", LevelWarning)  # the caller gets it as `Conversion.level_doubt`
            return convert(job.source, job.output, picture=picture, **settings)
    except Scene2HapError as error:
        return Failure(job.source, str(error))
    except OSError as error:
        return Failure(job.source, unwritable(job.output, error))


def _planned(sources: Sequence[Path], output: Path, suffix: str) -> tuple[dict[int, _Job], dict[int, Failure]]:
    """Return the job of each file, and the failures of files that cannot be converted."""
    if suffix not in FORMATS:
        raise AudioError(f"suffix is {suffix!r}; it must be one of {', '.join(FORMATS)}.")
    is_folder = os.path.isdir(output)
    if len(sources) == 1 and not os.path.isdir(sources[0]) and output.suffix and not is_folder:
        return {0: _Job(sources[0], output)}, {}
    if (output.suffix.lower() in FORMATS and not is_folder) or os.path.isfile(output):
        given = "is one file, and there is more than one to make"
        if len(sources) == 1 and not os.path.isdir(sources[0]):
            given = f"is a file, and ends in none of {', '.join(FORMATS)}"
        raise AudioError(f"{output} {given}. Give a folder.")
    jobs: dict[int, _Job] = {}
    failures: dict[int, Failure] = {}
    taken: dict[Path, Path] = {}
    for index, (path, below) in enumerate(_found(sources, output)):
        target = (output / below).with_suffix(suffix)
        if target in taken:
            failures[index] = Failure(path, f"{path} would become {target}, as {taken[target]} does. Rename one.")
        else:
            taken[target] = path
            jobs[index] = _Job(path, target)
    return jobs, failures


def _found(sources: Sequence[Path], output: Path) -> Iterator[tuple[Path, Path]]:
    """Yield every file and its path in the output folder. Files in the output folder are skipped as earlier results."""
    for source in sources:
        if not os.path.isdir(source):
            yield source, Path(source.name)
            continue
        for path in sorted(source.rglob("*")):
            is_output = path.resolve().is_relative_to(output.resolve()) and output.resolve() != source.resolve()
            if path.suffix.lower() in SUFFIXES and path.is_file() and not is_output:
                yield path, path.relative_to(source)
