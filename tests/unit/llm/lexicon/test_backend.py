"""Answers of LexiconBackend to each component."""

import asyncio
import json
from typing import Any, get_args

import pytest

from scene2hap.errors import BadAnswer
from scene2hap.llm import BACKENDS
from scene2hap.llm.answers import MaterialAnswer, ObjectAnswer, SceneAnswer, VibrationAnswer
from scene2hap.llm.lexicon import LexiconBackend
from scene2hap.llm.lexicon.descriptions import describe
from scene2hap.llm.lexicon.table import table
from scene2hap.llm.protocol import Component, LLMBackend, LLMRequest

SHAPES = {
    "scene_analyzer": SceneAnswer,
    "object_analyzer": ObjectAnswer,
    "material_estimator": MaterialAnswer,
    "vibration_describer": VibrationAnswer,
}


def ask(component: Component, **facts: Any) -> Any:
    request = LLMRequest(component, "", "", facts, {}, "1")
    reply = asyncio.run(LexiconBackend().complete(request))
    assert reply.finish_reason == "stop"
    assert reply.usage == {}
    return SHAPES[component].model_validate_json(reply.text)


def analyse(name: str, size_m: tuple[float, float, float] = (0.6, 0.5, 0.02), **facts: Any) -> ObjectAnswer:
    measured = dict(zip(("length_m", "width_m", "thickness_m"), size_m, strict=True))
    facts = {"scene_category": "kitchen", "relative_height_m": 0.0, "surface_flags": [], "neighbour_names": []} | facts
    answer = ask("object_analyzer", object_name=name, **measured, **facts)
    assert isinstance(answer, ObjectAnswer)
    return answer


def test_lexicon_is_a_backend_registered_by_its_kind() -> None:
    assert isinstance(LexiconBackend(), LLMBackend)
    assert BACKENDS.load("lexicon") is LexiconBackend
    assert set(SHAPES) == set(get_args(Component))


def test_replies_name_the_table_and_are_repeatable() -> None:
    request = LLMRequest("material_estimator", "", "", {"material_category": "oak"}, {}, "1")
    first, second = (asyncio.run(LexiconBackend().complete(request)) for _ in range(2))
    assert first == second
    assert first.model.startswith("lexicon/")
    assert json.loads(first.text)


@pytest.mark.parametrize(
    ("names", "place"),
    [
        (["Fridge_A", "stove", "chair", "chair", "pot"], "kitchen"),
        (["bathtub", "toilet", "towel_rail", "washer"], "bathroom"),
        (["excavator", "jackhammer", "Scaffolding_03"], "building site"),
        (["SofaC_01", "CoffeeTable_01", "carpet"], "living room"),
        (["treadmill", "dumbbells"], "gym"),
        (["chair", "floor", "wall", "door"], "undefined"),
        (["Object_1", "Object_2"], "undefined"),
        (["Object_1", "treadmill"], "undefined"),  # one word may be a misreading
        (["toilet", "bathtub", "treadmill", "barbell"], "undefined"),  # a tie
        ([], "undefined"),
    ],
)
def test_kind_of_place_follows_the_majority_of_objects(names: list[str], place: str) -> None:
    assert ask("scene_analyzer", scene_name="Scene01", object_names=names).scene_category == place


def test_scene_name_is_a_weak_hint() -> None:
    def place(scene_name: str, *names: str) -> str:
        answer = ask("scene_analyzer", scene_name=scene_name, object_names=list(names))
        assert isinstance(answer, SceneAnswer)
        return answer.scene_category

    assert place("Garage", "bathtub", "toilet") == "bathroom"
    assert place("Kitchen", "Object_1") == "undefined"
    assert place("Gym", "toilet", "bathtub", "treadmill", "barbell") == "gym"


def test_refrigerator_hums() -> None:
    answer = analyse("fridge_A", (1.8, 0.6, 0.5))
    assert answer.object_category == "refrigerator"
    assert answer.vibrates
    assert [(state.name, state.intensity, state.needs_contact) for state in answer.states] == [("on", 0.1, None)]
    assert "fridge" in answer.category_reason
    assert answer.confidence > 0.8


