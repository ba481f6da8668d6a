"""The paper's ten materials: density, modulus and Poisson's ratio from a backend, and ranges from literature.

Source: Scene2Hap, CHI 2026, table "Comparison of LLM's material property estimation". It gives the ranges, the paper's
sources of the ranges, and the answers of GPT-4o. A value on a bound counts as inside.
"""

from __future__ import annotations

from dataclasses import dataclass

from inference.labels import read_rows
from scene2hap import materials
from scene2hap.errors import BadAnswer
from scene2hap.llm.answers import MaterialAnswer
from scene2hap.llm.prompts import Prompts
from scene2hap.llm.protocol import LLMBackend, LLMRequest

CONSTANTS = ("density_kg_m3", "youngs_gpa", "poisson")


@dataclass(frozen=True)
class MaterialRow:
    """One material: ranges from literature, and the constants of a backend (None: no usable answer) and of GPT-4o."""

    material: str
    ranges: tuple[tuple[float, float], ...]
    answer: tuple[float, float, float] | None
    gpt4o: tuple[float, float, float]
    source: str

    @property
    def inside(self) -> tuple[bool, ...]:
        """Which constants of the answer lie in the range."""
        return within(self.answer, self.ranges)

    @property
    def gpt4o_inside(self) -> tuple[bool, ...]:
        """Which of GPT-4o's constants lie in the range, as the paper prints them."""
        return within(self.gpt4o, self.ranges)


def within(values: tuple[float, float, float] | None, ranges: tuple[tuple[float, float], ...]) -> tuple[bool, ...]:
    """Whether each value lies in its range, bounds included up to the last printed digit."""
    if values is None:
        return (False,) * len(ranges)
    return tuple(
        low * (1 - 1e-9) <= value <= high * (1 + 1e-9) for value, (low, high) in zip(values, ranges, strict=True)
    )


async def material_table(backend: LLMBackend) -> list[MaterialRow]:
    """Estimate each of the ten materials from its name alone, as the chain does, one after the other."""
    return [await _row(backend, row) for row in read_rows("paper_materials.csv")]


async def _row(backend: LLMBackend, row: dict[str, str]) -> MaterialRow:
    ranges = tuple(
        (float(row[low]), float(row[high]))
        for low, high in (
            ("density_lo_kg_m3", "density_hi_kg_m3"),
            ("youngs_lo_gpa", "youngs_hi_gpa"),
            ("poisson_lo", "poisson_hi"),
        )
    )
    gpt4o = (float(row["gpt4o_density_kg_m3"]), float(row["gpt4o_youngs_gpa"]), float(row["gpt4o_poisson"]))
    return MaterialRow(row["material"], ranges, await _ask(backend, row["material"]), gpt4o, row["source"])


async def _ask(backend: LLMBackend, material: str) -> tuple[float, float, float] | None:
    facts, prompts = {"material_category": material, "scene_category": "undefined"}, Prompts.load()
    request = LLMRequest(
        component="material_estimator",
        subject=material,
        prompt=prompts.fill("material_estimator", facts),
        facts=facts,
        answer_schema=MaterialAnswer.model_json_schema(),
        prompt_version=prompts.version,
    )
    try:
        answer = MaterialAnswer.model_validate_json((await backend.complete(request)).text)
    except (BadAnswer, ValueError):
        return None
    return answer.density_kg_m3, answer.youngs_modulus_gpa, answer.poisson_ratio


def own_table_differs() -> list[str]:
    """Names of materials whose ranges in scene2hap's table differ from `paper_materials.csv`."""
    known = {row.material.name: row for row in materials.table()}
    apart = []
    for row in read_rows("paper_materials.csv"):
        mine = known[row["material"]]
        pairs = (
            (mine.density_range_kg_m3, (float(row["density_lo_kg_m3"]), float(row["density_hi_kg_m3"]))),
            (mine.youngs_range_pa, (1e9 * float(row["youngs_lo_gpa"]), 1e9 * float(row["youngs_hi_gpa"]))),
            (mine.poisson_range, (float(row["poisson_lo"]), float(row["poisson_hi"]))),
        )
        if any(abs(a - b) > 1e-6 * abs(b) for ours, theirs in pairs for a, b in zip(ours, theirs, strict=True)):
            apart.append(row["material"])
    return apart
