"""The seven things that vibrate. Fronts face +Z; pivots: the middle of the foot, or where a thing meets the wall."""

from __future__ import annotations

from math import cos, radians, sin

import numpy as np

from demo_kitchen.furniture import upright_pull
from demo_kitchen.shapes import (
    Array,
    Part,
    at_each,
    box,
    cylinder,
    facing_front,
    frame,
    lathe,
    loft,
    ring,
    rounded,
    stacked,
    tray,
    tube,
)

SHEET_M = 0.001
"""Sheet steel of housings; assumed, 0.6-1 mm is common."""
_DOME = (0.047, 0.0170), (0.030, 0.0190), (0.013, 0.020)
"""Radius and height [m] of the wires that ring the fan's guard."""
_HEAD = (-0.007, 0.007), (-0.003, 0.003), (-0.012, 0.012)
"""The brush head before it is laid to the front: ranges in x, y, z [m]."""


def microwave() -> list[Part]:
    """A steel housing on four rubber feet; a door with a dark window, a handle and a panel with buttons."""
    face, door_x, height = (0.16, 0.18), (-0.25, 0.12), (0.01, 0.29)
    hole = (-0.20, 0.04), (0.06, 0.24)
    key = box("light_grey_plastic", (-0.012, 0.012), (-0.009, 0.009), (0.18, 0.183))
    return [
        *at_each(cylinder("black_rubber", 0.015, (0.0, 0.01), 12), (-0.21, 0.21), (-0.14, 0.14)),
        tray("brushed_steel", (-0.25, 0.25), height, (-0.18, 0.16), SHEET_M, opening="+z"),
        frame("brushed_steel", door_x, height, face, hole, through="z"),
        box("black_glass", *hole, (0.165, 0.178)),
        *upright_pull("dark_steel", 0.085, (0.05, 0.25), face[1]),
        box("black_plastic", (0.123, 0.25), height, face),
        box("green_display", (0.142, 0.232), (0.225, 0.262), (0.18, 0.182)),
        *(key.moved(x=x, y=y) for x in (0.152, 0.187, 0.222) for y in (0.125, 0.155, 0.185)),
        *(part.moved(x=0.187, y=0.065, z=0.18) for part in _knob("light_grey_plastic", 0.026)),
    ]


def refrigerator() -> list[Part]:
    """A housing with walls of 50 mm, the freezer's door above the larger one, a bar handle on both."""
    fridge, freezer = (0.03, 1.21), (1.222, 1.80)
    return [
        *at_each(cylinder("black_rubber", 0.022, (0.0, 0.02), 12), (-0.25, 0.25), (0.06, 0.50)),
        tray("dark_steel", (-0.30, 0.30), (0.02, 1.80), (0.0, 0.555), 0.05, opening="+z"),
        *(box("black_rubber", (-0.285, 0.285), (y[0] + 0.015, y[1] - 0.015), (0.555, 0.56)) for y in (fridge, freezer)),
        *(box("light_steel", (-0.30, 0.30), y, (0.56, 0.62)) for y in (fridge, freezer)),
        *upright_pull("black_steel", 0.25, (0.62, 1.16), 0.62),
        *upright_pull("black_steel", 0.25, (1.27, 1.60), 0.62),
        box("dark_steel", (-0.05, 0.05), (1.70, 1.715), (0.62, 0.622)),
    ]


