"""Whether a scene's sizes can be metres: a warning with the unit that would make them so.

glTF says metres and is often wrong (centimetres, toy scale). Known heights decide where names give them away; otherwise
only a scene far too wide or too small is doubted.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.snapshot import SceneObject, SceneSnapshot


class UnitWarning(UserWarning):
    """A scene whose sizes are implausible as metres."""


# Height of the top above the floor [m] by what a name says, with the words that it must be (assumed, from usual
# furniture; whatever hangs, lies on something or is only part of another thing is left out).
_TOPS_M: tuple[tuple[str, float], ...] = (
    (r"(front |main |room |entrance |folding |sliding |wooden |interior )?door", 2.0),
    (r"(arm |office |kitchen |dining |desk )?chair", 0.9),
    (r"(dining |kitchen |work |wooden )?table|(reading |writing |office )?desk", 0.75),
    (r"work ?top|(kitchen )?counter( top)?|stove|sink counter", 0.9),
    (r"fridge|refrigerator", 1.7),
    (r"wardrobe", 2.0),
    (r"sofa|couch", 0.85),
    (r"washing machine|washer|tumble dryer|dishwasher", 0.85),
    (r"toilet", 0.75),
    (r"bath ?tub", 0.6),
)
_MAX_WIDTH_M, _MAX_HEIGHT_M = 100.0, 20.0  # a hall, and more than one room high (assumed)
_MIN_WIDTH_M = 0.2
_MIN_OBJECTS = 5  # fewer objects than this may well be a close-up of something small
_ROOM_WIDTH_M, _ROOM_HEIGHT_M = (1.0, 30.0), (1.8, 6.0)
_TYPICAL_WIDTH_M = 5.0
_UNITS = {0.01: "centimetres", 0.001: "millimetres", 0.0254: "inches", 0.1: "decimetres", 0.3048: "feet"}
_SAME_FACTOR = 1.25
# Off by more than this is doubted: one piece of furniture may well be odd, several hardly (tuned on real scenes).
_DOUBT_ONE, _DOUBT_SEVERAL = 2.2, 1.5


def warn_if_implausible(snapshot: SceneSnapshot, unit_m: float) -> None:
    """Issue a UnitWarning if the scene, read at `unit_m` metres per unit, has sizes that furniture does not have."""
    up = {"y": 1, "z": 2}[snapshot.up_axis]
    bounds = np.array([item.bounds_m for item in snapshot.objects])
    low, high = bounds[:, 0].min(axis=0), bounds[:, 1].max(axis=0)
    known = _furniture(snapshot.objects, bounds[:, 1, up] - low[up])
    # One name may mislead (a worktop called `Table`), so the whole scene is heard before it.
    by_one = _by_furniture(known) if known else None
    found = by_one if len(known) > 1 else _by_size(high - low, up, len(snapshot.objects)) or by_one
    if found is None:
        return
    factor, reason = found
    unit = factor * unit_m
    told, meant = next(
        ((f"{known:g}", f", {word}") for known, word in _UNITS.items() if np.isclose(unit, known)), (f"{unit:.2g}", "")
    )
    warnings.warn(
        f"sizes in {snapshot.name!r} are implausible as metres: {reason}. "
        f"Perhaps unit_m={told} (metres per unit of the file{meant}); giving any unit_m ends this warning.",
        UnitWarning,
        stacklevel=3,
    )


def _furniture(objects: Sequence[SceneObject], tops_m: NDArray[np.float64]) -> list[tuple[float, float, str]]:
    """Usual height, height and name of the things whose names tell how high they are."""
    return [
        (usual, float(top), item.name)
        for item, top in zip(objects, tops_m, strict=True)
        if top > 0 and (usual := _usual(item.name)) is not None
    ]


def _by_furniture(known: Sequence[tuple[float, float, str]]) -> tuple[float, str] | None:
    factor = float(np.median([usual / top for usual, top, _ in known]))
    doubt = _DOUBT_ONE if len(known) == 1 else _DOUBT_SEVERAL
    if 1 / doubt <= factor <= doubt:
        return None
    usual, top, name = min(known, key=lambda row: abs(np.log(row[0] / row[1] / factor)))
    near = [unit for unit in _UNITS if factor / _SAME_FACTOR < unit < factor * _SAME_FACTOR]
    return (near[0] if near else factor), f"{name!r} reaches {top:.3g} m above the floor, where {usual:g} m is usual"


def _by_size(size_m: NDArray[np.float64], up: int, n_objects: int) -> tuple[float, str] | None:
    width, height = float(np.delete(size_m, up).max()), float(size_m[up])
    is_small = width < _MIN_WIDTH_M and height < _MIN_WIDTH_M and n_objects >= _MIN_OBJECTS
    if width <= _MAX_WIDTH_M and height <= _MAX_HEIGHT_M and not is_small:
        return None
    units = [1 / unit for unit in _UNITS] if is_small else list(_UNITS)
    low, high = _ROOM_WIDTH_M
    likely = [unit for unit in units if low <= width * unit <= high]
    # Rooms differ less in height than in width.
    low, high = _ROOM_HEIGHT_M
    likely = [unit for unit in likely if low <= height * unit <= high] or likely or [_TYPICAL_WIDTH_M / width]
    return likely[0], f"the scene is {width:.3g} m wide and {height:.3g} m high"


def _usual(name: str) -> float | None:
    """The usual height of a thing's top [m]; None if its name does not say."""
    apart = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name)
    words = " ".join(re.findall(r"[a-z]{2,}", apart.lower()))
    for pattern, top_m in _TOPS_M:
        if re.fullmatch(f"({pattern})( (left|right|front|back))?", words):
            return top_m
    return None
