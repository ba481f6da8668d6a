"""Category, size and vibration of an object from its name, its size, and the names of its neighbours and chain."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from scene2hap.llm.answers import LONGEST_REASON, ObjectAnswer, StateAnswer
from scene2hap.llm.lexicon.masses import usual_mass_kg
from scene2hap.llm.lexicon.materials import make, painted_with
from scene2hap.llm.lexicon.name_checks import (
    MINIATURE,
    check_name,
    ground_plane,
    meant_abroad,
    mounted_on,
    owner_of_part,
)
from scene2hap.llm.lexicon.names import NameReading, read_name
from scene2hap.llm.lexicon.robot_chains import link_of_robot
from scene2hap.llm.lexicon.table import ObjectRow, StateRow, table
from scene2hap.llm.lexicon.words import SOUNDING
from scene2hap.scene.surface import plate_sizes

UNKNOWN = "unknown"

# Beyond three times the largest size, the scene's unit is doubtful. Assumed, wide enough for kits at double scale.
_GIANT = 3.0
_MINIATURE_TRUST = 0.8
_GIANT_TRUST = 0.5

_MOST_SHOWN = 100  # letters of a name in a reason
_LARGEST_M = 1e5  # the bound of ObjectAnswer; only a scene in a wrong unit has larger objects
_THINNEST_M = 1e-3  # a thinner plate is assumed to be modelled without thickness
_MINIATURE_MATERIAL = "plastic"  # assumed for all miniatures
_MINIATURE_THICKNESS_M = 2e-3  # assumed

# Nouns of the table that begin with a vowel when spoken: not "ufo", "ukulele", "uniform", "urinal", "usb stick" and
# "utensil rack", but "hourglass" and abbreviations that are spelt out.
_VOWEL_FIRST = re.compile(r"[aeio]|u(?!fo|k|ni|ri|sb|t)|hour|led\b|mri\b|x-ray")


@dataclass(frozen=True)
class ObjectFacts:
    """The data of an object in the scene: authored name, size of its dominant surface, and doubts about the size.

    `scene_category` is empty if unknown. `material_names` are the authored names of its surface materials, empty if
    unknown. `height_m` is the height of its lowest point above the scene's lowest point [m], None if unknown.
    `whole_m` are the edges of the box around the whole object [m], empty if unknown.
    `chain_names` are the names of all objects of its chain, empty without hinges; `n_in_series` is the number in its
    longest series.
    """

    name: str
    size_m: tuple[float, float, float]
    flags: Sequence[str] = ()
    scene_category: str = ""
    material_names: Sequence[str] = ()
    height_m: float | None = None
    whole_m: tuple[float, ...] = ()
    chain_names: Sequence[str] = ()
    n_in_series: int = 0


def judge(item: ObjectFacts, neighbour_names: Sequence[str] = ()) -> ObjectAnswer:
    """Return the Object Analyzer's answer. An unreadable name gives "unknown": silent and of low confidence."""
    length, width, thickness = (min(edge, _LARGEST_M) for edge in item.size_m)
    item = replace(item, size_m=(length, width, thickness))
    reading = read_name(item.name)
    reading = ground_plane(reading, item.whole_m, item.height_m) or reading
    link = link_of_robot(reading, item.chain_names, item.n_in_series)
    if link is not None and link[0].row is not None:
        return _as_real(item, link[0], link[0].row, neighbour_names, link[1])
    if reading.row is None:
        return _unknown(item, reading)
    row, why = reading.row, ""
    whole_m = item.whole_m or item.size_m
    owner = owner_of_part(reading, item.whole_m) or mounted_on(reading, whole_m) or meant_abroad(reading, whole_m)
    if owner is not None and owner[0].row is not None:
        (reading, why), row = owner, owner[0].row
    miniature = _miniature(reading, row, item.size_m)
    if miniature:
        return _as_miniature(item, reading, row, miniature)
    return _as_real(item, reading, row, neighbour_names, why)


def _unknown(item: ObjectFacts, reading: NameReading) -> ObjectAnswer:
    words = ", ".join(map(repr, reading.unread)) or "no word for an object"
    thickness = plate_sizes.with_thickness(item.size_m)[2]
    assumed = (
        "" if thickness == item.size_m[2] else f" It was measured without thickness; {thickness:.2g} m is assumed."
    )
    return ObjectAnswer(
        object_category=UNKNOWN,
        category_reason=_cut(
            f"the table of {len(table())} objects cannot tell: the name {_shown(item.name)} holds {words}."
        ),
        material_category=reading.material or painted_with(item.material_names) or UNKNOWN,
        estimated_length_m=item.size_m[0],
        estimated_width_m=item.size_m[1],
        estimated_thickness_m=thickness,
        size_reason=f"as measured; nothing to compare it with.{assumed}",
        usage=UNKNOWN,
        vibrates=False,
        vibration_reason="nothing is known about it, so it stays silent.",
        states=[],
        confidence=reading.confidence,
    )


