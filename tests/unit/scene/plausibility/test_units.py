"""Warnings about units: none for plausible sizes, otherwise with the unit that corrects the sizes."""

from __future__ import annotations

import re
import warnings
from pathlib import Path
from unittest.mock import ANY as ANY_TEXT

import pytest

from gltf_builder import Gltf
from scene2hap.scene.load import UnitWarning, load_scene
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.plausibility.units import implausible, warn_if_implausible
from scene2hap.scene.snapshot import SceneSnapshot
from scenes import box, scene

# (name, width, height) in metres of objects on the floor.
FURNITURE = [("Door_01", 0.9, 2.02), ("ChairA_01_003", 0.45, 0.88), ("kitchen table", 1.4, 0.74), ("Fridge", 0.6, 1.75)]


def room(scale: float, things: list[tuple[str, float, float]]) -> SceneSnapshot:
    floor = box("slab", (4 * scale, 0.1 * scale, 3 * scale), (0.0, -0.05 * scale, 0.0))
    return scene(
        floor, *(box(name, (w * scale, h * scale, w * scale), (0.0, h * scale / 2, 0.0)) for name, w, h in things)
    )


def suggestion(snapshot: SceneSnapshot, unit_m: float = 1.0) -> float | None:
    """The unit that the warning names; None if there is no warning."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        warn_if_implausible(snapshot, unit_m)
    if not caught:
        return None
    assert [item.category for item in caught] == [UnitWarning]
    found = re.search(r"unit_m=([\d.e+-]+)", str(caught[0].message))
    assert found is not None
    return float(found[1].rstrip("."))


@pytest.mark.parametrize("scale", [1.0, 0.8, 1.3])
def test_plausible_room_gets_no_suggestion(scale: float) -> None:
    assert suggestion(room(scale, FURNITURE)) is None


@pytest.mark.parametrize(
    ("scale", "unit_m"), [(100.0, 0.01), (1000.0, 0.001), (39.37, 0.0254), (10.0, 0.1), (3.281, 0.3048)]
)
def test_unit_is_suggested_from_furniture_sizes(scale: float, unit_m: float) -> None:
    assert suggestion(room(scale, FURNITURE)) == unit_m


@pytest.mark.parametrize(("scale", "unit_m"), [(100.0, 0.01), (39.37, 0.0254)])
def test_one_named_table_decides_between_units_of_a_room_without_walls(scale: float, unit_m: float) -> None:
    assert suggestion(room(scale, [("table", 1.2, 0.72), ("thing", 0.45, 0.9), ("blower", 0.3, 0.3)])) == unit_m


@pytest.mark.parametrize("scale", [1.8, 0.5])
def test_toy_scale_is_suggested_as_a_ratio(scale: float) -> None:
    assert suggestion(room(scale, FURNITURE)) == pytest.approx(1 / scale, rel=0.15)


def test_one_odd_object_among_many_gives_no_suggestion() -> None:
    assert suggestion(room(1.0, [*FURNITURE, ("table", 0.3, 0.2)])) is None


def test_single_named_object_must_be_far_off_for_a_suggestion() -> None:
    assert suggestion(room(1.0, [("table", 1.4, 0.4)])) is None
    assert suggestion(room(1.0, [("table", 1.4, 7.4)])) == 0.1


def test_a_table_without_legs_and_floor_has_no_height() -> None:
    board, thing = (
        box("wooden table", (1.2, 0.04, 0.8), (0.0, 0.7, 0.0)),
        box("thing", (0.1, 0.1, 0.1), (0.0, 0.77, 0.0)),
    )
    assert suggestion(scene(board, thing)) is None
    assert suggestion(scene(board, box("floor", (4.0, 0.1, 4.0), (0.0, -6.0, 0.0)))) is not None  # 6.7 m above it


def test_a_sky_around_the_scene_is_not_its_ground() -> None:
    """The bottom of a sky dome is kilometres below the feet of the furniture, whose sizes are right."""
    furnished = room(1.0, FURNITURE)
    sky = box("sky", (18_000.0, 18_000.0, 18_000.0), (0.0, 0.0, 0.0))
    assert suggestion(scene(sky, *furnished.objects)) is None
    assert suggestion(scene(sky, *room(100.0, FURNITURE).objects)) == 0.01


def test_what_a_simulation_keeps_below_the_floor_is_not_the_ground() -> None:
    """Targets and spare objects wait below the floor until they are needed; the table is 0.8 m high."""
    parked = box("target", (0.1, 0.1, 0.1), (0.0, -1.0, 0.0))
    floor = box("Floor_01", (6.0, 0.02, 6.0), (0.0, 0.0, 0.0))
    table = box("table", (1.4, 0.8, 0.8), (0.0, 0.4, 0.0))
    assert suggestion(scene(parked, floor, table)) is None
    high = box("table", (140.0, 80.0, 80.0), (0.0, 40.0, 0.0))
    assert suggestion(scene(parked, floor, high)) == 0.01


@pytest.mark.parametrize("name", ["doormat", "Cupboard_Door_R", "Tablet", "chair_leg_cover", "table lamp", "Куб", "7"])
def test_unrelated_names_give_no_suggestion(name: str) -> None:
    assert suggestion(room(1.0, [(name, 0.3, 0.02)])) is None


def test_extremely_wide_scene_gets_a_suggestion_without_names() -> None:
    assert suggestion(scene(box("Object_1", (360.0, 207.0, 60.0), (0, 0, 0)))) == 0.01


@pytest.mark.parametrize(("size_m", "unit", "of_model"), [((60, 42, 32), "0.1", "0.01"), ((400, 300, 350), "0.01", "")])
def test_a_single_model_may_be_in_centimetres(size_m: tuple[float, float, float], unit: str, of_model: str) -> None:
    """A cooker hood of 60 cm is as large as a room in decimetres."""
    hood = scene(*(box(f"Circle.{k}", size_m, (0, 0, 0)) for k in range(2)))
    assert (implausible(hood), implausible(hood, 0.1)) == (
        (ANY_TEXT, unit, ANY_TEXT, of_model),
        (ANY_TEXT, f"{float(unit) / 10:g}", ANY_TEXT, f"{float(of_model) / 10:g}" if of_model else ""),
    )
    with pytest.warns(
        UnitWarning, match="or 0.01 if it holds one model and no room; giving" if of_model else "; giving"
    ):
        warn_if_implausible(hood)


def test_a_ground_of_its_own_may_be_of_any_width() -> None:
    corners = [(0.0, 0.0, 0.0), (200.0, 0.0, 0.0), (200.0, 0.0, 200.0), (0.0, 0.0, 200.0)]
    ground = SceneObject("planeLink", geometry=(corners, [(0, 2, 1), (0, 3, 2)]))
    assert suggestion(scene(ground)) is None


def test_extremely_high_room_gets_a_suggestion_without_names() -> None:
    assert suggestion(scene(box("Object_1", (28.0, 27.0, 26.0), (0, 0, 0)))) == 0.1


def test_many_objects_within_a_hand_get_a_suggestion_and_one_does_not() -> None:
    def tiny(n: int) -> SceneSnapshot:
        return scene(*(box(f"o{i}", (0.004, 0.003, 0.004), (0.005 * i, 0.0, 0.0)) for i in range(n)))

    assert suggestion(tiny(1)) is None
    assert suggestion(tiny(8)) == pytest.approx(100.0)


def test_a_robot_hand_in_metres_gets_no_suggestion() -> None:
    """A hand of 16 cm is as high as it is wide; a room of that size is flat."""
    fingers = [
        box(f"finger_{k}_{j}", (0.02, 0.035, 0.02), (0.035 * k, 0.04 * j, 0.0)) for k in range(5) for j in range(4)
    ]
    assert suggestion(scene(*fingers)) is None


def test_large_factors_are_written_without_exponents() -> None:
    tiny = scene(*(box(f"o{i}", (0.004, 0.003, 0.004), (0.005 * i, 0.0, 0.0)) for i in range(8)))
    with pytest.warns(UnitWarning, match=r"unit_m=100 \(metres per unit"):
        warn_if_implausible(tiny)


def test_suggestion_is_relative_to_the_current_unit() -> None:
    assert suggestion(room(100.0, FURNITURE), unit_m=0.001) == pytest.approx(1e-5)


def metre_cube_in_centimetres(tmp_path: Path) -> Path:
    gltf = Gltf()
    for i, name in enumerate(("door", "wall", "floor")):
        gltf.node(name, mesh=gltf.cube(), scale=[90.0, 200.0, 5.0], translation=[100.0 * i, 0.0, 0.0], root=True)
    return gltf.write(tmp_path / "room.glb")


def test_unit_warning_has_the_line_of_the_caller(tmp_path: Path) -> None:
    with pytest.warns(UnitWarning, match=r"'room' are implausible.*unit_m=0\.01 .*centimetres") as caught:
        load_scene(metre_cube_in_centimetres(tmp_path))
    assert caught[0].filename == __file__


@pytest.mark.parametrize("unit_m", [0.01, 1.0])
def test_given_unit_is_not_questioned(tmp_path: Path, unit_m: float) -> None:
    assert len(load_scene(metre_cube_in_centimetres(tmp_path), unit_m=unit_m).objects) == 3


def park(scale: float = 1.0, *, named: bool = True) -> SceneSnapshot:
    """A ground of 225 m with benches, trees and a tower."""
    sizes = [("ground", (225.0, 0.1, 180.0)), ("tower", (9.0, 40.0, 9.0))]
    sizes += [(f"Bench_{i:02}", (1.6, 0.8, 0.5)) for i in range(8)] + [(f"tree_{i}", (4.0, 9.0, 4.0)) for i in range(6)]
    return scene(
        *(
            box(name if named else f"Object_{i}", tuple(scale * edge for edge in size), (9 * scale * i, 0.0, 0.0))
            for i, (name, size) in enumerate(sizes)
        )
    )


@pytest.mark.parametrize("named", [True, False])
def test_park_in_metres_gets_no_suggestion(named: bool) -> None:
    assert suggestion(park(named=named)) is None


def test_park_in_centimetres_gets_a_suggestion() -> None:
    assert suggestion(park(100.0)) == 0.01


@pytest.mark.parametrize("n", [1, 4])
def test_keyboards_of_157_cm_get_a_suggestion(n: int) -> None:
    keyboards = [(f"Keyboard_{i}", 1.57, 0.07) for i in range(n)]
    assert suggestion(room(1.0, keyboards)) == pytest.approx(0.22, rel=0.1)
    assert suggestion(room(1.0, [("Keyboard_1", 0.44, 0.03)])) is None


def test_many_copies_of_one_object_do_not_decide_the_unit() -> None:
    assert suggestion(room(1.0, [*FURNITURE, *((f"Keyboard_{i}", 1.57, 0.07) for i in range(12))])) is None


def test_single_small_door_gives_no_suggestion() -> None:
    assert (
        suggestion(scene(box("door", (0.6, 0.75, 0.02), (0.0, 0.4, 0.0)), box("rack", (0.5, 0.1, 0.5), (0, 0, 0))))
        is None
    )


@pytest.mark.parametrize("edge", [0.5, 1.0, 2.0])
def test_placeholder_cubes_give_no_suggestion(edge: float) -> None:
    names = ["microwave_oven_2", "Keyboard_1", "cup", "wooden_table_1", "fridge", "kettle"]
    assert suggestion(scene(*(box(name, (edge,) * 3, (3 * i, edge / 2, 0)) for i, name in enumerate(names)))) is None
    assert suggestion(scene(box("cup", (edge,) * 3, (0.0, 0.0, 0.0)))) is None
