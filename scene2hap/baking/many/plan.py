"""What a run over many scenes would do, without baking and without a question to a model."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from scene2hap.baking.config import BakeConfig
from scene2hap.baking.many.pool import Pool
from scene2hap.baking.many.run import Progress, Run, scene_paths
from scene2hap.baking.questions import count_questions
from scene2hap.bundle.folder_replacement import require_replaceable
from scene2hap.common import checks
from scene2hap.common.calls import clear_attributes, clear_call
from scene2hap.common.run_coroutine import run_waiting
from scene2hap.errors import ConfigError, Scene2HapError
from scene2hap.llm.chain.dry_run import CountedQuestions, DryRun
from scene2hap.llm.wrappers import is_remote
from scene2hap.scene.capture import capture_images
from scene2hap.scene.load import load_scene


@clear_attributes
@dataclass(frozen=True)
class ScenePlan:
    """What `bake_many` would do with one scene.

    Parameters: plan : "bake"; "sounds", if only its sounds and loops are missing; "keep", if file and settings are
    unchanged since an earlier run; or "fail"; questions : those to a model behind a network, None without one.
    """

    scene: str
    bundle: str
    plan: Literal["bake", "sounds", "keep", "fail"]
    n_objects: int = 0
    questions: DryRun | None = None
    error: str = ""

    def __str__(self) -> str:
        return self.plan

    def to_data(self) -> dict[str, Any]:
        """Return plain data, for JSON."""
        questions = None if self.questions is None else self.questions.as_json()
        paths = {"scene": Path(self.scene).as_posix(), "bundle": Path(self.bundle).as_posix()}
        return {"plan": self.plan, "n_objects": self.n_objects, "error": self.error, **paths, "questions": questions}


@clear_call
def plan_many(
    scenes: Iterable[str | os.PathLike[str]],
    folder: str | os.PathLike[str],
    *,
    config: BakeConfig | Mapping[str, Any] | str | os.PathLike[str] | None = None,
    options: Mapping[str, Any] | None = None,
    pictures: bool = False,
    user_prompt: str = "",
    progress: Progress | None = None,
) -> list[ScenePlan]:
    """Return what `bake_many` would do with each scene; for parameters, see there. Writes nothing.

    Without pictures, questions count as kept if the cache can answer them or another scene has the same. With pictures,
    which are part of a question and are not rendered here, every question counts.
    Raises: ConfigError: as `bake_many`.
    """
    return run_waiting(
        _planned(scenes, folder, BakeConfig.parse(config), options, pictures, user_prompt, progress),
        "asyncio.to_thread(plan_many, ...)",
    )


async def _planned(
    scenes: Iterable[str | os.PathLike[str]],
    folder: str | os.PathLike[str],
    config: BakeConfig,
    options: Mapping[str, Any] | None,
    pictures: bool,
    user_prompt: str,
    progress: Progress | None,
) -> list[ScenePlan]:
    paths, place = scene_paths(scenes), checks.path("folder", folder, error=ConfigError)
    counted: CountedQuestions = {}
    turn = asyncio.Lock()  # one scene after the other, so that a shared question counts for the first of them
    with Pool(None) as pool:
        run = Run(paths, place, config, config, dict(options or {}), user_prompt, pool, pictures, progress)

        async def one(path: Path) -> ScenePlan:
            async with turn:
                return await planned(path)

        async def planned(path: Path) -> ScenePlan:
            target = str(run.target(path))
            try:
                _, stage = await run.state(path)
                if stage:
                    return ScenePlan(str(path), target, "keep" if stage == "baked" else "sounds")
                require_replaceable(run.target(path))
                scene = await asyncio.to_thread(load_scene, path, **run.options)
                n = len(scene.objects)
                if not is_remote(config.llm):
                    return ScenePlan(str(path), target, "bake", n)
                seen = capture_images(scene, alone=config.share_scenes) if pictures else scene
                found = await count_questions(seen, config, user_prompt=user_prompt, counted=counted)
                return ScenePlan(str(path), target, "bake", n, found)
            except (Scene2HapError, OSError) as problem:
                return ScenePlan(str(path), target, "fail", error=f"{type(problem).__name__}: {problem}")

        return await run.each(one)
