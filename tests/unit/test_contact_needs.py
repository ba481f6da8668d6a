"""Contact needs of a source's state, matched to object categories by meaning."""

import pytest

from scene2hap import SourceState
from scene2hap.contact_needs import meets
from scene2hap.haptics import unmet_needs
from scene2hap.llm.lexicon.table import table


@pytest.mark.parametrize(
    ("needed", "category"),
    [
        ("stove", "cooktop"), ("stove", "hob"), ("stove", "Gas Hob"), ("a hot stove", "induction hob"),
        ("Stove", "stove"), ("stoves", "electric stove"), ("stove or oven", "cooktop"), ("heater/stove", "hot plate"),
        ("stove (switched on)", "hob"), ("on a stovetop", "burner"), ("table", "dining table"), ("desk", "table"),
        ("coffee table", "table"), ("charging station", "charger"), ("heat source", "campfire"),
    ],
)  # fmt: skip
def test_synonyms_match(needed: str, category: str) -> None:
    assert meets(needed, "Object_7", category)


@pytest.mark.parametrize(
    ("needed", "category"),
    [
        ("stove", "table"), ("stove", "stove door"), ("stove", "toy stove"), ("stove", "cooker hood"),
        ("hot plate", "plate"), ("table", "table lamp"), ("stove", "fire extinguisher"), ("stove", ""),
    ],
)  # fmt: skip
def test_words_of_different_meaning_do_not_match(needed: str, category: str) -> None:
    assert not meets(needed, "Object_7", category)


def test_need_matches_the_id_when_the_category_is_unknown() -> None:
    assert meets("Cube.003", "Cube.003", "cabinet")
    assert meets("stove", "Kitchen_Cooktop_01", "unknown")
    assert not meets("stove", "Kitchen_Cooktop_01", "shelf")


@pytest.mark.parametrize("needed", ["", "  ", "none", "None", "NULL", "null", "n/a", "not needed", None])
def test_words_for_no_need_are_read_as_none(needed: str | None) -> None:
    assert SourceState("on", 0.5, "s", "k", needed).needs_contact is None


def test_every_synonym_of_lexicon_needs_matches() -> None:
    needed = {noun for row in table() for state in row.states for noun in state.needs_contact}
    assert needed
    for row in table():
        if row.noun in needed and row.noun != "heater":  # a fan heater is not a stove
            for word in (row.noun, *row.synonyms):
                assert meets("stove", "Object_7", word), word


def test_unmet_needs_are_reported_and_an_object_cannot_meet_its_own() -> None:
    states = (SourceState("boiling", 0.5, "s", "k", "stove"), SourceState("on", 0.5, "s", "k"))
    (told,) = unmet_needs("stove", states, {"stove": "stove", "table": "table"})
    assert "'boiling' needs contact with 'stove', which no other object here is" in told
    assert unmet_needs("pot", states, {"pot": "pot", "hob": "cooktop"}) == ()
