"""LexiconBackend: answers for the four components of the chain from a table, without network or randomness."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.errors import BadAnswer, UnknownMaterial
from scene2hap.llm.answers import Answer, MaterialAnswer, SceneAnswer, VibrationAnswer
from scene2hap.llm.lexicon import categories, descriptions, places, similar_materials, table
from scene2hap.llm.protocol import Component, LLMReply, LLMRequest

_Facts = Mapping[str, Any]


@clear_construction
class LexiconBackend:
    """Answer by word lists and tables of everyday objects, without network and key; the default backend.

    Only `request.facts` is read; prompt, pictures and temperature are ignored.
    An object that is not in the table gets the category "unknown", a confidence of at most 0.2, and is silent.
    Raises (from `complete`): BadAnswer: a fact is missing or of the wrong kind, or the requested material is not in the
    material table.
    """

    def __repr__(self) -> str:
        return "LexiconBackend()"

    async def complete(self, request: LLMRequest) -> LLMReply:
        """Return the answer to one request. Equal facts give equal answers."""
        answer = _ANSWERS[request.component](request.facts)
        return LLMReply(text=json.dumps(answer.model_dump()), model=f"lexicon/{table.version()}")


def _scene(facts: _Facts) -> Answer:
    return SceneAnswer(scene_category=places.kind_of_place(_text(facts, "scene_name"), _texts(facts, "object_names")))


def _object(facts: _Facts) -> Answer:
    length, width, thickness = (
        checks.number(name, facts.get(name), "m", at_least=0.0, error=BadAnswer, hint="The lexicon reads it as a fact.")
        for name in ("length_m", "width_m", "thickness_m")
    )
    return categories.judge(
        categories.ObjectFacts(
            _text(facts, "object_name"),
            (length, width, thickness),
            _texts(facts, "surface_flags"),
            scene_category=_text(facts, "scene_category", default=""),
            material_names=_texts(facts, "material_names"),
            height_m=_optional_m(facts, "relative_height_m"),
            whole_m=tuple(edge for edge in (_optional_m(facts, name) for name in _WHOLE_M) if edge is not None),
            chain_names=_texts(facts, "chain_names"),
            n_in_series=int(
                checks.number("n_in_series", facts.get("n_in_series", 0), "-", at_least=0, error=BadAnswer)
            ),
        ),
        _texts(facts, "neighbour_names"),
    )


_WHOLE_M = ("whole_length_m", "whole_width_m", "whole_height_m")


def _optional_m(facts: _Facts, name: str) -> float | None:
    length = facts.get(name)
    return None if length is None else checks.number(name, length, "m", error=BadAnswer)


def _material(facts: _Facts) -> Answer:
    word = _text(facts, "material_category")
    try:
        material = similar_materials.constants(word)
    except UnknownMaterial as cause:
        raise BadAnswer(f"the lexicon cannot estimate a material: {cause}") from cause
    return MaterialAnswer(
        density_kg_m3=material.density_kg_m3,
        youngs_modulus_gpa=material.youngs_modulus_pa / 1e9,
        poisson_ratio=material.poisson_ratio,
        damping_ratio=material.loss_factor / 2,
    )


def _vibration(facts: _Facts) -> VibrationAnswer:
    return descriptions.describe(
        _text(facts, "object_category"), _text(facts, "state"), _text(facts, "scene_category", default="")
    )


_ANSWERS: dict[Component, Callable[[_Facts], Answer]] = {
    "scene_analyzer": _scene,
    "object_analyzer": _object,
    "material_estimator": _material,
    "vibration_describer": _vibration,
}


def _text(facts: _Facts, name: str, default: str | None = None) -> str:
    value = facts.get(name, default)
    if not isinstance(value, str):
        raise BadAnswer(f"fact {name!r} is {value!r}; the lexicon needs a text there.")
    # Replace lone surrogates (from a file name that is not UTF-8), since they have no JSON.
    return value.encode("utf-8", "replace").decode()


def _texts(facts: _Facts, name: str) -> tuple[str, ...]:
    value = facts.get(name, ())
    if isinstance(value, str) or not isinstance(value, (list, tuple)):
        raise BadAnswer(f"fact {name!r} is {value!r}; the lexicon needs a list of texts there.")
    return tuple(_text({name: item}, name) for item in value)
