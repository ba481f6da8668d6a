"""Check whether an object's name fits its measured height, size and neighbours.

A name alone can mislead: a "bench" may be the hob on a kitchen bench, and a "chairCushion" the whole chair. Each misfit
lowers the confidence by a factor and is reported. An object is silenced only if it is an inner part of the machine that
it touches.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from scene2hap.llm.lexicon import translations, word_split, words
from scene2hap.llm.lexicon.names import NameReading, read_name
from scene2hap.llm.lexicon.table import ObjectRow


def _set(text: str) -> frozenset[str]:
    return frozenset(text.split(","))


_SHELLS = _set("wall,partition,brick wall,concrete wall,floor,parquet,ceiling,roof")

_STANDS = _set(
    "chair,armchair,bean bag,desk chair,lounge chair,rocking chair,deck chair,wheelchair,dining chair,stool,bar stool,"
    "footstool,sofa,futon,recliner,bench,park bench,bed bench,weight bench,bed,bunk bed,crib,bed frame,day bed,"
    "hospital bed,chaise longue,garden chair,folding chair,table,dining table,coffee table,side table,console table,"
    "picnic table,desk,computer desk,workbench,wardrobe,sideboard,dresser,night stand,bookcase,refrigerator,dishwasher,"
    "washing machine,tumble dryer,bathtub,floor lamp,piano,grand piano,treadmill,pool table,ironing board"
)
"""Objects that stand on the floor, or on a floor covering or platform."""

_GROUND = _set(
    "floor,parquet,tile,carpet,mat,pallet,road,sidewalk,terrace,deck,path,grass,ground,foundation,podium,stage,sand,"
    "gravel,stone floor,tile floor,concrete floor,carpet floor,driveway,stairs,balcony,platform,roof,truck,van,"
    "trailer,boat,ship,scaffold,elevator"
)

_INNER = _set("motor,pump,fan,sprinkler,turbine,engine,compressor,burner,heater,transformer,propeller,blade,arm")
"""Parts inside machines that also exist as separate objects."""

_COMPONENTS = _set(
    "arm,arms,rack,racks,tray,basket,drum,hose,filter,handle,knob,door,drawer,lid,leg,foot,blade,hinge,panel,cover,"
    "carcass,casing,housing,frame,rail"
)
"""Words beside the name of a machine that mark the object as a part of it."""

_FURNISHINGS = _set("cushion")
"""Objects that are parts of furniture, and also exist as separate objects. A table with a sink is a sink: hands touch
its metal sheet."""
_THICK_M = 0.3
"""Drawers, doors and cushions are thinner than this in one direction; assumed."""

_PLACES = _SHELLS | _set("stage,deck,terrace,bridge,driver cab")
"""Large objects that name the place of a smaller one."""
_FITTINGS = _set(
    "windscreen wiper,seat,bus seat,toilet,lamp,headlight,taillight,mirror,window,horn,siren,radio,speaker,"
    "engine,motor,battery,antenna"
)
"""Objects inside or on vehicles that are no parts alone."""
MINIATURE = 0.5
"""An object shorter than this share of the smallest real one is a miniature; assumed, so that asset kits at half scale
are real."""
_SLAB_SHARE = 0.15
"""Walls, floors, ceilings and roofs are thinner than this share of their length; assumed."""
_LARGEST_MACHINE_M = 3.0
"""Largest size of a machine of known mass whose size the table does not bound; assumed."""

_FLAT_SHARE, _SMALLEST_GROUND_M = 0.01, 3.0
"""The ground is flat and low within this share of its length, and wider than this [m]; assumed."""

# All assumed. They only rank answers by the strength of the evidence against them.
_HIGH_M = 0.5
_SHORT_SHELL_M = 1.0
_THIN_SHARE = 0.5
_SLENDER_SHARE = 0.2
_MEASURED_M = 1e-3
_TOO_HIGH, _TOO_SHORT, _TOO_THIN, _TOO_SLENDER, _PART, _BESIDE_SAME, _OWNER = 0.4, 0.5, 0.6, 0.5, 0.5, 0.7, 0.8


@dataclass(frozen=True)
class NameCheck:
    """The agreement of a reading with measurements: confidence factor, reasons, and the machine it belongs to."""

    trust: float = 1.0
    doubts: tuple[str, ...] = ()
    part_of: str = ""


def owner_of_part(reading: NameReading, whole_m: Sequence[float]) -> tuple[NameReading, str] | None:
    """Return the furniture named before a part, and the reason; None unless the object is too thick for the part.

    "chairCushion" is a chair with a cushion, a "cupboard_door" of 2 cm is a door. Parts of machines stay parts: a
    machine would vibrate. `whole_m` are the edges of the box around the object [m]; without them the result is None.
    """
    part = reading.row
    if part is None or not (part.role == "part" or part.noun in _FURNISHINGS) or min(whole_m, default=0.0) <= _THICK_M:
        return None
    why = f"It is {min(whole_m):.2g} m thick, too thick for a {part.noun} alone."
    owner = _before_head(reading)
    while owner.row is not None and not owner.row.vibrates:
        is_large = owner.row.min_size_m is not None and max(whole_m) >= owner.row.min_size_m
        if is_large and owner.row.mass_kg is not None and owner.row.mass_kg > (part.mass_kg or 0.0):
            trust = round(_OWNER * min(owner.confidence, reading.confidence), 3)
            return replace(owner, name=reading.name, words=reading.words, confidence=trust), why
        owner = _before_head(owner)
    return None


def mounted_on(reading: NameReading, size_m: Sequence[float]) -> tuple[NameReading, str] | None:
    """Return the object named before a wall, roof or vehicle that the object cannot be; None if there is none.

    "monitor_wall" of 0.4 m is a monitor that hangs on a wall, "hvac_roof" of 2 m by 1.5 m by 0.5 m is too thick for a
    roof, and "seat_truck" of 0.5 m is no toy. Before a wall, only objects of known mass count, since a part of a
    "house_wall" is no house; before a vehicle only its fittings, since a "banana_car" is a toy.
    """
    place, longest = reading.row, max(size_m)
    if place is None or reading.toy or longest <= 0.0:
        return None
    before = _before_head(reading)
    if before.row is None or (before.row.vibrates and reading.head.split()[0] in words.NO_MACHINES):
        return None
    if place.noun in _PLACES:
        is_mounted = before.row.mass_kg is not None and (longest < _SHORT_SHELL_M or _is_block(before.row, size_m))
    else:
        is_fitting = before.row.role == "part" or before.row.noun in _FITTINGS
        is_mounted = is_fitting and place.role == "vehicle" and longest < MINIATURE * (place.min_size_m or 0.0)
    if not is_mounted:
        return None
    why = f"It is {longest:.2g} m long and {min(size_m):.2g} m thick, unlike a {place.noun}, so that word is its place."
    trust = round(_OWNER * min(before.confidence, reading.confidence), 3)
    return replace(before, name=reading.name, words=reading.words, confidence=trust), why


def _is_block(row: ObjectRow, size_m: Sequence[float]) -> bool:
    """Return True if an object has the size of a machine that drives nobody, and is too thick for a wall."""
    is_machine = row.vibrates and row.role != "vehicle"
    largest_m = row.max_size_m or _LARGEST_MACHINE_M
    return is_machine and max(size_m) <= largest_m and min(size_m) > _SLAB_SHARE * max(size_m)


def ground_plane(reading: NameReading, whole_m: Sequence[float], height_m: float | None) -> NameReading | None:
    """Return the floor if a name says no more than "plane", and the object is one; else None.

    Simulators and modelling tools call the ground so. It is flat, level, larger than a table, and the lowest object.
    """
    if reading.row is not None or "plane" not in reading.words or len(whole_m) < 3 or height_m is None:
        return None
    longer, shorter, height = whole_m
    if max(height, height_m) > _FLAT_SHARE * longer or shorter < _SMALLEST_GROUND_M:
        return None
    return replace(reading, row=word_split.nouns()["floor"][0], head="plane", confidence=_OWNER)


def meant_abroad(reading: NameReading, size_m: Sequence[float]) -> tuple[NameReading, str] | None:
    """Return the reading of an English word in another language if the object is too large for the English meaning.

    An Italian "mobile" of 0.9 m is a cabinet and no phone, a German "Wand" of 4 m a wall and no wand. None if the
    English meaning fits, or no other does.
    """
    row, longest = reading.row, max(size_m)
    if row is None or row.max_size_m is None or longest <= row.max_size_m:
        return None
    for meaning in translations.by_language(reading.head).values():
        other = read_name(" ".join(meaning)).row
        if other is not None and other is not row and longest <= (other.max_size_m or longest):
            why = f"It is {longest:.2g} m long; a {row.noun} is at most {row.max_size_m:g} m, so the word is foreign."
            return replace(reading, row=other, confidence=round(_OWNER * reading.confidence, 3)), why
    return None


def _before_head(reading: NameReading) -> NameReading:
    """Read the words before the recognised part of a name."""
    said, head = reading.words, tuple(reading.head.split())
    starts = [i for i in range(len(said)) if said[i : i + len(head)] == head]
    return read_name(" ".join(said[: starts[-1]]))


def check_name(
    reading: NameReading,
    row: ObjectRow,
    size_m: tuple[float, float, float],
    flags: Sequence[str],
    height_m: float | None,
    neighbour_names: Sequence[str],
) -> NameCheck:
    """Compare a reading with size, height above the lowest object [m] (None if unknown) and neighbours."""
    beside = [other.row for other in map(read_name, neighbour_names) if other.row is not None and not other.toy]
    found = [*_by_height(row, height_m, beside), *_by_size(row, size_m, flags), *_by_name(reading, row)]
    part_of = _machine_around(reading, row, beside)
    if part_of:
        found.append((_PART, f"It is taken for a part of the {part_of} that it touches."))
    elif row.vibrates and row in beside:
        found.append((_BESIDE_SAME, f"It touches another {row.noun}, of which it may be a part."))
    trust = 1.0
    for factor, _ in found:
        trust *= factor
    return NameCheck(trust, tuple(why for _, why in found), part_of)


def _by_height(row: ObjectRow, height_m: float | None, beside: Sequence[ObjectRow]) -> list[tuple[float, str]]:
    if height_m is None or height_m <= _HIGH_M or row.noun not in _STANDS or _GROUND & {other.noun for other in beside}:
        return []
    on = f" and touches {', '.join(dict.fromkeys(other.noun for other in beside))}" if beside else ""
    return [
        (_TOO_HIGH, f"It begins {height_m:.2g} m above the lowest thing here{on}; a {row.noun} stands on the floor.")
    ]


def _by_size(row: ObjectRow, size_m: tuple[float, float, float], flags: Sequence[str]) -> list[tuple[float, str]]:
    found = []
    longest, width, thickness = max(size_m), size_m[1], size_m[2]
    if row.noun in _SHELLS:
        if 0.0 < longest < _SHORT_SHELL_M:
            found.append((_TOO_SHORT, f"It is {longest:.2g} m long; a {row.noun} of a room is longer."))
        if _MEASURED_M <= thickness < _THIN_SHARE * row.thickness_m and "zero-thickness" not in flags:
            usual = f"{1e3 * row.thickness_m:.3g} mm are usual of a {row.noun}"
            found.append((_TOO_THIN, f"It is {1e3 * thickness:.2g} mm thick; {usual}."))
    if row.vibrates and row.min_size_m is not None and 0.0 < width < _SLENDER_SHARE * row.min_size_m:
        found.append((_TOO_SLENDER, f"It is {width:.2g} m wide, slender for a {row.noun}."))
    return found


def _by_name(reading: NameReading, row: ObjectRow) -> list[tuple[float, str]]:
    outside = set(reading.words) - set(reading.head.split())
    parts = sorted(outside & _COMPONENTS) if row.vibrates else []
    return [(_PART, f"The name also says {parts[0]!r}, which may be a part of the {row.noun}.")] if parts else []


def _machine_around(reading: NameReading, row: ObjectRow, beside: Sequence[ObjectRow]) -> str:
    """Return the machine that an inner part names first and touches ("dishwasher_pump": dishwasher), or ""."""
    if row.noun not in _INNER:
        return ""
    before = _before_head(reading).row
    return before.noun if before is not None and before.vibrates and before is not row and before in beside else ""
