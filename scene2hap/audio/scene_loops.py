"""The tactile loops of a whole scene: frequencies of all sources, and the level of each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from scene2hap.audio.actuators import equalize_loop
from scene2hap.audio.analysis import rhythm_hz
from scene2hap.audio.clip import AudioClip, Samples
from scene2hap.audio.felt_component import FeltComponent, felt_component_of
from scene2hap.audio.felt_component.bands import kept_band
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.levels import TACTILE_HEADROOM_DB, at_level, felt_level_db, sensation_level_db
from scene2hap.audio.loops import loop_pair
from scene2hap.audio.protocol import ConversionContext, TactileConverter, follows_target
from scene2hap.audio.sensation import Sensation
from scene2hap.audio.spreading import FeltSource, Placement, SpreadLimits, spread
from scene2hap.haptics import ActuatorProfile

_PEAK = 10 ** (-TACTILE_HEADROOM_DB / 20)


@dataclass(frozen=True, eq=False)
class SourceClip:
    """The chosen sound of one state of one source, with its intensity, above 0, up to 1 [-].

    group : sources of one group may feel alike: the states of an object, objects of one kind; keep : do not move its
    frequency; pitch_hz : the frequency to which it is moved, None for none. Other sources are moved away from a source
    with either.
    """

    clip: AudioClip
    intensity: float
    group: str = ""
    keep: bool = False
    pitch_hz: float | None = None


@dataclass(frozen=True)
class Plan:
    """The conversion of one source, and its planned sensation level [dB]."""

    context: ConversionContext
    level_db: float


def plan_scene(
    sources: Sequence[SourceClip],
    converter: TactileConverter,
    actuator: ActuatorProfile,
    limits: SpreadLimits | None = None,
    standing: Sequence[tuple[HapticLoop, str]] = (),
) -> tuple[Plan, ...]:
    """Return a plan for each source. Sources are moved apart within the limits if the converter follows targets.

    Parameters: standing : loops that do not change, with their groups; the sources are moved away from them, too.
    Raises: AudioError: an intensity that is not above 0, or is more than 1.
    """
    levels = [sensation_level_db(source.intensity) for source in sources]
    analysed = _analysed(sources, levels, actuator)
    follows = follows_target(converter)
    felt_sources = {
        i: FeltSource(
            source.pitch_hz or (component.felt_hz if follows else component.frequency_hz),
            level,
            source.group,
            component.crest_db,
            is_placed=source.keep or source.pitch_hz is not None,
            rhythm_hz=rhythm,
        )
        for i, (source, level, (component, rhythm)) in enumerate(zip(sources, levels, analysed, strict=True))
        if component is not None
    }
    fixed = [_standing_source(loop, group, actuator) for loop, group in standing]
    if follows:
        placed = dict(zip(felt_sources, spread([*felt_sources.values(), *fixed], actuator, limits), strict=False))
    else:
        placed = {i: Placement(one.own_hz, one.level_db) for i, one in felt_sources.items()}
    others = [(place.target_hz, sources[i].group) for i, place in placed.items()]
    others += [(one.own_hz, one.group) for one in fixed]
    neighbours_hz = {
        own: tuple(dict.fromkeys(frequency for frequency, group in others if group != own))
        for own in {source.group for source in sources}
    }
    plans = []
    for i, (source, (component, _)) in enumerate(zip(sources, analysed, strict=True)):
        context = ConversionContext(actuator, source.intensity, neighbours_hz[source.group])
        if component is None:
            plans.append(Plan(context, levels[i]))
        else:
            plans.append(Plan(component.added_to(context, placed[i].target_hz), placed[i].level_db))
    return tuple(plans)


def _analysed(
    sources: Sequence[SourceClip], levels: Sequence[float], actuator: ActuatorProfile
) -> list[tuple[FeltComponent | None, float | None]]:
    """Return felt component and rhythm [Hz] of each source; sources that share a clip and a level are analysed once."""
    known: dict[tuple[int, float], tuple[FeltComponent | None, float | None]] = {}
    for source, level in zip(sources, levels, strict=True):
        key, clip = (id(source.clip), level), source.clip
        if key not in known:
            component = felt_component_of(clip.samples, clip.sample_rate_hz, level, actuator)
            rhythm = None
            if component is not None:
                rhythm = component.rough_hz or _band_rhythm_hz(clip, component)
            known[key] = component, rhythm
    return [known[id(source.clip), level] for source, level in zip(sources, levels, strict=True)]


def _band_rhythm_hz(clip: AudioClip, component: FeltComponent) -> float | None:
    x, rate = clip.samples.astype(np.float64), clip.sample_rate_hz
    return rhythm_hz(kept_band(x, rate, component.frequency_hz, component.q), rate)


def _standing_source(loop: HapticLoop, group: str, actuator: ActuatorProfile) -> FeltSource:
    clip = loop.tactile
    level_db = felt_level_db(clip.samples, clip.sample_rate_hz, actuator)
    rhythm = rhythm_hz(clip.samples, clip.sample_rate_hz)
    return FeltSource(loop.frequency_tactile_hz, level_db, group, is_placed=True, rhythm_hz=rhythm)


def felt_loop(clip: AudioClip, converter: TactileConverter, plan: Plan) -> HapticLoop:
    """Make the loops of a source; the tactile one is equalized for the actuator and has the planned level.

    The level is lower if a peak would exceed full scale less `TACTILE_HEADROOM_DB`.
    Raises: AudioError: the clip is too short, or the clip or its conversion is silent.
    """
    actuator, rate = plan.context.actuator, clip.sample_rate_hz

    def at_planned_level(samples: Samples) -> Samples:
        return at_level(equalize_loop(samples, rate, actuator), rate, plan.level_db, actuator, _PEAK)

    loop = loop_pair(clip, converter, plan.context, at_planned_level)
    level_db = felt_level_db(loop.tactile.samples, loop.tactile.sample_rate_hz, actuator)
    return replace(loop, felt=Sensation.of(level_db, plan.level_db, converter, plan.context))
