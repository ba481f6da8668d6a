"""The six rooms of `rooms.ROOMS`."""

from __future__ import annotations

from math import cos, sin

from rooms.room import Room, Thing, checked, cuboid, cylinder, joined, moved, pairs, swapped

_GAP_M = 0.001  # a gap as authors leave under objects
_WOOD, _STEEL, _WHITE, _RED = (0.5, 0.33, 0.18), (0.7, 0.72, 0.75), (0.9, 0.9, 0.88), (0.7, 0.15, 0.1)
_PARQUET, _PAINTED = checked(_WOOD), checked(_RED)

# -- equal cubes -------------------------------------------------------------------------------------------------------

_CUBE = cuboid((0.5, 0.5, 0.5))
_NAMES = (
    *("refrigerator", "wooden_table_1", "microwave_oven_1", "sofa", "washing_machine", "bookshelf"),
    *("radio_1", "wooden_table_2", "microwave_oven_2", "crate", "radio_2", "bed"),
)
_PLACES = {name: divmod(n, 6) for n, name in enumerate(_NAMES)}


def _stacked() -> str:
    """Contacts: the lower row stands on the floor, the upper row on the lower; columns do not touch."""
    lower, upper = _NAMES[:6], _NAMES[6:]
    return "\n".join([" ".join(lower) + ": floor", *(f"{a}: {b}" for a, b in zip(upper, lower, strict=True))])


cubes = Room(
    "cubes",
    (
        Thing("floor", cuboid((6.0, 0.1, 6.0)), (1.25, -0.05, 0.0), colour=_WOOD),
        *(
            Thing(name, _CUBE, (0.52 * column, 0.25 + 0.5 * row, 0.0), colour=_WHITE)
            for name, (row, column) in _PLACES.items()
        ),
    ),
    contacts=pairs(_stacked()),
    sources=frozenset(
        {"refrigerator", "microwave_oven_1", "microwave_oven_2", "washing_machine", "radio_1", "radio_2"}
    ),
    sizes_m={"floor": (6.0, 6.0, 0.1)},
)

# -- meshes that rest on each other ------------------------------------------------------------------------------------

_TOP_M = 0.74
_TABLE = joined(
    cuboid((1.6, 0.04, 0.9), (0.0, _TOP_M - 0.02, 0.0)),
    *(cuboid((0.06, _TOP_M - 0.04, 0.06), (x, (_TOP_M - 0.04) / 2, z)) for x in (-0.72, 0.72) for z in (-0.38, 0.38)),
)
_CHAIR = joined(
    cuboid((0.42, 0.04, 0.42), (0.0, 0.45, 0.0)),
    *(cuboid((0.04, 0.43, 0.04), (x, 0.215, z)) for x in (-0.18, 0.18) for z in (-0.18, 0.18)),
    cuboid((0.42, 0.45, 0.03), (0.0, 0.695, -0.195)),
)
_PLATE, _CUP = cylinder(0.12, 0.02), cylinder(0.04, 0.1)
_TURN = 0.3


def _on_table(x: float, z: float, height_m: float = 0.0) -> tuple[float, float, float]:
    """World position of a place on the rotated table."""
    return (cos(_TURN) * x + sin(_TURN) * z, _TOP_M + height_m + _GAP_M, cos(_TURN) * z - sin(_TURN) * x)


dining_room = Room(
    "dining_room",
    (
        Thing("floor", cuboid((5.0, 0.1, 5.0)), (0.0, -0.05, 0.0), texture=_PARQUET),
        Thing("wooden_table", _TABLE, (0.0, 0.0, 0.0), _TURN, texture=_PARQUET),
        Thing("chair_left", _CHAIR, (-0.5, 0.0, -1.2), 0.1, _WOOD),
        Thing("chair_right", _CHAIR, (0.7, 0.0, -1.2), -0.2, _WOOD),
        Thing("plate_1", _PLATE, _on_table(-0.5, 0.1), 0.0, _WHITE),
        Thing("plate_2", _PLATE, _on_table(0.0, 0.1), 0.7, _WHITE),
        Thing("cup", _CUP, _on_table(0.0, 0.1, 0.02 + _GAP_M), 0.0, _WHITE),
        Thing("radio", cuboid((0.24, 0.14, 0.1), (0.0, 0.07, 0.0)), _on_table(0.5, -0.2), 0.9, texture=_PAINTED),
        Thing("refrigerator", cuboid((0.6, 1.8, 0.65), (0.0, 0.9, 0.0)), (2.0, 0.0, 1.8), 0.0, _STEEL),
    ),
    contacts=pairs("""
        wooden_table chair_left chair_right refrigerator: floor
        plate_1 plate_2 radio: wooden_table
        cup: plate_2
    """),
    sources=frozenset({"radio", "refrigerator"}),
    sizes_m={"floor": (5.0, 5.0, 0.1), "wooden_table": (1.6, 0.9, 0.04)},
    copies=(("chair_left", "chair_right"), ("plate_1", "plate_2")),
)

# -- stacked shelves ---------------------------------------------------------------------------------------------------

