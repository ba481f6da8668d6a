"""Confidence of names that contradict height, size or neighbours."""

from typing import Any

import pytest

from scene2hap.llm.lexicon.categories import ObjectFacts, judge

SURE = 0.9


def confidence(name: str, size_m: tuple[float, float, float], *neighbours: str, **about: Any) -> float:
    return judge(ObjectFacts(name, size_m, **about), neighbours).confidence


def test_bench_on_a_cabinet_is_judged_with_low_confidence() -> None:
    size = (0.6, 0.5, 0.05)
    assert confidence("kitchen_bench", size, "floor", height_m=0.0) > SURE
    assert confidence("kitchen_bench", size, "base_cabinet", height_m=0.86) < 0.5
    answer = judge(ObjectFacts("kitchen_bench", size, height_m=0.86), ["base_cabinet"])
    assert "begins 0.86 m above the lowest thing here and touches cabinet" in answer.category_reason


@pytest.mark.parametrize("ground", ["floor", "Rug_01", "stage", "stairs", "balcony_floor"])
def test_a_chair_on_a_raised_floor_is_a_chair(ground: str) -> None:
    assert confidence("chair", (0.45, 0.45, 0.02), ground, height_m=3.1) > SURE


def test_missing_height_does_not_lower_the_confidence() -> None:
    assert confidence("bench", (1.5, 0.4, 0.03)) > SURE


def test_a_carcass_named_walls_is_hardly_a_wall() -> None:
    assert confidence("walls", (4.0, 2.5, 0.0125)) > SURE
    assert confidence("walls", (0.6, 0.55, 0.004)) < 0.35
    assert confidence("walls", (4.0, 2.5, 0.004)) < 0.6
    assert confidence("walls", (4.0, 2.5, 0.0), flags=("zero-thickness",)) > SURE


@pytest.mark.parametrize("name", ["spray_arm_dishwasher", "dishwasher"])
def test_a_spray_arm_is_hardly_a_dishwasher(name: str) -> None:
    assert confidence("dishwasher", (0.6, 0.55, 0.001), height_m=0.0) > SURE
    assert confidence(name, (0.5, 0.05, 0.02), "dishwasher") < 0.5


def test_inner_part_of_a_touching_machine_is_no_source() -> None:
    size = (0.3, 0.2, 0.1)
    alone, inside = (
        judge(ObjectFacts("dishwasher_pump", size)),
        judge(ObjectFacts("dishwasher_pump", size), ["dishwasher"]),
    )
    assert alone.vibrates
    assert not inside.vibrates
    assert inside.confidence < 0.5
    assert "shaken by the dishwasher" in inside.vibration_reason


def test_burner_on_a_stove_vibrates() -> None:
    assert judge(ObjectFacts("Burner 1", (0.17, 0.17, 0.02)), ["stove"]).vibrates


@pytest.mark.parametrize(
    ("name", "whole_m", "category"),
    [
        ("chairCushion", (0.36, 0.36, 0.83), "chair"),
        ("chairModernFrameCushion", (0.36, 0.36, 0.83), "chair"),
        ("chairCushion", (0.4, 0.4, 0.1), "cushion"),
        ("kitchenCabinetDrawer", (0.77, 0.81, 0.81), "cabinet"),
        ("cabinetBedDrawer", (0.39, 0.47, 0.48), "night stand"),
        ("Cupboard_Big_door_upper", (0.03, 0.62, 1.4), "door"),
        ("kitchencounter_sink", (1.2, 1.17, 1.08), "sink"),
        ("Oven_Drawer", (0.4, 0.5, 0.5), "drawer"),  # an oven would vibrate
        ("lamp_shade", (0.4, 0.5, 0.5), "lampshade"),
        ("sink", (0.6, 0.6, 0.9), "sink"),
        ("house_door", (0.31, 1.0, 2.0), "door"),
    ],
)
def test_an_object_too_thick_for_the_part_it_is_named_after_is_the_whole(
    name: str, whole_m: tuple[float, float, float], category: str
) -> None:
    answer = judge(ObjectFacts(name, (0.4, 0.4, 0.05), whole_m=whole_m))
    assert answer.object_category == category
    parts = ("cushion", "door", "drawer", "lampshade", "sink")
    assert ("too thick for" in answer.category_reason) == (category not in parts)


