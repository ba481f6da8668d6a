from __future__ import annotations

import pytest

from scene2hap.audio.sources.word_stems import noun_phrase, stems


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
def test_spellings_of_one_name_have_equal_stems(one: str, other: str) -> None:
    assert stems(one) == stems(other) != ()


@pytest.mark.parametrize(
    ("one", "other"),
    [("ring", "r"), ("string", "str"), ("glass", "glas s"), ("bus", "bu"), ("sewing machine", "washer")],
)
def test_different_names_have_different_stems(one: str, other: str) -> None:
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
def test_noun_phrase_ends_with_the_head_noun(category: str, head: str) -> None:
    assert noun_phrase(category)[-1:] == stems(head)


def test_text_without_words_has_no_noun_phrase() -> None:
    assert noun_phrase("") == noun_phrase("123 / 4") == ()
