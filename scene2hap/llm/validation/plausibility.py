"""Comparison of an answer's numbers with measured sizes and with published material constants.

One repair requests all numbers out of bounds again (`faults.find_fault`). Numbers that stay out of bounds are
replaced by the measured size (`sizes`) or by the table's constant (`materials`).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeGuard

from scene2hap.llm.protocol import Component
from scene2hap.llm.validation.masses import mass_fault
from scene2hap.materials import MaterialRow, find_row
from scene2hap.scene.surface import plate_sizes

EDGES = ("length", "width", "thickness")
_WHOLE = ("length", "width", "height")

# Factors beyond the published range (assumed). A wrong unit gives a factor of a thousand or a million; materials with
# the same name ("wood", "foam") differ by less. Assembled objects have far higher loss factors than their material.
_DENSITY_FAR, _MODULUS_FAR, _LOSS_FAR = 3.0, 10.0, 100.0
_POISSON_FAR = 0.2
_ANY_SOLID_KG_M3 = (5.0, 25000.0)
"""Bounds on the density of an unknown material; a smaller number was meant in g/cm3 (foams begin at 10). Assumed."""

_UNITS = {"density_kg_m3": "kg/m3", "youngs_modulus_gpa": "GPa", "poisson_ratio": "-", "damping_ratio": "-"}
_SLIPS = {"density_kg_m3": "g/cm3? Give kg/m3", "youngs_modulus_gpa": "pascal or megapascal? Give gigapascal"}
_SLIP = 30.0  # beyond this factor, the message suggests that the unit is wrong


def implausible(component: Component, answer: Mapping[str, Any], facts: Mapping[str, Any]) -> dict[str, str]:
    """Find implausible values for the object or material. Returns a text for the model by field of the answer.

    The result is empty if the request has no facts to compare with.
    """
    if component == "object_analyzer":
        return _sizes(answer, facts) | _mass(answer, facts)
    if component == "material_estimator" and "material_category" in facts:
        return constants(str(facts["material_category"]), answer)
    return {}


def constants(word: str, answer: Mapping[str, Any]) -> dict[str, str]:
    """Find constants of a material far from all published values. Returns a text by field of the answer.

    A material without a row in the table has bounds for its density only.
    """
    row = row_of(word)
    wrong = {}
    for name, (low, high) in _bounds(row).items():
        value = answer.get(name)
        if not _is_number(value) or low <= value <= high:
            continue
        off = max(value / high, low / value if value > 0 else 0.0)
        hint = f" ({_SLIPS[name]})" if off > _SLIP and name in _SLIPS else ""
        unit = "" if _UNITS[name] == "-" else f" {_UNITS[name]}"
        whose = f"{row.material.name} has" if row is not None else "a solid has"
        wrong[name] = f"{value:.4g}{unit}, but {whose} {_plain(low)} to {_plain(high)}{unit}{hint}"
    return wrong


def row_of(word: str) -> MaterialRow | None:
    """Return the table's row of a material, or of the longest part of its name with a row (brushed stainless steel)."""
    parts = word.replace("-", " ").replace("_", " ").split()[:_LONGEST]
    for length in range(len(parts), 0, -1):
        for start in range(len(parts) - length, -1, -1):
            row = find_row(" ".join(parts[start : start + length]))
            if row is not None:
                return row
    return None


_LONGEST = 6  # most words of a material that are read


def _bounds(row: MaterialRow | None) -> dict[str, tuple[float, float]]:
    if row is None:
        return {"density_kg_m3": _ANY_SOLID_KG_M3}
    (light, heavy), (soft, stiff) = row.density_range_kg_m3, row.youngs_range_pa
    return {
        "density_kg_m3": (light / _DENSITY_FAR, heavy * _DENSITY_FAR),
        "youngs_modulus_gpa": (soft / 1e9 / _MODULUS_FAR, stiff / 1e9 * _MODULUS_FAR),
        "poisson_ratio": (row.poisson_range[0] - _POISSON_FAR, row.poisson_range[1] + _POISSON_FAR),
        "damping_ratio": (0.0, row.loss_range[1] / 2 * _LOSS_FAR),
    }


def _sizes(answer: Mapping[str, Any], facts: Mapping[str, Any]) -> dict[str, str]:
    measured = [edge for edge in (facts.get(f"{name}_m") for name in EDGES) if _is_number(edge)]
    if len(measured) < len(EDGES):
        return {}
    stated = [answer.get(f"estimated_{name}_m") for name in EDGES]
    # A value that is not a number is reported elsewhere. The other values are still compared with the bounds.
    found = plate_sizes.faults(
        [one if _is_number(one) else other for one, other in zip(stated, measured, strict=True)], measured
    )
    return {f"estimated_{edge}_m": why for edge, why in found.items() if _is_number(stated[EDGES.index(edge)])}


def _mass(answer: Mapping[str, Any], facts: Mapping[str, Any]) -> dict[str, str]:
    mass, whole = answer.get("estimated_mass_kg"), [facts.get(f"whole_{edge}_m") for edge in _WHOLE]
    edges = [edge for edge in whole if _is_number(edge)]
    why = mass_fault(mass, edges) if _is_number(mass) and len(edges) == len(whole) else ""
    return {"estimated_mass_kg": why} if why else {}


def _plain(value: float) -> str:
    """Format a number with three digits, without an exponent if that is short: 2610, not 2.61e+03."""
    return f"{float(f'{value:.3g}'):g}"


def _is_number(value: object) -> TypeGuard[float]:
    return isinstance(value, int | float) and not isinstance(value, bool)
