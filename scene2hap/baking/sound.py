"""Sounds for each state of each vibrating object: found or synthesized, chosen, looped, and converted into vibration.

Equal work is done once: states with equal requests share the sound, and states with equal conversions share the loops.
A loop of an earlier bundle is reused if its fingerprint is unchanged.
"""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import suppress
from contextvars import ContextVar
from dataclasses import dataclass, field, replace
from functools import cached_property
from threading import Lock

import numpy as np

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.encoding import as_stored, sound_digest
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.loops import middle_of, without_silent_ends
from scene2hap.audio.protocol import NamedSounds, follows_target
from scene2hap.audio.recorded_runs import recorded_runs
from scene2hap.audio.scene_loops import Plan, SourceClip, felt_loop, plan_scene
from scene2hap.audio.select import Choice, explain_choice
from scene2hap.audio.sources.chain import gather
from scene2hap.baking.config import BakeConfig
from scene2hap.baking.fingerprint import (
    OWN_CLIP,
    actuator_digest,
    converter_name,
    differences,
    made_by,
    request_digests,
)
from scene2hap.baking.own_words import own_word
from scene2hap.baking.recorded_times import NO_RUNS, Runs, runs_of, shown_runs
from scene2hap.bundle import BundleWarning, Override
from scene2hap.bundle.edited_loops import LOOPS, is_edited, loop_digests
from scene2hap.bundle.pending_corrections import CORRECTIONS, corrections_digest
from scene2hap.common.blas_threads import one_blas_thread
from scene2hap.common.counted import first_of
from scene2hap.common.warning import warn_of
from scene2hap.errors import AudioError
from scene2hap.haptics import ActuatorProfile, ObjectHaptics, SourceState, VibrationDescription

Progress = Callable[[str, str, int, int], None]
"""Called with (stage, step, number done, total number)."""


def no_progress(stage: str, step: str, n_done: int, n: int) -> None:
    """Ignore progress."""


Remade = Mapping[str, Mapping[str, tuple[str, ...]]]
"""Reasons why each loop was made, by id and state: parts of its fingerprint, or "new"."""

_REPEATED_S = 3.0
_MOST_THREADS = 4
"""Assumed: each thread holds the spectra of a clip, some 100 MB, and Python code runs in one thread at a time."""
N_THREADS: ContextVar[int] = ContextVar("N_THREADS", default=0)
"""Number of loops made at once; 0 for one per processor. Fewer are useful if other processes bake at the same time."""
_NEW: tuple[str, ...] = ("new",)
_UNCHANGED: tuple[str, ...] = ()


@dataclass(frozen=True)
class EarlierLoops:
    """Loops and sounds of an earlier bundle, and limits on their reuse.

    chosen_again : objects whose sounds are chosen again; any_source : keep sounds even if the sound sources have
    changed; any_making : leave loops without a fingerprint unchanged.
    """

    loops: Mapping[str, Mapping[str, HapticLoop]] = field(default_factory=dict)
    choices: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    chosen_again: Collection[str] = ()
    any_source: bool = True
    any_making: bool = True


@dataclass(frozen=True)
class Sounds:
    """Loops by object and state, the reason for each choice of a sound, and the reason why each loop was made."""

    loops: dict[str, Mapping[str, HapticLoop]] = field(default_factory=dict)
    choices: dict[str, dict[str, str]] = field(default_factory=dict)
    remade: dict[str, dict[str, tuple[str, ...]]] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class _Part:
    """One state of one source, with its sound. Without a sound, its earlier loop stays unchanged. `runs` are its
    recorded start and stop."""

    object_id: str
    state: SourceState
    group: str
    clip: AudioClip | None
    request: Mapping[str, str]
    earlier: HapticLoop | None
    keep: bool = False
    pitch_hz: float | None = None
    runs: Runs = NO_RUNS


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
    sounds, chooser = Sounds(), _Chooser(config, overrides, before, inferred or objects, names or {})
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


