"""Options of the commands that read scene files."""

from __future__ import annotations

import argparse
from typing import Any

from scene2hap.scene.load import load_scene
from scene2hap.scene.snapshot import SceneSnapshot

SCENE_ARGUMENTS = ("unit_m", "assets_root", "names", "up_axis", "group")
"""See `add_scene_arguments`."""


def add_scene_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments for scene files with missing or wrong information."""
    parser.add_argument(
        "--unit-m", type=float, metavar="METRES", help="metres per unit of the file, overriding its own"
    )
    parser.add_argument(
        "--assets-root", metavar="FOLDER", help="folder from which the file may read; default: its own folder"
    )
    parser.add_argument(
        "--names", metavar="FILE", help="CSV or JSON with names of templates, for Habitat scenes that name them by hash"
    )
    parser.add_argument(
        "--up-axis", metavar="AXIS", choices=("y", "z"), help="y or z, overriding the axis of the file's format"
    )
    parser.add_argument(
        "--group",
        metavar="RULE",
        help="authored (default), leaf, loose, or a depth in the node tree (0: one object)",
    )


def read_scene(arguments: argparse.Namespace) -> SceneSnapshot:
    """Read the scene file in the arguments."""
    return load_scene(arguments.scene, **scene_options(arguments))


def scene_options(arguments: argparse.Namespace) -> dict[str, Any]:
    """Return the arguments of `load_scene` except the path."""
    group = arguments.group or "authored"
    is_depth = group.isascii() and group.isdigit() and len(group) < 10
    return {
        "up_axis": arguments.up_axis,
        "unit_m": arguments.unit_m,
        "group": int(group) if is_depth else group,
        "assets_root": arguments.assets_root,
        **({"names": arguments.names} if arguments.names else {}),
    }
