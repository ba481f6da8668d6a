"""A person's overrides in a bake: before inference, they rename objects; after it, they replace inferred values."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

from scene2hap.baking.config import BakeConfig
from scene2hap.baking.loops import Progress, no_progress
from scene2hap.bundle import BundleWarning, Override
from scene2hap.bundle.pending_corrections import reason_of_name
from scene2hap.common import checks
from scene2hap.common.counted import counted
from scene2hap.common.warning import warn_of
from scene2hap.errors import BackendError, ConfigError
from scene2hap.haptics import ObjectHaptics, SourceState, is_unknown
from scene2hap.llm.chain import Inference, infer_scene
from scene2hap.llm.chain.questions import ConcurrencyLimit
from scene2hap.llm.protocol import LLMBackend
from scene2hap.llm.wrappers import reports
from scene2hap.scene.snapshot import SceneSnapshot

_VIBRATES = "This object vibrates by itself: tell in which states."
"""Prompt for an object that a person wants to vibrate."""

_ASSUMED_INTENSITY = 0.3
"""Intensity of a state that a person requests and no model describes."""


def overrides_of_scene(overrides: Mapping[str, Override], scene: SceneSnapshot) -> dict[str, Override]:
    """Return the overrides of the objects of a scene.

    Raises: ConfigError: they are no overrides. Warns: BundleWarning: one of an absent object is dropped.
    """
    is_mapping = isinstance(overrides, Mapping)
    wrong = [one for one in overrides.values() if not isinstance(one, Override)] if is_mapping else [overrides]
    if wrong:
        verb = "has" if is_mapping else "is"
        raise ConfigError(
            f"overrides {verb} {checks.described(wrong[0])}; it must be a mapping of ids to Override, as "
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
    limit: ConcurrencyLimit | None = None,
    before: Mapping[str, ObjectHaptics] | None = None,
) -> Inference:
    """Infer a scene with the names and vibration of the overrides. See `infer_scene`.

    `before` : earlier answers; they stay for objects whose given name is unknown.
    An error that stops it has a note on the answers that the cache keeps (`__notes__`), since the same bake continues.
    Warns: BundleWarning: a name that a person gave is unknown.
    """
    tell = progress or no_progress
    names = {key: override.name for key, override in overrides.items() if override.name is not None}
    if names:
        renamed = (replace(item, name=names.get(item.id, item.name)) for item in scene.objects)
        scene = replace(scene, objects=tuple(renamed))
    try:
        inference = await infer_scene(
            scene,
            backend,
            user_prompt=user_prompt,
            config=config,
            progress=lambda what, done, total: tell("inference", what + _cache_hits(backend), done, total),
            only=only,
            scene_category=scene_category,
            object_prompts={key: _VIBRATES for key, override in overrides.items() if override.vibrates},
            limit=limit,
        )
    except BackendError as cause:
        cached = reports(backend).get("CacheBackend", {})
        if n_kept := cached.get("stored", 0) + cached.get("hits", 0):
            cause.add_note(
                f"The cache keeps {counted(n_kept, 'answer')} so far; the same command continues from there."
            )
        raise
    objects = {
        key: _named(key, haptics, names[key], (before or {}).get(key)) if key in names else haptics
        for key, haptics in inference.objects.items()
    }
    return replace(inference, objects=objects)


def _named(object_id: str, haptics: ObjectHaptics, name: str, before: ObjectHaptics | None) -> ObjectHaptics:
    """Return the answer for the name that a person gave an object, with a note of it.

    An unknown name does not replace an earlier answer, or the object would fall silent.
    Warns: BundleWarning: the name is unknown.
    """
    if is_unknown(haptics.object_category):
        is_kept = before is not None and not is_unknown(before.object_category)
        effect = "the object stays as it was" if is_kept else "no material and no vibration are inferred"
        warn_of(
            f"nothing is known of {checks.shown(name)}, the name that a person gave {object_id!r}; {effect}. Use a "
            "common noun, as 'washing machine', or infer it by a model (llm).",
            BundleWarning,
        )
        if before is not None and is_kept:
            return before
    return replace(haptics, reasons={**haptics.reasons, "name": reason_of_name(name)})


def replace_vibration(before: ObjectHaptics, inferred: ObjectHaptics) -> ObjectHaptics:
    """Return an object with the vibration of another answer. The rest stays: a bundle has no pictures, from which the
    material may have been inferred, and a person may have edited it."""
    by = {name: who for name, who in inferred.provenance.items() if name == "vibrates" or name.startswith("states.")}
    why = {name: reason for name, reason in inferred.reasons.items() if name == "vibration"}
    return replace(
        before,
        vibrates=inferred.vibrates,
        states=inferred.states,
        provenance={**before.provenance, **by},
        reasons={**before.reasons, **why},
    )


def apply_overrides(
    objects: Mapping[str, ObjectHaptics], overrides: Mapping[str, Override]
) -> dict[str, ObjectHaptics]:
    """Return the objects with a person's corrections. An object made to vibrate gets at least one state."""
    return {key: _apply(overrides[key], haptics) if key in overrides else haptics for key, haptics in objects.items()}


def _apply(override: Override, haptics: ObjectHaptics) -> ObjectHaptics:
    if override.vibrates and not haptics.states:
        words = haptics.object_category
        on = SourceState("on", _ASSUMED_INTENSITY, f"{words} running", f"{words} humming")
        haptics = replace(haptics, vibrates=True, states=(on,))
    return override.applied(haptics)


def _cache_hits(backend: object) -> str:
    kept = reports(backend).get("CacheBackend", {}).get("hits")
    return f" ({kept} answers kept)" if kept else ""