@pytest.mark.parametrize(
    ("name", "length_m", "category"),
    [
        ("patientMonitor_wall", 0.4, "patient monitor"),
        ("PA_Loudspeaker_ceiling", 0.3, "speaker"),
        ("fridge_wall", 3.0, "wall"),
        ("house_wall", 0.4, "wall"),
        ("wall", 0.4, "wall"),
    ],
)
def test_a_wall_or_ceiling_too_short_to_be_one_is_the_place_of_the_object(
    name: str, length_m: float, category: str
) -> None:
    answer = judge(ObjectFacts(name, (length_m, 0.3, 0.05)))
    assert answer.object_category == category
    assert ("that word is its place" in answer.category_reason) == (category != "wall")


@pytest.mark.parametrize(
    ("name", "whole_m", "category"),
    [
        ("hvac_unit_roof", (2.0, 1.5, 0.5), "air conditioner"),
        ("air_conditioner_wall", (1.1, 0.3, 0.25), "air conditioner"),
        ("drillPress_floor", (1.6, 0.6, 0.45), "drill press"),
        ("drillPress_floor", (4.0, 3.0, 0.8), "floor"),
        ("air_conditioner_wall", (2.5, 2.4, 0.2), "wall"),
        ("pump_floor", (2.0, 2.0, 0.05), "floor"),
        ("pump_room_wall", (0.5, 0.5, 0.3), "wall"),
        ("elevator_wall", (1.5, 1.5, 0.5), "wall"),
        ("air_conditioning_unit_cabin", (0.9, 0.3, 0.25), "air conditioner"),
        ("door_truck", (1.0, 1.0, 0.1), "door"),
        ("toilet_train", (0.6, 0.6, 0.5), "toilet"),
        ("horn_truck", (0.3, 0.2, 0.2), "fog horn"),
        ("banana_car", (0.3, 0.2, 0.2), "toy car"),
        ("toy_wheel_truck", (0.3, 0.3, 0.1), "toy truck"),
        ("truck", (0.3, 0.2, 0.2), "toy truck"),
        ("speaker_stage", (0.5, 0.4, 0.4), "speaker"),
        ("speaker_stage", (5.0, 4.0, 0.4), "stage"),
    ],
)
def test_a_roof_or_vehicle_that_the_object_cannot_be_is_its_place(
    name: str, whole_m: tuple[float, float, float], category: str
) -> None:
    assert judge(ObjectFacts(name, whole_m, whole_m=whole_m)).object_category == category


@pytest.mark.parametrize(
    ("name", "material"),
    [
        ("tractor_tire", "rubber"),
        ("drill_cable", "pvc"),
        ("truck_windshield", "glass"),
        ("car_dashboard", "plastic"),
        ("oven_door", "steel"),
    ],
)
def test_a_part_is_of_its_owner_s_material_only_if_it_is_cut_from_the_same_sheet(name: str, material: str) -> None:
    assert judge(ObjectFacts(name, (0.6, 0.4, 0.05))).material_category == material


def test_without_the_size_of_the_whole_the_name_decides() -> None:
    assert judge(ObjectFacts("chairCushion", (0.4, 0.4, 0.05))).object_category == "cushion"


@pytest.mark.parametrize(
    ("name", "whole_m", "height_m", "category"),
    [
        ("planeLink", (200.0, 200.0, 0.0), 0.0, "floor"),
        ("Plane.001", (5.0, 4.0, 0.02), 0.0, "floor"),
        ("Plane", (2.0, 2.0, 0.0), 0.0, "unknown"),  # of any use
        ("Plane", (5.0, 4.0, 0.0), 2.5, "unknown"),  # a ceiling
        ("Plane", (5.0, 0.01, 4.0), 0.0, "unknown"),  # a wall
        ("Plane", (5.0, 4.0, 1.2), 0.0, "unknown"),  # an aeroplane
    ],
)
def test_a_wide_plane_under_all_others_is_the_floor(
    name: str, whole_m: tuple[float, float, float], height_m: float, category: str
) -> None:
    item = ObjectFacts(name, (whole_m[0], whole_m[1], 0.01), whole_m=whole_m, height_m=height_m)
    assert judge(item).object_category == category