_BOARDS_M = (0.1, 0.5, 0.9, 1.3)
_UNIT = joined(
    *(cuboid((0.9, 0.02, 0.32), (0.0, h - 0.01, 0.0)) for h in _BOARDS_M),
    *(cuboid((0.02, 1.7, 0.32), (x, 0.85, 0.0)) for x in (-0.46, 0.46)),
)
_JAR, _BOOK = cylinder(0.045, 0.12), cuboid((0.16, 0.03, 0.22), (0.0, 0.015, 0.0))

shelves = Room(
    "shelves",
    (
        Thing("floor", cuboid((4.0, 0.1, 3.0)), (0.0, -0.05, 0.0), colour=_WOOD),
        Thing("bookshelf", _UNIT, (0.0, 0.0, -1.0), 0.15, _WOOD),
        *(
            Thing(f"jar_{k}_{n}", _JAR, (0.26 * (n - 1), _BOARDS_M[k] + _GAP_M, -1.0 - 0.04 * (n - 1)), 0.0, _WHITE)
            for k in (1, 2)
            for n in range(3)
        ),
        Thing("book_1", _BOOK, (0.0, _BOARDS_M[0] + _GAP_M, -1.0), 0.1, _RED),
        Thing("book_2", _BOOK, (0.01, _BOARDS_M[0] + 0.03 + 2 * _GAP_M, -1.0), 0.3, _RED),
        Thing("book_3", _BOOK, (0.0, _BOARDS_M[0] + 0.06 + 3 * _GAP_M, -1.01), -0.1, _RED),
        Thing("small_speaker", cuboid((0.14, 0.2, 0.14), (0.0, 0.1, 0.0)), (0.1, _BOARDS_M[3] + _GAP_M, -1.0)),
    ),
    contacts=pairs("""
        bookshelf: floor
        jar_1_0 jar_1_1 jar_1_2 jar_2_0 jar_2_1 jar_2_2 book_1 small_speaker: bookshelf
        book_2: book_1
        book_3: book_2
    """),
    sources=frozenset({"small_speaker"}),
    copies=(
        tuple(f"jar_{k}_{n}" for k in (1, 2) for n in range(3)),
        ("book_1", "book_2", "book_3"),
    ),
)

# -- no source ---------------------------------------------------------------------------------------------------------

storage = Room(
    "storage",
    (
        Thing("floor", cuboid((4.0, 0.1, 4.0)), (0.0, -0.05, 0.0), colour=_WOOD),
        Thing("wall", cuboid((4.0, 2.5, 0.1)), (0.0, 1.25, -2.05), colour=_WHITE),
        Thing("picture", cuboid((0.6, 0.4, 0.02)), (0.3, 1.5, -1.97), texture=_PAINTED),
        Thing("crate_1", cuboid((0.4, 0.3, 0.4), (0.0, 0.15, 0.0)), (-1.0, 0.0, 0.0), 0.2, _WOOD),
        Thing("crate_2", cuboid((0.3, 0.25, 0.3), (0.0, 0.125, 0.0)), (-1.0, 0.3 + _GAP_M, 0.0), 0.5, _WOOD),
        Thing("stool", cylinder(0.18, 0.45), (0.5, 0.0, 0.5), 0.0, _WOOD),
    ),
    contacts=pairs("""
        wall crate_1 stool: floor
        picture: wall
        crate_2: crate_1
    """),
    sizes_m={"wall": (4.0, 2.5, 0.1), "picture": (0.6, 0.4, 0.02)},
)

# -- z up --------------------------------------------------------------------------------------------------------------

workshop = Room(
    "workshop",
    (
        Thing("floor", cuboid((5.0, 5.0, 0.1)), (0.0, 0.0, -0.05)),
        Thing("workbench", swapped(_TABLE), (0.0, 0.0, 0.0), 0.4),
        Thing("radio", cuboid((0.24, 0.1, 0.14), (0.0, 0.0, 0.07)), (0.1, 0.1, _TOP_M + _GAP_M), 0.2),
        Thing("paint_can", swapped(cylinder(0.08, 0.18)), (-0.4, 0.0, _TOP_M + _GAP_M)),
        Thing("washing_machine", cuboid((0.6, 0.6, 0.85), (0.0, 0.0, 0.425)), (1.8, 1.0, 0.0)),
    ),
    contacts=pairs("""
        workbench washing_machine: floor
        radio paint_can: workbench
    """),
    sources=frozenset({"radio", "washing_machine"}),
    sizes_m={"workbench": (1.6, 0.9, 0.04)},
    up_axis="z",
)

# -- one merged mesh ---------------------------------------------------------------------------------------------------

merged = Room(
    "merged",
    (
        Thing(
            "mesh_0",
            joined(
                cuboid((4.0, 0.1, 4.0), (0.0, -0.05, 0.0)),
                _TABLE,
                moved(_CHAIR, (0.0, 0.0, -0.9)),
                moved(_CUP, (0.2, _TOP_M, 0.1)),
            ),
            (0.0, 0.0, 0.0),
        ),
    ),
)
