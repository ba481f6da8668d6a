"""Design time: a scene in, a bundle out.

Inference tells what each object is and how it vibrates; a sound is found or made for each state of each vibrating
object, the best candidate chosen, looped and turned into a tactile signal.
"""

from __future__ import annotations

import asyncio
import warnings
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, ValidationInfo, field_validator

from scene2hap.audio.actuators import actuator_profile
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.felt_loop import SourceClip, felt_loop, plan_scene
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.select import select_clip
from scene2hap.audio.sources import SOURCES
from scene2hap.audio.sources.chain import ENOUGH, gather
from scene2hap.audio.spreading import SpreadLimits
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.bundle import HapticBundle, Override
from scene2hap.haptics import ActuatorProfile, ObjectHaptics, SourceState, VibrationDescription
from scene2hap.llm.chain import Inference, infer_scene
from scene2hap.llm.config import InferenceConfig
from scene2hap.llm.report import InferenceReport
from scene2hap.llm.wrappers import build_backend, reports
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.settings import cache_folder

Progress = Callable[[str, str, int, int], None]
"""Told (stage, what is done, how many are done, of how many)."""

OnReport = Callable[[InferenceReport], None]

_VIBRATES = "This object vibrates by itself: tell in which states."

_ASSUMED_INTENSITY = 0.3
"""Of a state that a person wants and no model describes."""


def _sources(specs: object) -> object:
    return tuple(SOURCES.build(spec) for spec in specs) if isinstance(specs, list | tuple) else (SOURCES.build(specs),)


class BakeConfig(InferenceConfig):
    """How a scene is baked. Every part is chosen by a `kind`, or given ready made.

    llm : the backend of inference, whose course the settings of `InferenceConfig` decide. One that is reached over a
        network gets retries, repairs and a cache around it (`standard_stack`), unless it is given ready made;
    cache_dir : where its answers are kept, None for the user's folder of caches;
    max_cost_usd : what the answers may cost, checked before each call, None for no limit;
    prices : of models, in US dollars per million tokens read and written, beside the dated list;
    audio : where sounds come from, tried in order until `enough_candidates` remain (1 is the paper's rule);
    tactile : what turns sound into touch; actuator : what it is turned for, by name, CSV file or fields;
    spread : how far a source may be moved in frequency and level to be told from the others;
    seed : of everything that is synthesized.
    """

    of_what = "bake"

    cache_dir: Path | None = None
    max_cost_usd: float | None = Field(default=None, ge=0.0)
    prices: dict[str, tuple[float, float]] = Field(default_factory=dict)
    llm: Any = Field(default="lexicon", validate_default=True)
    audio: Annotated[Any, BeforeValidator(_sources)] = Field(default="synth", validate_default=True)
    enough_candidates: int = Field(default=ENOUGH, ge=1, le=5)
    tactile: Annotated[Any, BeforeValidator(CONVERTERS.build)] = Field(default="adaptive", validate_default=True)
    actuator: Annotated[ActuatorProfile, BeforeValidator(actuator_profile)] = Field(default_factory=ActuatorProfile)
    spread: SpreadLimits = Field(default_factory=SpreadLimits)
    seed: int = 0

    @field_validator("llm", mode="before")
    @classmethod
    def _in_its_stack(cls, spec: object, info: ValidationInfo) -> object:
        # Folder, limit and prices stand before the backend in the class, so they are known here.
        folder = info.data.get("cache_dir") or cache_folder("llm")
        limits = {"max_cost": info.data.get("max_cost_usd"), "prices": info.data.get("prices")}
        return build_backend(spec, folder, **limits)


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
    loops = await _make_loops(objects, wishes, config, progress)
    return HapticBundle(scene, inference.scene_category, objects, loops, wishes)


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
    made = await _make_loops(sounding, wishes, config, progress, standing)
    loops = {key: {**kept, **made}[key] for key in said if key in kept or key in made}
    return replace(bundle, objects=said, loops=loops)


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


async def _make_loops(
    objects: Mapping[str, ObjectHaptics],
    wishes: Mapping[str, Override],
    config: BakeConfig,
    progress: Progress | None,
    standing: Sequence[tuple[HapticLoop, str]] = (),
) -> dict[str, dict[str, HapticLoop]]:
    """The loops of all objects by state; `standing` are those of the scene's other objects, and their categories.

    All sounds are chosen before any is converted, since each source is moved clear of the others.
    """
    tell = progress or _say_nothing
    wanted = [(key, haptics, state) for key, haptics in objects.items() for state in haptics.states]
    sources = []
    for done, (object_id, haptics, state) in enumerate(wanted, start=1):
        clip = wishes[object_id].clip if object_id in wishes else None
        if clip is None:
            clip = await asyncio.to_thread(_choose, object_id, haptics, state, config)
        sources.append(SourceClip(clip, state.intensity, haptics.object_category))
        tell("sound", object_id, done, len(wanted))
    plans = await asyncio.to_thread(plan_scene, sources, config.tactile, config.actuator, config.spread, standing)
    loops: dict[str, dict[str, HapticLoop]] = {}
    for done, ((object_id, _, state), source, plan) in enumerate(zip(wanted, sources, plans, strict=True), start=1):
        loops.setdefault(object_id, {})[state.name] = await asyncio.to_thread(
            felt_loop, source.clip, config.tactile, plan
        )
        tell("touch", object_id, done, len(wanted))
    return loops


def _choose(object_id: str, haptics: ObjectHaptics, state: SourceState, config: BakeConfig) -> AudioClip:
    description = VibrationDescription(
        object_category=haptics.object_category,
        state=state.name,
        sentence=state.sentence,
        keywords=state.keywords,
        intensity=state.intensity,
        size_m=haptics.estimated_size_m,
        material=haptics.material_category,
        seed=config.seed,
    )
    return select_clip(gather(object_id, description, config.audio, enough=config.enough_candidates))


def _hits(backend: object) -> str:
    kept = reports(backend).get("CacheBackend", {}).get("hits")
    return f" ({kept} answers kept)" if kept else ""


def _say_nothing(stage: str, what: str, done: int, total: int) -> None: ...
