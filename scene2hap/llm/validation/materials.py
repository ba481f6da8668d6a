"""Comparison of a model's material constants with the table of measured constants."""

from __future__ import annotations

from dataclasses import dataclass, replace

from scene2hap.errors import UnknownMaterial
from scene2hap.llm.answers import MaterialAnswer
from scene2hap.llm.validation.plausibility import constants, row_of
from scene2hap.materials import Material, lookup

_FIELDS = {
    "density_kg_m3": "density_kg_m3",
    "youngs_modulus_gpa": "youngs_modulus_pa",
    "poisson_ratio": "poisson_ratio",
    "damping_ratio": "loss_factor",
}
"""Field of an answer -> constant of a material."""


@dataclass(frozen=True)
class Estimate:
    """The constants of one material word (None if unknown), their source, and doubts about them."""

    material: Material | None
    provenance: str
    flags: tuple[str, ...] = ()


def from_table(word: str) -> Estimate | None:
    """Return the table's constants; None if it has no such row."""
    try:
        known = lookup(word)
    except UnknownMaterial:
        return None
    return Estimate(replace(known, name=word), "table of materials")


def from_model(word: str, answer: MaterialAnswer, provenance: str) -> Estimate:
    """Return a model's constants. The table's constant replaces an implausible one and is flagged; none is rescaled.

    This finds wrong units (2.7 for g/cm3, megapascal for gigapascal). If the table has no row for the material, an
    implausible constant is flagged but kept, since no better value is known.
    """
    modulus_pa = answer.youngs_modulus_gpa * 1e9
    material = Material(word, answer.density_kg_m3, modulus_pa, answer.poisson_ratio, answer.loss_factor)
    wrong, row = constants(word, answer.model_dump()), row_of(word)
    if not wrong:
        return Estimate(material, provenance)
    if row is None:
        return Estimate(material, provenance, tuple(f"{name}: {why}" for name, why in wrong.items()))
    usual = {_FIELDS[name]: getattr(row.material, _FIELDS[name]) for name in wrong}
    flags = tuple(f"{name}: {why}; the table's constant is used" for name, why in wrong.items())
    return Estimate(replace(material, **usual), f"{provenance}; {', '.join(usual)}: table of materials", flags)


def without_answer(word: str, problem: str) -> Estimate:
    """Return the table's row in place of a missing estimate, or no constants; flagged either way."""
    known = from_table(word)
    if known is None:
        return Estimate(None, f"error: {problem}", (f"no constants: {problem}",))
    return Estimate(known.material, known.provenance, (f"the table's constants, since {problem}",))
