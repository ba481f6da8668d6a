"""Count the questions of an inference and estimate its cost, without a model.

The chain runs with a stand-in for the model that counts requests. The lexicon estimates from the authored names which
objects may vibrate, and the number of materials. No picture is rendered, so that a question with pictures counts even
if a cache has its answer.
"""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from scene2hap.errors import BadAnswer
from scene2hap.haptics import is_unknown
from scene2hap.llm.backends.image_tokens import CHARACTERS_PER_TOKEN, image_tokens
from scene2hap.llm.chain.config import InferenceConfig
from scene2hap.llm.chain.inference import infer_scene
from scene2hap.llm.chain.report import InferenceReport
from scene2hap.llm.lexicon import LexiconBackend
from scene2hap.llm.protocol import COMPONENTS, Component, LLMReply, LLMRequest
from scene2hap.llm.request_key import request_key
from scene2hap.llm.wrappers.cache import CacheBackend
from scene2hap.llm.wrappers.prices import Given, Price, PriceList, price_list
from scene2hap.scene.snapshot import SceneSnapshot

_ANSWER_TOKENS: Mapping[Component, int] = {
    "scene_analyzer": 15,
    "object_analyzer": 300,
    "material_estimator": 50,
    "vibration_describer": 45,
}
"""Assumed: lengths of good answers. Reasoning models write several times as much."""

CountedQuestions = dict[str, LLMReply]
"""Questions that a dry run has counted, by `request_key`, with the answers that it assumed."""

_PICTURE_PX = 512
"""Default size of pictures in `scene.capture`."""


@dataclass(frozen=True)
class DryRun:
    """The questions that a run would send.

    calls : number by component; kept : number of further questions that a cache answers; images : pictures sent;
    text_tokens, image_tokens, answer_tokens : estimates, None if unknown for the model; cost_usd : at the prices of
    `price_date`, None if any part of it is unknown.
    report : the chain's report, with the calls that it would skip.
    """

    model: str
    calls: Mapping[Component, int]
    kept: int
    images: int
    text_tokens: int
    image_tokens: int | None
    answer_tokens: int
    cost_usd: float | None
    price_date: str
    report: InferenceReport

    @property
    def n_calls(self) -> int:
        """The number of questions to be sent."""
        return sum(self.calls.values())

    def rows(self) -> list[tuple[str, str]]:
        """Return the figures as (label, value) for display. An unknown figure reads "unknown"."""
        known = "unknown" if self.image_tokens is None else f"{self.image_tokens:,}"
        cost = "unknown" if self.cost_usd is None else f"{self.cost_usd:.2f} US dollars (prices of {self.price_date})"
        return [
            ("model", self.model),
            *((f"calls of {component.replace('_', ' ')}", str(self.calls[component])) for component in COMPONENTS),
            ("calls in all", str(self.n_calls)),
            ("answers in the cache", str(self.kept)),
            ("objects that share an analysis", str(self.report.skipped["copies"])),
            ("pictures", str(self.images)),
            ("tokens of text, about", f"{self.text_tokens:,}"),
            ("tokens of pictures, about", known),
            ("tokens of answers, about", f"{self.answer_tokens:,}"),
            ("cost, about", cost),
        ]

    def as_json(self) -> dict[str, Any]:
        """Return the figures as JSON values."""
        values = {name: getattr(self, name) for name in self.__dataclass_fields__ if name != "report"}
        return {**values, "calls": dict(self.calls), "skipped": dict(self.report.skipped)}


async def dry_run(
    scene: SceneSnapshot,
    model: str,
    *,
    user_prompt: str = "",
    config: InferenceConfig | Mapping[str, Any] | None = None,
    size_px: int = _PICTURE_PX,
    detail: str = "low",
    prices: Mapping[str, Price | Given] | None = None,
    service_tier: str = "",
    cache: CacheBackend | None = None,
    counted: CountedQuestions | None = None,
) -> DryRun:
    """Count the questions that `infer_scene` would send to `model` for a scene, and estimate their cost.

    `size_px` is the edge of each picture, `detail` its level of detail. `prices` override the dated list.
    `service_tier` is the billed tier, "" for the standard one. `cache` has earlier answers, and `counted` the questions
    that were counted before, to which those of this scene are added; with a cache each is sent once.
    Raises: ConfigError.
    """
    counter = _Counter(cache, {} if counted is None else counted)
    inference = await infer_scene(scene, counter, user_prompt=user_prompt, config=config)
    known_prices = price_list(prices)
    per_image = image_tokens(model, size_px, detail)
    seen = 0 if not counter.images else None if per_image is None else per_image * counter.images
    cost = None
    if seen is not None:
        usage = {"prompt_tokens": counter.text_tokens + seen, "completion_tokens": counter.answer_tokens}
        cost = known_prices.cost_usd(model, usage, service_tier)
    return DryRun(
        model,
        counter.calls,
        counter.kept,
        counter.images,
        counter.text_tokens,
        seen,
        counter.answer_tokens,
        cost,
        known_prices.date,
        inference.report,
    )


def estimated_cost_usd(
    request: LLMRequest, model: str, detail: str, prices: PriceList, service_tier: str = ""
) -> float | None:
    """Estimate the cost of one answer; None if it is unknown. No picture is rendered."""
    per_image = image_tokens(model, _PICTURE_PX, detail) if request.images else 0
    if per_image is None:
        return None
    read = _text_tokens(request) + per_image * len(request.images)
    usage = {"prompt_tokens": read, "completion_tokens": _ANSWER_TOKENS[request.component]}
    return prices.cost_usd(model, usage, service_tier)


def _text_tokens(request: LLMRequest) -> int:
    return math.ceil((len(request.prompt) + len(json.dumps(request.answer_schema))) / CHARACTERS_PER_TOKEN)


@dataclass
class _Counter:
    """Stand-in for a model: counts requests, and takes the answers from the lexicon.

    An object without an entry in the lexicon counts as one with a material of its own. This overestimates: most real
    objects share a material.
    """

    cache: CacheBackend | None
    counted: CountedQuestions
    calls: Counter[Component] = field(default_factory=Counter)
    kept: int = 0
    images: int = 0
    text_tokens: int = 0
    answer_tokens: int = 0

    async def complete(self, request: LLMRequest) -> LLMReply:
        if self.cache is None or request.images:
            return await self._counted(request)
        key = request_key(request)
        known = self.cache.stored(request) or self.counted.get(key)
        self.kept += known is not None
        self.counted[key] = known or await self._counted(request)
        return self.counted[key]

    async def _counted(self, request: LLMRequest) -> LLMReply:
        self.calls[request.component] += 1
        self.images += len(request.images)
        self.text_tokens += _text_tokens(request)
        self.answer_tokens += _ANSWER_TOKENS[request.component]
        try:
            reply = await LexiconBackend().complete(request)
        except BadAnswer:  # the material is in no table
            constants = {"density_kg_m3": 1.0, "youngs_modulus_gpa": 1.0, "poisson_ratio": 0.0, "damping_ratio": 0.0}
            return LLMReply(json.dumps(constants), "nobody")
        answer = json.loads(reply.text)
        if is_unknown(answer.get("material_category", "known")):
            answer["material_category"] = f"material of {request.subject}"[:60]
        return LLMReply(json.dumps(answer), reply.model)
