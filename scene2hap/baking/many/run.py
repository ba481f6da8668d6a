"""Bake many scenes independently, with limits on running workers and on concurrent questions.

FOLDER/NAME.bundle                 the bundle of each scene
FOLDER/.bake-many/NAME.json        the record of its inputs: digests of scene and settings
FOLDER/.bake-many/NAME.lock        held by the run that bakes the scene
FOLDER/.bake-many/NAME.pictures/   pictures for a model, until it has answered
FOLDER/.bake-many/NAME.draft/      a model's answers, until the bundle is written
FOLDER/report.json                 the report of the last run

An executor makes pictures and sounds, and the whole bundle if no model is behind a network. This process sends all
questions to a model, so that all scenes share one cache, one budget and one rate limit.
"""

from __future__ import annotations

import asyncio
import hashlib
import os
import shutil
import time
import warnings
from collections import Counter
from collections.abc import Awaitable, Callable, Iterable, Mapping
from contextlib import AsyncExitStack, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

from filelock import AsyncFileLock

from scene2hap.baking.config import BakeConfig
from scene2hap.baking.corrections import infer_corrected
from scene2hap.baking.many.pool import Pool, Submits
from scene2hap.baking.many.record import REPORT, WORK, read_record, scene_digest, settings_digest, write_record
from scene2hap.baking.many.report import ManyReport, SceneReport
from scene2hap.baking.many.tasks import Counters, bake_scene, make_sounds, take_pictures
from scene2hap.bundle import HapticBundle
from scene2hap.bundle.overrides_file import read_overrides
from scene2hap.bundle.sounds import file_stem
from scene2hap.common import checks
from scene2hap.common.calls import clear_call
from scene2hap.common.printable import quoted
from scene2hap.common.run_coroutine import run_waiting
from scene2hap.common.warning import SceneWarning
from scene2hap.errors import ConfigError, unwritable
from scene2hap.llm.chain import Inference
from scene2hap.llm.chain.questions import ConcurrencyLimit
from scene2hap.llm.lexicon import LexiconBackend
from scene2hap.llm.protocol import LLMBackend
from scene2hap.llm.wrappers import is_remote, reports
from scene2hap.llm.wrappers.prices import price_list
from scene2hap.scene.capture import capture_images
from scene2hap.scene.files import scene_stem
from scene2hap.scene.load import load_scene
from scene2hap.scene.looks.textures import TextureWarning
from scene2hap.scene.plausibility.units import UnitWarning
from scene2hap.scene.snapshot import SceneSnapshot

Report = TypeVar("Report")

Progress = Callable[[str, str, int, int], None]
"""Called with (stage, scene, number of scenes done, total number)."""

_COUNTS = ("n_objects", "n_sources", "n_unknown")
_AHEAD = 4
"""Scenes in progress beyond the number of workers; assumed: as many as wait for a model at the same time."""


@clear_call
def bake_many(
    scenes: Iterable[str | os.PathLike[str]],
    folder: str | os.PathLike[str],
    *,
    config: BakeConfig | Mapping[str, Any] | str | os.PathLike[str] | None = None,
    executor: str | Submits | None = None,
    options: Mapping[str, Any] | None = None,
    pictures: bool = False,
    user_prompt: str = "",
    progress: Progress | None = None,
) -> ManyReport:
    """Bake scene files into bundles below a folder. Where an event loop runs, use `abake_many`.

    A scene is kept if its file and settings are unchanged since its last bake. If a scene fails, the others go on, and
    the report has its error. A stopped run can be repeated: it continues with the unfinished scenes, and the cache has
    the answers that were billed.

    Parameters:
    scenes : paths of scene files.
    folder : folder of the bundles. Each has the name of its scene file, with a digest if two names are equal.
    config : as for `bake`.
    executor : None for this process; "processes", "processes:N" or "dask:ADDRESS"; or an object with
        `submit(function, *arguments)` that returns a concurrent.futures.Future: process pools, Dask's
        `Client.get_executor()`, and executors for MPI or Slurm. Workers must see the same paths.
    options : arguments of `load_scene` for all scenes: up_axis, unit_m, group, assets_root, names.
    pictures : let workers render pictures, and show them to the model.
    Raises: ConfigError: settings or an executor that cannot work, no scenes.
    """
    running = abake_many(
        scenes,
        folder,
        config=config,
        executor=executor,
        options=options,
        pictures=pictures,
        user_prompt=user_prompt,
        progress=progress,
    )
    return run_waiting(running, "abake_many(...)")


