"""Contacts of whole scenes, against pairs known by construction, or listed by hand from coordinates of other scenes."""

from functools import cache

import numpy as np
import pytest

from contact_scenes import pairs, points, weight
from others import SCENES, needed, there
from rooms import ROOMS, room_file
from rooms.room import pairs as listed
from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.load import load_scene

COMPOSED = "composed_kitchen_kaykit"


@cache
def graph_of(name: str) -> ContactGraph:
    return ContactGraph(load_scene(room_file(name) if name in ROOMS else needed(SCENES / name / f"{name}.glb")))


KITCHEN = """
    chair_left chair_right counter_left counter_right crate_tomatoes fridge oven sink_counter stove table: floor
    cutting_board jar_large jar_small: counter_right
    bowl: cutting_board
    dishrack radio: counter_left
    pan pot: stove
    ketchup_bottle paper_towel plate_1 plate_2: table
    stew_bowl: plate_2
    counter_left counter_right extractor_hood fridge oven sink_counter stove: wall_back
    wall_cabinet_left wall_cabinet_right: wall_back
    wall_back wall_left: floor
    wall_back: wall_left
    counter_left wall_cabinet_left: fridge
    counter_left stove: sink_counter
    stove oven: counter_right
    extractor_hood: wall_cabinet_right
"""


@pytest.mark.parametrize("name", [*ROOMS, *there([COMPOSED], SCENES.joinpath)])
def test_exactly_the_composed_contacts_are_found(name: str) -> None:
    graph = graph_of(name)
    assert pairs(graph) == (ROOMS[name].contacts if name in ROOMS else listed(KITCHEN))
    assert all(contact.weight == 1.0 for contact in graph.contacts)


@pytest.mark.parametrize("name", ROOMS)
def test_contact_points_lie_on_both_objects(name: str) -> None:
    """Points lie within both bounding boxes, which are at most 1 mm apart; the picture is 20 mm off its wall."""
    scene = load_scene(room_file(name))
    for contact in graph_of(name).contacts:
        apart_m = 0.02 if contact.a == "picture" else 0.001
        low, high = np.array([scene.object(key).bounds_m for key in (contact.a, contact.b)]).swapaxes(0, 1)
        assert (np.asarray(contact.point_m) >= low - apart_m - 1e-6).all()
        assert (np.asarray(contact.point_m) <= high + apart_m + 1e-6).all()


def test_contact_points_of_the_kitchen() -> None:
    graph = graph_of(COMPOSED)
    for a, b, height in (("pot", "stove", 0.864), ("plate_1", "table", 0.723), ("bowl", "cutting_board", 0.774)):
        assert points(graph, a, b)[:, 1] == pytest.approx(height, abs=1e-3)
    chair = points(graph, "chair_left", "floor")
    # The chair has a foot in each corner of its box of 0.59 m x 0.56 m about (-1.68, 1.5).
    assert {(x < -1.68, z < 1.5) for x, _, z in chair.tolist()} == {(x, z) for x in (0, 1) for z in (0, 1)}
    fridge = points(graph, "fridge", "wall_back")
    assert fridge[:, 2] == pytest.approx(-1.6, abs=1e-3)
    assert np.ptp(fridge, axis=0)[0] > 0.9


# Pairs that a person sees resting or hanging; the scene has gaps of 0-60 mm (largest: sofa and folding doors).
LIVING = """
    BalconyTable_01_001 ChairD_01_001 ChairD_01_002: FloorB_01_001
    TVCabinet_01_001 ShoeRack_01_001 AirconditionerB_01_001: FloorB_01_001
    DeskPortraitB_01 DeskPortraitB_02 PortraitB_01 PortraitB_03 Carpet_01_001 Carpet_01_002: FloorB_01_001
    FoldingDoor_01_001 FoldingDoor_01_002 HouseWallB_01_001: FloorB_01_001
    SofaC_01_001 CoffeeTable_01_001 Trash_01_001: Carpet_01_001
    Ball_01_001 Dumbbell_01_001 FitnessEquipment_01_001: Carpet_01_002
    Tablet_01_001 DeskPortraitA_02: CoffeeTable_01_001
    SecurityCamera_01_001 DeskPortraitA_01 DeskPortraitD_02: TVCabinet_01_001
    DeskPortraitD_04: ShoeRack_01_001
    Vase_01_001 DeskPortraitD_01: Board_01_001
    Board_01_001 TV_01_001 PortraitD_01 LightC_01_001 LightC_01_002: HouseWallB_01_001
    RoomWindow_01_006 RoomWindow_01_007 RoomWindow_01_008 RoomWindow_01_009: HouseWallB_01_001
"""
# Also correct: frames side by side, doors in their frame, a leaning picture, heavy objects sunk through the carpet.
LIVING_BESIDES = """
    RoomWindow_01_006 RoomWindow_01_008: RoomWindow_01_007
    RoomWindow_01_009: RoomWindow_01_008
    FoldingDoor_01_001 FoldingDoor_01_002 PortraitB_01: HouseWallB_01_001
    Dumbbell_01_001 FitnessEquipment_01_001: FloorB_01_001
"""


def test_a_real_living_room_has_the_contacts_that_a_person_sees_and_no_others() -> None:
    graph = graph_of("aws_house_living")
    assert listed(LIVING) - pairs(graph) == set()
    assert pairs(graph) - listed(LIVING) - listed(LIVING_BESIDES) == set()
    assert {pair: weight(graph, *pair) for pair in listed(LIVING)} == dict.fromkeys(listed(LIVING), 1.0)


def test_a_composed_bathroom_stands_hangs_and_is_stacked() -> None:
    graph = graph_of("composed_bathroom_kenney")
    assert pairs(graph) >= listed("""
        bath_cabinet bath_mat bathtub shower_cabin stool: floor
        toilet trash_bin tumble_dryer vanity_sink washing_machine: floor
        radio: washing_machine
        plant small_speaker: tumble_dryer
        toilet_roll: stool
        mirror towel_rail wall_cabinet: wall_back
    """)
    assert not pairs(graph) & listed("""
        trash_bin mirror wall_cabinet: toilet
        plant: small_speaker
        bath_mat: bathtub
    """)
