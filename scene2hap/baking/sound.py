"""A sound for each state of each vibrating object: found or made, chosen, looped, and turned into touch."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from scene2hap.audio.felt_loop import SourceClip, felt_loop, plan_scene
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.select import Choice, explain_choice
from scene2hap.audio.sources.chain import gather
from scene2hap.baking.config import BakeConfig
from scene2hap.bundle import Override
from scene2hap.haptics import ObjectHaptics, SourceState, VibrationDescription

Progress = Callable[[str, str, int, int], None]
"""Told (stage, what is done, how many are done, of how many)."""


@dataclass(frozen=True)
class Sounds:
    """The loops by object and state, and why each sound was chosen where there was a choice."""

    loops: dict[str, dict[str, HapticLoop]] = field(default_factory=dict)
    choices: dict[str, dict[str, str]] = field(default_factory=dict)


async def make_loops(
    objects: Mapping[str, ObjectHaptics],
    wishes: Mapping[str, Override],
    config: BakeConfig,
    tell: Progress,
    standing: Sequence[tuple[HapticLoop, str]] = (),
) -> Sounds:
    """The loops of all objects; `standing` are those of the scene's other objects, and their categories.

    All sounds are chosen before any is converted, since each source is moved clear of the others.
    """
    wanted = [(key, haptics, state) for key, haptics in objects.items() for state in haptics.states]
    sounds, sources = Sounds(), []
    for done, (object_id, haptics, state) in enumerate(wanted, start=1):
        clip = wishes[object_id].clip if object_id in wishes else None
        if clip is None:
            choice = await asyncio.to_thread(_choose, object_id, haptics, state, config)
            clip = choice.winner
            sounds.choices.setdefault(object_id, {})[state.name] = str(choice)
        sources.append(SourceClip(clip, state.intensity, haptics.object_category))
        tell("sound", object_id, done, len(wanted))
    plans = await asyncio.to_thread(plan_scene, sources, config.tactile, config.actuator, config.spread, standing)
    for done, ((object_id, _, state), source, plan) in enumerate(zip(wanted, sources, plans, strict=True), start=1):
        sounds.loops.setdefault(object_id, {})[state.name] = await asyncio.to_thread(
            felt_loop, source.clip, config.tactile, plan
        )
        tell("touch", object_id, done, len(wanted))
    return sounds


def _choose(object_id: str, haptics: ObjectHaptics, state: SourceState, config: BakeConfig) -> Choice:
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
    return explain_choice(gather(object_id, description, config.audio, enough=config.enough_candidates))
