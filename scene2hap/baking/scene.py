"""Bake a scene or an object into a bundle, and bake parts of a bundle again.

Inference names each object and its vibration. For each state of each vibrating object, a sound is found or synthesized.
The best candidate is chosen, looped and converted into a tactile signal.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from typing import Any

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.baking.config import BakeConfig
from scene2hap.baking.corrections import (
    apply_overrides,
    infer_corrected,
    overrides_of_scene,
    replace_vibration,
)
from scene2hap.baking.fingerprint import converter_settings
from scene2hap.baking.likely_mistakes import (
    all_have_fingerprints,
    warn_of_scene,
    warn_of_vain_corrections,
    warn_of_weak_loops,
)
from scene2hap.baking.loops import Progress, Remade, Sounds, make_loops
from scene2hap.baking.recorded_times import with_recorded_times
from scene2hap.baking.sound_choice import EarlierLoops
from scene2hap.bundle import HapticBundle, MadeWith, Override
from scene2hap.bundle.arguments import given_bundle
from scene2hap.bundle.edited_loops import is_edited
from scene2hap.bundle.override import NONE, answers_before
from scene2hap.bundle.pending_corrections import objects_without_states, renamed_objects
from scene2hap.common import checks
from scene2hap.common.calls import clear_call
from scene2hap.common.run_coroutine import run_waiting
from scene2hap.errors import ConfigError, SceneError
from scene2hap.haptics import ObjectHaptics
from scene2hap.llm.chain.report import InferenceReport
from scene2hap.scene import limits
from scene2hap.scene.arguments import given_scene
from scene2hap.scene.objects import SceneObject, UpAxis
from scene2hap.scene.snapshot import SceneSnapshot

OnReport = Callable[[InferenceReport], None]
OnRemade = Callable[[Remade], None]


@clear_call
def bake(
    scene: SceneSnapshot | str | os.PathLike[str],
    config: BakeConfig | Mapping[str, Any] | str | os.PathLike[str] | None = None,
    *,
    user_prompt: str = "",
    progress: Progress | None = None,
    on_report: OnReport | None = None,
    overrides: Mapping[str, Override] | None = None,
    earlier: HapticBundle | None = None,
) -> HapticBundle:
    """Infer each object's material and vibration, and make the loops of each source. Returns the bundle.

    In a notebook, where an event loop runs, write `bundle = await abake(scene)`.

    Parameters:
    scene : a snapshot, or the path of a scene file, which `load_scene` reads.
    config : a BakeConfig, its settings, or the path of a TOML or JSON file with a table `bake`.
    user_prompt : instruction to the model, with priority over all others.
    progress : called with stage, step, number done and total number.
    on_report : receives the report of the inference: calls, skipped calls, tokens, errors of single objects. Without
        it a BackendWarning names the first error.
    overrides : a person's corrections by id, for example of an earlier bundle; they replace inferred values.
    earlier : a bundle of this scene; the states and loops of objects that `overrides` lock are taken from it, and loops
        that a person edited by hand, unless they would now be made otherwise (with a warning).

    Raises: ConfigError; SceneError: more objects than a bundle may have (`scene.limits`); BackendError: inference
    failed; AudioError: no source has a sound for a vibrating object.
    """
    baking = abake(
        scene,
        config,
        user_prompt=user_prompt,
        progress=progress,
        on_report=on_report,
        overrides=overrides,
        earlier=earlier,
    )
    return run_waiting(baking, "abake(...)")


@clear_call
async def abake(
    scene: SceneSnapshot | str | os.PathLike[str],
    config: BakeConfig | Mapping[str, Any] | str | os.PathLike[str] | None = None,
    *,
    user_prompt: str = "",
    progress: Progress | None = None,
    on_report: OnReport | None = None,
    overrides: Mapping[str, Override] | None = None,
    earlier: HapticBundle | None = None,
) -> HapticBundle:
    """Bake a scene, awaitable; see `bake`."""
    scene = given_scene(scene)
    limits.at_most("the number of objects", len(scene.objects), "MAX_OBJECTS")  # else its bundle could not be loaded
    _require_callable(progress=progress, on_report=on_report)
    config = BakeConfig.parse(config)
    overrides = overrides_of_scene(overrides or {}, scene)
    inference = await infer_corrected(scene, config.llm, config, overrides, user_prompt=user_prompt, progress=progress)
    _give_report(inference.report, on_report)
    return await bake_inferred(scene, inference.scene_category, inference.objects, overrides, config, progress, earlier)


async def bake_inferred(
    scene: SceneSnapshot,
    scene_category: str,
    inferred: Mapping[str, ObjectHaptics],
    overrides: Mapping[str, Override],
    config: BakeConfig,
    progress: Progress | None = None,
    earlier: HapticBundle | None = None,
) -> HapticBundle:
    """Make the loops of an inferred scene. Returns its bundle, as `bake` after inference. Raises: AudioError."""
    before_bake, answers = EarlierLoops(), inferred
    if earlier is not None:
        locked = {key: states for key, states in earlier.loops.items() if overrides.get(key, NONE).locked}
        edited = {
            key: {name: loop for name, loop in states.items() if is_edited(loop)}
            for key, states in earlier.loops.items()
        }
        before_bake = EarlierLoops(edited | locked, earlier.choices, any_source=False)
        kept = {key: replace_vibration(inferred[key], earlier.objects[key]) for key in locked if key in inferred}
        inferred = {**inferred, **kept}
    objects, sounds = await _make_loops(scene, inferred, overrides, config, progress, before_bake, {})
    warn_of_scene(scene, objects)
    warn_of_vain_corrections(objects, overrides)
    before = answers_before(with_recorded_times(answers, sounds.loops, {}), overrides, {})
    return HapticBundle(
        scene, scene_category, objects, sounds.loops, overrides, sounds.choices, _made_with(config), before
    )


async def _make_loops(
    scene: SceneSnapshot,
    inferred: Mapping[str, ObjectHaptics],
    overrides: Mapping[str, Override],
    config: BakeConfig,
    progress: Progress | None,
    earlier: EarlierLoops,
    timed_by: Mapping[str, Mapping[str, HapticLoop]],
) -> tuple[dict[str, ObjectHaptics], Sounds]:
    """Return the corrected objects, with the times of recordings, and their loops.

    `timed_by` has the loops whose times the inferred objects have already. A person's corrections have priority.
    """
    objects = apply_overrides(inferred, overrides)
    names = {item.id: overrides.get(item.id, NONE).name or item.name for item in scene.objects}
    sounds = await make_loops(objects, overrides, config, progress, earlier, inferred, names)
    return apply_overrides(with_recorded_times(objects, sounds.loops, timed_by), overrides), sounds


@clear_call
def bake_object(
    item: SceneObject,
    config: BakeConfig | Mapping[str, Any] | None = None,
    *,
    up_axis: UpAxis = "y",
    user_prompt: str = "",
    override: Override | None = None,
) -> HapticBundle:
    """Bake one object without a scene: a prefab. `HapticSession.spawn` adds copies of it.

    The bundle has the id and pose of the original; each copy gets an id and pose of its own.
    Raises: as `bake`; SceneError: not an object.
    """
    if not isinstance(item, SceneObject):
        raise SceneError(f"item is {checks.described(item)}; it must be a SceneObject, as scene.object(id) gives.")
    overrides = None if override is None else {item.id: override}
    return bake(SceneSnapshot(item.name, up_axis, (item,)), config, user_prompt=user_prompt, overrides=overrides)


@clear_call
def rebake(
    bundle: HapticBundle | str | os.PathLike[str],
    config: BakeConfig | Mapping[str, Any] | str | os.PathLike[str] | None = None,
    *,
    objects: Collection[str] = (),
    corrections: str | os.PathLike[str] | None = None,
    user_prompt: str = "",
    progress: Progress | None = None,
    on_report: OnReport | None = None,
    on_remade: OnRemade | None = None,
) -> HapticBundle:
    """Bake some objects of a bundle again, and make every loop again whose inputs have changed.

    Inputs are the overrides, edits of `objects.json`, and the given settings. Settings of the loops that are not given
    (actuator, tactile, spread, seed) are taken from the bundle. The frequencies and levels of all sources are planned
    together, as by `bake`. A sound is chosen again only if its words changed, if `audio` or `enough_candidates` is
    given and differs, or if its object is in `objects`. Otherwise loops are made from the sound in the bundle.

    Parameters:
    bundle : a HapticBundle, or the path of its folder.
    objects : ids to infer again, with `user_prompt`; a cache answers repeated requests. A bundle has the names of
        objects and materials, but no pictures; a model that should see them needs `bake`.
    corrections : a file of corrections saved in a report's viewer; applied first, as by `HapticBundle.corrected`.
    on_remade : receives the loops that were made, by id and state, with the inputs that differed: "sound",
        "converter", "actuator", "intensity", "plan" (the source's place among the others), "new", or
        "no fingerprint". `progress` receives the same.
    Raises: as `bake`; UnknownObject. ConfigError: the bundle's converter was given ready made; give it again.
    Warns: BundleWarning: loops of an older bundle, which have no fingerprint, stay unchanged. LevelWarning: a loop
    from your own sound, or of your own pitch, is felt more than 3 dB weaker than planned, or most at another pitch.
    """
    return run_waiting(
        arebake(
            bundle,
            config,
            objects=objects,
            corrections=corrections,
            user_prompt=user_prompt,
            progress=progress,
            on_report=on_report,
            on_remade=on_remade,
        ),
        "arebake(...)",
    )


@clear_call
async def arebake(
    bundle: HapticBundle | str | os.PathLike[str],
    config: BakeConfig | Mapping[str, Any] | str | os.PathLike[str] | None = None,
    *,
    objects: Collection[str] = (),
    corrections: str | os.PathLike[str] | None = None,
    user_prompt: str = "",
    progress: Progress | None = None,
    on_report: OnReport | None = None,
    on_remade: OnRemade | None = None,
) -> HapticBundle:
    """Bake some objects of a bundle again, awaitable; see `rebake`."""
    bundle = given_bundle(bundle)
    bundle = bundle if corrections is None else bundle.corrected(corrections)
    _require_callable(progress=progress, on_report=on_report, on_remade=on_remade)
    config = BakeConfig.parse(config)
    given, config = config.model_fields_set, _settings_of(bundle, config)
    for key in [key for key in bundle.inferred if bundle.overrides.get(key, NONE) == NONE]:
        # Its row was removed from the file. Its loops stay, since they may be edited by hand.
        reset = bundle.reset(key)
        bundle = replace(reset, loops={one: bundle.loops[one] for one in reset.loops})
    if isinstance(objects, str):
        raise ConfigError(f"objects is the text {objects!r}; give a list of ids, [{objects!r}].")
    whole = [*checks.items("objects", objects, error=ConfigError), *renamed_objects(bundle)]
    again = list(dict.fromkeys([*whole, *objects_without_states(bundle)]))
    inference = await infer_corrected(
        bundle.snapshot,
        config.llm,
        config,
        bundle.overrides,
        user_prompt=user_prompt,
        progress=progress,
        only=again,
        scene_category=bundle.scene_category,
        before=bundle.objects,
    )
    _give_report(inference.report, on_report)
    inferred = dict(bundle.objects)
    for key, haptics in inference.objects.items():
        inferred[key] = haptics if key in whole else replace_vibration(bundle.objects[key], haptics)
    answers = {key: haptics for key, haptics in inference.objects.items() if key in whole}
    before = answers_before(bundle.objects, bundle.overrides, bundle.inferred)
    before |= answers_before(answers, bundle.overrides, {})
    earlier = EarlierLoops(
        bundle.loops,
        bundle.choices,
        chosen_again=again,
        any_source=not given & {"audio", "enough_candidates"},
        any_making=not given & {"actuator", "tactile", "spread"},
    )
    baked, sounds = await _make_loops(
        bundle.snapshot, inferred, bundle.overrides, config, progress, earlier, bundle.loops
    )
    if on_remade is not None:
        on_remade(sounds.remade)
    warn_of_weak_loops(sounds, bundle.overrides, config.actuator)
    made_with = _made_with(config) if all_have_fingerprints(sounds.loops) else None
    warn_of_vain_corrections(baked, bundle.overrides, bundle.objects)
    return replace(
        bundle, objects=baked, loops=sounds.loops, choices=sounds.choices, made_with=made_with, inferred=before
    )


def _give_report(report: InferenceReport, on_report: OnReport | None) -> None:
    """Pass the report to the caller's function. Without one, warn of the errors: objects without answers are silent."""
    if on_report is not None:
        on_report(report)
    else:
        report.warn_of_errors()


def _require_callable(**callbacks: object) -> None:
    for name, given in callbacks.items():
        if given is not None and not callable(given):
            raise ConfigError(f"{name} is {checks.represented(given)}; it must be a function or None.")


def _made_with(config: BakeConfig) -> MadeWith:
    return MadeWith(config.actuator, converter_settings(config.tactile), config.spread, config.seed)


def _settings_of(bundle: HapticBundle, config: BakeConfig) -> BakeConfig:
    """Return the settings. The bundle's settings replace absent ones. Raises: ConfigError: see `rebake`."""
    if bundle.made_with is None:
        return config
    kept = {name: getattr(bundle.made_with, name) for name in ("actuator", "spread", "seed", "tactile")}
    kept = {name: value for name, value in kept.items() if name not in config.model_fields_set}
    if "tactile" in kept:
        if "kind" not in kept["tactile"]:
            raise ConfigError(
                f"the bundle was made with a converter of {kept['tactile'].get('class', 'a class of its own')}, which "
                'no kind names. Give the converter again: rebake(bundle, {"tactile": ...}).'
            )
        kept["tactile"] = CONVERTERS.build(kept["tactile"])
    return config.model_copy(update=kept)
