"""Sentences of the lexicon's reasons: articles, and names of any length."""

import re

import pytest

from scene2hap.llm.lexicon.categories import ObjectFacts, judge
from scene2hap.llm.lexicon.table import table

# The pronunciation decides: a you-niform, an em-ar-eye scanner, an our-glass.
SPOKEN_WITH_A_CONSONANT = {"ufo", "ukulele", "uniform", "urinal", "usb stick", "utensil rack"}
SPOKEN_WITH_A_VOWEL = {"hourglass", "led strip", "mri scanner", "x-ray machine"}


def test_every_noun_of_the_table_gets_the_right_article() -> None:
    nouns = {row.noun for row in table()}
    assert nouns >= SPOKEN_WITH_A_CONSONANT | SPOKEN_WITH_A_VOWEL
    for noun in nouns:
        vowel = noun in SPOKEN_WITH_A_VOWEL or (noun[0] in "aeiou" and noun not in SPOKEN_WITH_A_CONSONANT)
        right, wrong = ("an", "a") if vowel else ("a", "an")
        answer = judge(ObjectFacts(noun.replace(" ", "_"), (0.0, 0.0, 0.0)))
        assert f" names {right} {noun}." in answer.category_reason
        assert not re.search(rf"\b{wrong} {re.escape(noun)}\b", str(answer)), answer


def test_reasons_use_the_right_article() -> None:
    airplane = judge(ObjectFacts("toy_airplane", (0.1, 0.1, 0.0)))
    assert "names an airplane." in airplane.category_reason
    assert airplane.vibration_reason == "a toy airplane has no working mechanism."
    assert "assumed for a toy airplane." in airplane.size_reason
    umbrella = judge(ObjectFacts("umbrella", (0.5, 0.5, 0.0)))
    assert "assumed for an umbrella." in umbrella.size_reason
    assert umbrella.vibration_reason.startswith("an umbrella has no mechanism")


@pytest.mark.parametrize(
    ("name", "state"),
    [
        ("purring cat", "purring"),
        ("Radiator_ticking", "ticking"),
        ("dripping_faucet", "dripping"),
        ("flushing toilet", "flushing"),
        ("vibrating bed", "shaking"),
    ],
)
def test_name_that_says_what_a_silent_thing_does_makes_it_vibrate(name: str, state: str) -> None:
    answer = judge(ObjectFacts(name, (0.5, 0.5, 0.4)))
    assert [one.name for one in answer.states] == [state]
    assert answer.vibrates
    assert answer.vibration_reason.startswith("the name says that it is ")
    assert "Not understood" not in answer.category_reason


@pytest.mark.parametrize(
    "name", ["cat", "hummingbird", "rocking chair", "rolling pin", "running shoes", "toy cat purring", "spinning top"]
)
def test_silent_things_stay_silent(name: str) -> None:
    assert not judge(ObjectFacts(name, (0.4, 0.3, 0.1))).vibrates


def test_what_a_machine_does_by_itself_goes_before_its_name() -> None:
    (state,) = judge(ObjectFacts("humming refrigerator", (1.8, 0.6, 0.6))).states
    assert state.name == "on"


def test_names_of_any_length_are_answered() -> None:
    for name in ("table " * 200, "x" * 100_000, "fridge_" + "z" * 700, "toy car " + "y" * 700):
        answer = judge(ObjectFacts(name, (0.5, 0.5, 0.02)))
        assert len(answer.category_reason) <= 600


@pytest.mark.parametrize(
    ("name", "painted", "material"),
    [
        ("wooden block", (), "wood"),
        ("steel_platform_03", (), "steel"),
        ("Cube_wood_01", ("M_steel",), "wood"),
        ("Cube_01", ("M_Wood_Oak",), "oak"),
        ("Cube_01", (), "unknown"),
    ],
)
def test_unknown_object_is_of_the_material_that_its_name_says(
    name: str, painted: tuple[str, ...], material: str
) -> None:
    answer = judge(ObjectFacts(name, (0.3, 0.2, 0.1), material_names=painted))
    assert (answer.object_category, answer.material_category) == ("unknown", material)
    assert not answer.vibrates


@pytest.mark.parametrize(
    ("name", "material"),
    [
        ("steel ball", "steel"),
        ("oak plank", "oak"),
        ("plastic fork", "plastic"),
        ("fork", "stainless steel"),
        ("stone_fruit", "firm food"),
        ("wood frog", "soft tissue"),
        ("metal saw", "steel"),
    ],
)
def test_name_says_the_material_of_small_things_but_not_of_food_and_animals(name: str, material: str) -> None:
    assert judge(ObjectFacts(name, (0.2, 0.1, 0.1))).material_category == material


@pytest.mark.parametrize(
    ("name", "size_m", "category"),
    [
        ("Mobile basso", (0.9, 0.6, 0.5), "cabinet"),
        ("mobile_01", (0.15, 0.07, 0.01), "smartphone"),
        ("Wand_2", (4.0, 2.5, 0.1), "wall"),
        ("Magic_Wand", (0.35, 0.02, 0.02), "staff"),
    ],
)
def test_english_word_is_foreign_if_the_object_is_too_large(
    name: str, size_m: tuple[float, float, float], category: str
) -> None:
    assert judge(ObjectFacts(name, size_m)).object_category == category
