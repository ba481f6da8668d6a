"""The loops of each state of each vibrating object: its sound, made a seamless loop and converted into vibration.

States with equal conversions share the loops. A loop of an earlier bundle is reused if its fingerprint is unchanged.
"""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable, Mapping, Sequence
from contextvars import ContextVar
from dataclasses import dataclass, field, replace
from threading import Lock

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.encoding import as_stored
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.protocol import follows_target
from scene2hap.audio.scene_loops import Plan, SourceClip, felt_loop, plan_scene
from scene2hap.baking.config import BakeConfig
from scene2hap.baking.fingerprint import (
    OWN_CLIP,
    actuator_digest,
    converter_name,
    differences,
    made_by,
)
from scene2hap.baking.recorded_times import runs_of
from scene2hap.baking.sound_choice import EarlierLoops, SoundChooser, StateSound
from scene2hap.bundle import BundleWarning, Override
from scene2hap.bundle.edited_loops import LOOPS, is_edited, loop_digests
from scene2hap.bundle.pending_corrections import CORRECTIONS, corrections_digest
from scene2hap.common.blas_threads import one_blas_thread
from scene2hap.common.counted import first_of
from scene2hap.common.warning import warn_of
from scene2hap.errors import AudioError
from scene2hap.haptics import ActuatorProfile, ObjectHaptics

Progress = Callable[[str, str, int, int], None]
"""Called with (stage, step, number done, total number)."""


def no_progress(stage: str, step: str, n_done: int, n: int) -> None:
    """Ignore progress."""


Remade = Mapping[str, Mapping[str, tuple[str, ...]]]
"""Reasons why each loop was made, by id and state: parts of its fingerprint, or "new"."""
_MOST_THREADS = 4
"""Assumed: each thread holds the spectra of a clip, some 100 MB, and Python code runs in one thread at a time."""
N_THREADS: ContextVar[int] = ContextVar("N_THREADS", default=0)
"""Number of loops made at once; 0 for one per processor. Fewer are useful if other processes bake at the same time."""
_NEW: tuple[str, ...] = ("new",)
_UNCHANGED: tuple[str, ...] = ()


@dataclass(frozen=True)
class Sounds:
    """Loops by object and state, the reason for each choice of a sound, and the reason why each loop was made."""

    loops: dict[str, Mapping[str, HapticLoop]] = field(default_factory=dict)
    choices: dict[str, dict[str, str]] = field(default_factory=dict)
    remade: dict[str, dict[str, tuple[str, ...]]] = field(default_factory=dict)


async def make_loops(
    objects: Mapping[str, ObjectHaptics],
    overrides: Mapping[str, Override],
    config: BakeConfig,
    progress: Progress | None = None,
    earlier: EarlierLoops | None = None,
    inferred: Mapping[str, ObjectHaptics] | None = None,
    names: Mapping[str, str] | None = None,
) -> Sounds:
    """Make the loops of all objects.

    All sounds are chosen before any is converted, since each source is moved away from the frequencies of the others.
    `inferred` are the objects before a person corrected them: a corrected intensity changes the level of a sound, not
    the sound itself. `names` are the names of the objects, by which a source may search.
    """
    wanted = [(key, haptics, state) for key, haptics in objects.items() if haptics.vibrates for state in haptics.states]
    before, tell = earlier or EarlierLoops(), progress or no_progress
    sounds, chooser = Sounds(), SoundChooser(config, overrides, before, inferred or objects, names or {})
    parts = []
    for done, (object_id, haptics, state) in enumerate(wanted, start=1):
        part, why = await asyncio.to_thread(chooser.part, object_id, haptics, state)
        request = {**part.request, CORRECTIONS: corrections_digest(overrides.get(object_id, Override()), state.name)}
        pitch_hz = _pitch_hz(object_id, state.name, overrides, config)
        parts.append(replace(part, request=request, pitch_hz=pitch_hz))
        if why:
            sounds.choices.setdefault(object_id, {})[state.name] = why
        tell("sound", object_id, done, len(wanted))
    sources = [
        SourceClip(part.clip, part.state.intensity, part.group, part.keep, part.pitch_hz) for part in parts if part.clip
    ]
    standing = [(part.earlier, part.group) for part in parts if part.clip is None and part.earlier is not None]
    with one_blas_thread:
        plans = await asyncio.to_thread(plan_scene, sources, config.tactile, config.actuator, config.spread, standing)
        made = await _made(parts, plans, config, tell)
    if any({"actuator", *_NEW}.intersection(reasons) for _, reasons in made):
        _warn_of_other_actuator(parts, config.actuator)
    loops: dict[str, dict[str, HapticLoop]] = {}
    for part, (loop, reasons) in zip(parts, made, strict=True):
        loops.setdefault(part.object_id, {})[part.state.name] = loop
        if reasons:
            sounds.remade.setdefault(part.object_id, {})[part.state.name] = reasons
    _warn_of_lost_edits(before.loops, loops)
    for object_id, states in loops.items():
        known = before.loops.get(object_id)
        sounds.loops[object_id] = known if known is not None and _is_same(known, states) else states
    return sounds