def _warn_of_other_actuator(parts: Sequence[_Part], actuator: ActuatorProfile) -> None:
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
    parts: Sequence[_Part], plans: Sequence[Plan], config: BakeConfig, tell: Progress
) -> list[tuple[HapticLoop, tuple[str, ...]]]:
    """Return the loops of each part, and why they were made. Several threads work at once, one per loop."""
    n_threads = N_THREADS.get() or min(_MOST_THREADS, os.cpu_count() or 1)
    maker, gate = _Maker(config), asyncio.Semaphore(n_threads)

    async def one(part: _Part, plan: Plan | None) -> tuple[HapticLoop, tuple[str, ...]]:
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


class _Chooser:
    """Find the sound of each state: a person's own, the earlier bundle's, or the best one from the sources."""

    def __init__(
        self,
        config: BakeConfig,
        overrides: Mapping[str, Override],
        earlier: EarlierLoops,
        inferred: Mapping[str, ObjectHaptics],
        names: Mapping[str, str],
    ) -> None:
        self._config, self._overrides, self._earlier, self._inferred = config, overrides, earlier, inferred
        self._names = names
        self._chosen: dict[VibrationDescription, tuple[AudioClip, str, Runs]] = {}
        self._clips: dict[tuple[VibrationDescription, str], AudioClip] = {}
        self._own: dict[str, tuple[AudioClip, Runs]] = {}

    def part(self, object_id: str, haptics: ObjectHaptics, state: SourceState) -> tuple[_Part, str]:
        """Return the state with its sound, and the reason for the choice ("" without a choice)."""
        override, group = self._overrides.get(object_id), haptics.object_category
        before = self._earlier.loops.get(object_id, {}).get(state.name)
        if override is not None and override.locked and before is not None:
            why = self._earlier.choices.get(object_id, {}).get(state.name, "")
            return _Part(object_id, state, group, None, {}, before), why
        if override is not None and override.clip is not None:
            if object_id not in self._own:
                self._own[object_id] = _own(override.clip)
            clip, runs = self._own[object_id]
            request = {"words": OWN_CLIP, "sources": OWN_CLIP}
            shown = shown_runs(runs, state, before)
            return _Part(object_id, state, group, clip, request, before, override.keep, runs=shown), ""
        before_corrected = self._inferred.get(object_id, haptics)
        as_inferred = next((one for one in before_corrected.states if one.name == state.name), state)
        description = self._description(object_id, before_corrected, as_inferred)
        request = request_digests(description, self._config)
        if before is not None and object_id not in self._earlier.chosen_again:
            why = self._earlier.choices.get(object_id, {}).get(state.name, "")
            if not before.fingerprint:
                repeated = None if self._earlier.any_making else _prepared(_repeated(before.audible))
                return _Part(object_id, state, group, repeated, request, before, runs=runs_of(before)), why
            if self._holds(before.fingerprint, request):
                clip = before.source or _prepared(_repeated(before.audible))  # None if the file was removed
                request = {**request, "sources": before.fingerprint.get("sources", "")}
                return _Part(object_id, state, group, clip, request, before, runs=runs_of(before)), why
        if (name := self._names.get(object_id, "")).casefold() in self._named:
            description = replace(description, name=name)
        if description not in self._chosen:
            choice = self._choose(object_id, description)
            runs = choice.start_up, choice.wind_down
            # Objects that differ in their authors' names alone share the loops of a sound that suits both.
            key = replace(description, own_word="", name=""), sound_digest(choice.winner)
            self._chosen[description] = self._clips.setdefault(key, _prepared(choice.winner)), str(choice), runs
        clip, why, runs = self._chosen[description]
        return _Part(object_id, state, group, clip, request, before, runs=shown_runs(runs, state, before)), why

    @cached_property
    def _named(self) -> frozenset[str]:
        """Names of sounds. Descriptions leave out all other names, so that objects of one type share a search."""
        found: set[str] = set()
        for source in self._config.audio:
            if isinstance(source, NamedSounds):
                # Plug-ins may raise anything. `gather` warns of a source that fails, and queries the next one.
                with suppress(Exception):
                    found |= source.names()
        return frozenset(found)

    def _holds(self, fingerprint: Mapping[str, str], request: Mapping[str, str]) -> bool:
        parts = ("words",) if self._earlier.any_source else ("words", "sources")
        return all(fingerprint.get(part) == request[part] for part in parts)

    def _choose(self, object_id: str, description: VibrationDescription) -> Choice:
        config = self._config
        candidates = gather(object_id, description, config.audio, enough=config.enough_candidates)
        try:
            return explain_choice(candidates)
        except AudioError as cause:
            raise AudioError(
                f"no sound for {object_id!r} ({description.keywords!r}): {cause} Or add the synthesizer (kind 'synth') "
                "as the last source."
            ) from cause

    def _description(self, object_id: str, haptics: ObjectHaptics, state: SourceState) -> VibrationDescription:
        return VibrationDescription(
            object_category=haptics.object_category,
            state=state.name,
            sentence=state.sentence,
            keywords=state.keywords,
            intensity=state.intensity,
            size_m=haptics.estimated_size_m,
            material=haptics.material_category,
            seed=self._config.seed,
            own_word=own_word(self._names.get(object_id, ""), haptics.object_category),
        )


