"""Show what is in a scene file or a bundle."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from scene2hap.bundle import HapticBundle
from scene2hap.cli.bake import add_scene_arguments, read_scene
from scene2hap.cli.console import Console
from scene2hap.cli.tables import bundle_outcome, scene_outcome, show_bundle, show_scene

HELP = "tables of a scene or a bundle"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``scene2hap inspect``."""
    parser.add_argument("scene", metavar="SCENE|BUNDLE", help="scene file or bundle folder")
    add_scene_arguments(parser)


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Show a folder as a bundle, anything else as a scene."""
    if Path(arguments.scene).is_dir():
        bundle = HapticBundle.load(arguments.scene)
        show_scene(console, bundle.snapshot)
        show_bundle(console, bundle)
        return {**scene_outcome(bundle.snapshot), **bundle_outcome(bundle)}
    scene = read_scene(arguments)
    show_scene(console, scene)
    return scene_outcome(scene)