def washing_machine() -> list[Part]:
    """A white housing on four feet, with a round glass door, a detergent drawer, a programme knob and a display."""
    face = (0.26, 0.28)
    porthole = facing_front(
        ring("chrome", 0.135, 0.19, (0.0, 0.03), 24),
        lathe("black_glass", [(0.0, 0.0), (0.134, 0.0), (0.134, 0.024), (0.09, 0.05), (0.0, 0.06)], 24),
    )
    return [
        *at_each(cylinder("black_rubber", 0.025, (0.0, 0.02), 12), (-0.25, 0.25), (-0.23, 0.21)),
        tray("white_enamel", (-0.30, 0.30), (0.02, 0.82), (-0.28, 0.26), SHEET_M, opening="+z"),
        box("white_enamel", (-0.30, 0.30), (0.82, 0.85), (-0.28, 0.29)),
        box("white_enamel", (-0.30, 0.30), (0.02, 0.70), face),
        box("light_grey_plastic", (-0.30, 0.30), (0.704, 0.82), face),
        *(part.moved(y=0.38, z=face[1]) for part in porthole),
        box("chrome", (0.17, 0.20), (0.34, 0.42), (0.31, 0.325)),
        box("white_enamel", (-0.285, -0.11), (0.718, 0.808), (0.28, 0.288)),
        box("dark_steel", (-0.25, -0.15), (0.722, 0.734), (0.288, 0.292)),
        *(part.moved(y=0.762, z=face[1]) for part in _knob("chrome", 0.036)),
        box("black_glass", (0.09, 0.26), (0.738, 0.788), (0.28, 0.282)),
        box("green_display", (0.15, 0.22), (0.752, 0.774), (0.282, 0.283)),
        box("light_grey_plastic", (-0.28, -0.18), (0.05, 0.13), (0.28, 0.284)),
    ]


def cooker_hood() -> list[Part]:
    """A sheet steel canopy under a chimney, open below, with a filter, two lamps and three buttons."""
    depth, chimney, top = 0.48, 0.26, 0.85
    outer = [(0.0, 0.30, depth), (0.06, 0.30, depth), (0.24, 0.12, chimney), (top, 0.12, chimney)]
    inner = [*outer[:-1], (top - SHEET_M, 0.12, chimney)]
    levels = [(y, (-half + SHEET_M, half - SHEET_M), (SHEET_M, front - SHEET_M)) for y, half, front in inner[::-1]]
    levels += [(y, (-half, half), (0.0, front)) for y, half, front in outer]
    slat = box("dark_steel", (-0.27, 0.27), (0.008, 0.014), (-0.008, 0.008))
    lamp = cylinder("warm_light", 0.03, (0.010, 0.014))
    button = cylinder("black_plastic", 0.009, (0.0, 0.006), 10)
    return [
        stacked("brushed_steel", levels),
        box("dark_steel", (-0.299, 0.299), (0.014, 0.020), (0.001, 0.479)),
        *at_each(slat, (0.0,), (0.06 + 0.03 * i for i in range(9))),
        *at_each(lamp, (-0.2, 0.2), (0.40,)),
        *(part.moved(x=x, y=0.03, z=depth) for x in (-0.05, 0.0, 0.05) for part in facing_front(button)),
    ]


def smartphone() -> list[Part]:
    """A 6.1-inch phone that lies on its back, with a screen full of icons."""
    colours = ("app_green", "app_orange", "app_blue")
    icon = {colour: box(colour, (-0.0055, 0.0055), (0.0082, 0.0084), (-0.0055, 0.0055)) for colour in colours}
    grid = [(row, column) for row in range(6) for column in range(4) if row != 4]
    icons = [icon[colours[(2 * r + c) % 3]].moved(x=0.0156 * c - 0.0234, z=0.0195 * r - 0.048) for r, c in grid]
    return [
        rounded("dark_steel", (-0.0355, 0.0355), (0.0, 0.0078), (-0.0735, 0.0735), 0.010),
        rounded("black_glass", (-0.0335, 0.0335), (0.0078, 0.0082), (-0.0715, 0.0715), 0.008),
        *icons,
        box("dark_steel", (0.0355, 0.0362), (0.003, 0.006), (-0.030, -0.012)),
    ]


