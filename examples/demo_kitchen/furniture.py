"""The room, its cabinets and what people sit at. Pivots: the middle of the foot, or where a thing meets the wall."""

from __future__ import annotations

from demo_kitchen.shapes import (
    Part,
    Range,
    at_each,
    box,
    cylinder,
    facing_front,
    frame,
    lathe,
    post,
    rounded,
    slanted_box,
    tray,
    tube,
)

PANEL_M = 0.018
WORKTOP_THICKNESS_M = 0.038
BASE_HEIGHT_M = 0.862
BASE_DEPTH_M = 0.56
TABLE_HEIGHT_M = 0.74
TABLE_TOP_M = 0.027


def floor(length: float, depth: float) -> list[Part]:
    """A slab whose top is the ground."""
    return [box("stone_tiles", (-length / 2, length / 2), (-0.12, 0.0), (-depth / 2, depth / 2))]


def back_wall(length: float) -> list[Part]:
    """A slab that faces the room with its plane z = 0."""
    return [box("warm_plaster", (-length / 2, length / 2), (0.0, 2.5), (-0.10, 0.0))]


def left_wall(length: float, opening_y: Range, opening_z: Range) -> list[Part]:
    """A slab that faces the room with its plane x = 0, and an opening for a window."""
    hole = (opening_y, opening_z)
    return [frame("warm_plaster", (-0.10, 0.0), (0.0, 2.5), (-length / 2, length / 2), hole, through="x")]


def window(height: float, width: float) -> list[Part]:
    """A frame that fills its opening, with two panes of 4 mm."""
    half, rim, mullion = width / 2, 0.05, 0.025
    light = (rim, height - rim)
    hole = (light, (-half + rim, half - rim))
    panes = [(-half + rim, -mullion), (mullion, half - rim)]
    return [
        frame("white_lacquer", (-0.06, 0.01), (0.0, height), (-half, half), hole, through="x"),
        box("white_lacquer", (-0.06, 0.01), light, (-mullion, mullion)),
        *(box("window_glass", (-0.027, -0.023), light, pane) for pane in panes),
        box("brushed_steel", (0.01, 0.03), (0.50, 0.53), (-0.015, 0.015)),
        box("brushed_steel", (0.03, 0.042), (0.50, 0.62), (-0.010, 0.010)),
    ]


def window_sill(width: float) -> list[Part]:
    """A marble board that sticks out of the wall below the window; its top is at the pivot."""
    return [box("marble", (0.0, 0.20), (-0.025, 0.0), (-width / 2, width / 2))]


def worktop(length: float, sink_x: Range, sink_z: Range) -> list[Part]:
    """An oak board along the wall, cut out for the sink."""
    ranges = (-length / 2, length / 2), (0.0, WORKTOP_THICKNESS_M), (0.0, 0.62)
    return [frame("oak", *ranges, (sink_x, sink_z), through="y")]


def base_cabinet(width: float) -> list[Part]:
    """Panels of 18 mm, open above, with two doors."""
    doors = _halves(width)
    return [*_carcass(width), *(part for x in doors for part in _front(x, (0.10, 0.855), BASE_DEPTH_M)), *_knobs(0.76)]


def drawer_unit(width: float) -> list[Part]:
    """The same carcass with four drawer fronts."""
    heights = [(0.10, 0.31), (0.315, 0.525), (0.53, 0.69), (0.695, 0.855)]
    x = (-width / 2 + 0.002, width / 2 - 0.002)
    return [
        *_carcass(width),
        *(box("sage_lacquer", x, y, (BASE_DEPTH_M, BASE_DEPTH_M + PANEL_M)) for y in heights),
        *(part for y in heights for part in level_pull(0.20, y[1] - 0.05, BASE_DEPTH_M + PANEL_M)),
    ]


def wall_cabinet(width: float) -> list[Part]:
    """A box of 18 mm panels that hangs on the wall, with a shelf inside and two doors."""
    side, height, depth = width / 2, 0.70, 0.33
    return [
        tray("sage_lacquer", (-side, side), (0.0, height), (0.0, depth), PANEL_M, opening="+z"),
        box("sage_lacquer", (-side + PANEL_M, side - PANEL_M), (0.34, 0.34 + PANEL_M), (PANEL_M, depth - 0.02)),
        *(part for x in _halves(width) for part in _front(x, (0.002, height - 0.002), depth)),
        *_knobs(0.04, z=depth + PANEL_M),
    ]