@clear_call
async def abake_many(
    scenes: Iterable[str | os.PathLike[str]],
    folder: str | os.PathLike[str],
    *,
    config: BakeConfig | Mapping[str, Any] | str | os.PathLike[str] | None = None,
    executor: str | Submits | None = None,
    options: Mapping[str, Any] | None = None,
    pictures: bool = False,
    user_prompt: str = "",
    progress: Progress | None = None,
) -> ManyReport:
    """Bake scene files into bundles below a folder, awaitable; see `bake_many`."""
    paths, parsed = scene_paths(scenes), BakeConfig.parse(config)
    with Pool(executor) as pool:
        run = Run(
            paths,
            checks.path("folder", folder, error=ConfigError),
            parsed,
            # Workers get the lexicon in place of a network model: they send no questions, and a connection cannot be
            # pickled.
            parsed.model_copy(update={"llm": LexiconBackend()}) if is_remote(parsed.llm) else parsed,
            dict(options or {}),
            user_prompt,
            pool,
            pictures,
            progress,
        )
        return await run.all()


MOST_SCENES = 10_000_000
"""Bound on the scenes of a run, which only an endless generator exceeds."""


def scene_paths(scenes: Iterable[str | os.PathLike[str]]) -> list[Path]:
    """Return the scene files as paths. Raises: ConfigError: the list is empty, a single path, or no list."""
    if isinstance(scenes, str | os.PathLike):
        raise ConfigError(f"scenes is the path {quoted(scenes)}; give a list of paths, as sorted(Path(...).glob(...)).")
    given = checks.items("scenes", scenes, at_most=MOST_SCENES, error=ConfigError)
    paths = [checks.path(f"scenes[{i}]", scene, error=ConfigError) for i, scene in enumerate(given)]
    if not paths:
        raise ConfigError("scenes is empty; name at least one scene file.")
    return paths


@dataclass(frozen=True)
class _Inferred:
    """A model's answers about a scene, and their duration [s] by stage."""

    scene: SceneSnapshot
    found: Inference
    seconds: dict[str, float]