def _as_real(
    item: ObjectFacts, reading: NameReading, row: ObjectRow, neighbour_names: Sequence[str], why_owner: str
) -> ObjectAnswer:
    material, thickness_m = make(reading, row, item.scene_category, item.material_names)
    thickness, size_reason = _thickness(item, thickness_m, row.noun)
    confidence = reading.confidence
    if row.max_size_m is not None and max(item.size_m) > _GIANT * row.max_size_m:
        confidence *= _GIANT_TRUST
        size_reason += f" A real {row.noun} is at most {row.max_size_m:g} m long: check the scene's unit."
    checked = check_name(reading, row, item.size_m, item.flags, item.height_m, neighbour_names)
    states, vibration_reason = _states(row, neighbour_names, reading)
    if checked.part_of:
        states, vibration_reason = [], f"it is shaken by the {checked.part_of} that it is a part of."
    return ObjectAnswer(
        object_category=row.noun,
        category_reason=_cut(
            " ".join(filter(None, (_category_reason(item.name, reading, row), why_owner, *checked.doubts)))
        ),
        material_category=material,
        estimated_length_m=item.size_m[0],
        estimated_width_m=item.size_m[1],
        estimated_thickness_m=thickness,
        size_reason=size_reason,
        usage=row.usage,
        vibrates=bool(states),
        vibration_reason=vibration_reason,
        states=states,
        confidence=round(confidence * checked.trust, 3),
        estimated_mass_kg=None if checked.part_of else usual_mass_kg(row, item.whole_m),
        feet_material=None if checked.part_of else row.feet,
    )


def _as_miniature(item: ObjectFacts, reading: NameReading, row: ObjectRow, why: str) -> ObjectAnswer:
    category = f"{'toy' if row.role == 'vehicle' else 'miniature'} {row.noun}"
    thickness, size_reason = _thickness(item, _MINIATURE_THICKNESS_M, category)
    return ObjectAnswer(
        object_category=category,
        category_reason=_cut(f"{_category_reason(item.name, reading, row)} {why}"),
        material_category=reading.material or _MINIATURE_MATERIAL,
        estimated_length_m=item.size_m[0],
        estimated_width_m=item.size_m[1],
        estimated_thickness_m=thickness,
        size_reason=size_reason,
        usage="Played with, or stands there as decoration.",
        vibrates=False,
        vibration_reason=f"{_a(category)} has no working mechanism.",
        states=[],
        confidence=reading.confidence * _MINIATURE_TRUST,
    )


def _miniature(reading: NameReading, row: ObjectRow, size_m: tuple[float, float, float]) -> str:
    """Return why the object is a miniature or a toy, "" if it may be real."""
    if reading.toy:
        return "The name says that it is not a real one."
    longest = max(size_m)
    if row.min_size_m is not None and 0.0 < longest < MINIATURE * row.min_size_m:
        return f"It is {longest:.2g} m long, far below a real one of at least {row.min_size_m:g} m."
    return ""


def _category_reason(name: str, reading: NameReading, row: ObjectRow) -> str:
    if not reading.head:
        return f"the name {_shown(name)} alone does not tell."
    reason = f"{reading.head!r} in the name {_shown(name)} names {_a(row.noun)}."
    if reading.unread:
        reason += f" Not understood: {', '.join(map(repr, reading.unread))}."
    return reason


def _shown(name: str) -> str:
    return repr(name if len(name) <= _MOST_SHOWN else f"{name[:_MOST_SHOWN]}...")


def _cut(reason: str) -> str:
    """Cut a reason to the length that an answer allows, since names can have any length."""
    return reason if len(reason) <= LONGEST_REASON else f"{reason[: LONGEST_REASON - 3]}..."


def _thickness(item: ObjectFacts, plausible_m: float, category: str) -> tuple[float, str]:
    measured = item.size_m[2]
    if measured >= _THINNEST_M and "zero-thickness" not in item.flags:
        return measured, "as measured."
    return plausible_m, (
        f"measured thickness of {measured:g} m replaced by {plausible_m:g} m, which is assumed for {_a(category)}."
    )


def _states(row: ObjectRow, neighbour_names: Sequence[str], reading: NameReading) -> tuple[list[StateAnswer], str]:
    """Return the states of an object, and the reason. A pan that touches objects has states only if one is a heater.

    A pan that touches nothing (held in the air, or analysed alone) may be put on a heater later. Its states then name
    the heater that they need. On a table it is silent, as in the paper, section "Study 1".
    """
    own = [state for state in row.states if not state.needs_contact]
    if own:
        doing = ", ".join(f"{state.verb} when {state.name}" for state in own)
        return [_state(state, None) for state in own], f"by a mechanism or sound of its own: {doing}."
    touched = [reading.row.noun for reading in map(read_name, neighbour_names) if reading.row and not reading.toy]
    heated = [
        (state, noun)
        for state in row.states
        for noun in [next((noun for noun in touched if noun in state.needs_contact), None)]
        if noun is not None
    ]
    if heated:
        return [_state(state, noun) for state, noun in heated], f"it touches the {heated[0][1]}, which can heat it."
    if row.states and not neighbour_names:
        waiting = [_state(state, state.needs_contact[0]) for state in row.states]
        return waiting, f"it touches nothing here; on {_a(row.states[0].needs_contact[0])} its content is heated."
    if row.states:
        heaters = ", ".join(row.states[0].needs_contact)
        return [], f"{_a(row.noun)} is still by itself; it would be heard only on one of: {heaters}; it touches none."
    for word in reading.words:
        if word in SOUNDING and word not in reading.head.split():
            name, intensity = SOUNDING[word]
            said = StateAnswer(name=name, intensity=intensity, needs_contact=None)
            return [said], f"the name says that it is {word}."
    return [], f"{_a(row.noun)} has no mechanism, sound or heated content of its own; being shaken does not count."


def _state(state: StateRow, needs_contact: str | None) -> StateAnswer:
    return StateAnswer(name=state.name, intensity=state.intensity, needs_contact=needs_contact)


def _a(noun: str) -> str:
    """Return the noun with its article."""
    return f"{'an' if _VOWEL_FIRST.match(noun) else 'a'} {noun}"
