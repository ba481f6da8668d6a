"""Implausible numbers in answers: all are named in a repair request, then replaced and reported."""

import asyncio
import json
from typing import Any

import pytest

from llm_server import GOOD, request
from scene2hap import FunctionBackend, LLMReply, LLMRequest, RepairBackend, materials
from scene2hap.llm.chain import infer_scene, inference
from scene2hap.llm.validation import find_fault
from scene2hap.llm.validation.plausibility import constants, row_of
from scene2hap.materials import table
from scene2hap.scene.surface.plate_sizes import THINNEST_M, assumed_thickness_m, with_thickness
from scripted_backend import SCENE, Scripted, run

STEEL = {"density_kg_m3": 7850.0, "youngs_modulus_gpa": 200.0, "poisson_ratio": 0.3, "damping_ratio": 0.0005}
TABLE = {"length_m": 1.8, "width_m": 0.7, "thickness_m": 0.05}


def steel(**changes: Any) -> str:
    return json.dumps({**STEEL, **changes})


def told_of(text: str, word: str = "steel") -> str:
    fault = find_fault("material_estimator", text, {"material_category": word})
    return "" if fault is None else fault.reason


def told_of_size(length: float, width: float, thickness: float, **facts: float) -> str:
    edges = {"estimated_length_m": length, "estimated_width_m": width, "estimated_thickness_m": thickness}
    answer = {**GOOD["object_analyzer"], **edges}
    fault = find_fault("object_analyzer", json.dumps(answer), {**TABLE, **facts})
    return "" if fault is None else fault.reason


def test_every_row_of_the_table_is_plausible() -> None:
    for row in table():
        constant = row.material
        told = {
            "density_kg_m3": constant.density_kg_m3,
            "youngs_modulus_gpa": constant.youngs_modulus_pa / 1e9,
            "poisson_ratio": constant.poisson_ratio,
            "damping_ratio": constant.loss_factor / 2,
        }
        assert constants(constant.name, told) == {}, constant.name


def test_an_invalid_number_is_named_once_and_what_is_no_number_is_no_doubt() -> None:
    assert told_of(steel(density_kg_m3=1e9)).count("density_kg_m3") == 1
    assert constants("steel", {"density_kg_m3": "heavy", "poisson_ratio": None, "damping_ratio": True}) == {}


def test_a_measured_thickness_below_that_of_a_foil_is_none() -> None:
    assert with_thickness((1.0, 0.5, THINNEST_M)) == (1.0, 0.5, THINNEST_M)
    for thinner_m in (0.0, THINNEST_M / 2):
        assert with_thickness((1.0, 0.5, thinner_m)) == (1.0, 0.5, assumed_thickness_m((1.0, 0.5, 0.0)))


def test_error_for_density_in_grams_states_bounds_and_unit() -> None:
    assert "density_kg_m3: 7.85 kg/m3, but steel has 2610 to 23600 kg/m3 (g/cm3? Give kg/m3)" in told_of(
        steel(density_kg_m3=7.85)
    )


def test_error_lists_all_implausible_constants() -> None:
    told = told_of(steel(density_kg_m3=7.85, youngs_modulus_gpa=2e11, poisson_ratio="low", damping_ratio=0.9))
    for name in STEEL:
        assert f"{name}: " in told
    told = told_of(steel(density_kg_m3=7.85, youngs_modulus_gpa=0.2))
    assert "density_kg_m3: " in told
    assert "youngs_modulus_gpa: 0.2 GPa" in told


@pytest.mark.parametrize("word", ["brushed stainless steel", "painted steel sheet", "Steel", "steel-plate"])
def test_material_is_recognised_within_a_longer_phrase(word: str) -> None:
    assert row_of(word) is not None
    assert "density_kg_m3" in told_of(steel(density_kg_m3=7.85), word)


def test_the_last_of_several_materials_counts() -> None:
    """In English it is the noun: a steel rubber is a rubber."""
    found = row_of("steel rubber"), row_of("rubber steel")
    assert [row.material.name for row in found if row is not None] == ["rubber", "steel"]