@dataclass
class Run:
    """One run over scenes: settings, paths on disk, and progress. Raises: ConfigError: a scene is given twice."""

    paths: list[Path]
    folder: Path
    config: BakeConfig
    for_workers: BakeConfig
    options: dict[str, Any]
    user_prompt: str
    pool: Pool
    pictures: bool
    progress: Progress | None
    n_done: int = 0

    def __post_init__(self) -> None:
        self.names: dict[Path, str] = _names(self.paths)
        options = {**self.options, "pictures": self.pictures}
        self.settings: str = settings_digest(self.config, self.user_prompt, options)
        self.limit: ConcurrencyLimit = ConcurrencyLimit(self.config.concurrency)  # of all scenes together

    async def all(self) -> ManyReport:
        """Bake the scenes, and write the report."""
        begun = time.perf_counter()
        try:
            (self.folder / WORK).mkdir(parents=True, exist_ok=True)  # before a model costs money
        except OSError as cause:
            raise ConfigError(unwritable(self.folder, cause)) from cause
        found = await self.each(self._scene)
        stack = {name: dict(layer) for name, layer in reports(self.config.llm).items()}
        report = ManyReport(found, time.perf_counter() - begun, stack)
        if not report.failed:
            shutil.rmtree(self._work("all", ".pictures"), ignore_errors=True)
        try:
            write_record(self.folder / REPORT, report.to_data())
        except ConfigError as cause:
            # On a full disk the scenes have failed, too, and no report tells why.
            errors = " ".join(f"{one.scene}: {one.error}" for one in report.failed[:3])
            raise ConfigError(f"{cause} {report}. {errors}".rstrip()) from cause
        return report

    async def each(self, work: Callable[[Path], Awaitable[Report]]) -> list[Report]:
        """Return the report of each scene. Keeps enough scenes in progress to use all workers."""
        gate = asyncio.Semaphore(self.pool.n_workers + _AHEAD)

        async def one(path: Path) -> Report:
            async with gate:
                found = await work(path)
            self.n_done += 1
            if self.progress is not None:
                self.progress(str(found), self.names[path], self.n_done, len(self.paths))
            return found

        with warnings.catch_warnings():
            # Workers repeat the warnings of a scene when they check it. The filters belong to all threads, so they are
            # set once here and not by each thread that reads a scene.
            for category in (SceneWarning, TextureWarning, UnitWarning):
                warnings.simplefilter("ignore", category)
            running = [asyncio.ensure_future(one(path)) for path in self.paths]
            try:
                return await asyncio.gather(*running)
            except asyncio.CancelledError:
                # `gather` ends with the first cancelled scene. Others wait for answers that are paid for.
                await asyncio.wait(running)
                raise

    async def _scene(self, path: Path) -> SceneReport:
        """Bake one scene, or return a report with its error. Waits while another run bakes it."""
        async with AsyncExitStack() as held:
            # A file system without locks goes on: two runs are rare, and then one of both may have to run again.
            with suppress(OSError, NotImplementedError):
                await held.enter_async_context(AsyncFileLock(self._work(self.names[path], ".lock")))
            return await self._baked(path)

    async def _baked(self, path: Path) -> SceneReport:
        report, target = self._unmade(path), self.target(path)
        try:
            made_of, stage = await self.state(path)
            if stage == "baked":
                await asyncio.to_thread(shutil.rmtree, self._draft(path), ignore_errors=True)  # of a killed run
                before = read_record(self._record(path))
                counts = {key: before[key] for key in _COUNTS if isinstance(before.get(key), int)}
                return replace(report, outcome="kept", **counts)
            if is_remote(self.config.llm):
                draft = self._draft(path)
                if stage != "inferred":
                    report = await self._drafted(path, made_of, await self._inferred(path, self.config.llm))
                made = await self.pool.run(make_sounds, str(draft), str(target), self.for_workers, self._written(path))
            else:
                whole = (str(path), self.options, str(target), self.for_workers, self.user_prompt, self._written(path))
                made = await self.pool.run(bake_scene, *whole)
            report = _with(report, made)
            counts = {key: getattr(report, key) for key in _COUNTS}
            # Before anything is awaited: a run that is cancelled ends there, and the bundle is on the disk.
            self._note(path, made_of, stage="baked", bundle=made.digest, **counts)
            await asyncio.to_thread(shutil.rmtree, self._draft(path), ignore_errors=True)
            return report
        except Exception as error:  # a foreign executor may raise any exception
            return replace(report, error=f"{type(error).__name__}: {error}")

    async def infer_ahead(self, path: Path, backend: LLMBackend, is_whole: Callable[[], bool]) -> bool:
        """Infer a scene with a backend, and write its draft if `is_whole` then returns True.

        Returns True if the scene now has a draft or a bundle.

        Raises: as `load_scene` and `infer_corrected`.
        """
        made_of, stage = await self.state(path)
        if stage:
            return True
        found = await self._inferred(path, backend)
        if is_whole():
            await self._drafted(path, made_of, found)
        return is_whole()

    async def state(self, path: Path) -> tuple[dict[str, str], str]:
        """Return the digests of a scene's inputs, and how far they are baked: "baked", "inferred" (a draft), or "".

        Raises: ConfigError: the bundle of its name is that of another scene file, which an earlier run has baked.
        """
        before = read_record(self._record(path))
        place = before.get("path")
        other = Path(os.path.normpath(self.folder / place)) if isinstance(place, str) else path
        if path.is_file() and other.is_file() and not path.samefile(other):
            raise ConfigError(
                f"{self.target(path)} is the bundle of {other}. Bake both scenes in one run, which gives them "
                "different names, or choose another folder."
            )
        made_of = {"scene": await asyncio.to_thread(scene_digest, path, self.options), "settings": self.settings}
        stage = str(before["stage"]) if made_of.items() <= before.items() else ""
        made_at = {"baked": self.target(path), "inferred": self._draft(path)}.get(stage)
        return made_of, stage if made_at is not None and (made_at / "bundle.json").is_file() else ""

    def _note(self, path: Path, made_of: Mapping[str, str], **facts: str | int) -> None:
        """Write the record of a scene. Raises: ConfigError: it cannot be written."""
        place = str(path.absolute())
        with suppress(ValueError):  # another drive, on Windows
            place = os.path.relpath(path, self.folder)  # a project that is copied as a whole finds its own scenes
        write_record(self._record(path), {**made_of, "path": Path(place).as_posix(), **facts})

    def _written(self, path: Path) -> str:
        """Return the digest of the bundle that the last bake of a scene wrote, "-" if that is unknown."""
        return str(read_record(self._record(path)).get("bundle", "-"))

    async def _inferred(self, path: Path, backend: LLMBackend) -> _Inferred:
        """Read a scene and infer it with the model."""
        begun = time.perf_counter()
        scene = await asyncio.to_thread(load_scene, path, **self.options)
        read_s, begun = time.perf_counter() - begun, time.perf_counter()
        seen = await self._captured(path, scene) if self.pictures else scene
        overrides = read_overrides(self.target(path))
        found = await infer_corrected(
            seen, backend, self.config, overrides, user_prompt=self.user_prompt, limit=self.limit
        )
        return _Inferred(scene, found, {"reading": read_s, "inference": time.perf_counter() - begun})

    async def _drafted(self, path: Path, made_of: Mapping[str, str], inferred: _Inferred) -> SceneReport:
        """Write the inferred scene as a draft, from which a worker or a later run continues."""
        found, draft = inferred.found, self._draft(path)
        draft.parent.mkdir(parents=True, exist_ok=True)
        await asyncio.to_thread(HapticBundle(inferred.scene, found.scene_category, found.objects, {}).save, draft)
        self._note(path, made_of, stage="inferred", bundle=self._written(path))
        if not self.config.share_scenes:
            await asyncio.to_thread(shutil.rmtree, self._pictures(path), ignore_errors=True)
        return replace(
            self._unmade(path),
            calls=sum(found.report.calls.values()),
            kept=found.report.kept,
            cost_usd=found.report.cost_usd(price_list(self.config.prices)),
            seconds=inferred.seconds,
        )

    async def _captured(self, path: Path, scene: SceneSnapshot) -> SceneSnapshot:
        """Return the scene with pictures, which a worker renders."""
        folder, alone = str(self._pictures(path)), self.config.share_scenes
        await self.pool.run(take_pictures, str(path), self.options, folder, alone)
        return capture_images(scene, config={"cache_dir": folder}, alone=alone)

    def _pictures(self, path: Path) -> Path:
        """Return the folder of pictures for inference. Pictures of single objects are shared by all scenes."""
        return self._work("all" if self.config.share_scenes else self.names[path], ".pictures")

    def _unmade(self, path: Path) -> SceneReport:
        return SceneReport(str(path), str(self.target(path)), "failed")

    def target(self, path: Path) -> Path:
        """Return the folder of a scene's bundle."""
        return self.folder / f"{self.names[path]}.bundle"

    def _record(self, path: Path) -> Path:
        return self._work(self.names[path], ".json")

    def _draft(self, path: Path) -> Path:
        return self._work(self.names[path], ".draft")

    def _work(self, name: str, ending: str) -> Path:
        return self.folder / WORK / f"{name}{ending}"


def _with(report: SceneReport, made: Counters) -> SceneReport:
    return replace(
        report,
        outcome="baked",
        n_objects=made.n_objects,
        n_sources=made.n_sources,
        n_unknown=made.n_unknown,
        calls=report.calls + made.calls,
        seconds={**report.seconds, "baking": made.seconds},
        warnings=made.warnings,
    )


def _names(paths: list[Path]) -> dict[Path, str]:
    """Return a name for each scene: the name of its file, with a digest of its path if several files have one name.

    Raises: ConfigError: a scene is given twice.
    """
    twice = [path for path, n in Counter(paths).items() if n > 1]
    if twice:
        raise ConfigError(f"scenes has {quoted(twice[0])} twice; give each scene once.")
    alike = Counter(file_stem(scene_stem(path)).casefold() for path in paths)
    return {
        path: stem if alike[(stem := file_stem(scene_stem(path))).casefold()] == 1 else f"{stem}-{_digest(path)}"
        for path in paths
    }


def _digest(path: Path) -> str:
    return hashlib.sha256(os.fsencode(path.absolute())).hexdigest()[:8]
