from __future__ import annotations

import pytest

from scene2hap.audio.sources.words import noun_phrase, stems


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("washing machine", "Washing Machines"),
        ("washing_machine_01", "washer"),
        ("hum", "humming"),
        ("vibrate", "vibrating"),
        ("buzz", "buzzes"),
        ("buzz", "buzzing"),
        ("drill", "drilling"),
        ("boil", "boils"),
        ("idle", "idling"),
        ("battery", "batteries"),
        ("watch", "watches"),
        ("fridge", "refrigerator"),
        ("microwave", "microwave oven"),
        ("coffee machine", "coffeeMaker"),
        ("fan-hum.2", "fan hum"),
    ],
)
def test_spellings_of_one_thing_are_one(one: str, other: str) -> None:
    assert stems(one) == stems(other) != ()


@pytest.mark.parametrize(
    ("one", "other"),
    [("ring", "r"), ("string", "str"), ("glass", "glas s"), ("bus", "bu"), ("sewing machine", "washer")],
)
def test_different_things_stay_different(one: str, other: str) -> None:
    assert stems(one) != stems(other)


@pytest.mark.parametrize(
    ("category", "head"),
    [
        ("electric toothbrush", "toothbrush"),
        ("pan on a heater", "pan"),
        ("bottle of water", "bottle"),
        ("computer (desktop)", "computer"),
        ("Washing Machine", "washer"),
        ("microwave oven", "microwave"),
    ],
)
def test_the_head_noun_says_what_it_is(category: str, head: str) -> None:
    assert noun_phrase(category)[-1:] == stems(head)


def test_no_words_no_noun() -> None:
    assert noun_phrase("") == noun_phrase("123 / 4") == ()
