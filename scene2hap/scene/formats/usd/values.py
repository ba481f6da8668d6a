"""Names of USD prims, and values of their attributes at rest.

An attribute with a default value is read there. An attribute with only time samples is read at its first sample:
animation exporters write such attributes even for objects at rest.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from pxr import Usd

from scene2hap.common.arrays import Floats, Ints

_WEAK = (Usd.ResolveInfoSourceNone, Usd.ResolveInfoSourceFallback)


_BLENDER_OBJECT, _BLENDER_DATA = "userProperties:blender:object_name", "userProperties:blender:data_name"


def name_of(prim: Any) -> str:
    """Return the display name of a prim, else its name in Blender, else its own name, which has no spaces."""
    in_blender = value(prim.GetAttribute(_BLENDER_OBJECT)) or value(prim.GetAttribute(_BLENDER_DATA))
    return str(prim.GetDisplayName() or in_blender or prim.GetName())


def is_data_of_parent(prim: Any) -> bool:
    """Return True if Blender wrote a prim as the mesh of the object above it.

    Blender writes an object as a transform with its mesh and the objects that are parented to it.
    """
    has_data = prim.HasAttribute(_BLENDER_DATA) and not prim.HasAttribute(_BLENDER_OBJECT)
    return has_data and prim.GetParent().HasAttribute(_BLENDER_OBJECT)


def rest_time(attributes: Sequence[Any]) -> Any:
    """Return the time (`Usd.TimeCode`) at which attributes that belong together are read."""
    for attribute in attributes:
        if attribute.GetNumTimeSamples() and attribute.GetResolveInfo(Usd.TimeCode.Default()).GetSource() in _WEAK:
            return Usd.TimeCode.EarliestTime()
    return Usd.TimeCode.Default()


def value(attribute: Any) -> Any:
    """Return the value of an attribute; None if it does not exist or is empty."""
    return attribute.Get(rest_time((attribute,))) if attribute else None


def vectors(attribute: Any) -> Floats:
    """Return an array attribute as (n, 3) float64; empty if it holds nothing."""
    return np.array(value(attribute) or (), dtype=np.float64).reshape(-1, 3)


def integers(attribute: Any) -> Ints:
    """Return an array attribute as (n,) int64; empty if it holds nothing."""
    return np.array(value(attribute) or (), dtype=np.int64).reshape(-1)


def positive(attribute: Any) -> float | None:
    """Return a number above 0. None if it is not: the author then gave no mass or size."""
    number = value(attribute)
    return float(number) if number is not None and np.isfinite(number) and number > 0 else None
