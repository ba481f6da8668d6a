"""The dated list of model prices."""

from datetime import date

import pytest

from scene2hap import Price
from scene2hap.llm.wrappers import price_list


def test_price_list_states_date_and_source() -> None:
    listed = price_list()
    assert date.fromisoformat(listed.date) >= date(2026, 1, 1)
    assert "genai-prices" in listed.source


@pytest.mark.parametrize(
    ("model", "price"),
    [
        ("gpt-4o", Price(2.5, 10.0, 1.25)),
        ("gpt-4o-2024-08-06", Price(2.5, 10.0, 1.25)),
        ("gpt-4o-2024-05-13", Price(5.0, 15.0)),  # the only snapshot with a higher price than its model
        ("gpt-4o-mini-2024-07-18", Price(0.15, 0.6, 0.075)),
        ("gpt-4", None),
        ("llava", None),
        ("gpt-4o-2024-08", None),
        ("", None),
    ],
)
def test_price_list_finds_models_and_snapshots_but_no_others(model: str, price: Price | None) -> None:
    assert price_list().of(model) == price


def test_given_prices_extend_or_replace_listed_prices() -> None:
    own = price_list({"llava": (0.0, 0.0), "gpt-4o": Price(1.0, 2.0)})
    assert own.of("llava") == Price(0.0, 0.0)
    assert own.of("gpt-4o-2024-11-20") == Price(1.0, 2.0)
    assert own.of("gpt-4.1") == price_list().of("gpt-4.1")
    assert price_list().of("gpt-4o") == Price(2.5, 10.0, 1.25)


def test_cached_input_and_tiers_have_separate_prices() -> None:
    listed = price_list({"own": (4.0, 8.0, 1.0), "plain": (4.0, 8.0)})
    usage = {"prompt_tokens": 1_000_000, "completion_tokens": 500_000, "cached_tokens": 250_000}
    assert listed.cost_usd("own", usage) == pytest.approx(0.75 * 4 + 0.25 * 1 + 4)
    assert listed.cost_usd("plain", usage) == pytest.approx(4 + 4)
    assert listed.cost_usd("own", usage, "batch") == pytest.approx((0.75 * 4 + 0.25 * 1 + 4) / 2)
    assert listed.cost_usd("own", usage, "default") == listed.cost_usd("own", usage)
    assert listed.cost_usd("own", usage, "of tomorrow") is None
    assert listed.cost_usd("nobody", usage) is None


def test_more_cached_input_than_input_costs_as_the_input() -> None:
    usage = {"prompt_tokens": 1_000_000, "cached_tokens": 9_000_000, "completion_tokens": 0}
    assert Price(2.0, 8.0, 0.5).cost(usage) == 0.5


def test_cached_input_never_costs_more_than_fresh() -> None:
    for model, price in price_list().prices.items():
        assert (price.cached_input_per_million or 0.0) < price.input_per_million, model


def test_a_gateway_puts_the_maker_before_the_name() -> None:
    listed = price_list({"openai/gpt-4.1": (3.0, 9.0)})
    assert listed.of("openai/gpt-4o-2024-08-06") == listed.of("gpt-4o")
    assert listed.of("openai/gpt-4.1") == Price(3.0, 9.0)
    assert listed.of("somebody/gpt-4o") is None
