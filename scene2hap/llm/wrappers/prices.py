"""Prices of models: a dated list that settings can override."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.errors import ConfigError

_SNAPSHOT = re.compile(r"-\d{4}-\d{2}-\d{2}$")
"""The date in the name of a model version: gpt-4o-2024-08-06."""
_MAKER = "openai/"
"""Gateways put it before the names of the models in the built-in list."""

Given = tuple[float, float] | tuple[float, float, float]
"""A price in settings: input, output, and optionally cached input."""

_STANDARD_TIERS = frozenset({"", "auto", "default"})


@clear_construction
@dataclass(frozen=True)
class Price:
    """Cost of a model per million tokens. The list is in US dollars; use dollars for your own prices too.

    cached_input_per_million : for input in the service's prompt cache; None means the price of other input.
    """

    input_per_million: float
    output_per_million: float
    cached_input_per_million: float | None = None

    def __post_init__(self) -> None:
        for name in ("input_per_million", "output_per_million", "cached_input_per_million"):
            if getattr(self, name) is not None:
                checks.number(name, getattr(self, name), "-", at_least=0.0, error=ConfigError)

    def cost(self, usage: Mapping[str, int]) -> float:
        """Return the cost of prompt_tokens (cached_tokens of them from the prompt cache) and completion_tokens."""
        cached = min(usage.get("cached_tokens", 0), usage["prompt_tokens"])
        of_cached = self.input_per_million if self.cached_input_per_million is None else self.cached_input_per_million
        fresh = (usage["prompt_tokens"] - cached) * self.input_per_million
        return (fresh + cached * of_cached + usage["completion_tokens"] * self.output_per_million) / 1e6


@dataclass(frozen=True)
class PriceList:
    """Prices by model, as of `date` (ISO 8601) and from `source`. `tiers` are price factors by service tier."""

    date: str
    source: str
    prices: Mapping[str, Price]
    tiers: Mapping[str, float]

    def of(self, model: str) -> Price | None:
        """Return the price of a model; None if unknown. Without its own, that of the name without maker or date."""
        name = model.removeprefix(_MAKER)
        return self.prices.get(model) or self.prices.get(name) or self.prices.get(_SNAPSHOT.sub("", name))

    def cost_usd(self, model: str, usage: Mapping[str, int], service_tier: str = "") -> float | None:
        """Return the cost of an answer [US dollars]; None if the price of its model or tier is unknown."""
        price = self.of(model)
        factor = 1.0 if service_tier in _STANDARD_TIERS else self.tiers.get(service_tier)
        return None if price is None or factor is None else factor * price.cost(usage)


def price_list(overrides: Mapping[str, Price | Given] | None = None) -> PriceList:
    """Return the built-in list, overridden by your own prices: model -> `Price`, or (input, output) or (input, output,
    cached input) per million tokens.

    Raises: ConfigError: an invalid price.
    """
    built_in = _built_in()
    if overrides is not None and not isinstance(overrides, Mapping):
        raise ConfigError(
            f"prices is {checks.described(overrides)}; it must be a mapping of models to US dollars per million "
            "tokens, as {'my-model': (0.5, 1.5)}."
        )
    own = {model: _price(model, price) for model, price in (overrides or {}).items()}
    return replace(built_in, prices={**built_in.prices, **own})


@cache
def _built_in() -> PriceList:
    table = json.loads(files(__package__).joinpath("prices.json").read_text(encoding="utf-8"))
    prices = {model: Price(*numbers) for model, numbers in table["usd"].items()}
    return PriceList(table["date"], table["source"], prices, table["tiers"])


def _price(model: str, price: Price | Given) -> Price:
    if isinstance(price, Price):
        return price
    try:
        return Price(*price)
    except ConfigError:
        raise
    except Exception as cause:  # a value that is no pair of numbers may raise anything
        raise ConfigError(
            f"the price of {model!r} is {checks.represented(price)}; it must be (input, output) or (input, output, "
            "cached input) per million tokens."
        ) from cause
