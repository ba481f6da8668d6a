"""The questions that a bake would send to its model, counted in advance."""

from __future__ import annotations

from scene2hap.baking.config import BakeConfig
from scene2hap.llm.chain.dry_run import CountedQuestions, DryRun, dry_run
from scene2hap.llm.lexicon import LexiconBackend
from scene2hap.llm.wrappers import CacheBackend, identity, innermost
from scene2hap.scene.snapshot import SceneSnapshot


async def count_questions(
    scene: SceneSnapshot, config: BakeConfig, *, user_prompt: str = "", counted: CountedQuestions | None = None
) -> DryRun:
    """Count the questions about a scene that the cache of the settings cannot answer.

    `counted` has the questions about other scenes of one run, which the cache will have answered. This scene's are
    added.
    Raises: ConfigError.
    """
    settings, prices = identity(config.llm), config.prices
    model = str(settings.get("model", "no model behind an address"))
    if isinstance(innermost(config.llm), LexiconBackend):
        model, prices = "lexicon", {**(prices or {}), "lexicon": (0.0, 0.0)}
    return await dry_run(
        scene,
        model,
        user_prompt=user_prompt,
        config=config,
        detail=settings.get("detail", "low"),
        prices=prices,
        service_tier=getattr(innermost(config.llm), "service_tier", ""),
        cache=config.llm if isinstance(config.llm, CacheBackend) else None,
        counted=counted,
    )
