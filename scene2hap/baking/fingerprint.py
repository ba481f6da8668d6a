"""Fingerprint of a loop: one digest for each of its inputs. If one differs, the loop is made again.

sound      the clip before it was cut
words      the request for the sound: category, state, sentence, keywords, seed
sources    the sound sources, in their order, and how many candidates were enough
converter  kind and settings
actuator   the profile
intensity  of the state
plan       the source's place among the others: frequencies and level
loop, audible  the tactile and the audible loop that were made; show that a person edited them (`bundle.edited_loops`)
corrections  a person's sound, intensity and pitch; shows that a correction is not baked yet

If `words` or `sources` differ, a sound is chosen again. If another digest differs, its loops are made again.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, fields, is_dataclass
from hashlib import sha256
from importlib.metadata import entry_points
from typing import Any

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.encoding import sound_digest
from scene2hap.audio.scene_loops import Plan
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.baking.config import BakeConfig
from scene2hap.haptics import ActuatorProfile, VibrationDescription

OWN_CLIP = "own clip"
"""Replaces the digests of words and sources if a person gave the sound."""

_MADE_BY = ("sound", "converter", "actuator", "intensity", "plan")
_NO_FINGERPRINT = "no fingerprint"


def request_digests(description: VibrationDescription, config: BakeConfig) -> dict[str, str]:
    """Return the digests that decide which sound is chosen: of the words and of the sound sources."""
    words = (description.object_category, description.state, description.sentence, description.keywords)
    sources = [described(source) for source in config.audio]
    return {
        "words": _name([*words, description.seed]),
        "sources": _name([*sources, config.enough_candidates]),
    }


def converter_name(converter: object) -> str:
    """Return the digest of a converter and its settings. Takes milliseconds, since it searches installed packages."""
    return _name([converter_settings(converter), described(converter)])


def made_by(clip: AudioClip, converter: str, plan: Plan) -> dict[str, str]:
    """Return the digests that decide how the loops of a clip are made. `converter` comes from `converter_name`."""
    context = plan.context
    # A converter with a given target does not need the other sources' frequencies.
    neighbours_hz = () if context.target_hz is not None else sorted(context.neighbours_hz)
    some = [value for value in (context.rough_hz, context.band_q) if value is not None]
    places = [context.own_hz, context.target_hz, plan.level_db, *some]
    return {
        "sound": sound_digest(clip),
        "converter": converter,
        "actuator": actuator_digest(context.actuator),
        "intensity": f"{context.intensity:g}",
        # Rounded to 0.01 Hz and 0.01 dB: machines differ in the last digits, and smaller differences cannot be felt.
        "plan": _name([_rounded(places), _rounded(neighbours_hz)]),
    }


def actuator_digest(actuator: ActuatorProfile) -> str:
    """Return the digest of an actuator."""
    return _name(asdict(actuator))


def differences(earlier: Mapping[str, str], now: Mapping[str, str]) -> tuple[str, ...]:
    """Return the inputs of a loop that differ. The plan follows from other inputs, so it is named only if alone."""
    if not earlier:
        return (_NO_FINGERPRINT,)
    found = tuple(part for part in _MADE_BY if earlier.get(part) != now[part])
    return found[:-1] if len(found) > 1 and found[-1] == "plan" else found


def converter_settings(converter: object) -> dict[str, Any]:
    """Return the configuration that builds a converter again, or only its class if it is not registered."""
    place = f"{type(converter).__module__}:{type(converter).__qualname__}"
    kinds = [kind for kind, value in CONVERTERS.builtins.items() if value == place]
    if not kinds:  # last, since reading the entry points of all installed packages takes some 10 ms
        guests = {entry.name: entry.value for entry in entry_points(group=CONVERTERS.name)}
        kinds = [kind for kind, value in guests.items() if value == place and kind not in CONVERTERS.builtins]
    if not kinds or not is_dataclass(converter):
        return {"class": place}
    settings = {field.name: getattr(converter, field.name) for field in fields(converter) if field.init}
    try:
        return {"kind": kinds[0], **json.loads(json.dumps(settings, allow_nan=False))}
    except (TypeError, ValueError):
        return {"class": place}


def described(part: object) -> str:
    """Return the `repr` of a part, or its class name: the default `repr` holds an address that differs in each run."""
    return type(part).__qualname__ if type(part).__repr__ is object.__repr__ else repr(part)


def _rounded(values: Any) -> list[str]:
    return ["" if value is None else f"{value:.2f}" for value in values]


def _name(document: Any) -> str:
    return sha256(json.dumps(document, sort_keys=True, default=str).encode()).hexdigest()[:16]
