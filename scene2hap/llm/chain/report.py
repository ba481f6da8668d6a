"""Report of an inference: calls, skipped calls and their reasons, usage, and errors."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from scene2hap.common.checks import represented
from scene2hap.common.counted import first_of
from scene2hap.common.warning import warn_of
from scene2hap.llm.protocol import BackendWarning, Component, LLMReply
from scene2hap.llm.wrappers.prices import PriceList

_LONGEST_SHOWN = 1000
"""Most characters of an error in a warning: a service's longest message, its address and the next step."""


@dataclass
class InferenceReport:
    """The report of one run of the chain.

    calls : number sent to the backend, by component; kept : number answered by a cache or recording.
    skipped : number of saved calls by reason: "copies" (copies of another object), "silent" (objects without a state
        to describe), "same_material" (material words that already have an answer), "unknown_material", "table_material"
        (words looked up in the table), "unreached_material" (words that no source needs).
    billed : tokens of answers billed in this run, by (model, service tier) and kind of token; unmetered : number of
        billed answers without usage.
    errors : questions without an answer, by object id ("" is the scene) or material word.
    flags : doubtful constants, by material word; doubts : by object id, rejected sizes and masses, and needed contacts
        that the scene cannot give.
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
        """Add an answer to the report."""
        if reply.is_kept:
            self.kept += 1
        elif reply.usage:
            self.billed.setdefault((reply.model, reply.service_tier), Counter()).update(reply.usage)
        else:
            self.unmetered += 1

    def add_answers_of(self, earlier: InferenceReport) -> None:
        """Add the calls and the answers of an earlier run over the same scene, which were paid for too."""
        self.calls.update(earlier.calls)
        self.kept += earlier.kept
        self.unmetered += earlier.unmetered
        for billed_as, used in earlier.billed.items():
            self.billed.setdefault(billed_as, Counter()).update(used)

    @property
    def tokens(self) -> dict[str, Counter[str]]:
        """Tokens of answers billed in this run, by model and kind of token."""
        by_model: dict[str, Counter[str]] = {}
        for (model, _), used in self.billed.items():
            by_model.setdefault(model, Counter()).update(used)
        return by_model

    def cost_usd(self, prices: PriceList) -> float | None:
        """Return the cost of the answers; None if a model or tier has no price, or an answer has no usage."""
        costs = [prices.cost_usd(model, used, tier) for (model, tier), used in self.billed.items()]
        known = [cost for cost in costs if cost is not None]
        return None if self.unmetered or len(known) < len(costs) else sum(known)

    def warn_of_errors(self) -> None:
        """Warn of objects, states and materials without an answer, for callers who do not get the report.

        Warns: BackendWarning.
        """
        if not self.errors:
            return
        about = first_of([represented(what) if what else "the scene" for what in self.errors], 3)
        # A backend of a user's own may raise an error with a whole answer in it.
        first = " ".join(next(iter(self.errors.values())).split())
        first = f"{first[:_LONGEST_SHOWN]}..." if len(first) > _LONGEST_SHOWN else f"{first.rstrip('.')}."
        warn_of(
            f"the model gave no answer about {about}. The first error: {first} What is not known is left out. Ask "
            "again, which repeats only these questions if the backend has a cache, or give the values by override. The "
            "report has all errors: on_report= of bake, or that of infer_scene.",
            BackendWarning,
        )

    def as_json(self) -> Mapping[str, Any]:
        """Return the report as JSON values."""
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
