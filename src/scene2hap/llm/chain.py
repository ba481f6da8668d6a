"""Four components in a chain, from scene to haptic properties.

Scene Analyzer -> for each object: Object Analyzer -> Material Property Estimator, and for each state of a vibrating
object the Vibration Describer. What does not vibrate is not described; a material is estimated once.

Source: Jingu, AliAbbasi et al., Scene2Hap, CHI 2026, section "LLM Workflow and Components".
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from pydantic import ValidationError

from scene2hap import checks
from scene2hap.contact.graph import ContactGraph
from scene2hap.errors import BadAnswer
from scene2hap.haptics import ObjectHaptics, SourceState
from scene2hap.llm import prompts
from scene2hap.llm.answers import Answer, MaterialAnswer, ObjectAnswer, SceneAnswer, StateAnswer, VibrationAnswer
from scene2hap.llm.protocol import Component, LLMBackend, LLMRequest
from scene2hap.materials import Material
from scene2hap.scene.snapshot import SceneObject, SceneSnapshot

TEMPERATURE = 0.2
"""As in the paper, section "LLM Workflow"."""

UNKNOWN = frozenset({"", "unknown", "undefined"})
"""Words by which a backend says that it cannot tell."""

Progress = Callable[[str, int, int], None]
"""Told (what is done, how many are done, of how many)."""

AnswerType = TypeVar("AnswerType", bound=Answer)


@dataclass(frozen=True)
class Inference:
    """What the chain found: the kind of place, and the haptics of each object by id."""

    scene_category: str
    objects: dict[str, ObjectHaptics]


async def infer_scene(
    scene: SceneSnapshot,
    backend: LLMBackend,
    *,
    user_prompt: str = "",
    concurrency: int = 8,
    progress: Progress | None = None,
) -> Inference:
    """Run the chain on every object of a scene, up to `concurrency` objects at once.

    A scene with images (`capture_images`) shows them to the backend.

    Raises: BackendError and its children, with the object that was asked about.
    """
    chain = _Chain(backend, user_prompt)
    scene_facts = {"scene_name": scene.name, "object_names": [item.name for item in scene.objects]}
    answer, _ = await chain.ask("scene_analyzer", "", scene_facts, SceneAnswer, scene.images or ())
    category = answer.scene_category
    neighbours = _neighbour_names(scene)
    turn = asyncio.Semaphore(concurrency)
    done = 0

    async def infer(item: SceneObject) -> ObjectHaptics:
        nonlocal done
        async with turn:
            haptics = await chain.infer_object(item, category, neighbours[item.id])
        done += 1
        if progress is not None:
            progress(item.id, done, len(scene.objects))
        return haptics

    found = await asyncio.gather(*(infer(item) for item in scene.objects))
    return Inference(category, {item.id: haptics for item, haptics in zip(scene.objects, found, strict=True)})


def infer_haptics(scene: SceneSnapshot, backend: LLMBackend, *, user_prompt: str = "") -> dict[str, ObjectHaptics]:
    """The haptics of each object by id; `infer_scene` for callers that run an event loop."""
    return asyncio.run(infer_scene(scene, backend, user_prompt=user_prompt)).objects


class _Chain:
    """One run over one scene: the backend, the user's wish, and the materials that were asked for already."""

    def __init__(self, backend: LLMBackend, user_prompt: str) -> None:
        self._backend = backend
        self._user_prompt = user_prompt
        self._materials: dict[str, asyncio.Task[tuple[Material | None, str]]] = {}

    async def infer_object(self, item: SceneObject, scene_category: str, neighbours: list[str]) -> ObjectHaptics:
        """Analyse one object, estimate its material and describe each of its states."""
        length, width, thickness = item.size_m
        facts = {
            "scene_category": scene_category,
            "object_name": item.name,
            "length_m": length,
            "width_m": width,
            "thickness_m": thickness,
            "relative_height_m": item.relative_height_m,
            "surface_flags": list(item.surface.flags),
            "neighbour_names": neighbours,
        }
        images = item.images.together if item.images is not None else ()
        answer, analyst = await self.ask("object_analyzer", item.id, facts, ObjectAnswer, images)
        material, estimator = await self.material(answer.material_category)
        described = [await self.describe(item, answer, state, scene_category) for state in answer.states]
        vibrates = answer.vibrates and bool(described)
        provenance = {"object_analyzer": analyst, "material_estimator": estimator}
        if vibrates:
            provenance["vibration_describer"] = described[0][1]
        return ObjectHaptics(
            object_category=answer.object_category,
            material_category=answer.material_category,
            material=material,
            estimated_size_m=(answer.estimated_length_m, answer.estimated_width_m, answer.estimated_thickness_m),
            usage=answer.usage,
            vibrates=vibrates,
            states=tuple(state for state, _ in described) if vibrates else (),
            confidence=answer.confidence,
            reasons={
                "category": answer.category_reason,
                "size": answer.size_reason,
                "vibration": answer.vibration_reason,
            },
            provenance=provenance,
        )

    async def material(self, category: str) -> tuple[Material | None, str]:
        """The constants of a material, and who gave them; each distinct word is asked once."""
        word = category.strip().lower()
        if word not in self._materials:
            self._materials[word] = asyncio.ensure_future(self._estimate(word))
        return await self._materials[word]

    async def _estimate(self, word: str) -> tuple[Material | None, str]:
        if word in UNKNOWN:
            return None, "not asked: the material is unknown"
        try:
            answer, who = await self.ask("material_estimator", word, {"material_category": word}, MaterialAnswer)
        except BadAnswer as cause:
            # One material that nobody knows must not cost the whole scene: its objects just carry no vibration.
            return None, f"no usable answer: {cause}"
        modulus_pa = answer.youngs_modulus_gpa * 1e9
        return Material(word, answer.density_kg_m3, modulus_pa, answer.poisson_ratio, answer.loss_factor), who

    async def describe(
        self, item: SceneObject, analysed: ObjectAnswer, state: StateAnswer, scene_category: str
    ) -> tuple[SourceState, str]:
        """One state in words, and who wrote them."""
        facts = {
            "scene_category": scene_category,
            "object_category": analysed.object_category,
            "usage": analysed.usage,
            "state": state.name,
        }
        words, who = await self.ask("vibration_describer", item.id, facts, VibrationAnswer)
        return SourceState(state.name, state.intensity, words.sentence, words.keywords, state.needs_contact), who

    async def ask(
        self,
        component: Component,
        subject: str,
        facts: Mapping[str, Any],
        shape: type[AnswerType],
        images: Sequence[bytes] = (),
    ) -> tuple[AnswerType, str]:
        """A validated answer, and who gave it.

        Raises: BadAnswer: the reply was cut short, is not JSON or breaks a bound; it carries the raw text.
        """
        request = LLMRequest(
            component=component,
            subject=subject,
            prompt=prompts.fill(component, facts, self._user_prompt),
            facts=facts,
            answer_schema=shape.model_json_schema(),
            prompt_version=prompts.VERSION,
            images=images,
            temperature=TEMPERATURE,
        )
        reply = await self._backend.complete(request)
        about = f"{component} about {subject or 'the scene'!r}"
        if reply.finish_reason != "stop":
            raise BadAnswer(f"{about}: the answer ended by {reply.finish_reason!r}, not by itself.", reply.text)
        try:
            return shape.model_validate_json(reply.text), f"{reply.model}, prompt {prompts.VERSION}"
        except ValidationError as cause:
            problem = checks.first_problem(cause)
            place = problem.place or "(whole answer)"
            raise BadAnswer(f"{about}: {place}: {problem.reason}.", reply.text) from cause


def _neighbour_names(scene: SceneSnapshot) -> dict[str, list[str]]:
    graph = ContactGraph(scene)
    return {
        item.id: [scene.object(neighbour).name for neighbour in graph.neighbours(item.id)] for item in scene.objects
    }
