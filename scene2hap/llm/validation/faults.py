"""Validation of a reply against the schema and bounds of its component; one message names all errors."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from scene2hap.llm.answers import Answer, MaterialAnswer, ObjectAnswer, SceneAnswer, VibrationAnswer, read_answer
from scene2hap.llm.answers.json_text import fields_of
from scene2hap.llm.protocol import Component
from scene2hap.llm.validation.plausibility import implausible

ANSWERS: Mapping[Component, type[Answer]] = {
    "scene_analyzer": SceneAnswer,
    "object_analyzer": ObjectAnswer,
    "material_estimator": MaterialAnswer,
    "vibration_describer": VibrationAnswer,
}

_ARTICLE = re.compile(r"^(a|an|the)\s+")
_NUMERIC = ("greater_than", "less_than", "finite_number", "float_", "int_", "bool_")
_MOST_SHOWN = 15  # every field of the longest answer
_STEEPEST_GPA = 1300.0


@dataclass(frozen=True)
class Fault:
    """The reason why a reply is invalid. `needs_images` is False if the repair needs no pictures.

    A minor fault justifies one repair, but not the loss of the answer.
    """

    reason: str
    needs_images: bool
    is_minor: bool = False


def find_fault(component: Component, text: str, facts: Mapping[str, Any] | None = None) -> Fault | None:
    """Return the fault of a reply, in words for the model that wrote it; None if there is none.

    With the `facts` of the request, a sentence must begin with the object's category, and numbers must be plausible for
    that object or material. The fault names all errors at once.
    """
    doubtful = implausible(component, fields_of(text) or {}, facts or {})
    try:
        answer = read_answer(ANSWERS[component], text)
    except ValidationError as error:
        problems = error.errors(include_url=False)
        reasons = [_in_words(problem) for problem in problems[:_MOST_SHOWN]]
        wrong = {problem["loc"][0] for problem in problems if problem["loc"]}
        reasons += [f"{name}: {why}" for name, why in doubtful.items() if name not in wrong]
        return Fault("; ".join(reasons), not all(problem["type"].startswith(_NUMERIC) for problem in problems))
    if doubtful:
        reason = "; ".join(f"{name}: {why}" for name, why in doubtful.items())
        return Fault(reason, needs_images=False, is_minor=True)
    if isinstance(answer, VibrationAnswer) and facts is not None:
        return _misses_category(answer.sentence, str(facts.get("object_category", "")))
    return None


def _misses_category(sentence: str, category: str) -> Fault | None:
    said, named = (_ARTICLE.sub("", text.strip().lower()) for text in (sentence, category))
    if said.startswith(named):
        return None
    return Fault(f"sentence: it must begin with {category!r}, got {sentence[:80]!r}", needs_images=False, is_minor=True)


def _in_words(problem: ErrorDetails) -> str:
    place = ".".join(map(str, problem["loc"])) or "(whole answer)"
    value = problem["input"]
    shown = f", got {value!r}" if isinstance(value, str | int | float) and problem["loc"] else ""
    return f"{place}: {problem['msg']}{shown[:80]}{_unit_hint(place, value)}"


def _unit_hint(place: str, value: object) -> str:
    # Most frequent mistake: tables give moduli in pascal. The value is not rescaled: 1400 may also be a typing error.
    if place == "youngs_modulus_gpa" and isinstance(value, float | int) and value > _STEEPEST_GPA:
        return " (pascal or megapascal? give gigapascal)"
    return ""
