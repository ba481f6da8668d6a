"""Furniture as MJCF: bodies with joints in files that include each other, with meshes in folders beside the main file.

`write_furniture` uses the layout of robot kitchen kits: `kitchen/kitchen.xml` includes files from other folders, so
that it needs the folder above as its root; `dishwasher.xml` holds one machine. Z is up, lengths are in metres. Visible
geoms do not collide; colliding geoms are larger.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rooms.room import Triple, cuboid, joined
from scene2hap import TriMesh

IDS = {
    "kitchen/kitchen.xml": (
        "counter",
        "dishwasher",
        "top_rack",
        "door",
        "kettleroot",
        *(f"knob {i}" for i in range(4)),
    ),
    "dishwasher.xml": ("dishwasher", "top_rack", "door"),
}
"""The ids of each file: its bodies with geoms. The body `kettle` contains only the body `kettleroot`."""

COUNTER_BOUNDS_M = ((0.7, -0.32, 0.0), (2.1, 0.32, 0.9))
"""Bounds of the counter: a base of 0.86 m and a top of 40 mm."""

_WALL = 0.02
_TUB = joined(  # open to the front (y < 0), 0.6 m x 0.6 m x 0.8 m, with two rails for the rack
    *(cuboid((0.6, 0.6, _WALL), (0.0, 0.0, z)) for z in (_WALL / 2, 0.8 - _WALL / 2)),
    *(cuboid((_WALL, 0.6, 0.8 - 2 * _WALL), (x, 0.0, 0.4)) for x in (-0.29, 0.29)),
    cuboid((0.6 - 2 * _WALL, _WALL, 0.8 - 2 * _WALL), (0.0, 0.29, 0.4)),
    *(cuboid((0.04, 0.56, _WALL), (x, 0.0, 0.45)) for x in (-0.26, 0.26)),
)
_RACK = joined(
    cuboid((0.54, 0.5, 0.01), (0.0, 0.0, 0.005)),
    *(cuboid((0.54, 0.01, 0.1), (0.0, y, 0.06)) for y in (-0.245, 0.245)),
)
_ASSETS = """<mujocoinclude><asset>
  <mesh name="tub" file="dishwasher/meshes/tub.obj"/>
  <mesh name="rack" file="dishwasher/meshes/rack.obj"/>
</asset></mujocoinclude>"""
_SEEN = '<default><default class="seen"><geom contype="0" conaffinity="0"/></default></default>'
_DISHWASHER = """<mujocoinclude><body name="dishwasher" pos="0 0 0">
  <geom class="seen" type="mesh" mesh="tub"/>
  <geom type="box" size="0.4 0.4 0.5" pos="0 0 0.4"/>
  <body name="top_rack" pos="0 0 0.46">
    <inertial pos="0 0 0" mass="2" diaginertia="1 1 1"/>
    <joint name="top_rack" type="slide" axis="0 -1 0" limited="true" range="0 0.25" damping="0.01"/>
    <geom class="seen" type="mesh" mesh="rack"/>
  </body>
  <body name="door" pos="0 -0.3 0.02">
    <inertial pos="0 0 0.4" mass="2" diaginertia="1 1 1"/>
    <joint name="door" axis="1 0 0" limited="true" range="0 1.5" frictionloss="100"/>
    <geom class="seen" type="box" size="0.3 0.01 0.38" pos="0 -0.01 0.38"/>
  </body>
</body></mujocoinclude>"""
_KETTLE = """<mujocoinclude><body name="kettleroot">
  <geom class="seen" type="cylinder" size="0.08 0.1" pos="0 0 0.1"/>
  <geom class="seen" type="capsule" size="0.01 0.04" pos="0.1 0 0.12"/>
</body></mujocoinclude>"""
_COUNTER = """<mujocoinclude><body name="counter" pos="1.4 0 0">
  <geom class="seen" type="box" size="0.68 0.3 0.43" pos="0 0 0.43"/>
  <geom class="seen" type="box" size="0.7 0.32 0.02" pos="0 0 0.88"/>
  <geom type="box" size="0.9 0.5 0.6" pos="0 0 0.6"/>
</body></mujocoinclude>"""
_KNOB = '<geom class="seen" type="cylinder" size="0.02 0.01" euler="1.5708 0 0"/>'
_KNOBS = "".join(f'<body name="knob {i}" pos="{1.1 + 0.2 * i:g} -0.31 0.8">{_KNOB}</body>' for i in range(4))


def write_furniture(folder: Path) -> Path:
    """Write all files below a folder. Returns the folder, which is the root that the kitchen needs."""
    files = {
        "dishwasher/meshes/tub.obj": _obj(_TUB),
        "dishwasher/meshes/rack.obj": _obj(_RACK),
        "dishwasher/dishwasher_asset.xml": _ASSETS,
        "dishwasher/dishwasher_body.xml": _DISHWASHER,
        "kettle/kettle_body.xml": _KETTLE,
        "counter/counter_body.xml": _COUNTER,
        "dishwasher.xml": _model(
            ".", ["dishwasher/dishwasher_asset.xml"], [_include("dishwasher/dishwasher_body.xml")]
        ),
        "kitchen/kitchen.xml": _model(
            "..",
            ["../dishwasher/dishwasher_asset.xml"],
            [
                _include("../counter/counter_body.xml"),
                _include("../dishwasher/dishwasher_body.xml"),
                _KNOBS,
                f'<body name="kettle" pos="1.4 0 0.9">{_include("../kettle/kettle_body.xml")}</body>',
            ],
        ),
    }
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder


def _model(mesh_folder: str, assets: Sequence[str], bodies: Sequence[str]) -> str:
    return (
        f'<mujoco model="furniture"><compiler angle="radian" meshdir="{mesh_folder}"/>{_SEEN}'
        f"{''.join(map(_include, assets))}<worldbody>{''.join(bodies)}</worldbody></mujoco>"
    )


def _include(path: str) -> str:
    return f'<include file="{path}"/>'


def _obj(mesh: TriMesh) -> str:
    def rows(letter: str, table: Sequence[Triple]) -> str:
        return "".join(f"{letter} {a} {b} {c}\n" for a, b, c in table)

    return rows("v", mesh.vertices_m.tolist()) + rows("f", (mesh.faces + 1).tolist())
