"""The unit of a scene: check that its sizes can be metres; otherwise warn with the likely unit.

glTF prescribes metres, but files often use centimetres or toy scale. If names identify objects, their usual sizes
decide. Otherwise the check warns if scene and objects are both far too large, or if the scene is too small: a park is
200 m wide, but its benches are not.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np

from scene2hap.common import checks
from scene2hap.common.arrays import Bools, Floats
from scene2hap.common.warning import warn_of
from scene2hap.errors import SceneError
from scene2hap.scene.geometry import joined
from scene2hap.scene.objects import VERTICAL, SceneData, SceneObject
from scene2hap.scene.plausibility.usual_sizes import DOOR, UsualSpan, is_floor, usual


class UnitWarning(UserWarning):
    """A scene whose sizes are implausible as metres."""


_MAX_WIDTH_M, _MAX_HEIGHT_M = 100.0, 20.0  # a hall, and more than one storey (assumed)
_MAX_MEDIAN_M = 10.0  # half of the objects in a room or a park are shorter than this along their longest edge (assumed)
_MOST_OF_A_KIND = 3
_PARTS_TOO = frozenset({DOOR})  # a lone door may be a dishwasher's
_MIN_WIDTH_M = 0.2
_MIN_OBJECTS = 5  # a scene with fewer objects may be a close-up of something small
_ROOM_WIDTH_M, _ROOM_HEIGHT_M = (1.0, 30.0), (1.8, 6.0)
_TYPICAL_WIDTH_M = 5.0
# A scene within a hand is doubted if it is a room at one of these scales: its numbers were taken for centimetres or
# millimetres once too often. A hand of a robot, as high as it is wide, is none.
_TOO_OFTEN = (100.0, 1000.0)
_UNITS = {0.01: "centimetres", 0.001: "millimetres", 0.0254: "inches", 0.1: "decimetres", 0.3048: "feet"}
# Single models are mostly in centimetres: 463 of 484 of the Sweet Home 3D catalogues, at most this large [m] (assumed).
_OF_MODELS, _LARGEST_MODEL_M = 0.01, 3.0
_SAME_FACTOR = 1.25
# Evidence that differs from the usual size by more than this factor causes a warning. One piece of furniture may have
# an odd size, several hardly (tuned on real scenes).
_DOUBT_ONE, _DOUBT_SEVERAL = 2.2, 1.5


# A top that is lower than this share of its longest edge is a board without legs and without a floor, as simulations
# have tables: its height says nothing (assumed).
_BOARD = 0.1


class _Evidence(NamedTuple):
    """Evidence of one named object: the factors between its size and the usual size, and the usual range."""

    factor: float
    excess: float
    name: str
    measured_m: float
    usual: UsualSpan


class UnitDoubt(NamedTuple):
    """Why sizes cannot be metres, and the likely unit: in metres, as text, and its name, empty if it has none.

    `of_model_m` is the likely unit if the file holds a single model and no room, empty if it is the same.
    """

    sentence: str
    unit_m: str
    name: str
    of_model_m: str = ""


def metres_per_unit(unit_m: float | None) -> float:
    """Return the metres per unit of an engine, 1 if it is None. Raises: SceneError: it is not a number above 0."""
    return checks.number("unit_m", 1.0 if unit_m is None else unit_m, "m", above=0.0, error=SceneError)


def warn_if_implausible(
    snapshot: SceneData, unit_m: float = 1.0, *, source: Literal["file", "engine", "python"] = "file"
) -> None:
    """Issue a UnitWarning if sizes of the scene, read at `unit_m` metres per unit, are implausible.

    The remedy depends on the source: a scene that was built in Python has no argument `unit_m`.
    """
    found = implausible(snapshot, unit_m)
    if found is None:
        return
    if source == "python":
        remedy = f"Multiply positions and sizes by {found.unit_m}{f' if they are in {found.name}' * bool(found.name)}."
    else:
        meant = f", {found.name}" if found.name else ""
        model = f", or {found.of_model_m} if it holds one model and no room" if found.of_model_m else ""
        remedy = (
            f"Perhaps unit_m={found.unit_m} (metres per unit of the {source}{meant}){model}; giving any unit_m ends "
            "this warning."
        )
    warn_of(f"{found.sentence} {remedy}", UnitWarning)


def implausible(snapshot: SceneData, unit_m: float = 1.0) -> UnitDoubt | None:
    """Return why the sizes of a scene, read at `unit_m` metres per unit, cannot be metres; None if they can."""
    up = VERTICAL[snapshot.up_axis]
    bounds = np.array([item.bounds_m for item in snapshot.objects])
    low, high = joined(bounds)
    extents = np.ptp(bounds, axis=1)
    floors = np.array([is_floor(item.name) for item in snapshot.objects])
    evidence = _evidence_of(snapshot.objects, bounds[:, 1, up] - _ground_m(bounds, floors, up), extents)
    by_name = _by_names(evidence) if evidence else None
    # A single name may mislead (a worktop called `Table`), so the size of the whole scene is checked first.
    found = by_name if len(evidence) > 1 else _by_size(high - low, up, extents.max(axis=1), by_name) or by_name
    if found is None:
        return None
    factor, reason = found
    unit = factor * unit_m
    rounded = f"{float(f'{unit:.2g}'):g}"  # 100, not 1e+02
    text, name = next(
        ((f"{known:g}", word) for known, word in _UNITS.items() if np.isclose(unit, known)), (rounded, "")
    )
    of_model = ""
    if found is not by_name and factor != _OF_MODELS and float(extents.max()) * _OF_MODELS <= _LARGEST_MODEL_M:
        of_model = f"{_OF_MODELS * unit_m:g}"
    return UnitDoubt(f"sizes in {snapshot.name!r} are implausible as metres: {reason}.", text, name, of_model)


def _ground_m(bounds_m: Floats, is_floor: Bools, up: int) -> float:
    """Return the height of the lowest floor [m]; without floors, that of the lowest object.

    Simulations keep objects below the floor until they need them. An object that encloses the whole scene does not
    count either: the bottom of a sky dome is kilometres below the floor.
    """
    if is_floor.any():
        return float(bounds_m[is_floor, 0, up].min())
    is_shell = (bounds_m == joined(bounds_m)).all(axis=(1, 2))
    standing = bounds_m if is_shell.all() else bounds_m[~is_shell]
    return float(standing[:, 0, up].min())


def _evidence_of(objects: Sequence[SceneObject], tops_m: Floats, extents_m: Floats) -> list[_Evidence]:
    """Return evidence of the named objects. Only the middle three of each kind count, so chairs do not outvote all."""
    named = [
        (known, item.name, float(top), tuple(f"{edge:.3g}" for edge in sorted(extent)), float(extent.max()))
        for item, top, extent in zip(objects, tops_m, extents_m, strict=True)
        if (known := usual(item.name)) is not None
    ]
    kinds_of_shape: dict[tuple[str, ...], set[str]] = {}
    for known, _, _, shape, _ in named:
        kinds_of_shape.setdefault(shape, set()).add(known.kind)
    evidence: dict[str, list[_Evidence]] = {}
    for known, name, top, shape, edge in named:
        measured = top if known.is_top else edge
        # Prototypes of games use placeholder boxes: a cube, or one size for objects of two kinds.
        is_placeholder = len(kinds_of_shape[shape]) > 1 or (not known.is_top and len(set(shape)) == 1)
        is_board = known.is_top and measured < _BOARD * edge
        if measured > 0 and not is_placeholder and not is_board:
            middle = float(np.sqrt(known.low_m * known.high_m))
            nearest = min(max(measured, known.low_m), known.high_m)
            one = _Evidence(middle / measured, nearest / measured, name, measured, known)
            evidence.setdefault(known.kind, []).append(one)
    if evidence.keys() <= _PARTS_TOO:
        return []
    return [one for of_kind in evidence.values() for one in _middle(sorted(of_kind))]


def _middle(evidence: Sequence[_Evidence]) -> Sequence[_Evidence]:
    start = max(0, (len(evidence) - _MOST_OF_A_KIND) // 2)
    return evidence[start : start + _MOST_OF_A_KIND]


def _by_names(evidence: Sequence[_Evidence]) -> tuple[float, str] | None:
    ordered = sorted(np.log([one.excess for one in evidence]))
    # If two halves of the evidence differ, the half with plausible sizes counts.
    excess = min(ordered[(len(ordered) - 1) // 2], ordered[len(ordered) // 2], key=abs)
    kinds = {one.usual.kind for one in evidence}
    if abs(excess) <= np.log(_DOUBT_ONE if len(kinds) == 1 else _DOUBT_SEVERAL):
        return None
    same = [one for one in evidence if (one.excess > 1) == (excess > 0) and one.excess != 1]
    factor = float(np.median([one.factor for one in same]))
    one = min(same, key=lambda one: abs(np.log(one.factor / factor)))
    near = [unit for unit in _UNITS if factor / _SAME_FACTOR < unit < factor * _SAME_FACTOR]
    where = "reaches {:.3g} m above the floor" if one.usual.is_top else "is {:.3g} m long"
    low, high = one.usual.low_m, one.usual.high_m
    span = f"{low:g} m" if low == high else f"{low:g} to {high:g} m"
    return (near[0] if near else factor), f"{one.name!r} {where.format(one.measured_m)}, where {span} is usual"


def _by_size(size_m: Floats, up: int, edges_m: Floats, by_name: tuple[float, str] | None) -> tuple[float, str] | None:
    """Return the likely unit of a scene that is far too large or small, and its size in words.

    Parameters: by_name : what a single name says, which decides between units that make a room of the scene.
    """
    width, height = float(np.delete(size_m, up).max()), float(size_m[up])
    is_small = width < _MIN_WIDTH_M and height < _MIN_WIDTH_M and len(edges_m) >= _MIN_OBJECTS
    is_large = (width > _MAX_WIDTH_M or height > _MAX_HEIGHT_M) and float(np.median(edges_m)) > _MAX_MEDIAN_M
    # The ground of a simulator comes in a file of its own, as wide as anybody may need.
    is_large &= height > 0.0
    if not is_large and not is_small:
        return None
    low, high = _ROOM_WIDTH_M
    if is_small:
        rooms = (unit for unit in _TOO_OFTEN if low <= width * unit <= high and height * unit <= _ROOM_HEIGHT_M[1])
        unit = next(rooms, None)
        return None if unit is None else (unit, _size(width, height))
    likely = [unit for unit in _UNITS if low <= width * unit <= high]
    if by_name is not None and by_name[0] in likely:
        return by_name[0], _size(width, height)
    # Rooms differ less in height than in width.
    low, high = _ROOM_HEIGHT_M
    likely = [unit for unit in likely if low <= height * unit <= high] or likely or [_TYPICAL_WIDTH_M / width]
    return likely[0], _size(width, height)


def _size(width_m: float, height_m: float) -> str:
    return f"the scene is {width_m:.3g} m wide and {height_m:.3g} m high"
