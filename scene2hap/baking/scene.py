"""Design time: a scene in, a bundle out.

Inference tells what each object is and how it vibrates; a sound is found or made for each state of each vibrating
object, the best candidate chosen, looped and turned into a tactile signal.
"""

from __future__ import annotations

import asyncio
import warnings
from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from typing import Any

from scene2hap.baking.config import BakeConfig
from scene2hap.baking.sound import Progress, make_loops
from scene2hap.bundle import HapticBundle, Override
from scene2hap.haptics import ObjectHaptics, SourceState
from scene2hap.llm.chain import Inference, infer_scene
from scene2hap.llm.report import InferenceReport
from scene2hap.llm.wrappers import reports
from scene2hap.scene.snapshot import SceneSnapshot

OnReport = Callable[[InferenceReport], None]

_VIBRATES = "This object vibrates by itself: tell in which states."

_ASSUMED_INTENSITY = 0.3
"""Of a state that a person wants and no model describes."""


def bake(
    scene: SceneSnapshot,
    config: BakeConfig | Mapping[str, Any] | None = None,
    *,
    user_prompt: str = "",
    progress: Progress | None = None,
    on_report: OnReport | None = None,
    overrides: Mapping[str, Override] | None = None,
) -> HapticBundle:
    """Bake a scene; `abake` for callers that run an event loop.

    Parameters:
    user_prompt : what the model is told above all else.
    on_report : is handed the account of the inference: calls, what was skipped, tokens, errors of single objects.
    overrides : a person's corrections by id, as of an earlier bundle of the scene; they outrank what is inferred.

    Raises: ConfigError; BackendError: inference failed; AudioError: no source has a sound for a vibrating object.
    """
    baking = abake(scene, config, user_prompt=user_prompt, progress=progress, on_report=on_report, overrides=overrides)
    return asyncio.run(baking)


async def abake(
    scene: SceneSnapshot,
    config: BakeConfig | Mapping[str, Any] | None = None,
    *,
    user_prompt: str = "",
    progress: Progress | None = None,
    on_report: OnReport | None = None,
    overrides: Mapping[str, Override] | None = None,
) -> HapticBundle:
    """Bake a scene, awaitable; see `bake`."""
    config = BakeConfig.parse(config)
    wishes = _of_this_scene(overrides or {}, scene)
    inference = await _infer(scene, config, wishes, user_prompt, progress, on_report)
    objects = {key: _as_wished(haptics, wishes.get(key)) for key, haptics in inference.objects.items()}
    sounds = await make_loops(objects, wishes, config, progress or _say_nothing)
    return HapticBundle(scene, inference.scene_category, objects, sounds.loops, wishes, sounds.choices)


def rebake(
    bundle: HapticBundle,
    config: BakeConfig | Mapping[str, Any] | None = None,
    *,
    objects: Collection[str] = (),
    user_prompt: str = "",
    progress: Progress | None = None,
    on_report: OnReport | None = None,
) -> HapticBundle:
    """Bake some objects of a bundle again, and bring all its overrides into force; the rest stays as it is.

    Parameters: objects : ids to infer anew, of which `user_prompt` is told; a cache answers what it was asked before.
    Raises: as `bake`; UnknownObject.
    """
    return asyncio.run(
        arebake(bundle, config, objects=objects, user_prompt=user_prompt, progress=progress, on_report=on_report)
    )


async def arebake(
    bundle: HapticBundle,
    config: BakeConfig | Mapping[str, Any] | None = None,
    *,
    objects: Collection[str] = (),
    user_prompt: str = "",
    progress: Progress | None = None,
    on_report: OnReport | None = None,
) -> HapticBundle:
    """Bake some objects of a bundle again, awaitable; see `rebake`."""
    config = BakeConfig.parse(config)
    wishes = bundle.overrides
    silent = [key for key, wish in wishes.items() if wish.vibrates and not bundle.objects[key].vibrates]
    again = list(dict.fromkeys([*objects, *silent]))
    inference = await _infer(
        bundle.snapshot, config, wishes, user_prompt, progress, on_report, again, bundle.scene_category
    )
    inferred = {**bundle.objects, **inference.objects}
    said = {key: _as_wished(haptics, wishes.get(key)) for key, haptics in inferred.items()}
    other_sound = {key for key, wish in wishes.items() if wish.clip is not None}
    sounding = {key: haptics for key, haptics in said.items() if key in {*again, *other_sound}}
    kept = {key: loops for key, loops in bundle.loops.items() if key not in sounding}
    standing = [(loop, inferred[key].object_category) for key, states in kept.items() for loop in states.values()]
    made = await make_loops(sounding, wishes, config, progress or _say_nothing, standing)
    loops, choices = kept | made.loops, {key: bundle.choices[key] for key in kept if key in bundle.choices}
    ordered = {key: loops[key] for key in said if key in loops}
    return replace(bundle, objects=said, loops=ordered, choices=choices | made.choices)


async def _infer(
    scene: SceneSnapshot,
    config: BakeConfig,
    wishes: Mapping[str, Override],
    user_prompt: str,
    progress: Progress | None,
    on_report: OnReport | None,
    only: Collection[str] | None = None,
    scene_category: str | None = None,
) -> Inference:
    tell = progress or _say_nothing
    inference = await infer_scene(
        scene,
        config.llm,
        user_prompt=user_prompt,
        config=config,
        progress=lambda what, done, total: tell("inference", what + _hits(config.llm), done, total),
        only=only,
        scene_category=scene_category,
        wishes={key: _VIBRATES for key, wish in wishes.items() if wish.vibrates},
    )
    if on_report is not None:
        on_report(inference.report)
    return inference


def _as_wished(haptics: ObjectHaptics, wish: Override | None) -> ObjectHaptics:
    """What is said of an object after a person's correction; one that is to vibrate has at least one state."""
    if wish is None:
        return haptics
    if wish.vibrates and not haptics.states:
        words = haptics.object_category
        on = SourceState("on", _ASSUMED_INTENSITY, f"{words} running", f"{words} humming")
        haptics = replace(haptics, vibrates=True, states=(on,))
    return wish.applied(haptics)


def _of_this_scene(overrides: Mapping[str, Override], scene: SceneSnapshot) -> dict[str, Override]:
    known = {item.id for item in scene.objects}
    for object_id in overrides.keys() - known:
        warnings.warn(f"the override of {object_id!r} is dropped: the scene has no such object any more.", stacklevel=3)
    return {key: wish for key, wish in overrides.items() if key in known}


def _hits(backend: object) -> str:
    kept = reports(backend).get("CacheBackend", {}).get("hits")
    return f" ({kept} answers kept)" if kept else ""


def _say_nothing(stage: str, what: str, done: int, total: int) -> None: ...
