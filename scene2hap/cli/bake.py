"""Infer the category, material and vibration of each object of a scene, and write the bundle.

Without settings it works offline: a lexicon of everyday objects reads the authored names, and a synthesizer makes the
sounds. `--llm openai:gpt-4o` or `--llm local:qwen2.5vl` uses a model that sees pictures. A settings file (TOML or JSON)
with a table [bake] chooses all other parts. Overrides in a bundle are kept when it is baked again. The bundle that a
bake replaces is kept in BUNDLE.before; `scene2hap edit BUNDLE undo` restores it. BUNDLE.account.json has calls, tokens,
cost and skipped questions, for `scene2hap report`.
"""

from __future__ import annotations

import argparse
import asyncio
from pathlib import Path
from typing import Any

from scene2hap.baking import BakeConfig, bake
from scene2hap.baking.bundle_before import bundle_before, readable_bundle
from scene2hap.baking.questions import count_questions
from scene2hap.bundle.account import write_account
from scene2hap.bundle.differences import differ
from scene2hap.bundle.folder_replacement import require_replaceable, save_stamp
from scene2hap.bundle.history import require_steps, step_beside
from scene2hap.bundle.overrides_file import read_overrides
from scene2hap.bundle.writing import write_bundle, write_edited
from scene2hap.cli.console import Console
from scene2hap.cli.scene_options import add_scene_arguments, read_scene
from scene2hap.cli.shared_options import add_backend_arguments, add_loop_arguments, backend_settings, loop_settings
from scene2hap.cli.tables import bundle_outcome, show_bundle, show_report
from scene2hap.errors import BundleChanged, BundleError, ConfigError
from scene2hap.llm.chain.report import InferenceReport
from scene2hap.llm.wrappers import is_remote
from scene2hap.llm.wrappers.prices import price_list
from scene2hap.scene.capture import capture_images
from scene2hap.scene.capture.given_pictures import GivenPictures
from scene2hap.scene.snapshot import SceneSnapshot


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap bake``."""
    kinds = "glTF, GLB, OBJ, STL, PLY, COLLADA, USD, URDF, MJCF, Habitat, scene JSON"
    parser.add_argument("scene", metavar="SCENE", help=kinds)
    parser.add_argument("-o", "--output", metavar="BUNDLE", help="folder to write (not needed with --dry-run)")
    parser.add_argument("--dry-run", action="store_true", help="show calls, tokens and cost only; no model is called")
    parser.add_argument("--pictures-from", metavar="FOLDER", help="pictures that an engine or Blender rendered")
    add_model_arguments(parser)
    add_scene_arguments(parser)


def add_model_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that choose the model, its pictures and the sound sources."""
    add_backend_arguments(parser)
    parser.add_argument(
        "--pictures",
        action=argparse.BooleanOptionalAction,
        help="show pictures to the model (extra `pictures`); default for models with a network address",
    )
    parser.add_argument("--sounds", metavar="FOLDER", help="your own sounds, tried before the synthesizer")
    add_loop_arguments(parser)


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Bake, save, and show the result of the inference and its cost."""
    if arguments.output is None and not arguments.dry_run:
        raise ConfigError("no output folder. Name one with -o BUNDLE, or ask for --dry-run.")
    config = BakeConfig.parse(bake_settings(arguments))
    if arguments.dry_run:
        return _dry_run(arguments, config, console)
    accounts: list[InferenceReport] = []
    while True:
        try:
            return _bake_once(arguments, config, console, accounts)
        except BundleChanged:  # by another process; the cache has the answers of a model
            console.say(f"{arguments.output} was edited in the meantime; baking again, with the edit")


def _bake_once(
    arguments: argparse.Namespace, config: BakeConfig, console: Console, accounts: list[InferenceReport]
) -> dict[str, Any]:
    """Bake and save. `accounts` has the reports of the runs before, and gets that of this one.

    Raises: BundleChanged: the bundle was saved by another process in the meantime; and as `bake`.
    """
    target = Path(arguments.output)
    read = save_stamp(target)
    overrides = read_overrides(target)
    require_replaceable(target)  # check before the model costs money
    before, unreadable = readable_bundle(target)
    if read is not None:
        require_steps(target)
    with console.progress() as tell:
        tell("reading", arguments.scene, 0, 1)
        scene = read_scene(arguments)
        tell("reading", arguments.scene, 1, 1)
        bundle = bake(
            _with_pictures(scene, arguments, config),
            config,
            user_prompt=arguments.prompt,
            progress=tell,
            on_report=accounts.append,
            overrides=overrides,
            earlier=before or bundle_before(target, overrides),
        )
    kept = read is not None and (before is None or differ(before, bundle))
    folder = write_edited(bundle, target, before, read) if kept else write_bundle(bundle, target, read)
    account = accounts.pop()
    for earlier in accounts:
        account.add_answers_of(earlier)
    try:
        write_account(folder, {**account.as_json(), "cost_usd": account.cost_usd(price_list(config.prices))})
    except BundleError as problem:  # the bundle is whole without its account
        console.warn(str(problem))
    show_bundle(console, bundle)
    show_report(console, account, config.prices)
    console.say(f"wrote {folder}")
    if kept:
        restored = unreadable if before is None else f"`scene2hap edit {folder} undo` restores it"
        console.say(f"the bundle before is in {step_beside(folder, 'before')}; {restored}")
    return {"bundle": str(folder), **bundle_outcome(bundle), "inference": account.as_json()}


def bake_settings(arguments: argparse.Namespace) -> dict[str, Any]:
    """Return the settings of a bake: those of the file, overridden by the arguments. Raises: ConfigError."""
    settings = {**backend_settings(arguments), **loop_settings(arguments)}
    if arguments.sounds:
        given = settings.get("audio", "synth")
        others = given if isinstance(given, list) else [given]
        settings["audio"] = [{"kind": "library", "folder": arguments.sounds}, *others]
    return settings


def wants_pictures(arguments: argparse.Namespace, config: BakeConfig) -> bool:
    """Return True if the model is to see pictures: by default one with a network address."""
    return is_remote(config.llm) if arguments.pictures is None else bool(arguments.pictures)


def _with_pictures(scene: SceneSnapshot, arguments: argparse.Namespace, config: BakeConfig) -> SceneSnapshot:
    if arguments.pictures_from:
        return GivenPictures.load(arguments.pictures_from).attach_to(scene)
    return capture_images(scene) if wants_pictures(arguments, config) else scene


def _dry_run(arguments: argparse.Namespace, config: BakeConfig, console: Console) -> dict[str, Any]:
    if arguments.output is not None:
        require_replaceable(Path(arguments.output))  # as before a bake
    scene = _with_pictures(read_scene(arguments), arguments, config)
    estimate = asyncio.run(count_questions(scene, config, user_prompt=arguments.prompt))
    console.table(f"{scene.name}: questions of a bake", ("item", ">number"), estimate.rows())
    return estimate.as_json()
