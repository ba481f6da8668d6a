"""The haptics of an object, from the answers about it and from the estimate of its material."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from scene2hap.errors import Scene2HapError
from scene2hap.haptics import LEAST_MASS_KG, LONGEST_PASSAGE_S, MOST_MASS_KG, ObjectHaptics, SourceState
from scene2hap.llm.answers import ObjectAnswer, VibrationAnswer
from scene2hap.llm.validation.masses import bounded_mass_kg, mass_fault
from scene2hap.llm.validation.materials import Estimate
from scene2hap.llm.validation.plausibility import row_of
from scene2hap.llm.validation.sizes import surface_size
from scene2hap.materials import Material
from scene2hap.scene.objects import SceneObject, UpAxis
from scene2hap.scene.surface import plate_sizes


@dataclass(frozen=True)
class Analysis:
    """The answers about one object before its material is known."""

    answer: ObjectAnswer
    analyst: str
    states: tuple[SourceState, ...]
    describers: tuple[str, ...]


class DoubtedHaptics(NamedTuple):
    """The haptics of an object, and the doubts about sizes and masses that were not used."""

    haptics: ObjectHaptics
    doubts: tuple[str, ...]


def haptics_of(item: SceneObject, found: Analysis, estimate: Estimate, up_axis: UpAxis) -> DoubtedHaptics:
    """Return the haptics of an object whose questions have answers."""
    answer = found.answer
    size_m, doubts = surface_size(answer, item.size_m)
    analysed = ("object_category", "material_category", "estimated_size_m", "usage", "vibrates")
    provenance = {**dict.fromkeys(analysed, found.analyst), "material": estimate.provenance}
    for state, who in zip(found.states, found.describers, strict=True):
        provenance[f"states.{state.name}"] = who
    reasons = {"category": answer.category_reason, "size": answer.size_reason, "vibration": answer.vibration_reason}
    mass = _mass(item, answer, estimate.material, found.analyst, up_axis)
    if mass.kg is not None:
        provenance["mass_kg"] = mass.origin
    feet = _feet(answer)
    if feet is not None:
        provenance["feet"] = found.analyst
    if mass.doubt:
        reasons["mass"] = mass.doubt
    if doubts:
        reasons["size"] = "; ".join((answer.size_reason, *doubts))
    if estimate.flags:
        reasons["material"] = "; ".join(estimate.flags)
    haptics = ObjectHaptics(
        object_category=answer.object_category,
        material_category=answer.material_category,
        material=estimate.material,
        estimated_size_m=size_m,
        usage=answer.usage,
        vibrates=bool(found.states),
        states=found.states,
        confidence=answer.confidence,
        reasons=reasons,
        provenance=provenance,
        mass_kg=mass.kg,
        feet=feet,
    )
    return DoubtedHaptics(haptics, (*doubts, *filter(None, (mass.doubt,))))


def haptics_without_answer(item: SceneObject, problem: Scene2HapError) -> ObjectHaptics:
    """Return the haptics of an object without an answer: "unknown" and silent."""
    return ObjectHaptics(
        object_category="unknown",
        material_category="unknown",
        material=None,
        estimated_size_m=plate_sizes.with_thickness(item.size_m),
        usage="unknown",
        vibrates=False,
        confidence=0.0,
        provenance={"object_category": f"error: {problem}"},
    )


def times_of(words: VibrationAnswer) -> dict[str, Any]:
    """Return the fields of a description about the start and the stop of a state.

    Starts and stops slower than `LONGEST_PASSAGE_S` cannot be felt, so longer times count as this one.
    """
    named = ("start_up_s", "wind_down_s", "spins", "on_s", "off_s")
    stated = {name: value for name in named if (value := getattr(words, name)) is not None}
    passages = {name: min(stated[name], LONGEST_PASSAGE_S) for name in ("start_up_s", "wind_down_s") if name in stated}
    return stated | passages


class _Mass(NamedTuple):
    """The mass of an object [kg], None if unknown; its origin, and a doubt about it, each "" for none."""

    kg: float | None = None
    origin: str = ""
    doubt: str = ""


def _mass(item: SceneObject, answer: ObjectAnswer, material: Material | None, analyst: str, up_axis: UpAxis) -> _Mass:
    # Simulators give frames and helpers placeholders such as 1e-8 kg.
    if item.mass_kg is not None and LEAST_MASS_KG <= item.mass_kg <= MOST_MASS_KG:
        return _Mass(item.mass_kg, "scene")
    mass_kg, whole_m = answer.estimated_mass_kg, item.whole_size_m(up_axis)
    if mass_kg is None:
        return _Mass()
    if why := mass_fault(mass_kg, whole_m):
        return _Mass(doubt=f"mass: {why}; none is used")
    if material is not None:
        mass_kg = bounded_mass_kg(mass_kg, whole_m, material.density_kg_m3)
    return _Mass(mass_kg, analyst)


def _feet(answer: ObjectAnswer) -> Material | None:
    """Return the material of an object's feet; None if it has no feet or the table has no such material."""
    row = row_of(answer.feet_material) if answer.feet_material else None
    return row.material if row is not None else None