def open_shelf(length: float) -> list[Part]:
    """An oak board of 20 mm on two steel brackets; the top of the board is at the pivot."""
    side = length / 2 - 0.12
    return [
        box("oak", (-length / 2, length / 2), (-0.02, 0.0), (0.0, 0.22)),
        *at_each(box("black_steel", (-0.015, 0.015), (-0.18, -0.02), (0.0, 0.005)), (-side, side), (0.0,)),
        *at_each(box("black_steel", (-0.015, 0.015), (-0.025, -0.02), (0.005, 0.19)), (-side, side), (0.0,)),
        *at_each(_brace(), (-side, side), (0.0,)),
    ]


def dining_table(length: float, width: float) -> list[Part]:
    """An oak top of 27 mm on an apron and four legs."""
    side, front, under = length / 2, width / 2, TABLE_HEIGHT_M - TABLE_TOP_M
    leg = slanted_box("oak", ((-0.022, 0.022),) * 2, ((-0.032, 0.032),) * 2, (0.0, under))
    legs_x, legs_z, apron = side - 0.06, front - 0.06, (under - 0.07, under)
    span_x, span_z = (-legs_x + 0.032, legs_x - 0.032), (-legs_z + 0.032, legs_z - 0.032)
    return [
        rounded("oak", (-side, side), (under, TABLE_HEIGHT_M), (-front, front), 0.02),
        *at_each(leg, (-legs_x, legs_x), (-legs_z, legs_z)),
        *at_each(box("oak", span_x, apron, (-0.011, 0.011)), (0.0,), (-legs_z, legs_z)),
        *at_each(box("oak", (-0.011, 0.011), apron, span_z), (-legs_x, legs_x), (0.0,)),
    ]


def chair() -> list[Part]:
    """A beech chair whose sitter looks along +Z."""
    front_leg = slanted_box("beech", ((-0.014, 0.014),) * 2, ((-0.018, 0.018),) * 2, (0.0, 0.432))
    back_post = slanted_box(
        "beech", ((-0.018, 0.018), (-0.022, 0.013)), ((-0.015, 0.015), (-0.055, -0.03)), (0.0, 0.86)
    )
    slat = box("beech", (-0.175, 0.175), (-0.03, 0.03), (-0.008, 0.008)).turned("x", -3)
    return [
        rounded("beech", (-0.21, 0.21), (0.432, 0.45), (-0.205, 0.22), 0.02),
        rounded("blue_fabric", (-0.19, 0.19), (0.45, 0.475), (-0.15, 0.20), 0.04),
        *at_each(front_leg, (-0.18, 0.18), (0.19,)),
        *at_each(back_post, (-0.188, 0.188), (-0.19,)),
        *(slat.moved(y=height, z=-0.193 - 0.043 * height) for height in (0.60, 0.70, 0.80)),
        *at_each(box("beech", (-0.009, 0.009), (0.20, 0.225), (-0.19, 0.176)), (-0.18, 0.18), (0.0,)),
    ]


def stool() -> list[Part]:
    """A round birch stool on four leaning legs."""
    seat = lathe("birch", [(0.0, 0.42), (0.15, 0.42), (0.165, 0.43), (0.165, 0.445), (0.155, 0.45), (0.0, 0.45)])
    feet = [(x, z) for x in (-0.15, 0.15) for z in (-0.15, 0.15)]
    legs = [post("birch", 0.015, (x, 0.0, z), (0.6 * x, 0.42, 0.6 * z)) for x, z in feet]
    rungs = [tube("birch", [(-0.135, 0.16, z), (0.135, 0.16, z)], 0.009) for z in (-0.127, 0.127)]
    return [seat, *legs, *rungs]


def rug() -> list[Part]:
    """A flat woven rug of 8 mm with a stripe at both ends."""
    body, stripe, end = 0.46, 0.54, 0.60
    bands = [("grey_wool", (-end, -stripe)), ("red_wool", (-stripe, -body)), ("grey_wool", (-body, body))]
    bands += [("red_wool", (body, stripe)), ("grey_wool", (stripe, end))]
    return [box(colour, x, (0.0, 0.008), (-0.30, 0.30)) for colour, x in bands]


def waste_bin() -> list[Part]:
    """A round steel bin with a domed lid and a pedal."""
    wall = [(0.14, 0.0), (0.14, 0.42), (0.138, 0.42), (0.138, 0.002)]
    lid = [(0.0, 0.42), (0.142, 0.42), (0.142, 0.435), (0.12, 0.455), (0.06, 0.468), (0.0, 0.47)]
    return [
        lathe("brushed_steel", wall),
        lathe("black_plastic", lid),
        box("black_plastic", (-0.04, 0.04), (0.015, 0.025), (0.13, 0.20)),
    ]


