"""Show the content of a scene file or a bundle.

The first table has the dominant surface of each object: its length, width and thickness, and the height of the object's
lowest point above that of the scene. "measured" is "well", or the reason to look at a size again.
"thickness corrected" marks a thickness that a person has corrected in a bundle.

The table of a bundle has the inferred values. "sound Hz" is the strongest frequency of the sound, "vibration Hz" the
frequency at which the vibration is felt most, of a melody one of its notes: "80 from 98" was moved from 98 Hz, "rough
49" adds roughness at 49 Hz.
"edited" means that a person has changed the WAV file: frequency and level are those before. "felt dB" is the level over
the threshold of touch at the object itself. "17 of 22" is 17 dB where 22 dB were planned: the actuator or full scale
allows no more. "starts, stops s" are the times of start and stop.

Warnings name likely mistakes, such as objects that float.

--pictures writes the pictures that a multimodal model would see into a folder: a contact sheet per object, and a plan
of the scene with names. This needs the extra `pictures`.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import Any

from scene2hap.bundle import HapticBundle
from scene2hap.bundle.sounds import file_stems
from scene2hap.cli.console import Console
from scene2hap.cli.scene_options import SCENE_ARGUMENTS, add_scene_arguments, read_scene
from scene2hap.cli.shared_options import reject_unused
from scene2hap.cli.tables import bundle_outcome, scene_outcome, show_bundle, show_scene
from scene2hap.common.counted import counted
from scene2hap.common.files import require_place, write_whole
from scene2hap.common.printable import quoted
from scene2hap.errors import SceneError, unwritable
from scene2hap.scene.capture import (
    RENDERERS,
    CaptureConfig,
    capture_images,
    contact_sheet,
    plan_view,
    render_all,
)
from scene2hap.scene.snapshot import SceneSnapshot

PLAN = "plan.png"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap inspect``."""
    parser.add_argument("scene", metavar="SCENE|BUNDLE", help="scene file or bundle folder")
    parser.add_argument("--pictures", metavar="FOLDER", help="write contact sheets and a plan view as PNG")
    add_scene_arguments(parser)


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Show a folder as a bundle, and any other path as a scene."""
    if arguments.pictures:
        require_pictures(Path(arguments.pictures))
    if os.path.isdir(arguments.scene):
        reject_unused(
            arguments, SCENE_ARGUMENTS, f"{quoted(arguments.scene)} is a bundle. Bake its scene file again with it."
        )
        bundle = HapticBundle.load(arguments.scene)
        scene = bundle.snapshot
        outcome = {**scene_outcome(scene), **bundle_outcome(bundle)}
        show_scene(console, scene, bundle.overrides)
        show_bundle(console, bundle)
    else:
        scene = read_scene(arguments)
        outcome = scene_outcome(scene)
        show_scene(console, scene)
    # Units are left out: `load_scene` warns about them, and the units of a bundle were given or accepted before.
    outcome["warnings"] = [str(found) for found in scene.check() if found.kind != "units"]
    for warning in outcome["warnings"]:
        console.warn(warning)
    if arguments.pictures:
        outcome["pictures"] = write_pictures(scene, Path(arguments.pictures), console)
    return outcome


def require_pictures(folder: Path) -> None:
    """Check before any work that pictures can be rendered, and written.

    Raises: MissingExtra: the renderer is not installed; SceneError: the folder cannot be written.
    """
    try:
        require_place(folder / PLAN)
    except OSError as cause:
        raise SceneError(unwritable(folder, cause)) from cause
    RENDERERS.load(CaptureConfig().renderer)


def write_pictures(scene: SceneSnapshot, folder: Path, console: Console) -> list[str]:
    """Write a contact sheet per object and a plan of the scene as PNG files. Returns their paths.

    Raises: SceneError: the folder cannot be written.
    """
    pictured = capture_images(scene)
    written: list[str] = []

    def put(name: str, png: bytes) -> None:
        try:
            folder.mkdir(parents=True, exist_ok=True)
            write_whole(folder / name, png)
        except OSError as cause:
            raise SceneError(unwritable(folder / name, cause)) from cause
        written.append(str(folder / name))

    with console.progress() as tell:
        render_all(pictured, workers=os.cpu_count(), progress=lambda done, total: tell("pictures", "", done, total))
    put(PLAN, plan_view(pictured))
    stems = file_stems(item.id for item in pictured.objects)
    for item in pictured.objects:
        put(f"{stems[item.id]}.png", contact_sheet(item))
    console.say(f"wrote {counted(len(written), 'picture')} to {folder}")
    return written