def test_unknown_material_is_checked_against_bounds_of_any_solid() -> None:
    assert told_of(steel(), "unobtainium") == ""
    assert "a solid has" in told_of(steel(density_kg_m3=2.2), "unobtainium")


def test_repair_request_states_the_bound_and_second_failure_keeps_the_answer() -> None:
    wrong = steel(density_kg_m3=7.85)
    inner = FunctionBackend(lambda _: LLMReply(wrong, "m"))
    asked = request("material_estimator", facts={"material_category": "steel"})
    reply = asyncio.run(RepairBackend(inner).complete(asked))
    assert json.loads(reply.text)["density_kg_m3"] == 7.85  # passed on, so that the chain replaces it
    assert len(inner.requests) == 2
    assert "2610 to 23600 kg/m3" in inner.requests[1].prompt


@pytest.mark.parametrize(
    ("constant", "low", "high"),
    # The table has for steel: 7820 to 7860 kg/m3, 190 to 210 GPa, 0.27 to 0.32, and a loss factor of up to 0.001.
    [
        ("density_kg_m3", 7820 / 3, 7860 * 3),
        ("youngs_modulus_gpa", 190 / 10, 210 * 10),
        ("poisson_ratio", 0.27 - 0.2, 0.32 + 0.2),
        ("damping_ratio", 0.0, 0.001 / 2 * 100),
    ],
)
def test_constants_may_be_some_way_outside_the_published_range(constant: str, low: float, high: float) -> None:
    assert [constants("steel", {constant: value}) for value in (low + 1e-6, high - 1e-6)] == [{}, {}]
    assert all(constants("steel", {constant: value}) for value in (low - 1e-6, high + 1e-6))


@pytest.mark.parametrize("edges", [(180.0, 70.0, 5.5), (1.8, 0.7, 0.0), (1.8, 0.7, 2.0), (0.2, 0.7, 0.05), (0, 0, 0)])
def test_sizes_far_from_measured_sizes_are_reported(edges: tuple[float, float, float]) -> None:
    assert "but it was measured as" in told_of_size(*edges)


@pytest.mark.parametrize("edges", [(1.8, 0.7, 0.05), (0.7, 1.8, 0.02), (2.0, 0.8, 0.001), (1.2, 0.6, 0.1)])
def test_sizes_near_the_measured_ones_pass(edges: tuple[float, float, float]) -> None:
    assert told_of_size(*edges) == ""


def test_length_and_width_may_be_exchanged() -> None:
    assert told_of_size(0.1, 2.0, 0.02, length_m=2.0, width_m=0.1, thickness_m=0.02) == ""


def test_an_edge_that_was_measured_as_nothing_has_the_upper_bound_of_the_other() -> None:
    sheet_on_edge = {"length_m": 1.0, "width_m": 0.0, "thickness_m": 0.0}
    assert told_of_size(2.9, 2.9, 2e-5, **sheet_on_edge) == ""
    assert "width_m: 3.1 m, but it was measured as 0 m" in told_of_size(3.1, 3.1, 2e-5, **sheet_on_edge)


def test_no_plate_is_thicker_than_a_third_of_its_width() -> None:
    plank = {"length_m": 2.0, "width_m": 0.12, "thickness_m": 0.0}
    assert told_of_size(2.0, 0.12, 0.039, **plank) == ""
    assert "give 2e-05 to 0.04 m" in told_of_size(2.0, 0.12, 0.041, **plank)


def test_floor_without_thickness_accepts_only_plausible_thickness() -> None:
    assert told_of_size(5.0, 4.0, 0.2, length_m=5.0, width_m=4.0, thickness_m=0.0) == ""
    for thickness in (0.0, 2.0):
        told = told_of_size(5.0, 4.0, thickness, length_m=5.0, width_m=4.0, thickness_m=0.0)
        assert "give 2e-05 to 0.5 m" in told


def test_error_lists_all_three_edges() -> None:
    told = told_of_size(180.0, 70.0, 5.5)
    for edge in ("length", "width", "thickness"):
        assert f"estimated_{edge}_m: " in told


