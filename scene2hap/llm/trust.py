"""Material constants from a model, held against the table of measured ones."""

from __future__ import annotations

from dataclasses import dataclass

from scene2hap.errors import UnknownMaterial
from scene2hap.llm.answers import MaterialAnswer
from scene2hap.materials import Material, lookup

FAR = 10.0
"""Factor by which density or modulus may differ from the table's before the estimate is doubted."""


@dataclass(frozen=True)
class Estimate:
    """The constants of one material word: None where nobody knows; who gave them; and what is doubtful about them."""

    material: Material | None
    provenance: str
    flags: tuple[str, ...] = ()


def from_table(word: str) -> Estimate | None:
    """The table's constants, None if it has no such row."""
    try:
        known = lookup(word)
    except UnknownMaterial:
        return None
    return Estimate(Material(word, *_constants(known)), "table of materials")


def from_model(word: str, answer: MaterialAnswer, provenance: str) -> Estimate:
    """A model's constants, flagged where density or modulus is ten-fold off the table's; never rescaled.

    A slip of units (2.7 for g/cm3, megapascal for gigapascal) shows as such a deviation, but so does foam for rubber.
    """
    modulus_pa = answer.youngs_modulus_gpa * 1e9
    material = Material(word, answer.density_kg_m3, modulus_pa, answer.poisson_ratio, answer.loss_factor)
    known = from_table(word)
    if known is None or known.material is None:
        return Estimate(material, provenance)
    pairs = (
        ("density", material.density_kg_m3, known.material.density_kg_m3, "kg/m3"),
        ("Young's modulus", material.youngs_modulus_pa, known.material.youngs_modulus_pa, "Pa"),
    )
    flags = tuple(
        f"{name} {value:.3g} {unit} is {max(value / usual, usual / value):.0f} times off the table's {usual:.3g} {unit}"
        for name, value, usual, unit in pairs
        if not 1 / FAR < value / usual < FAR
    )
    return Estimate(material, provenance, flags)


def without_answer(word: str, problem: str) -> Estimate:
    """What stands in for an estimate that could not be had: the table's row, or nothing; flagged either way."""
    known = from_table(word)
    if known is None:
        return Estimate(None, f"error: {problem}", (f"no constants: {problem}",))
    return Estimate(known.material, known.provenance, (f"the table's constants, since {problem}",))


def _constants(material: Material) -> tuple[float, float, float, float]:
    return material.density_kg_m3, material.youngs_modulus_pa, material.poisson_ratio, material.loss_factor
