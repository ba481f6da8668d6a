"""Build the demo's kitchen: seven objects that vibrate among usual objects of a kitchen, in metres, Y up::

    python examples/build_demo_kitchen.py [-o PATH]

It follows the third study of the Scene2Hap paper and has its handheld fan, electric toothbrush, smartphone, washing
machine, refrigerator, cooker hood and microwave. Every object touches its supports without a gap.

The script always writes the same bytes, so that the committed file can be compared with them. The world's origin is
the corner of the room, on the ground: x runs along the back wall, z into the room.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from demo_kitchen import appliances, furniture, glb, tableware
from demo_kitchen.glb import Colour
from demo_kitchen.shapes import Part, Point
from numpy.typing import NDArray
from trimesh.triangles import closest_point

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]
"""Vertices (n, 3) [m] in the world, and triangles (m, 3)."""

DEFAULT_PATH = Path(__file__).parents[1] / "scene2hap" / "demo" / "kitchen.glb"
MAX_BYTES = 500_000
TOUCH_M = 1e-6
"""Largest gap that counts as touching: coordinates are rounded to the micrometre."""


@dataclass(frozen=True)
class Thing:
    """One object: name, description, material, supports that it rests on or hangs from, pivot, shape and turn."""

    name: str
    what: str
    material: str
    support: str | tuple[str, ...]
    at: Point
    shape: Sequence[Part]
    yaw_deg: float = 0.0

    @property
    def supports(self) -> tuple[str, ...]:
        """Names of all supports."""
        return (self.support,) if isinstance(self.support, str) else self.support

    @property
    def node(self) -> glb.Node:
        """The object as a node of the file."""
        return glb.Node(self.name, self.shape, self.at, self.yaw_deg)


GROUND = 0.0
BASE = furniture.BASE_HEIGHT_M
WORKTOP = BASE + furniture.WORKTOP_THICKNESS_M
TABLE = furniture.TABLE_HEIGHT_M
SHELF = 1.40
SILL = 1.00
WASHER = 0.85

# fmt: off
KITCHEN = (
    # The room.
    Thing("floor", "tiled slab", "concrete", (),
          (2.30, GROUND, 1.55), furniture.floor(4.8, 3.3)),
    Thing("back_wall", "wall of 100 mm", "brick", "floor",
          (2.30, GROUND, 0.00), furniture.back_wall(4.8)),
    Thing("left_wall", "wall of 100 mm with an opening", "brick", "floor",
          (0.00, GROUND, 1.60), furniture.left_wall(3.2, (SILL, 2.10), (-0.30, 0.90))),
    Thing("window", "window with two panes", "glass", ("left_wall", "window_sill"),
          (0.00, SILL, 1.90), furniture.window(1.10, 1.20)),
    Thing("window_sill", "board below the window", "marble", "left_wall",
          (0.00, SILL, 1.90), furniture.window_sill(1.30)),
    Thing("wall_lamp", "lamp on a bent arm", "brass", "left_wall",
          (0.00, 1.65, 2.85), furniture.wall_lamp()),
    Thing("rug", "flat woven rug", "carpet", "floor",
          (1.30, GROUND, 1.05), furniture.rug()),
    Thing("waste_bin", "round pedal bin", "steel", "floor",
          (0.38, GROUND, 1.05), furniture.waste_bin()),

    # Along the back wall: cabinets, the worktop on them, objects set into it, objects above.
    Thing("sink_cabinet", "base cabinet", "particle board", ("floor", "back_wall"),
          (1.20, GROUND, 0.00), furniture.base_cabinet(0.80)),
    Thing("drawer_unit", "base cabinet with four drawers", "particle board", ("floor", "sink_cabinet"),
          (1.90, GROUND, 0.00), furniture.drawer_unit(0.60)),
    Thing("base_cabinet_1", "base cabinet", "particle board", ("floor", "drawer_unit"),
          (2.60, GROUND, 0.00), furniture.base_cabinet(0.80)),
    Thing("base_cabinet_2", "base cabinet", "particle board", ("floor", "base_cabinet_1"),
          (3.40, GROUND, 0.00), furniture.base_cabinet(0.80)),
    Thing("worktop", "board of 3 m", "oak", ("sink_cabinet", "drawer_unit", "base_cabinet_1", "base_cabinet_2"),
          (2.30, BASE, 0.00), furniture.worktop(3.0, (-1.35, -0.85), (0.18, 0.50))),
    Thing("sink", "basin in the worktop's hole", "stainless steel", "worktop",
          (1.20, WORKTOP, 0.34), tableware.sink()),
    Thing("tap", "mixer tap", "brass", "worktop",
          (1.20, WORKTOP, 0.076), tableware.tap()),
    Thing("wall_cabinet_1", "cabinet with two doors", "particle board", "back_wall",
          (1.35, 1.45, 0.00), furniture.wall_cabinet(0.80)),
    Thing("wall_cabinet_2", "cabinet with two doors", "particle board", "back_wall",
          (3.25, 1.45, 0.00), furniture.wall_cabinet(0.80)),
    Thing("open_shelf", "board on two brackets", "oak", "back_wall",
          (4.20, SHELF, 0.00), furniture.open_shelf(0.90)),

    # Objects that vibrate.
    Thing("refrigerator", "fridge with a freezer", "steel", "floor",
          (0.38, GROUND, 0.06), appliances.refrigerator()),
    Thing("cooker_hood", "hood with a chimney", "stainless steel", "back_wall",
          (2.30, 1.50, 0.00), appliances.cooker_hood()),
    Thing("microwave", "microwave oven", "steel", "worktop",
          (3.47, WORKTOP, 0.26), appliances.microwave()),
    Thing("washing_machine", "front loader", "steel", "floor",
          (4.20, GROUND, 0.36), appliances.washing_machine()),
    Thing("electric_toothbrush", "toothbrush on its charger", "abs", "open_shelf",
          (3.92, SHELF, 0.12), appliances.electric_toothbrush(), 15),
    Thing("smartphone", "phone on its back", "glass", "dining_table",
          (2.04, TABLE, 2.20), appliances.smartphone(), 20),
    Thing("handheld_fan", "fan standing on its foot", "abs", "dining_table",
          (3.05, TABLE, 2.36), appliances.handheld_fan(), 25),

    # Tables and chairs.
    Thing("dining_table", "table with a top of 27 mm", "oak", "floor",
          (2.60, GROUND, 2.20), furniture.dining_table(1.60, 0.85)),
    Thing("chair_1", "chair", "beech", "floor",
          (2.20, GROUND, 2.74), furniture.chair(), 172),
    Thing("chair_2", "chair", "beech", "floor",
          (2.95, GROUND, 1.64), furniture.chair(), -8),
    Thing("chair_3", "chair", "beech", "floor",
          (3.62, GROUND, 2.24), furniture.chair(), -75),
    Thing("stool", "round stool", "birch", "floor",
          (0.65, GROUND, 2.60), furniture.stool(), 20),

    # Small objects. The front of the worktop stays free between the cutting board and the microwave.
    Thing("cutting_board", "chopping board", "maple", "worktop",
          (1.68, WORKTOP, 0.38), tableware.cutting_board(), -90),
    Thing("knife_block", "block with five knives", "walnut", "worktop",
          (1.90, WORKTOP, 0.15), tableware.knife_block()),
    Thing("saucepan", "pan with a lid", "stainless steel", "worktop",
          (2.12, WORKTOP, 0.17), tableware.saucepan(), 12),
    Thing("frying_pan", "shallow pan", "cast iron", "worktop",
          (2.58, WORKTOP, 0.20), tableware.frying_pan(), 15),
    Thing("olive_oil_bottle", "bottle with a pourer", "glass", "worktop",
          (3.02, WORKTOP, 0.10), tableware.olive_oil_bottle()),
    Thing("spice_jar_1", "jar of paprika", "glass", "open_shelf",
          (4.28, SHELF, 0.11), tableware.spice_jar("paprika")),
    Thing("spice_jar_2", "jar of turmeric", "glass", "open_shelf",
          (4.38, SHELF, 0.11), tableware.spice_jar("turmeric")),
    Thing("tea_towel", "folded towel", "cotton", "washing_machine",
          (4.08, WASHER, 0.34), tableware.tea_towel(), -12),
    Thing("herb_pot", "basil in a clay pot", "terracotta", "window_sill",
          (0.11, SILL, 2.30), tableware.herb_pot()),
    Thing("fruit_bowl", "bowl with apples and oranges", "ceramic", "dining_table",
          (2.60, TABLE, 2.20), tableware.fruit_bowl()),
    Thing("plate_1", "dinner plate", "porcelain", "dining_table",
          (2.30, TABLE, 2.46), tableware.plate()),
    Thing("plate_2", "dinner plate", "porcelain", "dining_table",
          (2.93, TABLE, 1.93), tableware.plate()),
    Thing("cup_1", "mug", "ceramic", "dining_table",
          (2.55, TABLE, 2.48), tableware.cup("blue_stoneware"), 40),
    Thing("cup_2", "mug", "ceramic", "dining_table",
          (2.68, TABLE, 1.90), tableware.cup("mustard_stoneware"), 150),
    Thing("cookbook", "closed hardback", "paper", "dining_table",
          (2.12, TABLE, 1.94), tableware.cookbook(), -15),
)

PALETTE = {
    "stone_tiles": Colour((0.55, 0.52, 0.47)), "warm_plaster": Colour((0.86, 0.82, 0.74)),
    "white_lacquer": Colour((0.88, 0.88, 0.86), roughness=0.4), "sage_lacquer": Colour((0.36, 0.47, 0.39)),
    "oak": Colour((0.56, 0.36, 0.18)), "beech": Colour((0.68, 0.46, 0.27)), "birch": Colour((0.76, 0.60, 0.39)),
    "maple": Colour((0.78, 0.58, 0.34)), "walnut": Colour((0.22, 0.12, 0.06)),
    "marble": Colour((0.80, 0.79, 0.77), roughness=0.3), "terracotta": Colour((0.60, 0.25, 0.13)),
    "brushed_steel": Colour((0.60, 0.61, 0.63), metallic=0.9, roughness=0.4),
    "light_steel": Colour((0.74, 0.76, 0.78), metallic=0.6, roughness=0.4),
    "dark_steel": Colour((0.22, 0.23, 0.25), metallic=0.8, roughness=0.5),
    "black_steel": Colour((0.05, 0.05, 0.06), metallic=0.6, roughness=0.5),
    "chrome": Colour((0.78, 0.79, 0.80), metallic=1.0, roughness=0.15),
    "brass": Colour((0.72, 0.52, 0.22), metallic=1.0, roughness=0.3),
    "cast_iron": Colour((0.07, 0.07, 0.08), metallic=0.7, roughness=0.7),
    "white_enamel": Colour((0.90, 0.90, 0.91), roughness=0.3), "black_glass": Colour((0.02, 0.02, 0.03), roughness=0.1),
    "window_glass": Colour((0.62, 0.80, 0.92), roughness=0.1), "green_glass": Colour((0.12, 0.22, 0.05), roughness=0.1),
    "black_plastic": Colour((0.04, 0.04, 0.05)), "light_grey_plastic": Colour((0.62, 0.63, 0.65)),
    "white_plastic": Colour((0.90, 0.90, 0.89)), "coral_plastic": Colour((0.85, 0.30, 0.24)),
    "sky_plastic": Colour((0.22, 0.52, 0.78)), "mint_rubber": Colour((0.20, 0.64, 0.56)),
    "black_rubber": Colour((0.03, 0.03, 0.03)), "green_display": Colour((0.25, 0.85, 0.45)),
    "app_green": Colour((0.20, 0.72, 0.32)), "app_orange": Colour((0.95, 0.50, 0.12)),
    "app_blue": Colour((0.16, 0.45, 0.90)), "warm_light": Colour((1.0, 0.92, 0.72)),
    "linen": Colour((0.84, 0.76, 0.60)), "blue_fabric": Colour((0.16, 0.26, 0.42)),
    "grey_wool": Colour((0.24, 0.29, 0.34)), "red_wool": Colour((0.56, 0.12, 0.10)),
    "white_cotton": Colour((0.88, 0.87, 0.83)), "white_porcelain": Colour((0.92, 0.92, 0.90), roughness=0.2),
    "blue_stoneware": Colour((0.18, 0.30, 0.50)), "mustard_stoneware": Colour((0.72, 0.48, 0.10)),
    "paper": Colour((0.86, 0.83, 0.74)), "book_red": Colour((0.58, 0.10, 0.10)), "soil": Colour((0.10, 0.06, 0.04)),
    "leaf_green": Colour((0.12, 0.42, 0.10)), "apple_red": Colour((0.68, 0.07, 0.06)),
    "orange": Colour((0.90, 0.42, 0.05)), "paprika": Colour((0.60, 0.12, 0.03)), "turmeric": Colour((0.85, 0.55, 0.05)),
}
# fmt: on


def main(argv: Sequence[str] | None = None) -> int:
    """Build, check and write the kitchen. Returns 1 if the check finds a problem."""
    parser = argparse.ArgumentParser(description="Build the kitchen of scene2hap's demo.")
    parser.add_argument("-o", "--output", type=Path, default=DEFAULT_PATH, help="the .glb file to write")
    path: Path = parser.parse_args(argv).output
    content = glb.encode("kitchen", [thing.node for thing in KITCHEN], PALETTE)
    problems = [*check(KITCHEN), *([f"{len(content)} bytes, at most {MAX_BYTES}"] if len(content) > MAX_BYTES else [])]
    if problems:
        print(*problems, sep="\n", file=sys.stderr)
        return 1
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    print(f"{path}: {len(KITCHEN)} objects, {len(content) / 1000:.0f} kB")
    return 0


def check(things: Sequence[Thing]) -> list[str]:
    """Problems of a kitchen: names used twice, supports that are missing or not touched."""
    problems = [f"{name}: used {n} times" for name, n in Counter(thing.name for thing in things).items() if n > 1]
    meshes = {thing.name: thing.node.to_world() for thing in things}
    for thing in things:
        for support in thing.supports:
            if support not in meshes:
                problems.append(f"{thing.name}: no support {support!r}")
            elif not touch(meshes[thing.name], meshes[support]):
                problems.append(f"{thing.name}: does not touch {support} to {TOUCH_M} m")
    return problems


def touch(one: Mesh, other: Mesh) -> bool:
    """Whether a corner of either mesh lies on a face of the other, as with objects that stand, lie or hang flat."""
    return _corner_on_face(one, other) or _corner_on_face(other, one)


def _corner_on_face(corners_of: Mesh, faces_of: Mesh) -> bool:
    corners, triangles = corners_of[0][:, None], faces_of[0][faces_of[1]]
    in_box = (corners >= triangles.min(axis=1) - TOUCH_M) & (corners <= triangles.max(axis=1) + TOUCH_M)
    corner, triangle = np.nonzero(in_box.all(axis=-1))
    feet = closest_point(triangles[triangle], corners[corner, 0])
    return bool((np.linalg.norm(feet - corners[corner, 0], axis=1) <= TOUCH_M).any())


if __name__ == "__main__":
    raise SystemExit(main())
