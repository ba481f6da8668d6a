"""Objects without vibration, or without effect in a bake or on the map, each with the reason."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap.bundle import HapticBundle
from scene2hap.haptics import ObjectHaptics, is_unknown, unmet_needs
from scene2hap.report.felt_map import ALL_BANDS, ALL_SOURCES, FeltMap


def left_out(bundle: HapticBundle, felt: FeltMap, shells: Collection[str]) -> list[dict[str, Any]]:
    """Return each reason with the ids of its objects. Reasons without objects are left out."""
    categories = {item.id: "" for item in bundle.snapshot.objects}
    categories |= {key: haptics.object_category for key, haptics in bundle.objects.items()}
    wishes = bundle.overrides
    reached = _reached(felt)
    reasons: Mapping[str, Callable[[str, ObjectHaptics], bool]] = {
        "not answered: the model's answer failed": lambda _, haptics: _has_failed(haptics),
        "unknown: it was not recognised, so it is silent": lambda _, haptics: (
            is_unknown(haptics.object_category) and not haptics.vibrates and not _has_failed(haptics)
        ),
        "material unknown: no vibration spreads through it": lambda _, haptics: haptics.material is None,
        "vibrates, but has no sound": lambda key, haptics: haptics.vibrates and not bundle.loops.get(key),
        "needs a contact that no object here can provide": lambda key, haptics: bool(
            unmet_needs(key, haptics.states, categories)
        ),
        "muted until a game unmutes it": lambda key, _: bundle.is_muted(key),
        "locked: rebake leaves its loops as they are": lambda key, _: key in wishes and wishes[key].locked,
        "out of reach: no vibration of any source arrives": lambda key, _: key in reached and not reached[key],
        "hides the room: its surface is not on the felt map": lambda key, _: key in shells,
        "silent: it does not vibrate by itself": lambda key, haptics: (
            not haptics.vibrates and not is_unknown(haptics.object_category)
        ),
    }
    rows = [
        {"why": why, "objects": [key for key, one in bundle.objects.items() if holds(key, one)]}
        for why, holds in reasons.items()
    ]
    absent = [item.id for item in bundle.snapshot.objects if item.id not in bundle.objects]
    return [row for row in [{"why": "no properties were inferred for it", "objects": absent}, *rows] if row["objects"]]


def _has_failed(haptics: ObjectHaptics) -> bool:
    return haptics.provenance.get("object_category", "").startswith("error")


def _reached(felt: FeltMap) -> dict[str, bool]:
    """Return, for each object with points, True if vibration arrives at it by the first model."""
    found: dict[str, bool] = {}
    if not felt.models or len(felt.sources) < 2:
        return found
    levels: NDArray[np.float32] = felt.levels_db[felt.models[0]][ALL_SOURCES][ALL_BANDS]
    start = 0
    for patch in felt.patches:
        end = start + len(patch.points_m)
        found[patch.object_id] = bool(np.isfinite(levels[start:end]).any())
        start = end
    return found
