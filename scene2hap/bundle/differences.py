"""The differences between two bundles: as text, and as the objects that a session has to replace."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle.contents import BundleContents
from scene2hap.bundle.override import ANY_STATE, NONE
from scene2hap.errors import UnknownMaterial
from scene2hap.haptics import ObjectHaptics
from scene2hap.materials import lookup


class Difference(NamedTuple):
    """One property of an object that differs, and its value in each bundle, "-" if it has none."""

    object_id: str
    what: str
    one: str
    other: str


_UNTOUCHED = {"gain": "+0.0 dB", "sound": "chosen", "locked": "no", "muted": "no"}
"""Values of an object without an override."""


def differences(one: BundleContents, other: BundleContents) -> tuple[Difference, ...]:
    """List the differences between two bundles, object by object. Loops are compared by their samples."""
    ids = list(dict.fromkeys((*(item.id for item in one.snapshot.objects), *(x.id for x in other.snapshot.objects))))
    sides = [{object_id: dict(_said(bundle, object_id)) for object_id in ids} for bundle in (one, other)]
    return tuple(
        Difference(object_id, what, before, after)
        for object_id in ids
        for what in dict.fromkeys((*sides[0][object_id], *sides[1][object_id]))
        for before, after in [[side[object_id].get(what, _UNTOUCHED.get(what, "-")) for side in sides]]
        if before != after
    )


def differ(one: BundleContents, other: BundleContents) -> bool:
    """Return True if a person sees a difference, so that `undo` has something to restore.

    Corrections that correct nothing, such as `unmute` of an object that is not muted, make none.
    """
    corrections = [
        {key: override for key, override in bundle.overrides.items() if override != NONE} for bundle in (one, other)
    ]
    return one.objects != other.objects or bool(differences(one, other)) or corrections[0] != corrections[1]


def _said(bundle: BundleContents, object_id: str) -> Iterator[tuple[str, str]]:
    haptics, wish = bundle.objects.get(object_id), bundle.overrides.get(object_id)
    if haptics is not None:
        yield from _inferred(haptics)
    if wish is not None:
        if wish.name is not None:
            yield "name", wish.name
        yield "gain", f"{bundle.gain_db(object_id):+.1f} dB"
        yield "sound", wish.clip.credit.title if wish.clip is not None else "chosen"
        yield "locked", "yes" if wish.locked else "no"
        yield "muted", "yes" if wish.muted else "no"
        for state, pitch_hz in wish.pitch_hz.items():
            yield "pitch" if state == ANY_STATE else f"pitch {state}", f"{pitch_hz:g} Hz"
    states = bundle.loops.get(object_id, {})
    if len(states) > 1:
        yield "first state", next(iter(states))
    for state, loop in bundle.loops.get(object_id, {}).items():
        yield f"loop {state}", _digest(loop)
    if bundle.actuator is not None and object_id in bundle.loops:
        yield "actuator", bundle.actuator.name


def _inferred(haptics: ObjectHaptics) -> Iterator[tuple[str, str]]:
    yield "category", haptics.object_category
    yield "material", _material(haptics)
    yield "size", " x ".join(f"{length_m:.3g}" for length_m in haptics.estimated_size_m) + " m"
    if haptics.mass_kg is not None:
        yield "mass", f"{float(f'{haptics.mass_kg:.3g}'):g} kg"
    if haptics.feet is not None:
        yield "feet", haptics.feet.name
    yield "vibrates", "yes" if haptics.vibrates else "no"
    for state in haptics.states:
        yield f"intensity {state.name}", f"{state.intensity:.2f}"
        yield f"start {state.name}", f"{state.start_up_s:g} s"
        yield f"stop {state.name}", f"{state.wind_down_s:g} s"
        if state.on_s is not None and state.off_s is not None:
            yield f"turns {state.name}", f"{state.on_s:g} s on, {state.off_s:g} s off"


def _material(haptics: ObjectHaptics) -> str:
    """Return the name of a material, and its constants if they are not those of the table."""
    name, material = haptics.material_category, haptics.material
    try:
        is_usual = material is None or replace(lookup(name), name=material.name) == material
    except UnknownMaterial:
        is_usual = False
    if material is None or is_usual:
        return name
    return (
        f"{name} ({material.density_kg_m3:g} kg/m3, {material.youngs_modulus_pa:.3g} Pa, Poisson's ratio "
        f"{material.poisson_ratio:g}, loss factor {material.loss_factor:g})"
    )


def _digest(loop: HapticLoop) -> str:
    """Return the frequency of a tactile loop, and a digest of its samples."""
    content = hashlib.sha256(loop.tactile.samples.tobytes() + loop.audible.samples.tobytes()).hexdigest()[:8]
    return f"{loop.frequency_tactile_hz:.1f} Hz ({content})"


def changed_objects(before: BundleContents, after: BundleContents) -> list[str]:
    """Return the ids of objects whose haptics or tactile loops differ, in the order of `after`."""
    ids = dict.fromkeys((*after.objects, *before.objects))
    return [
        key
        for key in ids
        if before.objects.get(key) != after.objects.get(key)
        or not _are_equal(before.loops.get(key, {}), after.loops.get(key, {}))
    ]


def _are_equal(one: Mapping[str, HapticLoop], other: Mapping[str, HapticLoop]) -> bool:
    """Return True if both have the same states in the same order, with equal tactile loops."""
    return list(one) == list(other) and all(_is_same(one[state], other[state]) for state in one)


def _is_same(one: HapticLoop, other: HapticLoop) -> bool:
    a, b = one.tactile, other.tactile
    return a is b or (a.sample_rate_hz == b.sample_rate_hz and np.array_equal(a.samples, b.samples))