def electric_toothbrush() -> list[Part]:
    """A toothbrush that stands on its charger, its bristles to the front."""
    charger = [(0.0, 0.0), (0.030, 0.0), (0.032, 0.008), (0.026, 0.018), (0.0, 0.020)]
    handle = [(0.0, 0.020), (0.0130, 0.020), (0.0145, 0.060), (0.0145, 0.150), (0.0095, 0.178), (0.0, 0.180)]
    neck = [(0.0, 0.180), (0.0065, 0.180), (0.0036, 0.200), (0.0032, 0.236), (0.0, 0.238)]
    tuft = box("white_plastic", (-0.0022, 0.0022), (-0.0022, 0.0022), (0.003, 0.013))
    tufts = [tuft.moved(x=x, y=y) for x in (-0.0035, 0.0035) for y in (0.232, 0.239, 0.246)]
    return [
        lathe("white_plastic", charger),
        lathe("white_plastic", handle),
        ring("mint_rubber", 0.0140, 0.0155, (0.060, 0.140)),
        *(part.moved(y=0.115, z=0.0150) for part in facing_front(cylinder("white_plastic", 0.006, (0.0, 0.0025), 12))),
        lathe("mint_rubber", neck, 12),
        *(part.moved(y=0.239) for part in facing_front(rounded("mint_rubber", *_HEAD, 0.006))),
        *tufts,
    ]


def handheld_fan() -> list[Part]:
    """A fan of 130 mm on a handle that stands on its own foot; five blades behind a wire guard."""
    handle = [(0.0, 0.0), (0.045, 0.0), (0.045, 0.008), (0.020, 0.022), (0.0150, 0.045), (0.0170, 0.110)]
    handle += [(0.0135, 0.130), (0.0100, 0.145), (0.0, 0.145)]
    guard = _guard()
    back = [part.turned("y", 180) for part in guard]
    hub = facing_front(lathe("white_plastic", [(0.0, -0.012), (0.013, -0.012), (0.013, 0.010), (0.0, 0.014)], 16))
    motor = facing_front(cylinder("coral_plastic", 0.016, (-0.026, -0.012)))
    blades = [_blade().turned("z", 72 * i) for i in range(5)]
    rim = facing_front(ring("coral_plastic", 0.0625, 0.0650, (-0.014, 0.014), 20))
    return [
        lathe("coral_plastic", handle),
        *(part.moved(y=0.095, z=0.0155) for part in facing_front(cylinder("white_plastic", 0.007, (0.0, 0.003), 12))),
        *(part.moved(y=0.209) for part in (*rim, *guard, *back, *hub, *motor, *blades)),
    ]


def _knob(colour: str, radius: float) -> list[Part]:
    grip = box("dark_steel", (-0.002, 0.002), (0.2 * radius, 0.8 * radius), (0.020, 0.022))
    return [*facing_front(lathe(colour, [(radius, 0.0), (radius, 0.015), (0.8 * radius, 0.020)])), grip]


def _guard() -> list[Part]:
    """The wires in front of the blades: rings and spokes on a shallow dome."""
    rings = facing_front(*(ring("white_plastic", r - 0.0012, r, (y - 0.0006, y + 0.0006)) for r, y in _DOME))
    spoke = tube("white_plastic", [(r, 0.0, y) for r, y in ((0.0635, 0.012), *_DOME)], 0.0008, 4)
    cap = facing_front(lathe("coral_plastic", [(0.014, 0.018), (0.014, 0.022), (0.0, 0.024)], 16))
    return [*rings, *(spoke.turned("z", 36 * i) for i in range(10)), *cap]


def _blade() -> Part:
    """One blade along +X, twisted and wider towards its tip: (radius, chord, pitch)."""
    return loft("sky_plastic", [_section(*at) for at in ((0.011, 0.012, 50), (0.030, 0.026, 38), (0.056, 0.030, 28))])


def _section(radius: float, chord: float, pitch_deg: float) -> Array:
    along = np.array((0.0, cos(radians(pitch_deg)), sin(radians(pitch_deg)))) * chord / 2
    across = np.array((0.0, -sin(radians(pitch_deg)), cos(radians(pitch_deg)))) * 0.0005
    corners: Array = np.stack([along + across, across - along, -along - across, along - across])
    corners[:, 0] = radius
    return corners