class _Maker:
    """Make the loops of each sound; equal ones are made once. Threads may share it."""

    def __init__(self, config: BakeConfig) -> None:
        self._config = config
        self._made: dict[tuple[int, Plan], HapticLoop] = {}
        self._names: dict[tuple[int, Plan], dict[str, str]] = {}
        self._turns: dict[tuple[int, Plan], Lock] = {}
        self._lock = Lock()
        self._converter = converter_name(config.tactile)

    def loop(self, part: _Part, clip: AudioClip, plan: Plan) -> tuple[HapticLoop, tuple[str, ...]]:
        """Return the loops of a state, and why they were made; () if the earlier ones were reused."""
        key = id(clip), plan
        with self._lock:
            turn = self._turns.setdefault(key, Lock())
        with turn:
            return self._loop(part, clip, plan, key)

    def _loop(
        self, part: _Part, clip: AudioClip, plan: Plan, key: tuple[int, Plan]
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


def _is_edited_beside_others(part: _Part, reasons: tuple[str, ...]) -> bool:
    """Return True for a loop that a person edited by hand, if only the places of other sources have changed."""
    if reasons != ("plan",) or part.earlier is None or not is_edited(part.earlier):
        return False
    return part.earlier.fingerprint.get(CORRECTIONS, "") == part.request[CORRECTIONS]


def _as_of(part: _Part, loop: HapticLoop, fingerprint: Mapping[str, str]) -> HapticLoop:
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


def _own(clip: AudioClip) -> tuple[AudioClip, Runs]:
    """Return the steady part of a person's clip, as stored in a bundle, and its recorded start and stop."""
    if clip.is_vibration:
        return _prepared(clip), NO_RUNS
    found = recorded_runs(clip.samples, clip.sample_rate_hz, clip.loop)
    steady = without_silent_ends(middle_of(clip.part(found.first, found.end)))
    return as_stored(steady), (found.start_up, found.wind_down)


def _prepared(clip: AudioClip) -> AudioClip:
    """Return the part of a clip from which loops are cut, rounded as in a bundle, so that loops are reproducible."""
    return as_stored(clip if clip.is_vibration else middle_of(clip))


def _repeated(loop: AudioClip) -> AudioClip:
    """Repeat a loop into a clip that is long enough to be cut again: at least twice, and for three seconds."""
    times = max(2, int(np.ceil(_REPEATED_S / loop.duration_s)))
    return replace(loop, samples=np.tile(loop.samples, times))
