"""The sound of each state of a vibrating object: a person's own, an earlier bundle's, or the best of the sources.

States with equal requests share the sound.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.encoding import as_stored, sound_digest
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.loops import middle_of, without_silent_ends
from scene2hap.audio.protocol import NamedSounds
from scene2hap.audio.recorded_runs import recorded_runs
from scene2hap.audio.select import Choice, explain_choice
from scene2hap.audio.sources.chain import gather
from scene2hap.baking.config import BakeConfig
from scene2hap.baking.fingerprint import OWN_CLIP, request_digests
from scene2hap.baking.own_words import own_word
from scene2hap.baking.recorded_times import NO_RUNS, Runs, runs_of, shown_runs
from scene2hap.bundle import Override
from scene2hap.errors import AudioError
from scene2hap.haptics import ObjectHaptics, SourceState, VibrationDescription


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


_REPEATED_S = 3.0


@dataclass(frozen=True, eq=False)
class StateSound:
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


class SoundChooser:
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

    def part(self, object_id: str, haptics: ObjectHaptics, state: SourceState) -> tuple[StateSound, str]:
        """Return the state with its sound, and the reason for the choice ("" without a choice)."""
        override, group = self._overrides.get(object_id), haptics.object_category
        before = self._earlier.loops.get(object_id, {}).get(state.name)
        if override is not None and override.locked and before is not None:
            why = self._earlier.choices.get(object_id, {}).get(state.name, "")
            return StateSound(object_id, state, group, None, {}, before), why
        if override is not None and override.clip is not None:
            if object_id not in self._own:
                self._own[object_id] = _own(override.clip)
            clip, runs = self._own[object_id]
            request = {"words": OWN_CLIP, "sources": OWN_CLIP}
            shown = shown_runs(runs, state, before)
            return StateSound(object_id, state, group, clip, request, before, override.keep, runs=shown), ""
        before_corrected = self._inferred.get(object_id, haptics)
        as_inferred = next((one for one in before_corrected.states if one.name == state.name), state)
        description = self._description(object_id, before_corrected, as_inferred)
        request = request_digests(description, self._config)
        if before is not None and object_id not in self._earlier.chosen_again:
            why = self._earlier.choices.get(object_id, {}).get(state.name, "")
            if not before.fingerprint:
                repeated = None if self._earlier.any_making else _prepared(_repeated(before.audible))
                return StateSound(object_id, state, group, repeated, request, before, runs=runs_of(before)), why
            if self._holds(before.fingerprint, request):
                clip = before.source or _prepared(_repeated(before.audible))  # None if the file was removed
                request = {**request, "sources": before.fingerprint.get("sources", "")}
                return StateSound(object_id, state, group, clip, request, before, runs=runs_of(before)), why
        if (name := self._names.get(object_id, "")).casefold() in self._named:
            description = replace(description, name=name)
        if description not in self._chosen:
            choice = self._choose(object_id, description)
            runs = choice.start_up, choice.wind_down
            # Objects that differ in their authors' names alone share the loops of a sound that suits both.
            key = replace(description, own_word="", name=""), sound_digest(choice.winner)
            self._chosen[description] = self._clips.setdefault(key, _prepared(choice.winner)), str(choice), runs
        clip, why, runs = self._chosen[description]
        return StateSound(object_id, state, group, clip, request, before, runs=shown_runs(runs, state, before)), why

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
