"""Design time: a scene in, a bundle out.

Inference tells what each object is and how it vibrates; a sound is found or made for each state of each vibrating
object, the best candidate chosen, looped and turned into a tactile signal.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
from typing import Annotated, Any

from pydantic import BeforeValidator, Field

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.loops import loop_pair
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.select import select_clip
from scene2hap.audio.sources import SOURCES
from scene2hap.audio.sources.chain import ENOUGH, gather
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.bundle import HapticBundle
from scene2hap.haptics import ActuatorProfile, ObjectHaptics, SourceState, VibrationDescription
from scene2hap.llm import BACKENDS
from scene2hap.llm.chain import infer_scene
from scene2hap.llm.config import InferenceConfig
from scene2hap.scene.snapshot import SceneSnapshot

Progress = Callable[[str, str, int, int], None]
"""Told (stage, what is done, how many are done, of how many)."""


def _sources(specs: object) -> object:
    return tuple(SOURCES.build(spec) for spec in specs) if isinstance(specs, list | tuple) else (SOURCES.build(specs),)


class BakeConfig(InferenceConfig):
    """How a scene is baked. Every part is chosen by a `kind`, or given ready made.

    llm : the backend of inference, whose course the settings of `InferenceConfig` decide;
    audio : where sounds come from, tried in order until `enough_candidates` remain (1 is the paper's rule);
    tactile : what turns sound into touch; actuator : what it is turned for; seed : of everything that is synthesized.
    """

    of_what = "bake"

    llm: Annotated[Any, BeforeValidator(BACKENDS.build)] = Field(default="lexicon", validate_default=True)
    audio: Annotated[Any, BeforeValidator(_sources)] = Field(default="synth", validate_default=True)
    enough_candidates: int = Field(default=ENOUGH, ge=1, le=5)
    tactile: Annotated[Any, BeforeValidator(CONVERTERS.build)] = Field(default="svf_bandpass", validate_default=True)
    actuator: ActuatorProfile = Field(default_factory=ActuatorProfile)
    seed: int = 0


def bake(
    scene: SceneSnapshot,
    config: BakeConfig | Mapping[str, Any] | None = None,
    *,
    user_prompt: str = "",
    progress: Progress | None = None,
) -> HapticBundle:
    """Bake a scene; `abake` for callers that run an event loop.

    Raises: ConfigError; BackendError: inference failed; AudioError: no source has a sound for a vibrating object.
    """
    return asyncio.run(abake(scene, config, user_prompt=user_prompt, progress=progress))


async def abake(
    scene: SceneSnapshot,
    config: BakeConfig | Mapping[str, Any] | None = None,
    *,
    user_prompt: str = "",
    progress: Progress | None = None,
) -> HapticBundle:
    """Bake a scene, awaitable; see `bake`."""
    config = BakeConfig.parse(config)
    tell = progress or (lambda stage, what, done, total: None)
    inference = await infer_scene(
        scene,
        config.llm,
        user_prompt=user_prompt,
        config=config,
        progress=lambda what, done, total: tell("inference", what, done, total),
    )
    wanted = [
        (object_id, haptics, state) for object_id, haptics in inference.objects.items() for state in haptics.states
    ]
    loops: dict[str, dict[str, HapticLoop]] = {}
    for done, (object_id, haptics, state) in enumerate(wanted, start=1):
        loop = await asyncio.to_thread(_make_loop, object_id, haptics, state, config)
        loops.setdefault(object_id, {})[state.name] = loop
        tell("sound", object_id, done, len(wanted))
    return HapticBundle(scene, inference.scene_category, inference.objects, loops)


def _make_loop(object_id: str, haptics: ObjectHaptics, state: SourceState, config: BakeConfig) -> HapticLoop:
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
    clip = select_clip(gather(object_id, description, config.audio, enough=config.enough_candidates))
    context = ConversionContext(actuator=config.actuator, intensity=state.intensity)
    return loop_pair(clip, config.tactile, context)