def test_unknown_names_get_category_unknown() -> None:
    for name in ("Object_7", "zorgon", ""):
        answer = analyse(name)
        assert (answer.object_category, answer.material_category) == ("unknown", "unknown")
        assert not answer.vibrates
        assert answer.states == []
        assert answer.confidence <= 0.2


@pytest.mark.parametrize(
    ("name", "size_m", "category"),
    [
        ("Truck_01", (0.3, 0.1, 0.1), "toy truck"),
        ("Truck_01", (8.0, 2.5, 3.0), "truck"),
        ("fridge", (0.15, 0.06, 0.05), "miniature refrigerator"),
        ("fridge", (0.9, 0.3, 0.3), "refrigerator"),  # an asset kit at half scale
        ("mini_fridge", (0.5, 0.5, 0.5), "refrigerator"),
        ("toy_car", (4.0, 1.8, 1.4), "toy car"),
        ("phone", (0.15, 0.07, 0.008), "smartphone"),
        ("fridge", (0.0, 0.0, 0.0), "refrigerator"),  # an unknown size does not mean a small one
    ],
)
def test_miniatures_are_silent(name: str, size_m: tuple[float, float, float], category: str) -> None:
    answer = analyse(name, size_m)
    assert answer.object_category == category
    assert answer.vibrates == (category in ("truck", "refrigerator", "smartphone"))


def test_oversized_sources_vibrate_at_lower_confidence() -> None:
    giant, real = analyse("fridge", (180.0, 60.0, 60.0)), analyse("fridge", (1.8, 0.6, 0.6))
    assert giant.vibrates
    assert giant.confidence < real.confidence
    assert "unit" in giant.size_reason


def test_thickness_is_replaced_only_where_the_mesh_has_none() -> None:
    flat = analyse("FloorB_01", (5.0, 4.0, 0.0), scene_category="bedroom")
    flagged = analyse("floor", (5.0, 4.0, 0.3), surface_flags=["zero-thickness"], scene_category="bedroom")
    solid = analyse("floor", (5.0, 4.0, 0.3), surface_flags=["open-mesh"])
    assert flat.estimated_thickness_m == flagged.estimated_thickness_m == 0.022
    assert "assumed" in flat.size_reason
    assert (solid.estimated_length_m, solid.estimated_width_m, solid.estimated_thickness_m) == (5.0, 4.0, 0.3)


@pytest.mark.parametrize("heater", ["stove", "Cooktop_01", "hob", "SpaceHeater", "oven", "hotplate", "gas_stove_LOD0"])
def test_pan_sizzles_on_a_heater(heater: str) -> None:
    answer = analyse("pan", neighbour_names=["wall_back", heater])
    assert answer.vibrates
    (state,) = answer.states
    # The word is the heater's category, which a session compares with the need.
    assert state.needs_contact == analyse(heater, (0.6, 0.6, 0.6)).object_category


@pytest.mark.parametrize("neighbours", [["table"], ["oven_door", "pot"], ["toy_stove"], ["Object_3"]])
def test_pan_does_not_vibrate_away_from_a_heater(neighbours: list[str]) -> None:
    answer = analyse("pan", neighbour_names=neighbours)
    assert not answer.vibrates
    assert answer.states == []
    assert "stove" in answer.vibration_reason


def test_pan_without_contacts_needs_contact_with_a_stove() -> None:
    (state,) = analyse("pan").states
    assert state.needs_contact == analyse("stove").object_category


def test_object_shaken_by_a_neighbour_is_no_source() -> None:
    assert not analyse("mug", neighbour_names=["washing_machine"]).vibrates


@pytest.mark.parametrize(
    ("name", "material"),
    [
        ("door", "wood"),
        ("glass_door", "glass"),
        ("oven_door", "steel"),
        ("MetalBench", "metal"),
        ("crate_lid", "wood"),
        ("pot_lid", "stainless steel"),
        ("wood_chipper", "steel"),  # a machine that chips wood
        ("toy_truck", "plastic"),
        ("wooden_toy_truck", "wood"),
    ],
)
def test_material_is_read_from_name_and_category(name: str, material: str) -> None:
    assert analyse(name).material_category == material


