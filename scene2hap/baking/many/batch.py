"""Inference of many scenes in batches, which cost half the price and are answered within a day.

The chain's questions depend on each other: the kind of place, then the objects, then materials and states. So scenes
are inferred in stages, and each stage is one batch over all scenes. `submit_batch` sends every question that is ready
now. `collect_batch` fetches the answers, stores them in the cache, and writes a draft of each completely answered
scene. `bake_many` continues from the drafts without further questions.

FOLDER/.bake-many/batch/           the batches (`scene2hap.llm.batch.folder`), and the lock of the active run
"""

from __future__ import annotations

import os
from collections.abc import AsyncIterator, Iterable, Mapping
from contextlib import asynccontextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from filelock import FileLock, Timeout

from scene2hap.baking.config import BakeConfig
from scene2hap.baking.many.pool import Pool, Submits
from scene2hap.baking.many.record import WORK
from scene2hap.baking.many.run import Progress, Run, scene_paths
from scene2hap.common import checks
from scene2hap.common.calls import clear_attributes, clear_call
from scene2hap.common.counted import counted
from scene2hap.common.run_coroutine import run_waiting
from scene2hap.common.settings import cache_folder
from scene2hap.errors import BudgetExceeded, ConfigError, Scene2HapError
from scene2hap.llm.backends.openai import OpenAIBackend
from scene2hap.llm.batch import AnswerPending, BatchBackend, BatchFolder, BatchRow, BatchService, BatchStatus
from scene2hap.llm.protocol import LLMReply, LLMRequest
from scene2hap.llm.stack import Wrapper
from scene2hap.llm.wrappers import CacheBackend, RepairBackend, identity, innermost
from scene2hap.llm.wrappers.prices import price_list

Scenes = Iterable[str | os.PathLike[str]]
Config = BakeConfig | Mapping[str, Any] | str | os.PathLike[str] | None


@clear_attributes
@dataclass(frozen=True)
class BatchReport:
    """Progress of the batches of a folder.

    Parameters: batches : all so far; n_scenes : scenes in the batches; n_ready : completely answered scenes, for
    `bake_many`; n_answers, cost_usd : answers so far and their cost, None if unknown; errors : by path of each scene
    that cannot be read or inferred.
    """

    batches: tuple[BatchRow, ...]
    n_scenes: int = 0
    n_ready: int = 0
    n_answers: int = 0
    cost_usd: float | None = 0.0
    errors: dict[str, str] = field(default_factory=dict)

    @property
    def n_to_send(self) -> int:
        """Number of questions that the next `submit_batch` sends."""
        return sum(len(row.requests) for row in self.batches if row.stage == "written")

    @property
    def n_under_way(self) -> int:
        """Number of questions in batches that have not been collected."""
        return sum(len(row.requests) for row in self.batches if row.stage in ("uploaded", "begun"))

    def to_data(self) -> dict[str, Any]:
        """Return plain data, for JSON."""
        rows = [
            {
                "batch": row.batch,
                "stage": row.stage,
                "status": row.status,
                "requests": len(row.requests),
                "completed": row.completed,
                "failed": row.failed,
                "faults": list(row.faults),
            }
            for row in self.batches
        ]
        names = ("n_scenes", "n_ready", "n_to_send", "n_under_way", "n_answers", "cost_usd", "errors")
        return {"batches": rows, **{name: getattr(self, name) for name in names}}

    def __str__(self) -> str:
        cost = "unknown cost" if self.cost_usd is None else f"{self.cost_usd:.2f} dollars"
        parts = [f"{self.n_ready} of {self.n_scenes} scenes answered throughout"] if self.n_scenes else []
        parts += [f"{counted(self.n_under_way, 'question')} under way", f"{self.n_to_send} to send"]
        return "; ".join([*parts, f"{counted(self.n_answers, 'answer')}, {cost}"])