def _warn_of_other_actuator(parts: Sequence[StateSound], actuator: ActuatorProfile) -> None:
    """Warn of locked loops that were made for another actuator. Warns: BundleWarning."""
    now = actuator_digest(actuator)
    others = dict.fromkeys(
        part.object_id
        for part in parts
        if part.clip is None and part.earlier is not None and part.earlier.fingerprint.get("actuator", now) != now
    )
    if others:
        named = ", ".join(map(repr, others))
        warn_of(
            f"locked loops are kept, which were made for another actuator than {actuator.name!r}: {named}. "
            "They may be felt too strongly or too weakly. Unlock these objects, or use the earlier actuator.",
            BundleWarning,
        )


def _warn_of_lost_edits(
    earlier: Mapping[str, Mapping[str, HapticLoop]], now: Mapping[str, Mapping[str, HapticLoop]]
) -> None:
    """Warn of loops that were edited by hand, and are made again or removed. Warns: BundleWarning."""
    lost = [
        key
        for key, states in earlier.items()
        if any(
            is_edited(loop) and not _has_samples_of(loop, now.get(key, {}).get(name)) for name, loop in states.items()
        )
    ]
    if lost:
        warn_of(
            f"loops that were edited by hand are made again or removed, and the edits are lost: {first_of(lost, 5)}. "
            "`scene2hap edit BUNDLE undo` restores them. To keep such a loop, lock its object before.",
            BundleWarning,
        )


def _has_samples_of(earlier: HapticLoop, now: HapticLoop | None) -> bool:
    return now is not None and now.tactile is earlier.tactile


async def _made(
    parts: Sequence[StateSound], plans: Sequence[Plan], config: BakeConfig, tell: Progress
) -> list[tuple[HapticLoop, tuple[str, ...]]]:
    """Return the loops of each part, and why they were made. Several threads work at once, one per loop."""
    n_threads = N_THREADS.get() or min(_MOST_THREADS, os.cpu_count() or 1)
    maker, gate = _Maker(config), asyncio.Semaphore(n_threads)

    async def one(part: StateSound, plan: Plan | None) -> tuple[HapticLoop, tuple[str, ...]]:
        if part.clip is None or plan is None:
            assert part.earlier is not None  # a part without a clip has an earlier loop
            return part.earlier, _UNCHANGED
        async with gate:
            return await asyncio.to_thread(maker.loop, part, part.clip, plan)

    planned = iter(plans)
    tasks = [asyncio.create_task(one(part, next(planned) if part.clip is not None else None)) for part in parts]
    made = []
    try:
        for done, (part, task) in enumerate(zip(parts, tasks, strict=True), start=1):
            loop, reasons = await task
            made.append((loop, reasons))
            why = f" ({', '.join(reasons)})" if reasons and reasons != _NEW else ""
            tell("touch", f"{part.object_id}{why}", done, len(parts))
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
    return made


def _is_same(states: Mapping[str, HapticLoop], others: Mapping[str, HapticLoop]) -> bool:
    return list(states) == list(others) and all(states[name] is others[name] for name in states)


