"""Prices of models: a dated list that settings can override."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from scene2hap import checks
from scene2hap.calls import clear_construction
from scene2hap.errors import ConfigError

_SNAPSHOT = re.compile(r"-\d{4}-\d{2}-\d{2}$")
"""The date in the name of a model's version: gpt-4o-2024-08-06."""


@clear_construction
@dataclass(frozen=True)
class Price:
    """What a model costs per million tokens; the list is in US dollars, your own prices should be too."""

    input_per_million: float
    output_per_million: float

    def __post_init__(self) -> None:
        for name in ("input_per_million", "output_per_million"):
            checks.number(name, getattr(self, name), "-", at_least=0.0, error=ConfigError)


@dataclass(frozen=True)
class PriceList:
    """Prices by model, as of `date` (ISO 8601) and according to `source`."""

    date: str
    source: str
    prices: Mapping[str, Price]

    def of(self, model: str) -> Price | None:
        """The price of a model, or of the one that it is a dated snapshot of; None where it is not known."""
        return self.prices.get(model) or self.prices.get(_SNAPSHOT.sub("", model))


def price_list(overrides: Mapping[str, Price | tuple[float, float]] | None = None) -> PriceList:
    """The built-in list, with prices of one's own over it: model -> `Price` or (input, output) per million tokens.

    Raises: ConfigError: a price that is none.
    """
    built_in = _built_in()
    own = {model: _price(model, price) for model, price in (overrides or {}).items()}
    return PriceList(built_in.date, built_in.source, {**built_in.prices, **own})


@cache
def _built_in() -> PriceList:
    table = json.loads(files(__package__).joinpath("prices.json").read_text(encoding="utf-8"))
    return PriceList(table["date"], table["source"], {model: Price(*pair) for model, pair in table["usd"].items()})


def _price(model: str, price: Price | tuple[float, float]) -> Price:
    if isinstance(price, Price):
        return price
    try:
        return Price(*price)
    except ConfigError:
        raise
    except Exception as cause:  # what is no pair of numbers raises what it likes
        raise ConfigError(
            f"the price of {model!r} is {checks.represented(price)}; it must be (input, output) per million."
        ) from cause
