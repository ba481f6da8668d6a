"""A person's corrections of the inferred data of an object, kept when the scene is baked again."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.encoding import as_stored
from scene2hap.clips.haptic_clip import HapticClip
from scene2hap.clips.reading import as_vibration, read_any_clip
from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.common.warning import warn_of
from scene2hap.errors import BundleError, CallError
from scene2hap.haptics import LONGEST_PASSAGE_S, ObjectHaptics, SourceState, checked_mass_kg
from scene2hap.materials import Material, lookup
from scene2hap.scene.surface.plate_sizes import THINNEST_M, with_thickness

USER = "user"
"""Provenance of an overridden field."""

ANY_STATE = "*"
"""Key for all states of an object that have no entry of their own."""

MAKES_LOOPS = frozenset({"name", "vibrates", "clip", "keep", "intensity", "pitch_hz"})
"""Fields that decide how loops are made. They cannot change while an object is locked."""

_OF_STATES = ("intensity", "start_up_s", "wind_down_s")
"""Fields with a number for each state that replace a field of `SourceState`."""

_LEAST_GAIN_DB, _MOST_GAIN_DB = -120.0, 60.0
"""Bounds of a level [dB]; the lower one is that of 20 bits (assumed: whoever wants less wants silence)."""
_USUAL_DB = 40.0
"""Usual bound of a gain [dB]: a factor of 100, more than from the weakest to the strongest felt vibration."""
_THICKEST_M = 10.0
"""Largest thickness [m] (assumed: more than any wall, and less than most numbers that are meant in millimetres)."""
_LONGEST_NAME = 200
"""Most characters of a name (assumed: three times the longest name that a designer gives; a model reads it)."""
_BOUNDS: Mapping[str, Mapping[str, Any]] = {
    "intensity": {"unit": "-", "above": 0.0, "at_most": 1.0},
    # Frequencies that hands feel as a pitch; also the band of an actuator without a profile.
    "pitch_hz": {"unit": "Hz", "at_least": 10.0, "at_most": 1000.0},
    "start_up_s": {"unit": "s", "at_least": 0.0, "at_most": LONGEST_PASSAGE_S},
    "wind_down_s": {"unit": "s", "at_least": 0.0, "at_most": LONGEST_PASSAGE_S},
}
BY_STATE = tuple(_BOUNDS)
"""Fields with a number for each state."""


@clear_construction
@dataclass(frozen=True)
class Override:
    """A person's correction of one object. A field of None keeps the inferred value.

    vibrates : True if the object vibrates by itself.
    gain_db : its level at the hand, relative to the inferred one, -120..60 [dB].
    mass_kg : mass of the whole object [kg].
    thickness_m : thickness of its main surface, such as the sheet of a cabinet that was measured as a solid block,
        2e-5..10 [m]. `HapticBundle.override` also checks it against the measured size.
    feet : the material of its feet, in the same forms.
    name : what it is, such as "washing machine". Inference reads this instead of the authored name.
    material : its material, the constants of one by name, or a name in the table.
    clip : the sound from which its vibration is made, in every state, or the path of its file. A haptic clip (.haptic,
        .ahap) is played unchanged. keep : True if that sound keeps its own frequency and level; the scene's other
        sources are then moved away from it, in frequency and level.
    locked : True if its loops stay unchanged in every later bake.
    intensity : of the vibration at the object itself, above 0, up to 1 [-]; pitch_hz : the frequency of its vibration,
        10..1000 [Hz]; start_up_s, wind_down_s : its start and stop times, 0..30 [s]. Each is a number for all states or
        a mapping by state.
    state : its state at the start; muted : True if it is silent until a game unmutes it.
    Raises: BundleError: a field of another type or out of bounds. UnknownMaterial.
    """

    vibrates: bool | None = None
    gain_db: float | None = None
    material: Material | None = None
    clip: AudioClip | None = None
    keep: bool = True
    locked: bool = False
    intensity: Mapping[str, float] = field(default_factory=dict)
    pitch_hz: Mapping[str, float] = field(default_factory=dict)
    state: str | None = None
    muted: bool = False
    mass_kg: float | None = None
    thickness_m: float | None = None
    feet: Material | None = None
    start_up_s: Mapping[str, float] = field(default_factory=dict)
    wind_down_s: Mapping[str, float] = field(default_factory=dict)
    name: str | None = None

    def __post_init__(self) -> None:
        if self.vibrates is not None and not isinstance(self.vibrates, bool):
            raise BundleError(f"vibrates is {checks.represented(self.vibrates)}; it must be True, False or None.")
        for name in ("keep", "locked", "muted"):
            checks.flag(name, getattr(self, name), error=BundleError)
        for name in _BOUNDS:
            object.__setattr__(self, name, _by_state(name, getattr(self, name)))
        for name in ("state", "name"):
            if getattr(self, name) is not None:
                checks.text(name, getattr(self, name), error=BundleError)
        if self.name is not None and not 0 < len(self.name.strip()) <= _LONGEST_NAME:
            raise BundleError(
                f"name has {len(self.name.strip())} characters; it must have 1 to {_LONGEST_NAME}, and say what the "
                "object is, such as 'washing machine'."
            )
        if self.gain_db is not None:
            gain = checks.number("gain_db", self.gain_db, "dB", at_most=_MOST_GAIN_DB, error=BundleError)
            hint = "For silence mute it: muted=True, or `scene2hap edit BUNDLE mute ID`."
            checks.number("gain_db", gain, "dB", at_least=_LEAST_GAIN_DB, error=BundleError, hint=hint)
            object.__setattr__(self, "gain_db", gain)
        if self.mass_kg is not None:
            object.__setattr__(self, "mass_kg", checked_mass_kg(self.mass_kg, BundleError))
        if self.thickness_m is not None:
            thickness_m = checks.number(
                "thickness_m", self.thickness_m, "m", at_least=THINNEST_M, at_most=_THICKEST_M, error=BundleError
            )
            object.__setattr__(self, "thickness_m", thickness_m)
        for name in ("material", "feet"):
            given = getattr(self, name)
            if isinstance(given, str):
                object.__setattr__(self, name, lookup(given))
            elif isinstance(given, Mapping):
                object.__setattr__(self, name, _of_constants(name, given))
            elif given is not None and not isinstance(given, Material):
                raise BundleError(
                    f"{name} is {checks.represented(given)}; it must be a Material, its constants, or a name in the "
                    "table."
                )
        if isinstance(self.clip, str | os.PathLike):
            object.__setattr__(self, "clip", read_any_clip(self.clip))
        elif isinstance(self.clip, HapticClip):
            object.__setattr__(self, "clip", as_vibration(self.clip))
        if self.clip is not None and not isinstance(self.clip, AudioClip):
            raise BundleError(
                f"clip is {checks.described(self.clip)}; it must be an AudioClip, a HapticClip, or the path of a file."
            )
        if self.clip is not None:  # The intensity sets the level, so a sound beyond full scale is only scaled.
            object.__setattr__(self, "clip", as_stored(self.clip))

    def changed(self, changes: Mapping[str, Any]) -> Override:
        """Replace the fields that are not None. Numbers by state are added to earlier ones."""
        now = replace(self, **{name: value for name, value in changes.items() if value is not None})
        by_state: dict[str, Any] = {name: _on_top(getattr(self, name), getattr(now, name)) for name in BY_STATE}
        return replace(now, **by_state)

    def corrections(self) -> dict[str, Any]:
        """Return the fields that correct something, by name."""
        given = {one.name: getattr(self, one.name) for one in fields(self)}
        return {name: value for name, value in given.items() if value != getattr(NONE, name)}

    def pitch_of(self, state: str) -> float | None:
        """Return the corrected frequency of a state's vibration [Hz], None if it is not overridden."""
        return self.pitch_hz.get(state, self.pitch_hz.get(ANY_STATE))

    def applied(self, haptics: ObjectHaptics) -> ObjectHaptics:
        """Apply these corrections to inferred haptics. An object made to vibrate gets its state in the next bake."""
        provenance = dict(haptics.provenance)
        if self.material is not None:
            provenance |= {"material": USER, "material_category": USER}
            # Earlier versions stored no thickness for a sheet of unknown material, but propagation needs one.
            size_m = with_thickness(haptics.estimated_size_m)
            haptics = replace(
                haptics, material=self.material, material_category=self.material.name, estimated_size_m=size_m
            )
        if self.thickness_m is not None:
            provenance["estimated_size_m"] = USER
            length_m, width_m, _ = haptics.estimated_size_m
            haptics = replace(haptics, estimated_size_m=(length_m, width_m, self.thickness_m))
        if self.feet is not None:
            provenance["feet"] = USER
            haptics = replace(haptics, feet=self.feet)
        if self.mass_kg is not None:
            provenance["mass_kg"] = USER
            haptics = replace(haptics, mass_kg=self.mass_kg)
        if self.vibrates is False:
            provenance["vibrates"] = USER
            haptics = replace(haptics, vibrates=False, states=())
        elif self.vibrates and haptics.states:
            provenance["vibrates"] = USER
        for name in _OF_STATES:
            if getattr(self, name) and haptics.states:
                provenance[name] = USER
                haptics = replace(haptics, states=tuple(self._corrected(state, name) for state in haptics.states))
        if self.state is not None:
            haptics = replace(haptics, states=tuple(sorted(haptics.states, key=lambda one: one.name != self.state)))
        return replace(haptics, provenance=provenance)

    def _corrected(self, state: SourceState, name: str) -> SourceState:
        given: Mapping[str, float] = getattr(self, name)
        changes: dict[str, Any] = {name: given.get(state.name, given.get(ANY_STATE))}
        return state if changes[name] is None else replace(state, **changes)