def wall_lamp() -> list[Part]:
    """A brass arm that carries a linen shade, on a wall that faces +X."""
    plate = cylinder("brass", 0.05, (0.0, 0.012)).turned("z", -90)
    arm = [(0.012, 0.0, 0.0), (0.06, -0.03, 0.0), (0.11, -0.04, 0.0), (0.15, -0.02, 0.0), (0.16, 0.03, 0.0)]
    shade = [(0.115, 0.03), (0.075, 0.20), (0.073, 0.20), (0.113, 0.03)]
    bulb = [(0.0, 0.05), (0.012, 0.05), (0.028, 0.09), (0.022, 0.12), (0.0, 0.13)]
    spider = box("brass", (-0.11, 0.11), (0.044, 0.05), (-0.004, 0.004))
    return [
        plate,
        tube("brass", arm, 0.007),
        *(part.moved(x=0.16) for part in (lathe("linen", shade, loop=True), lathe("warm_light", bulb, 12))),
        spider.moved(x=0.16),
    ]


def level_pull(length: float, y: float, z: float) -> list[Part]:
    """A bar handle across a front whose face is at `z`."""
    feet = at_each(box("black_steel", (-0.006, 0.006), (y - 0.006, y + 0.006), (z, z + 0.024)), _ends(length), (0.0,))
    return [*feet, box("black_steel", (-length / 2, length / 2), (y - 0.006, y + 0.006), (z + 0.024, z + 0.036))]


def upright_pull(colour: str, x: float, y: Range, z: float) -> list[Part]:
    """A bar handle along a door's edge, on a face at `z`."""
    side = (x - 0.008, x + 0.008)
    feet = [box(colour, side, (end - 0.008, end + 0.008), (z, z + 0.03)) for end in (y[0] + 0.03, y[1] - 0.03)]
    return [*feet, box(colour, side, y, (z + 0.03, z + 0.045))]


def _carcass(width: float) -> list[Part]:
    side, inner = width / 2, width / 2 - PANEL_M
    return [
        *at_each(box("sage_lacquer", (-PANEL_M, 0.0), (0.0, BASE_HEIGHT_M), (0.0, BASE_DEPTH_M)), (side,), (0.0,)),
        *at_each(box("sage_lacquer", (0.0, PANEL_M), (0.0, BASE_HEIGHT_M), (0.0, BASE_DEPTH_M)), (-side,), (0.0,)),
        box("sage_lacquer", (-inner, inner), (0.10, 0.10 + PANEL_M), (0.0, BASE_DEPTH_M)),
        box("sage_lacquer", (-inner, inner), (0.10 + PANEL_M, BASE_HEIGHT_M), (0.0, PANEL_M)),
        box("sage_lacquer", (-inner, inner), (0.762, BASE_HEIGHT_M), (BASE_DEPTH_M - PANEL_M, BASE_DEPTH_M)),
        box("black_plastic", (-inner, inner), (0.0, 0.10), (0.48, 0.48 + PANEL_M)),
    ]


def _front(x: Range, y: Range, z: float) -> list[Part]:
    """A framed door: a rim of 70 mm around a thinner panel."""
    hole = (x[0] + 0.07, x[1] - 0.07), (y[0] + 0.07, y[1] - 0.07)
    return [
        frame("sage_lacquer", x, y, (z, z + PANEL_M), hole, through="z"),
        box("sage_lacquer", *hole, (z + 0.002, z + 0.010)),
    ]


def _halves(width: float) -> tuple[Range, Range]:
    return (-width / 2 + 0.002, -0.002), (0.002, width / 2 - 0.002)


def _knobs(y: float, z: float = BASE_DEPTH_M + PANEL_M) -> list[Part]:
    knob = facing_front(lathe("black_steel", [(0.006, 0.0), (0.006, 0.012), (0.014, 0.018), (0.012, 0.026)], 12))
    return [part.moved(x=x, y=y + 0.03, z=z) for part in knob for x in (-0.037, 0.037)]


def _brace() -> Part:
    return tube("black_steel", [(0.0, -0.17, 0.006), (0.0, -0.026, 0.16)], 0.005)


def _ends(length: float) -> tuple[float, float]:
    return (-length / 2 + 0.02, length / 2 - 0.02)
