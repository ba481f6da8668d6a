"""What stands and lies about. Pivots: the middle of the foot."""

from __future__ import annotations

from math import cos, radians, sin

from demo_kitchen.shapes import (
    Part,
    Point,
    arc,
    ball,
    box,
    cylinder,
    lathe,
    post,
    rounded,
    slanted_box,
    stacked,
    tube,
)


def sink() -> list[Part]:
    """A basin of 1 mm steel that hangs in the worktop's hole by a rim of 3 mm."""
    basin = [(-0.17, 0.23, 0.14), (0.0, 0.245, 0.155), (0.0, 0.28, 0.19), (0.003, 0.28, 0.19)]
    basin += [(0.003, 0.244, 0.154), (-0.169, 0.229, 0.139)]
    return [
        stacked("brushed_steel", [(y, (-half_x, half_x), (-half_z, half_z)) for y, half_x, half_z in basin]),
        cylinder("black_steel", 0.035, (-0.169, -0.166)),
    ]


def tap() -> list[Part]:
    """A chrome swan neck with a lever."""
    neck: list[Point] = [(0.0, 0.012, 0.0), (0.0, 0.10, 0.0), (0.0, 0.20, 0.0)]
    neck += [*arc((0.0, 0.24, 0.09), 0.09, (180, 0), 8), (0.0, 0.20, 0.18)]
    return [
        lathe("chrome", [(0.026, 0.0), (0.026, 0.006), (0.020, 0.012)]),
        tube("chrome", neck, 0.011),
        tube("chrome", [(0.009, 0.05, 0.0), (0.04, 0.06, 0.0), (0.085, 0.085, 0.0)], 0.006),
    ]


def cutting_board() -> list[Part]:
    """A maple board of 18 mm with a handle."""
    return [
        rounded("maple", (-0.15, 0.15), (0.0, 0.018), (-0.12, 0.12), 0.02),
        box("maple", (0.15, 0.21), (0.0, 0.018), (-0.022, 0.022)),
    ]


def knife_block() -> list[Part]:
    """A leaning block with five knives."""
    block = slanted_box("walnut", ((-0.05, 0.05), (-0.06, 0.06)), ((-0.05, 0.05), (-0.08, 0.0)), (0.0, 0.20))
    grips = [(-0.03, -0.055), (0.0, -0.055), (0.03, -0.055), (-0.018, -0.02), (0.018, -0.02)]
    return [block, *(post("black_plastic", 0.009, (x, 0.20, z), (x, 0.29, z - 0.018), 8) for x, z in grips)]


def saucepan() -> list[Part]:
    """A steel pan with a lid and a long handle."""
    wall = [(0.095, 0.0), (0.10, 0.01), (0.10, 0.12), (0.098, 0.12), (0.098, 0.012), (0.093, 0.003)]
    lid = [(0.0, 0.12), (0.102, 0.12), (0.102, 0.124), (0.05, 0.136), (0.0, 0.138)]
    knob = [(0.008, 0.138), (0.008, 0.148), (0.016, 0.155), (0.014, 0.165), (0.0, 0.168)]
    return [
        lathe("brushed_steel", wall),
        lathe("brushed_steel", lid),
        lathe("black_plastic", knob, 12),
        tube("black_plastic", [(0.099, 0.10, 0.0), (0.15, 0.105, 0.0), (0.27, 0.12, 0.0)], 0.009),
    ]


def frying_pan() -> list[Part]:
    """A shallow cast-iron pan."""
    wall = [(0.10, 0.0), (0.13, 0.045), (0.126, 0.045), (0.097, 0.004)]
    return [
        lathe("cast_iron", wall, 28),
        tube("cast_iron", [(0.122, 0.035, 0.0), (0.18, 0.05, 0.0), (0.30, 0.065, 0.0)], 0.010),
    ]


def olive_oil_bottle() -> list[Part]:
    """A tall green bottle with a cap and a label."""
    body = [(0.0, 0.0), (0.032, 0.0), (0.034, 0.01), (0.034, 0.17), (0.013, 0.22), (0.013, 0.27), (0.0, 0.27)]
    return [
        lathe("green_glass", body),
        lathe("black_plastic", [(0.014, 0.27), (0.014, 0.295), (0.010, 0.30)], 16),
        lathe("paper", [(0.0343, 0.06), (0.0348, 0.06), (0.0348, 0.13), (0.0343, 0.13)], loop=True),
    ]