@clear_call
def submit_batch(
    scenes: Scenes,
    folder: str | os.PathLike[str],
    *,
    config: Config,
    executor: str | Submits | None = None,
    options: Mapping[str, Any] | None = None,
    pictures: bool = False,
    user_prompt: str = "",
    progress: Progress | None = None,
) -> BatchReport:
    """Send all questions about scenes that are ready now and were not sent before.

    For parameters, see `bake_many`. The model must be of kind "openai", at OpenAI or at a compatible service with
    batches. An interrupted run can be repeated: no batch is begun twice.
    Raises: ConfigError: a setting that cannot work, or another run uses the folder. BudgetExceeded: the cost would
    exceed `max_cost_usd`. BackendUnavailable: the server cannot be reached, or refuses.
    """
    return run_waiting(
        _submitted(_Given(scenes, folder, config, executor, options, pictures, user_prompt, progress)),
        "asyncio.to_thread(submit_batch, ...)",
    )


@clear_call
def collect_batch(
    scenes: Scenes,
    folder: str | os.PathLike[str],
    *,
    config: Config,
    executor: str | Submits | None = None,
    options: Mapping[str, Any] | None = None,
    pictures: bool = False,
    user_prompt: str = "",
    progress: Progress | None = None,
) -> BatchReport:
    """Fetch the answers of batches that have ended, and write the next questions.

    For parameters, see `bake_many`. Answers are stored on disk before they are read. The next `submit_batch` sends
    the unanswered questions of an expired or cancelled batch again.
    Raises: as `submit_batch`.
    """
    return run_waiting(
        _collected(_Given(scenes, folder, config, executor, options, pictures, user_prompt, progress)),
        "asyncio.to_thread(collect_batch, ...)",
    )


@clear_call
def batch_status(folder: str | os.PathLike[str], *, config: Config, cancel: bool = False) -> BatchReport:
    """Fetch the status of a folder's batches. With `cancel`, end the running batches.

    Raises: as `submit_batch`.
    """
    return run_waiting(_status(_Given((), folder, config), cancel), "asyncio.to_thread(batch_status, ...)")


@dataclass(frozen=True)
class _Given:
    scenes: Scenes
    folder: str | os.PathLike[str]
    config: Config
    executor: str | Submits | None = None
    options: Mapping[str, Any] | None = None
    pictures: bool = False
    user_prompt: str = ""
    progress: Progress | None = None


@dataclass
class _Work:
    """A folder of batches, locked by this run."""

    config: BakeConfig
    model: OpenAIBackend
    folder: Path
    batches: BatchFolder
    service: BatchService

    async def recover(self) -> None:
        """Find batches that were begun although the server's reply was lost."""
        self.batches.discard_unfinished()
        for row in self.batches.rows():
            if row.stage == "uploaded":
                known = await self.service.begun_with(row.input_file)
                if known is not None:
                    self.batches.save(replace(row, stage="begun", batch=known.id, status=known.status))

    async def send(self) -> None:
        """Upload and begin every written batch. Raises: as `submit_batch`."""
        for row in self.batches.rows():
            if row.stage == "written":
                name = self.batches.input_path(row).name
                content = self.batches.requests(row)
                row = self.batches.save(
                    replace(row, stage="uploaded", input_file=await self.service.upload(name, content))
                )
            if row.stage == "uploaded":
                begun = await self.service.create(row.input_file)
                self.batches.save(replace(row, stage="begun", batch=begun.id, status=begun.status))

    async def fetch(self) -> None:
        """Record the progress of each batch, and store the results of ended batches."""
        for row in self.batches.rows():
            if row.stage == "begun":
                now = await self.service.status(row.batch)
                row = self._note(row, now)
                if now.has_ended:
                    names = (now.output_file, now.error_file)
                    files = [await self.service.content(name) if name else "" for name in names]
                    self.batches.keep(row, *files)

    async def note_status(self, cancel: bool) -> None:
        """Record the progress of each batch; with `cancel`, end it."""
        for row in self.batches.rows():
            if row.stage == "begun":
                now = await (self.service.cancel if cancel else self.service.status)(row.batch)
                self._note(row, now)

    def _note(self, row: BatchRow, now: BatchStatus) -> BatchRow:
        return self.batches.save(
            replace(row, status=now.status, completed=now.completed, failed=now.failed, faults=now.faults)
        )

    async def survey(self, given: _Given) -> BatchReport:
        """Infer every scene as far as answers exist, and write the next questions."""
        paths = scene_paths(given.scenes)
        backend = BatchBackend(self.model, self.batches, price_list(self.config.prices))
        stack = CacheBackend(RepairBackend(backend), self.config.cache_dir or cache_folder("llm"))
        errors: dict[str, str] = {}
        with Pool(given.executor) as pool:
            run = Run(
                paths,
                self.folder,
                self.config,
                self.config,
                dict(given.options or {}),
                given.user_prompt,
                pool,
                given.pictures,
                given.progress,
            )

            async def one(path: Path) -> str:
                watched = _Watched(stack)
                try:
                    return "ready" if await run.infer_ahead(path, watched, lambda: not watched.n_pending) else "waits"
                except AnswerPending:
                    return "waits"
                except (Scene2HapError, OSError) as problem:
                    errors[str(path)] = f"{type(problem).__name__}: {problem}"
                    return "failed"

            try:
                n_ready = (await run.each(one)).count("ready")
            finally:
                # Complete the file of new questions, however this run ends.
                backend.close()
        rows = tuple(self.batches.rows())
        return BatchReport(rows, len(paths), n_ready, backend.n_answers, backend.cost_usd, errors)

    def require_affordable(self, report: BatchReport) -> None:
        """Check the budget. Raises: BudgetExceeded: the estimated cost is above the limit, or a price is unknown."""
        limit = self.config.max_cost_usd
        written = [row for row in report.batches if row.stage == "written"]
        if limit is None or not written:
            return
        open_rows = [row for row in report.batches if row.stage != "collected"]
        costs = [report.cost_usd, *(row.estimate_usd for row in open_rows)]
        if None in costs:
            raise BudgetExceeded(
                f"max_cost_usd = {limit:g} cannot be kept: the price of {self.model.model!r} is unknown. Add it to "
                "prices, or set no limit."
            )
        spent, cost = report.cost_usd or 0.0, sum(cost for cost in costs if cost is not None)
        if cost > limit:
            raise BudgetExceeded(
                f"{report.n_to_send} questions would bring the cost to about {cost:.2f} dollars ({spent:.2f} so far); "
                f"max_cost_usd is {limit:g}. Nothing was sent. Raise the limit, or name fewer scenes."
            )