class _Maker:
    """Make the loops of each sound; equal ones are made once. Threads may share it."""

    def __init__(self, config: BakeConfig) -> None:
        self._config = config
        self._made: dict[tuple[int, Plan], HapticLoop] = {}
        self._names: dict[tuple[int, Plan], dict[str, str]] = {}
        self._turns: dict[tuple[int, Plan], Lock] = {}
        self._lock = Lock()
        self._converter = converter_name(config.tactile)

    def loop(self, part: StateSound, clip: AudioClip, plan: Plan) -> tuple[HapticLoop, tuple[str, ...]]:
        """Return the loops of a state, and why they were made; () if the earlier ones were reused."""
        key = id(clip), plan
        with self._lock:
            turn = self._turns.setdefault(key, Lock())
        with turn:
            return self._loop(part, clip, plan, key)

    def _loop(
        self, part: StateSound, clip: AudioClip, plan: Plan, key: tuple[int, Plan]
    ) -> tuple[HapticLoop, tuple[str, ...]]:
        if key not in self._names:
            self._names[key] = made_by(clip, self._converter, plan)
        fingerprint = {**part.request, **self._names[key]}
        reasons = differences(part.earlier.fingerprint, fingerprint) if part.earlier is not None else _NEW
        if part.earlier is not None and (not reasons or _is_edited_beside_others(part, reasons)):
            # The loop itself may have been edited by hand, and stays.
            fingerprint |= {name: digest for name in LOOPS if (digest := part.earlier.fingerprint.get(name))}
            unchanged = dict(part.earlier.fingerprint) == fingerprint and runs_of(part.earlier) == part.runs
            return part.earlier if unchanged else _as_of(part, part.earlier, fingerprint), _UNCHANGED
        if key not in self._made:
            try:
                made = felt_loop(clip, self._config.tactile, plan)
            except AudioError as cause:
                raise type(cause)(f"{part.object_id!r}, state {part.state.name!r}: {cause}") from cause
            # Rounded as in the folder, so that a bundle equals the one that is read back, and plays on over it.
            self._made[key] = replace(made, audible=as_stored(made.audible), tactile=as_stored(made.tactile))
        # A person's own clip is stored with the override. Without that override, another sound must be chosen.
        source = None if part.request["words"] == OWN_CLIP else clip
        fingerprint |= loop_digests(self._made[key])
        return replace(_as_of(part, self._made[key], fingerprint), source=source), reasons


def _is_edited_beside_others(part: StateSound, reasons: tuple[str, ...]) -> bool:
    """Return True for a loop that a person edited by hand, if only the places of other sources have changed."""
    if reasons != ("plan",) or part.earlier is None or not is_edited(part.earlier):
        return False
    return part.earlier.fingerprint.get(CORRECTIONS, "") == part.request[CORRECTIONS]


def _as_of(part: StateSound, loop: HapticLoop, fingerprint: Mapping[str, str]) -> HapticLoop:
    start_up, wind_down = part.runs
    return replace(loop, fingerprint=fingerprint, start_up=start_up, wind_down=wind_down)


def _pitch_hz(object_id: str, state: str, overrides: Mapping[str, Override], config: BakeConfig) -> float | None:
    """Return the pitch that a person requests [Hz], moved into the actuator's band; None if none.

    Warns: BundleWarning: it was moved, or the converter does not move sources.
    """
    override, actuator = overrides.get(object_id), config.actuator
    wanted_hz = override.pitch_of(state) if override is not None else None
    if override is None or wanted_hz is None or override.locked:
        return None
    limits = f"pitch_hz of {object_id!r} is {wanted_hz:g} Hz; "
    if not follows_target(config.tactile):
        name = type(config.tactile).__name__
        warn_of(f"{limits}{name} does not move sources. Use the converter 'adaptive'.", BundleWarning)
        return None
    played_hz = in_band_hz(wanted_hz, actuator)
    if played_hz != wanted_hz:
        limits += (
            f"the actuator {actuator.name!r} plays {actuator.min_frequency_hz:g} to {actuator.max_frequency_hz:g} Hz"
        )
        warn_of(f"{limits}. The loop is at {played_hz:g} Hz.", BundleWarning)
    return played_hz


def in_band_hz(wanted_hz: float, actuator: ActuatorProfile) -> float:
    """Return the frequency nearest to a pitch that is in the actuator's band [Hz]."""
    return min(max(wanted_hz, actuator.min_frequency_hz), actuator.max_frequency_hz)
