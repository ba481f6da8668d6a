"""Bake a scene or an object into a bundle, and bake parts of a bundle again.

Inference names each object and its vibration. For each state of each vibrating object, a sound is found or synthesized.
The best candidate is chosen, looped and converted into a tactile signal.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from scene2hap.audio.haptic_loop import HapticLoop, LevelWarning, level_doubt
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.baking.config import BakeConfig
from scene2hap.baking.fingerprint import converter_settings
from scene2hap.baking.recorded_times import with_recorded_times
from scene2hap.baking.sound import Earlier, Progress, Remade, make_loops
from scene2hap.bundle import BundleWarning, HapticBundle, MadeWith, Override
from scene2hap.bundle.arguments import given_bundle
from scene2hap.bundle.checking import vain_corrections
from scene2hap.common import checks
from scene2hap.common.calls import clear_call
from scene2hap.common.counted import counted, first_of
from scene2hap.common.warning import warn_of
from scene2hap.errors import ConfigError, SceneError
from scene2hap.haptics import ObjectHaptics, SourceState, is_unknown
from scene2hap.llm.chain import Inference, infer_scene
from scene2hap.llm.protocol import LLMBackend
from scene2hap.llm.questions import Slots
from scene2hap.llm.report import InferenceReport
from scene2hap.llm.run_coroutine import run_waiting
from scene2hap.llm.wrappers import reports
from scene2hap.scene import limits
from scene2hap.scene.arguments import given_scene
from scene2hap.scene.grouping.empty_names import names_a_place
from scene2hap.scene.objects import SceneObject, UpAxis
from scene2hap.scene.snapshot import SceneSnapshot

OnReport = Callable[[InferenceReport], None]
OnRemade = Callable[[Remade], None]


_VIBRATES = "This object vibrates by itself: tell in which states."
"""Prompt for an object that a person wants to vibrate."""

_ASSUMED_INTENSITY = 0.3
"""Intensity of a state that a person requests and no model describes."""


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
    on_report : receives the report of the inference: calls, skipped calls, tokens, errors of single objects.
    overrides : a person's corrections by id, for example of an earlier bundle; they replace inferred values.
    earlier : a bundle of this scene; the states and loops of objects that `overrides` lock are taken from it.

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
    overrides = of_this_scene(overrides or {}, scene)
    inference = await infer_corrected(scene, config.llm, config, overrides, user_prompt=user_prompt, progress=progress)
    if on_report is not None:
        on_report(inference.report)
    return await with_sounds(scene, inference.scene_category, inference.objects, overrides, config, progress, earlier)


async def with_sounds(
    scene: SceneSnapshot,
    scene_category: str,
    inferred: Mapping[str, ObjectHaptics],
    overrides: Mapping[str, Override],
    config: BakeConfig,
    progress: Progress | None = None,
    earlier: HapticBundle | None = None,
) -> HapticBundle:
    """Make the sounds of an inferred scene. Returns its bundle, as `bake` after inference. Raises: AudioError."""
    before = Earlier()
    if earlier is not None:
        locked = {key: loops for key, loops in earlier.loops.items() if key in overrides and overrides[key].locked}
        before = Earlier(locked, earlier.choices)
    kept = {
        key: _with_vibration(haptics, earlier.objects[key]) if earlier is not None and key in before.loops else haptics
        for key, haptics in inferred.items()
    }
    objects = {key: _as_wished(haptics, overrides.get(key)) for key, haptics in kept.items()}
    sounds = await make_loops(objects, overrides, config, progress or _say_nothing, before, kept)
    objects = _as_recorded(objects, sounds.loops, {}, overrides)
    _warn_of(scene, objects)
    for doubt in vain_corrections(objects, overrides):
        warn_of(doubt, BundleWarning)
    return HapticBundle(scene, scene_category, objects, sounds.loops, overrides, sounds.choices, _made_with(config))


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
    Warns: BundleWarning: loops of an older bundle, which have no fingerprint, stay unchanged. LevelWarning: a loop from
    your own sound is felt more than 3 dB weaker than planned.
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
    if isinstance(objects, str):
        raise ConfigError(f"objects is the text {objects!r}; give a list of ids, [{objects!r}].")
    objects = checks.items("objects", objects, error=ConfigError)
    overrides = bundle.overrides
    silent = [key for key, override in overrides.items() if override.vibrates and not bundle.objects[key].vibrates]
    renamed = [
        key
        for key, haptics in bundle.objects.items()
        if haptics.reasons.get("name") != _why_named(overrides.get(key, Override()).name)
    ]
    objects = [*objects, *renamed]
    again = list(dict.fromkeys([*objects, *silent]))
    inference = await infer_corrected(
        bundle.snapshot,
        config.llm,
        config,
        overrides,
        user_prompt=user_prompt,
        progress=progress,
        only=again,
        scene_category=bundle.scene_category,
    )
    if on_report is not None:
        on_report(inference.report)
    answers = {
        key: haptics if key in objects else _with_vibration(bundle.objects[key], haptics)
        for key, haptics in inference.objects.items()
    }
    inferred = {**bundle.objects, **answers}
    said = {key: _as_wished(haptics, overrides.get(key)) for key, haptics in inferred.items()}
    earlier = Earlier(
        bundle.loops,
        bundle.choices,
        chosen_again=again,
        any_source=not given & {"audio", "enough_candidates"},
        any_making=not given & {"actuator", "tactile", "spread"},
    )
    sounds = await make_loops(said, overrides, config, progress or _say_nothing, earlier, inferred)
    if on_remade is not None:
        on_remade(sounds.remade)
    _warn_of_weak(sounds.loops, sounds.remade, overrides)
    made_with = _made_with(config) if _all_are_known(sounds.loops) else None
    said = _as_recorded(said, sounds.loops, bundle.loops, overrides)
    known = vain_corrections(bundle.objects, overrides)
    for doubt in vain_corrections(said, overrides):
        if doubt not in known:
            warn_of(doubt, BundleWarning)
    return replace(bundle, objects=said, loops=sounds.loops, choices=sounds.choices, made_with=made_with)


def _warn_of(scene: SceneSnapshot, objects: Mapping[str, ObjectHaptics]) -> None:
    """Warn about probable mistakes. Units are left out, since `load_scene` has warned about them."""
    doubts = [found for found in scene.check() if found.kind != "units"]
    for found in doubts:
        warn_of(str(found))
    unknown = [key for key, haptics in objects.items() if is_unknown(haptics.object_category)]
    if len(objects) > 1 and not any(haptics.vibrates for haptics in objects.values()):
        # The loose parts of a merged room have its name.
        is_room = any(names_a_place(item.name) for item in scene.objects)
        is_one_model = 2 * len(unknown) > len(objects) and not is_room
        parts = " If the file is one model of many parts, load it with group=0." if is_one_model else ""
        warn_of(
            f"none of {len(objects)} objects of {scene.name!r} vibrates; nothing will be felt. Give objects names that "
            f"say what they are, let a model look at them (llm), or override(id, vibrates=True).{parts}"
        )
    elif len(objects) == 1 and unknown:
        is_merged = any(found.kind == "merged" for found in doubts)
        merges = "" if is_merged else " If it merges several objects, load it with group='loose' or group='leaf'."
        warn_of(
            f"{scene.name!r} is one object, {scene.objects[0].name!r}, which is unknown; nothing will be felt.{merges} "
            "If it is one object, give it a name that says what it is, or let a model look at it (llm)."
        )


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


def _all_are_known(loops: Mapping[str, Mapping[str, HapticLoop]]) -> bool:
    """Return True if every loop has a fingerprint. Warns: BundleWarning: loops without one."""
    unknown = [key for key, states in loops.items() if not all(loop.fingerprint for loop in states.values())]
    if unknown:
        warn_of(
            f"the loops of {counted(len(unknown), 'source')} ({first_of(unknown, 3)}) have no fingerprint, as in "
            "older bundles, and stay as they are. Give actuator or tactile to make them again.",
            BundleWarning,
        )
    return not unknown


def _warn_of_weak(
    loops: Mapping[str, Mapping[str, HapticLoop]],
    remade: Mapping[str, Mapping[str, object]],
    overrides: Mapping[str, Override],
) -> None:
    """Warn of loops that were made from a person's own sounds and miss their level. Warns: LevelWarning."""
    for key, states in remade.items():
        clip = overrides[key].clip if key in overrides else None
        for state in states if clip is not None and not clip.is_vibration else ():
            felt = loops[key][state].felt
            doubt = level_doubt(f"{key}, {state},", felt.level_db, felt.asked_level_db) if felt is not None else ""
            if doubt:
                warn_of(doubt, LevelWarning)


