"""Tell what each object of a scene is, how it vibrates, and write the bundle.

Without settings it works offline: a lexicon of everyday objects reads the authored names, and a synthesizer makes the
sounds. A settings file (TOML or JSON) with a table [bake] chooses other parts.
"""

from __future__ import annotations

import argparse
from typing import Any

from scene2hap.baking import BakeConfig, bake
from scene2hap.cli.console import Console
from scene2hap.cli.settings import read_settings
from scene2hap.cli.tables import bundle_outcome, show_bundle
from scene2hap.scene.capture import capture_images
from scene2hap.scene.load import load_scene
from scene2hap.scene.snapshot import SceneSnapshot

HELP = "scene file -> haptic bundle"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``scene2hap bake``."""
    parser.add_argument("scene", metavar="SCENE", help="glTF, GLB, OBJ, STL, PLY, COLLADA, MJCF, or scene JSON")
    parser.add_argument("-o", "--output", metavar="BUNDLE", required=True, help="folder to write")
    parser.add_argument("--prompt", default="", help="what you want told to the model; it outranks everything else")
    parser.add_argument("--pictures", action="store_true", help="show the model pictures (extra `pictures`)")
    parser.add_argument("--sounds", metavar="FOLDER", help="your own sounds, tried before the synthesizer")
    parser.add_argument("--settings", metavar="FILE", help="TOML or JSON with a table [bake]")
    add_scene_arguments(parser)


def add_scene_arguments(parser: argparse.ArgumentParser) -> None:
    """How to read a scene file that does not say everything about itself."""
    parser.add_argument("--unit-m", type=float, metavar="METRES", help="length of the file's unit, if it lies")
    parser.add_argument("--assets-root", metavar="FOLDER", help="what the scene may read, if not its own folder alone")
    parser.add_argument("--up-axis", choices=("y", "z"), help="the file's up axis, if not its format's")
    parser.add_argument(
        "--group", default="authored", metavar="RULE", help="authored (default), leaf, or a depth in the node tree"
    )


def read_scene(arguments: argparse.Namespace) -> SceneSnapshot:
    """The scene that the arguments name."""
    group: Any = int(arguments.group) if arguments.group.isdigit() else arguments.group
    return load_scene(
        arguments.scene,
        up_axis=arguments.up_axis,
        unit_m=arguments.unit_m,
        group=group,
        assets_root=arguments.assets_root,
    )


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Bake, save, and show what was inferred."""
    settings = read_settings(arguments.settings, "bake")
    if arguments.sounds:
        settings["audio"] = [{"kind": "library", "folder": arguments.sounds}, settings.get("audio", "synth")]
    config = BakeConfig.parse(settings)
    with console.progress() as tell:
        tell("reading", arguments.scene, 0, 1)
        scene = read_scene(arguments)
        tell("reading", arguments.scene, 1, 1)
        if arguments.pictures:
            scene = capture_images(scene)
        bundle = bake(scene, config, user_prompt=arguments.prompt, progress=tell)
    folder = bundle.save(arguments.output)
    show_bundle(console, bundle)
    console.say(f"wrote {folder}")
    return {"bundle": str(folder), **bundle_outcome(bundle)}
