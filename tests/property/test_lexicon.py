"""The lexicon gives every request a valid and repeatable answer."""

import asyncio
from typing import Any

from hypothesis import given, settings, strategies as st

from scene2hap.errors import BadAnswer
from scene2hap.llm.answers import Answer, MaterialAnswer, ObjectAnswer, SceneAnswer, VibrationAnswer
from scene2hap.llm.lexicon import LexiconBackend
from scene2hap.llm.lexicon.names import read_name
from scene2hap.llm.lexicon.table import table
from scene2hap.llm.protocol import Component, LLMRequest

WORDS = [name for row in table() for name in (row.noun, *row.synonyms)]
WORDS += ["SM", "of", "on", "toy", "mat", "glass", "light", "blue", "01", "(Clone)", "zorgon", "Куб", "A"]
# Texts of known words reach the rules; the others are any text, including lone surrogates.
NAMES = st.one_of(
    st.text(),
    st.text(alphabet=st.characters(categories=["Cs", "Lu", "Ll", "Mn", "Nd"])),
    st.builds(str.join, st.sampled_from(["_", "", " ", "-"]), st.lists(st.sampled_from(WORDS), max_size=5)),
)
SIZES = st.floats(min_value=0.0, max_value=1e6)


def answer(component: Component, shape: type[Answer], facts: dict[str, Any]) -> Any:
    reply = asyncio.run(LexiconBackend().complete(LLMRequest(component, "", "", facts, {}, "1")))
    return shape.model_validate_json(reply.text)


@settings(max_examples=120)
@given(NAMES)
def test_any_name_is_read_and_unknown_ones_are_unsure(name: str) -> None:
    reading = read_name(name)
    assert 0.0 < reading.confidence <= 1.0
    assert reading.row is not None or reading.confidence <= 0.2


@settings(max_examples=120)
@given(NAMES, SIZES, SIZES, SIZES, st.lists(NAMES, max_size=3))
def test_any_object_gets_a_valid_answer(name: str, length: float, width: float, height: float, near: list[str]) -> None:
    facts = {"object_name": name, "length_m": length, "width_m": width, "thickness_m": height, "neighbour_names": near}
    found = answer("object_analyzer", ObjectAnswer, facts)
    # The answer is limited to 100 km; a larger scene is in a wrong unit.
    assert (found.estimated_length_m, found.estimated_width_m) == (min(length, 1e5), min(width, 1e5))
    assert found.vibrates == bool(found.states)
    assert found.object_category != "unknown" or not found.vibrates
    assert found == answer("object_analyzer", ObjectAnswer, facts)


@settings(max_examples=100)
@given(NAMES, st.lists(NAMES, max_size=8), st.randoms(use_true_random=False))
def test_place_does_not_depend_on_the_order_of_objects(scene_name: str, names: list[str], order: Any) -> None:
    shuffled = order.sample(names, len(names))
    first, second = (
        answer("scene_analyzer", SceneAnswer, {"scene_name": scene_name, "object_names": some})
        for some in (names, shuffled)
    )
    assert first == second


@settings(max_examples=80)
@given(NAMES, NAMES, NAMES)
def test_any_state_is_described_within_bounds(category: str, state: str, place: str) -> None:
    facts = {"object_category": category, "state": state, "scene_category": place}
    found = answer("vibration_describer", VibrationAnswer, facts)
    assert len(found.sentence.split()) <= 15
    assert "vibrat" not in f"{found.sentence} {found.keywords}".casefold()


@settings(max_examples=100)
@given(st.one_of(NAMES, st.sampled_from([row.material for row in table()])))
def test_any_material_is_answered_or_refused(word: str) -> None:
    try:
        found = answer("material_estimator", MaterialAnswer, {"material_category": word})
    except BadAnswer:
        return
    assert found.density_kg_m3 > 0