async def infer_corrected(
    scene: SceneSnapshot,
    backend: LLMBackend,
    config: BakeConfig,
    overrides: Mapping[str, Override],
    *,
    user_prompt: str = "",
    progress: Progress | None = None,
    only: Collection[str] | None = None,
    scene_category: str | None = None,
    slots: Slots | None = None,
) -> Inference:
    """Infer a scene with the names and vibration of the overrides. See `infer_scene`."""
    tell = progress or _say_nothing
    inference = await infer_scene(
        _renamed(scene, overrides),
        backend,
        user_prompt=user_prompt,
        config=config,
        progress=lambda what, done, total: tell("inference", what + _hits(backend), done, total),
        only=only,
        scene_category=scene_category,
        object_prompts={key: _VIBRATES for key, override in overrides.items() if override.vibrates},
        slots=slots,
    )
    return replace(
        inference, objects={key: _as_named(key, said, overrides.get(key)) for key, said in inference.objects.items()}
    )


def _as_named(object_id: str, haptics: ObjectHaptics, override: Override | None) -> ObjectHaptics:
    """Note the name that a person gave an object, by which it was inferred. Warns: BundleWarning: it is unknown."""
    why = None if override is None else _why_named(override.name)
    if override is None or why is None:
        return haptics
    if is_unknown(haptics.object_category):
        warn_of(
            f"nothing is known of {checks.shown(override.name)}, the name that a person gave {object_id!r}; no "
            "material and no vibration are inferred. Use a common noun, as 'washing machine', or a model (llm).",
            BundleWarning,
        )
    return replace(haptics, reasons={**haptics.reasons, "name": why})