@pytest.mark.parametrize(
    ("name", "place", "material"),
    [
        ("floor", "bathroom", "ceramic"),
        ("floor_kitchen", "undefined", "ceramic"),
        ("wooden_floor", "bathroom", "wood"),
        ("floor", "living room", "wood"),
    ],
)
def test_floors_of_wet_rooms_are_tiled(name: str, place: str, material: str) -> None:
    assert analyse(name, scene_category=place).material_category == material


@pytest.mark.parametrize(
    ("name", "painted", "material"),
    [
        ("chair", ["M_Metal_Brushed"], "metal"),
        ("chair", ["wood_oak", "Oak.001"], "oak"),
        ("chair", ["wood_oak", "fabric_red"], "wood"),  # two materials: the lexicon's table decides
        ("glass_table", ["wood"], "glass"),  # the object's name has priority
        ("fridge", ["wood"], "steel"),  # a machine keeps its usual material
        ("bath_mat", ["wood"], "fabric"),  # kits name colours of cloth so
        ("sofa", ["leather"], "leather"),
        ("wooden_bath_mat", ["wood"], "wood"),
        ("Object_7", ["Marble_White"], "marble"),
        ("Object_7", ["Material.001", "lambert1"], "unknown"),
    ],
)
def test_surface_material_names_are_used_where_they_agree(name: str, painted: list[str], material: str) -> None:
    assert analyse(name, material_names=painted).material_category == material


def test_material_constants_come_from_the_table_in_gigapascal() -> None:
    steel = ask("material_estimator", material_category="Steel")
    assert (steel.density_kg_m3, steel.youngs_modulus_gpa, steel.poisson_ratio) == (7850.0, 200.0, 0.3)


def test_every_material_of_the_lexicon_fits_the_answer() -> None:
    for name in {row.material for row in table()}:
        ask("material_estimator", material_category=name)


@pytest.mark.parametrize("word", ["unknown", "unobtainium", ""])
def test_estimating_an_unknown_material_raises(word: str) -> None:
    with pytest.raises(BadAnswer, match="table"):
        ask("material_estimator", material_category=word)


def test_vibration_describer_answers_every_state_of_the_table() -> None:
    for row in table():
        for state in row.states:
            answer = describe(row.noun, state.name, "building site")
            assert answer.sentence.startswith(f"{row.noun} {state.verb} ")
            assert len(answer.sentence.split()) <= 15
            assert answer.keywords == f"{row.noun} {state.verb}"
            assert "vibrat" not in f"{answer.sentence} {answer.keywords}".lower()


def test_vibration_describer_names_object_and_manner() -> None:
    facts = {"object_category": "smartphone", "usage": "", "state": "ringing", "scene_category": "undefined"}
    answer = ask("vibration_describer", **facts)
    assert answer.sentence == "smartphone buzzing firmly and in bursts while ringing"
    assert answer.keywords == "smartphone buzzing"


def test_unknown_category_is_described_by_its_state() -> None:
    assert describe("hoverboard", "gliding").keywords == "hoverboard gliding"
    assert describe("vibrating plate", "vibrating").keywords == "plate humming"


@pytest.mark.parametrize(
    ("component", "facts", "named"),
    [
        ("scene_analyzer", {"scene_name": "a"}, None),
        ("scene_analyzer", {"object_names": []}, "scene_name"),
        ("scene_analyzer", {"scene_name": "a", "object_names": "fridge"}, "object_names"),
        ("scene_analyzer", {"scene_name": "a", "object_names": [1]}, "object_names"),
        ("object_analyzer", {"object_name": "a", "length_m": 1.0, "width_m": 1.0}, "thickness_m"),
        (
            "object_analyzer",
            {"object_name": "a", "length_m": 1.0, "width_m": 1.0, "thickness_m": 1.0, "material_names": "oak"},
            "material_names",
        ),
        ("object_analyzer", {"object_name": "a", "length_m": -1.0, "width_m": 1.0, "thickness_m": 1.0}, "length_m"),
        ("material_estimator", {}, "material_category"),
        ("vibration_describer", {"object_category": "fridge"}, "state"),
    ],
)
def test_error_names_missing_facts(component: Component, facts: dict[str, Any], named: str | None) -> None:
    if named is None:
        assert ask(component, **facts).scene_category == "undefined"
        return
    with pytest.raises(BadAnswer, match=named):
        ask(component, **facts)