class _Watched(Wrapper):
    """Count the questions of one scene that have no answer yet."""

    def __init__(self, inner: CacheBackend) -> None:
        super().__init__(inner)
        self.n_pending = 0

    async def complete(self, request: LLMRequest) -> LLMReply:
        """Return the inner backend's answer."""
        try:
            return await self.inner.complete(request)
        except AnswerPending:
            self.n_pending += 1
            raise


async def _submitted(given: _Given) -> BatchReport:
    async with _at_work(given) as work:
        await work.recover()
        report = await work.survey(given)
        work.require_affordable(report)
        await work.send()
        return replace(report, batches=tuple(work.batches.rows()))


async def _collected(given: _Given) -> BatchReport:
    async with _at_work(given) as work:
        await work.recover()
        await work.fetch()
        return await work.survey(given)


async def _status(given: _Given, cancel: bool) -> BatchReport:
    async with _at_work(given) as work:
        await work.recover()
        await work.note_status(cancel)
        backend = BatchBackend(work.model, work.batches, price_list(work.config.prices))
        return BatchReport(tuple(work.batches.rows()), n_answers=backend.n_answers, cost_usd=backend.cost_usd)


@asynccontextmanager
async def _at_work(given: _Given) -> AsyncIterator[_Work]:
    """Lock the folder's batches for one run. Raises: ConfigError: wrong kind of model, or another run has the lock."""
    config = BakeConfig.parse(given.config)
    model = innermost(config.llm)
    if not isinstance(model, OpenAIBackend):
        raise ConfigError(
            f"batches need a model of kind 'openai', given by its kind; llm is {type(model).__name__} "
            f"({dict(identity(config.llm)) or 'no address'}). Name one, as llm='openai:gpt-4o' or --llm openai:gpt-4o. "
            "For any other model, bake without batches: bake_many(...), or `scene2hap bake-many`."
        )
    folder = checks.path("folder", given.folder, error=ConfigError)
    batches = BatchFolder(folder / WORK / "batch")
    lock = FileLock(batches.path / "lock", timeout=0)
    try:
        lock.acquire()
    except Timeout:
        raise ConfigError(f"another run is at work on the batches in {batches.path}; wait until it ends.") from None
    try:
        yield _Work(config, model, folder, batches, BatchService(model.endpoint))
    finally:
        lock.release()