def _renamed(scene: SceneSnapshot, overrides: Mapping[str, Override]) -> SceneSnapshot:
    """Return the scene with the names that a person gave."""
    names = {key: override.name for key, override in overrides.items() if override.name is not None}
    if not names:
        return scene
    return replace(scene, objects=tuple(replace(item, name=names.get(item.id, item.name)) for item in scene.objects))


def _why_named(name: str | None) -> str | None:
    return None if name is None else f"a person calls it {name!r}."


def with_locked(folder: Path, overrides: Mapping[str, Override]) -> HapticBundle | None:
    """Return the bundle in a folder if a person has locked loops in it, None otherwise. Raises: BundleError."""
    return HapticBundle.load(folder) if any(override.locked for override in overrides.values()) else None


def _with_vibration(before: ObjectHaptics, asked: ObjectHaptics) -> ObjectHaptics:
    """Return an object with the vibration of another answer. The rest stays: a bundle has no pictures, from which the
    material may have been inferred, and a person may have edited it."""
    by = {name: who for name, who in asked.provenance.items() if name == "vibrates" or name.startswith("states.")}
    why = {name: reason for name, reason in asked.reasons.items() if name == "vibration"}
    return replace(
        before,
        vibrates=asked.vibrates,
        states=asked.states,
        provenance={**before.provenance, **by},
        reasons={**before.reasons, **why},
    )


def _as_wished(haptics: ObjectHaptics, override: Override | None) -> ObjectHaptics:
    """Apply a person's correction to an object. If it makes the object vibrate, the object gets at least one state."""
    if override is None:
        return haptics
    if override.vibrates and not haptics.states:
        words = haptics.object_category
        on = SourceState("on", _ASSUMED_INTENSITY, f"{words} running", f"{words} humming")
        haptics = replace(haptics, vibrates=True, states=(on,))
    return override.applied(haptics)


def _as_recorded(
    objects: Mapping[str, ObjectHaptics],
    loops: Mapping[str, Mapping[str, HapticLoop]],
    before: Mapping[str, Mapping[str, HapticLoop]],
    overrides: Mapping[str, Override],
) -> dict[str, ObjectHaptics]:
    """Return the objects with the times from recordings. A person's corrections have priority."""
    return {
        key: overrides[key].applied(haptics) if key in overrides else haptics
        for key, haptics in with_recorded_times(objects, loops, before).items()
    }


def of_this_scene(overrides: Mapping[str, Override], scene: SceneSnapshot) -> dict[str, Override]:
    """Return the overrides of the objects of a scene.

    Raises: ConfigError: they are no overrides. Warns: BundleWarning: one of an absent object is dropped.
    """
    wrong = (
        [override for override in overrides.values() if not isinstance(override, Override)]
        if isinstance(overrides, Mapping)
        else [overrides]
    )
    if wrong:
        raise ConfigError(
            f"overrides is or has {checks.described(wrong[0])}; it must be a mapping of ids to Override, as "
            "`bundle.overrides` is."
        )
    known = {item.id for item in scene.objects}
    for object_id, override in overrides.items():
        if object_id not in known and override.corrections():
            near = checks.did_you_mean(object_id, sorted(known - overrides.keys()))
            warn_of(
                f"the override of {object_id!r} is dropped: the scene has no such object any more. Dropped are its "
                f"{', '.join(override.corrections())}. {near}".rstrip(),
                BundleWarning,
            )
    return {key: override for key, override in overrides.items() if key in known}


def _hits(backend: object) -> str:
    kept = reports(backend).get("CacheBackend", {}).get("hits")
    return f" ({kept} answers kept)" if kept else ""


def _say_nothing(stage: str, what: str, done: int, total: int) -> None: ...