def sized(**edges: float) -> Any:
    def change(asked: LLMRequest, answer: dict[str, Any]) -> dict[str, Any]:
        return {**answer, **edges} if asked.subject == "table" else answer

    return run(Scripted(object_analyzer=change))


def test_implausible_size_is_replaced_by_the_measured_size_and_reported() -> None:
    found = sized(estimated_length_m=180.0, estimated_width_m=70.0, estimated_thickness_m=5.5)
    assert found.objects["table"].estimated_size_m == (1.6, 0.8, 0.02)
    told = found.report.doubts["table"]
    assert [doubt.split(":")[0] for doubt in told] == ["length", "width", "thickness"]
    assert "180 m, but it was measured as 1.6 m" in found.objects["table"].reasons["size"]
    assert found.report.as_json()["doubts"]["table"] == list(told)


def test_length_and_width_are_replaced_together() -> None:
    found = sized(estimated_length_m=180.0, estimated_width_m=0.9, estimated_thickness_m=0.03)
    assert found.objects["table"].estimated_size_m == (1.6, 0.8, 0.03)


def test_a_mass_is_at_most_that_of_the_solid_box_and_its_doubt_stands_beside_others() -> None:
    found = sized(estimated_mass_kg=100.0).objects["table"]
    assert found.mass_kg == pytest.approx(1.6 * 0.8 * 0.02 * 700.0)  # the oak of the scripted answers
    doubts = sized(estimated_mass_kg=1e6, estimated_length_m=180.0).report.doubts["table"]
    assert [doubt.split(":")[0] for doubt in doubts] == ["length", "mass"]


def test_implausible_thickness_alone_is_replaced() -> None:
    found = sized(estimated_length_m=1.5, estimated_thickness_m=0.0)
    assert found.objects["table"].estimated_size_m == (1.5, 0.8, 0.02)


def test_report_lists_contact_needs_that_no_object_meets() -> None:
    def change(asked: LLMRequest, answer: dict[str, Any]) -> dict[str, Any]:
        states = [{"name": "ringing", "intensity": 0.5, "needs_contact": "stove"}]
        return {**answer, "states": states, "estimated_length_m": 9.0} if asked.subject == "phone" else answer

    found = asyncio.run(infer_scene(SCENE, Scripted(object_analyzer=change)))
    assert found.report.doubts["phone"][0].startswith("length: 9 m")
    assert "needs contact with 'stove'" in found.report.doubts["phone"][-1]
    assert found.objects["phone"].states[0].needs_contact == "stove"
    assert "stove" in found.objects["phone"].reasons["contact"]


def test_categories_are_collected_once_per_scene(monkeypatch: pytest.MonkeyPatch) -> None:
    """The list is made once, not for each object, since scenes of thousands would take seconds."""
    given: list[object] = []
    monkeypatch.setattr(inference, "unmet_needs", lambda key, states, categories: given.append(categories) or ())
    asyncio.run(infer_scene(SCENE, Scripted()))
    assert len(given) == len(SCENE.objects) > 1
    assert all(one is given[0] for one in given)


def test_implausible_constants_are_replaced_by_the_table() -> None:
    def change(asked: LLMRequest, answer: dict[str, Any]) -> dict[str, Any]:
        return {**answer, "material_category": "steel"}

    backend = Scripted(object_analyzer=change, material_estimator=lambda *_: {**STEEL, "density_kg_m3": 7.85})
    material = run(backend).objects["table"].material
    assert material is not None
    assert material.density_kg_m3 == materials.lookup("steel").density_kg_m3
    assert material.loss_factor == 0.001


def test_a_material_without_a_row_is_looked_up_without_a_search_for_similar_names(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The feet of 2,000 objects took 14 s, for messages that nobody read."""

    def refused(*names: object) -> str:
        raise AssertionError("nobody reads a suggestion")

    monkeypatch.setattr("scene2hap.common.checks.did_you_mean", refused)
    assert row_of("unobtainium glides") is None