def spice_jar(spice: str) -> list[Part]:
    """A glass filled with a spice, under a steel lid."""
    glass = [(0.0, 0.0), (0.021, 0.0), (0.022, 0.003), (0.022, 0.012), (0.0, 0.012)]
    shoulder = [(0.0, 0.065), (0.022, 0.065), (0.022, 0.072), (0.017, 0.080), (0.0, 0.080)]
    return [
        lathe("window_glass", glass, 16),
        cylinder(spice, 0.0215, (0.012, 0.065)),
        lathe("window_glass", shoulder, 16),
        cylinder("brushed_steel", 0.020, (0.080, 0.100)),
    ]


def plate() -> list[Part]:
    """A dinner plate of 240 mm."""
    profile = [(0.075, 0.0), (0.080, 0.004), (0.120, 0.020), (0.119, 0.024), (0.078, 0.009)]
    return [lathe("white_porcelain", profile, 32)]


def cup(colour: str) -> list[Part]:
    """A stoneware mug with an ear."""
    wall = [(0.034, 0.0), (0.040, 0.006), (0.041, 0.092), (0.037, 0.092), (0.036, 0.008)]
    ear = [(0.0385 + 0.026 * sin(a), 0.05 - 0.030 * cos(a), 0.0) for a in (radians(22.5 * i) for i in range(9))]
    return [lathe(colour, wall), tube(colour, ear, 0.005)]


def fruit_bowl() -> list[Part]:
    """A wide earthenware bowl with apples and oranges."""
    wall = [(0.06, 0.0), (0.062, 0.012), (0.13, 0.075), (0.126, 0.078), (0.058, 0.018)]
    turns = [("orange", 0.0), ("apple_red", radians(120)), ("apple_red", radians(240))]
    fruit = [ball(colour, 0.036).moved(0.042 * cos(turn), 0.056, 0.042 * sin(turn)) for colour, turn in turns]
    return [lathe("blue_stoneware", wall, 28), *fruit, ball("orange", 0.036).moved(y=0.108)]


def cookbook() -> list[Part]:
    """A closed hardback."""
    cover, pages = (-0.095, 0.095), (-0.089, 0.089)
    return [
        box("book_red", cover, (0.0, 0.003), (-0.125, 0.125)),
        box("paper", pages, (0.003, 0.025), (-0.119, 0.119)),
        box("book_red", cover, (0.025, 0.028), (-0.125, 0.125)),
        box("book_red", (-0.095, -0.089), (0.003, 0.025), (-0.125, 0.125)),
        box("paper", (-0.06, 0.06), (0.028, 0.0284), (0.02, 0.08)),
    ]


def tea_towel() -> list[Part]:
    """A folded cotton towel with stripes."""
    heights = [(0.0, 0.006), (0.006, 0.012), (0.012, 0.018)]
    layers = [rounded("white_cotton", (-0.12, 0.12), y, (-0.08, 0.08), 0.008) for y in heights]
    stripes = [box("red_wool", (x, x + 0.02), (0.018, 0.0186), (-0.079, 0.079)) for x in (-0.09, -0.05, 0.07)]
    return [*layers, *stripes]


def herb_pot() -> list[Part]:
    """Basil in a clay pot."""
    pot = [(0.045, 0.0), (0.058, 0.085), (0.064, 0.085), (0.066, 0.11), (0.058, 0.11), (0.042, 0.006)]
    leaves = [
        (0.0, 0.20, 0.0, 0.055),
        (0.04, 0.16, 0.02, 0.04),
        (-0.035, 0.165, 0.025, 0.042),
        (0.0, 0.16, -0.04, 0.04),
    ]
    return [
        lathe("terracotta", pot),
        cylinder("soil", 0.0545, (0.085, 0.095)),
        tube("leaf_green", [(0.0, 0.095, 0.0), (0.0, 0.13, 0.0), (0.0, 0.19, 0.0)], 0.006, 6),
        *(ball("leaf_green", radius, 8).moved(x, y, z) for x, y, z, radius in leaves),
    ]