def _of_constants(name: str, constants: Mapping[str, Any]) -> Material:
    try:
        return Material(**{str(field): value for field, value in constants.items()})
    except CallError as cause:
        known = ", ".join(one.name for one in fields(Material))
        raise BundleError(
            f"{name} has {', '.join(map(str, constants)) or 'no field'}; the fields of a material are {known}. Only "
            "loss_factor may be left out."
        ) from cause


def _by_state(name: str, value: object) -> dict[str, float]:
    """Return numbers by state, `ANY_STATE` for one number. Raises: BundleError: another type, or out of bounds."""
    given = value if isinstance(value, Mapping) else {ANY_STATE: value}
    return {
        checks.text(f"state of {name}", state, error=BundleError): checks.number(
            name if state == ANY_STATE else f"{name}[{state!r}]", number, error=BundleError, **_BOUNDS[name]
        )
        for state, number in given.items()
    }


def _on_top(earlier: Mapping[str, float], later: Mapping[str, float]) -> Mapping[str, float]:
    return later if ANY_STATE in later else {**earlier, **later}


NONE = Override()
"""No correction."""


def answers_before(
    objects: Mapping[str, ObjectHaptics], overrides: Mapping[str, Override], known: Mapping[str, ObjectHaptics]
) -> dict[str, ObjectHaptics]:
    """Return what was inferred of each object that a person corrects. An object that was corrected before has its
    known answer, or none if it is unknown."""
    answers = {}
    for key, wish in overrides.items():
        haptics = known.get(key, objects.get(key))
        is_corrected = haptics is None or USER in haptics.provenance.values() or "name" in haptics.reasons
        if haptics is not None and wish != NONE and not is_corrected:
            answers[key] = haptics
    return answers


def warn_if_percent(gain_db: float) -> None:
    """Warn of a level above `_USUAL_DB` [dB], which is probably a percentage. Warns: SceneWarning."""
    if gain_db > _USUAL_DB:
        warn_of(
            f"gain_db is {gain_db:g} dB, a factor of {10 ** (gain_db / 20):.3g}, more than {_USUAL_DB:g} dB; it is in "
            "decibels, not in percent: 0 leaves the level, 6 doubles it, -6 halves it."
        )
