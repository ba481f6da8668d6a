"""Account of an inference: calls, skipped calls and their reasons, usage, and errors."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from scene2hap.llm.protocol import Component, LLMReply
from scene2hap.llm.wrappers.prices import PriceList


@dataclass
class InferenceReport:
    """The account of one run of the chain.

    calls : sent to the backend, by component; kept : how many of them a cache or recording answered.
    skipped : calls that were saved, by reason: "copies" (objects that another stands for), "silent" (objects without a
        state to describe), "same_material" (objects whose material word was answered already), "unknown_material",
        "table_material" (words that were looked up instead), "unreached_material" (words that no source needs).
    billed : tokens of answers that were paid for now, by (model, service tier) and kind of token; unmetered : such
        answers without usage.
    errors : what could not be answered, by object id ("" is the scene) or material word.
    flags : what is doubtful, by material word; doubts : by object id, sizes that were not believed and contacts that
        nothing in the scene can give.
    """

    calls: Counter[Component] = field(default_factory=Counter)
    kept: int = 0
    skipped: Counter[str] = field(default_factory=Counter)
    billed: dict[tuple[str, str], Counter[str]] = field(default_factory=dict)
    unmetered: int = 0
    errors: dict[str, str] = field(default_factory=dict)
    flags: dict[str, tuple[str, ...]] = field(default_factory=dict)
    doubts: dict[str, tuple[str, ...]] = field(default_factory=dict)

    def take(self, reply: LLMReply) -> None:
        """Take an answer into the account."""
        if reply.is_kept:
            self.kept += 1
        elif reply.usage:
            self.billed.setdefault((reply.model, reply.service_tier), Counter()).update(reply.usage)
        else:
            self.unmetered += 1

    @property
    def tokens(self) -> dict[str, Counter[str]]:
        """Tokens of answers that were paid for now, by model and kind of token."""
        by_model: dict[str, Counter[str]] = {}
        for (model, _), used in self.billed.items():
            by_model.setdefault(model, Counter()).update(used)
        return by_model

    def cost_usd(self, prices: PriceList) -> float | None:
        """Cost of the answers; None where a model or tier has no price, or an answer came without its usage."""
        costs = [prices.cost_usd(model, used, tier) for (model, tier), used in self.billed.items()]
        known = [cost for cost in costs if cost is not None]
        return None if self.unmetered or len(known) < len(costs) else sum(known)

    def as_json(self) -> Mapping[str, Any]:
        """The account as JSON values."""
        return {
            "calls": dict(self.calls),
            "kept": self.kept,
            "skipped": dict(self.skipped),
            "tokens": {model: dict(used) for model, used in self.tokens.items()},
            "service_tiers": sorted({tier for _, tier in self.billed if tier}),
            "unmetered": self.unmetered,
            "errors": self.errors,
            "flags": {word: list(flags) for word, flags in self.flags.items()},
            "doubts": {object_id: list(doubts) for object_id, doubts in self.doubts.items()},
        }
