"""Detection of walls that hide a room, without false detections."""

from __future__ import annotations

import math

import pytest

from scene2hap import Box, Pose, SceneObject, SceneSnapshot
from scene2hap.report.walls import shells, walls

HEIGHT, SIDE, THICK = 2.5, 4.0, 0.1
FURNITURE = {
    "table": ((0.3, 0.4, 0.2), (1.2, 0.8, 0.7)),
    "bookcase": ((1.0, 1.0, -1.75), (1.0, 2.0, 0.3)),
    "picture": ((-1.0, 1.5, -1.88), (0.6, 0.5, 0.03)),
    "door": ((-1.88, 1.0, 0.5), (0.04, 2.0, 0.9)),
}
WALLS = {
    "north": ((0.0, HEIGHT / 2, -1.95), (SIDE, HEIGHT, THICK)),
    "south": ((0.0, HEIGHT / 2, 1.95), (SIDE, HEIGHT, THICK)),
    "west": ((-1.95, HEIGHT / 2, 0.0), (THICK, HEIGHT, SIDE)),
    "east": ((1.95, HEIGHT / 2, 0.0), (THICK, HEIGHT, SIDE)),
}
FLOOR = {"floor": ((0.0, -0.05, 0.0), (SIDE, 0.1, SIDE))}
CEILING = {"ceiling": ((0.0, HEIGHT + 0.05, 0.0), (SIDE, 0.1, SIDE))}
OUT = {"north": (0, 0, -1), "south": (0, 0, 1), "west": (-1, 0, 0), "east": (1, 0, 0), "ceiling": (0, 1, 0)}

Things = dict[str, tuple[tuple[float, float, float], tuple[float, float, float]]]


def room(things: Things, yaw: float = 0.0, up_axis: str = "y") -> SceneSnapshot:
    """A scene of boxes by centre and size (y up), rotated about the vertical."""
    turn = Pose.from_yaw((0.0, 0.0, 0.0), yaw)
    objects = []
    for name, (centre, size) in things.items():
        (x, y, z) = (float(value) for value in turn.to_world([centre])[0])
        if up_axis == "z":
            objects.append(SceneObject(name, pose=Pose((x, -z, y)), geometry=Box((size[0], size[2], size[1]))))
        else:
            objects.append(SceneObject(name, pose=Pose.from_yaw((x, y, z), yaw), geometry=Box(size)))
    return SceneSnapshot.build(objects, name="room", up_axis=up_axis)


@pytest.mark.parametrize("up_axis", ["y", "z"])
def test_four_walls_are_found_and_no_furniture(up_axis: str) -> None:
    found = walls(room({**FLOOR, **WALLS, **FURNITURE}, up_axis=up_axis))
    y_up = {key: (x, y, z) if up_axis == "y" else (x, z, -y) for key, (x, y, z) in found.items()}
    assert {key: tuple(map(round, out)) for key, out in y_up.items()} == {key: OUT[key] for key in WALLS}


def test_rotated_house_has_the_same_walls() -> None:
    yaw = math.radians(25.0)
    scene = room({**FLOOR, **WALLS, **FURNITURE}, yaw)
    found = walls(scene)
    assert set(found) == set(WALLS)
    for name, out in found.items():
        (wanted,) = Pose.from_yaw((0.0, 0.0, 0.0), yaw).to_world([OUT[name]])
        assert out == pytest.approx(tuple(wanted), abs=1e-5)


def test_cupboards_along_a_side_are_no_wall() -> None:
    cupboards: Things = {"cupboards": ((0.0, HEIGHT / 2, -1.8), (SIDE, HEIGHT, 0.4))}
    assert walls(room({**FLOOR, **cupboards})) == {}


def test_a_drainpipe_outside_is_no_wall() -> None:
    pipe: Things = {"pipe": ((1.0, HEIGHT / 2, -2.05), (0.1, HEIGHT, 0.08))}
    assert set(walls(room({**FLOOR, **WALLS, **pipe}))) == set(WALLS)


def test_wall_pieces_are_joined() -> None:
    pieces: Things = {f"wall_{i}": ((-1.5 + i, HEIGHT / 2, -1.95), (1.0, HEIGHT, THICK)) for i in range(4)}
    assert set(walls(room({**FLOOR, **pieces, **FURNITURE}))) == set(pieces)
    fewer = {key: pieces[key] for key in ("wall_0", "wall_1")}
    assert walls(room({**FLOOR, **fewer})) == {}


def test_a_ceiling_is_as_wide_as_the_scene() -> None:
    """It may consist of panels. The top of a single table is none, in one piece or of boards."""
    ceiling = {**FLOOR, **CEILING, **FURNITURE}
    assert "ceiling" in shells(room(ceiling))  # as wide and as deep as the scene
    panels: Things = {f"panel_{i}": ((-1.5 + i, HEIGHT + 0.02, 0.0), (1.0, 0.04, SIDE)) for i in range(4)}
    found = walls(room({**FLOOR, **WALLS, **panels, **FURNITURE}))
    assert set(found) == {*WALLS, *panels}
    assert {found[name] for name in panels} == {OUT["ceiling"]}
    table: Things = {"top": ((0.0, 0.78, 0.0), (1.2, 0.04, 0.8)), "leg": ((0.0, 0.38, 0.0), (0.1, 0.76, 0.1))}
    assert walls(room(table)) == {}
    boards: Things = {f"board_{i}": ((-0.45 + 0.3 * i, 0.78, 0.0), (0.3, 0.04, 0.8)) for i in range(4)}
    assert walls(room({**boards, "leg": table["leg"]})) == {}


def test_a_source_is_no_wall_and_a_scene_without_walls_has_none() -> None:
    assert set(walls(room({**FLOOR, **WALLS}), sources=["north"])) == set(WALLS) - {"north"}
    assert walls(room({**FLOOR, **FURNITURE})) == {}
    assert walls(room({"mug": ((0.0, 0.0, 0.0), (0.1, 0.1, 0.1))})) == {}
