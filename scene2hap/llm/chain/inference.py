"""Chain of four components that infers haptic properties from a scene.

Scene Analyzer -> for each object: Object Analyzer -> Material Property Estimator, and for each state of a vibrating
object the Vibration Describer. Copies are analysed once, a material is estimated once, and only vibrating objects are
described. Independent calls run concurrently.

Source: Jingu, AliAbbasi et al., Scene2Hap, CHI 2026, section "LLM Workflow and Components".
"""

from __future__ import annotations

import asyncio
import os
from collections.abc import Awaitable, Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar, cast

from scene2hap.common import checks
from scene2hap.common.calls import clear_call
from scene2hap.common.run_coroutine import run_waiting
from scene2hap.contact.graph import ContactGraph
from scene2hap.errors import BackendUnavailable, BadAnswer, ConfigError, RequestRejected, Scene2HapError
from scene2hap.haptics import (
    ObjectHaptics,
    SourceState,
    is_unknown,
    unmet_needs,
)
from scene2hap.llm import BACKENDS
from scene2hap.llm.answers import MaterialAnswer, ObjectAnswer, SceneAnswer, StateAnswer, VibrationAnswer
from scene2hap.llm.chain.config import InferenceConfig
from scene2hap.llm.chain.object_haptics import Analysis, haptics_of, haptics_without_answer, times_of
from scene2hap.llm.chain.questions import ConcurrencyLimit, Questions
from scene2hap.llm.chain.report import InferenceReport
from scene2hap.llm.chain.sharing import copies, of_any_scene, reachable
from scene2hap.llm.lexicon.categories import ObjectFacts, judge
from scene2hap.llm.prompts import Prompts
from scene2hap.llm.prompts.quoting import clean
from scene2hap.llm.protocol import LLMBackend
from scene2hap.llm.validation.materials import Estimate, from_model, from_table, without_answer
from scene2hap.scene.arguments import given_scene
from scene2hap.scene.copies import material_names
from scene2hap.scene.hinges import kinematic_chains
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.snapshot import SceneSnapshot

_Result = TypeVar("_Result")

Progress = Callable[[str, int, int], None]
"""Called with (name of the step, number done, total number)."""

# Errors that end one question and leave the others running.
_SPOILED = (BadAnswer, BackendUnavailable)


@dataclass(frozen=True)
class Inference:
    """Result of the chain: kind of place, haptics of each object by id, and report of the run."""

    scene_category: str
    objects: dict[str, ObjectHaptics]
    report: InferenceReport


async def infer_scene(
    scene: SceneSnapshot,
    backend: LLMBackend,
    *,
    user_prompt: str = "",
    config: InferenceConfig | Mapping[str, Any] | None = None,
    progress: Progress | None = None,
    only: Collection[str] | None = None,
    scene_category: str | None = None,
    object_prompts: Mapping[str, str] | None = None,
    limit: ConcurrencyLimit | None = None,
) -> Inference:
    """Run the chain on every object of a scene, or only on the objects with ids in `only`.

    If the scene has images (`capture_images`), the backend gets them. A known `scene_category` saves the call that
    infers it. `object_prompts` are further user prompts, each for one object, by object id. `limit` bounds the
    concurrent questions of several scenes together; without it, `concurrency` limits those of this scene.

    An object without an answer becomes "unknown" and silent. Its error is in the report and in its provenance. An error
    that would affect every further call is raised after running calls have ended.
    Raises: BackendError and its children, with the object of the request: no object got an answer, the backend is
    unavailable or refuses, a budget is used up, or a recording lacks the answer. ConfigError. UnknownObject.
    """
    settings = InferenceConfig.parse(config)
    checks.text("user_prompt", user_prompt, error=ConfigError)
    if not isinstance(backend, LLMBackend):
        raise ConfigError(
            f"the backend is {checks.described(backend)}; it must have an async method complete(request). "
            "FunctionBackend makes one of a function."
        )
    questions = Questions(
        backend,
        Prompts.load(settings.prompts),
        limit or ConcurrencyLimit(settings.concurrency),
        user_prompt=user_prompt,
        temperature=settings.temperature,
        object_prompts=object_prompts,
    )
    wanted = [scene.object(object_id) for object_id in only] if only is not None else list(scene.objects)
    # Find contacts while waiting for the first answer.
    graph = asyncio.create_task(asyncio.to_thread(ContactGraph, scene))
    if scene_category is None:
        scene_category = await _scene_category(scene, questions)
    chain = _Chain(scene, scene_category, await graph, questions, settings)
    objects = await chain.infer(wanted, progress or (lambda what, done, total: None))
    return Inference(scene_category, objects, questions.report)


@clear_call
def infer_haptics(
    scene: SceneSnapshot | str | os.PathLike[str],
    backend: LLMBackend | str | Mapping[str, Any],
    *,
    user_prompt: str = "",
    config: InferenceConfig | Mapping[str, Any] | None = None,
) -> dict[str, ObjectHaptics]:
    """Infer category, material and vibration of each object of a scene, without sounds. Returns them by id.

    Where an event loop runs, use `infer_scene`.

    Parameters: scene : a snapshot or the path of a scene file; backend : a backend, its kind, or a mapping with a kind.
    Raises: as `infer_scene`. Warns: BackendWarning: a question got no answer; the first error is named.
    """
    built = cast("LLMBackend", BACKENDS.build(backend))  # `infer_scene` checks it
    running = infer_scene(given_scene(scene), built, user_prompt=user_prompt, config=config)
    inference = run_waiting(running, "infer_scene(...)")
    inference.report.warn_of_errors()
    return inference.objects


class _Chain:
    """One run over one scene."""

    def __init__(
        self,
        scene: SceneSnapshot,
        category: str,
        graph: ContactGraph,
        questions: Questions,
        settings: InferenceConfig,
    ) -> None:
        self._scene = scene
        self._category = category
        self._graph = graph
        self._chains = kinematic_chains(scene.objects)
        self._questions = questions
        self._settings = settings
        self._materials: dict[str, asyncio.Task[Estimate]] = {}

    @property
    def _report(self) -> InferenceReport:
        return self._questions.report

    async def infer(self, wanted: list[SceneObject], tell: Progress) -> dict[str, ObjectHaptics]:
        """Return the haptics of each wanted object, in order."""
        standing_for = copies(self._scene, self._graph, self._chains) if self._settings.share_copies else {}
        groups: dict[tuple[str, bool], list[SceneObject]] = {}
        for item in wanted:
            # A prompt for one object does not apply to its copies, so such an object does not share an answer.
            is_alone = self._questions.has_own_prompt(item.id)
            first = item.id if is_alone else standing_for.get(item.id, item.id)
            groups.setdefault((first, is_alone), []).append(item)
        firsts = {members[0].id: members for members in groups.values()}
        self._report.skipped["copies"] += len(wanted) - len(firsts)
        done = 0

        async def analyse(item: SceneObject) -> Analysis:
            nonlocal done
            analysis = await self._analyse(item)
            if self._settings.inference == "eager":
                await self._materials[_word(analysis.answer.material_category)]
            done += len(firsts[item.id])
            tell(item.id, done, len(wanted))
            return analysis

        # Objects that are likely to vibrate need more calls, so they go first.
        order = sorted(firsts, key=lambda object_id: not _seems_to_vibrate(self._scene.object(object_id)))
        try:
            ended = await asyncio.gather(*(analyse(self._scene.object(key)) for key in order), return_exceptions=True)
        finally:
            if self._questions.closed_by is not None:
                await asyncio.gather(*self._materials.values(), return_exceptions=True)
        if self._questions.closed_by is not None:
            raise self._questions.closed_by
        found = [_known(outcome) for outcome in ended]
        analyses = dict(zip(order, found, strict=True))
        failed = [problem for problem in found if isinstance(problem, Scene2HapError)]
        if failed and len(failed) == len(found):
            raise failed[0]
        of_member = {item.id: analyses[first] for first, members in firsts.items() for item in members}
        estimates = await self._estimates(of_member)
        said = {item.id: self._haptics(item, of_member[item.id], estimates) for item in wanted}
        categories = {item.id: said[item.id].object_category if item.id in said else "" for item in self._scene.objects}
        return {key: self._with_unmet_needs(key, haptics, categories) for key, haptics in said.items()}

    async def _analyse(self, item: SceneObject) -> Analysis:
        facts, images = self._shown(item)
        answer, analyst = await self._questions.ask("object_analyzer", item.id, facts, ObjectAnswer, images)
        if self._settings.inference == "eager":
            self._begin_material(answer.material_category)
        if not answer.vibrates:
            self._report.skipped["silent"] += 1
            return Analysis(answer, analyst, (), ())
        described = await _all_ended(self._describe(item, answer, state) for state in answer.states)
        states, describers = zip(*described, strict=True)
        return Analysis(answer, analyst, states, describers)

    def _shown(self, item: SceneObject) -> tuple[dict[str, Any], Sequence[bytes]]:
        """Return the facts and pictures of an object for the Object Analyzer."""
        length, width, thickness = item.size_m
        whole_length, whole_width, whole_height = item.whole_size_m(self._scene.up_axis)
        facts: dict[str, Any] = {
            "scene_category": self._category,
            "object_name": clean(item.name),
            "length_m": length,
            "width_m": width,
            "thickness_m": thickness,
            "whole_length_m": whole_length,
            "whole_width_m": whole_width,
            "whole_height_m": whole_height,
            "relative_height_m": item.relative_height_m,
            "surface_flags": list(item.surface.flags),
            "material_names": [clean(name) for name in material_names(item)],
            "neighbour_names": [clean(self._scene.object(other).name) for other in self._graph.neighbours(item.id)],
        }
        chain = self._chains.get(item.id)
        if chain is not None:
            facts["chain_names"] = [clean(self._scene.object(each).name) for each in chain.ids]
            facts["n_in_series"] = chain.n_in_series
        if not self._settings.share_scenes:
            return facts, item.images.together if item.images is not None else ()
        return of_any_scene(facts, item.name), item.images.isolated if item.images is not None else ()

    async def _describe(self, item: SceneObject, analysed: ObjectAnswer, state: StateAnswer) -> tuple[SourceState, str]:
        facts = {
            "scene_category": self._category,
            "object_category": analysed.object_category,
            "usage": analysed.usage,
            "state": state.name,
        }
        try:
            words, who = await self._questions.ask("vibration_describer", item.id, facts, VibrationAnswer)
            sentence, keywords, times = words.sentence, words.keywords, times_of(words)
        except _SPOILED as problem:
            self._report.errors[f"{item.id}, state {state.name}"] = str(problem)
            # The state itself has an answer. Its name is description enough to find or make a sound.
            sentence = keywords = f"{analysed.object_category} {state.name}"
            times = {}
            who = f"error: {problem}"
        return SourceState(state.name, state.intensity, sentence, keywords, state.needs_contact, **times), who

    def _begin_material(self, category: str) -> asyncio.Task[Estimate]:
        word = _word(category)
        if word in self._materials:
            self._report.skipped["unknown_material" if is_unknown(word) else "same_material"] += 1
        else:
            self._materials[word] = asyncio.ensure_future(self._estimate(word))
        return self._materials[word]

    async def _estimate(self, word: str) -> Estimate:
        if is_unknown(word):
            self._report.skipped["unknown_material"] += 1
            return Estimate(None, "no estimate: the material is unknown")
        if self._settings.materials == "table" and (known := from_table(word)) is not None:
            self._report.skipped["table_material"] += 1
            return known
        try:
            facts = {"scene_category": self._category, "material_category": word}
            answer, who = await self._questions.ask("material_estimator", word, facts, MaterialAnswer)
            estimate = from_model(word, answer, who)
        except _SPOILED as problem:
            self._report.errors[word] = str(problem)
            estimate = without_answer(word, str(problem))
        if estimate.flags:
            self._report.flags[word] = estimate.flags
        return estimate

    async def _estimates(self, analyses: Mapping[str, Analysis | Scene2HapError]) -> dict[str, Estimate]:
        """Return the estimate of each object's material, by object id. Requests missing estimates."""
        answered = {key: found for key, found in analyses.items() if isinstance(found, Analysis)}
        needed = set(answered)
        if self._settings.inference == "lazy":
            needed &= reachable((key for key, found in answered.items() if found.states), self._graph)
        for key, found in answered.items():
            if key in needed and _word(found.answer.material_category) not in self._materials:
                self._begin_material(found.answer.material_category)
        words = {key: _word(found.answer.material_category) for key, found in answered.items()}
        unreached = {word: _unreached(word) for word in words.values() if word not in self._materials}
        self._report.skipped["unreached_material"] += len(unreached)
        estimates = dict(zip(self._materials, await _all_ended(self._materials.values()), strict=True))
        return {key: {**unreached, **estimates}[word] for key, word in words.items()}

    def _haptics(
        self, item: SceneObject, found: Analysis | Scene2HapError, estimates: Mapping[str, Estimate]
    ) -> ObjectHaptics:
        if isinstance(found, Scene2HapError):
            self._report.errors[item.id] = str(found)
            return haptics_without_answer(item, found)
        haptics, doubts = haptics_of(item, found, estimates[item.id], self._scene.up_axis)
        if doubts:
            self._report.doubts[item.id] = doubts
        return haptics

    def _with_unmet_needs(self, object_id: str, haptics: ObjectHaptics, categories: Mapping[str, str]) -> ObjectHaptics:
        """Add a note to each state that needs a contact no object here offers. Such a state stays silent until then."""
        doubts = unmet_needs(object_id, haptics.states, categories)
        if not doubts:
            return haptics
        self._report.doubts[object_id] = (*self._report.doubts.get(object_id, ()), *doubts)
        return replace(haptics, reasons={**haptics.reasons, "contact": "; ".join(doubts)})


async def _all_ended(running: Iterable[Awaitable[_Result]]) -> list[_Result]:
    """Return the results in order, or raise the first error after all have ended.

    `asyncio.gather` raises at once. The event loop would then cancel calls that are paid for, or the storing of their
    answers.
    """
    ended = await asyncio.gather(*running, return_exceptions=True)
    for outcome in ended:
        if isinstance(outcome, BaseException):
            raise outcome
    return cast("list[_Result]", ended)


def _known(outcome: Analysis | BaseException) -> Analysis | Scene2HapError:
    """Return the outcome of an analysis. Raises: any error that is not of this library."""
    if isinstance(outcome, BaseException) and not isinstance(outcome, Scene2HapError):
        raise outcome
    return outcome


async def _scene_category(scene: SceneSnapshot, questions: Questions) -> str:
    """Return the kind of place; "undefined" if the answer is unusable."""
    facts = {"scene_name": clean(scene.name), "object_names": [clean(item.name) for item in scene.objects]}
    try:
        answer, _ = await questions.ask("scene_analyzer", "", facts, SceneAnswer, scene.images or ())
    except (BadAnswer, RequestRejected) as problem:
        questions.report.errors[""] = str(problem)
        return "undefined"
    return answer.scene_category


def _word(category: str) -> str:
    return " ".join(category.lower().split())


def _unreached(word: str) -> Estimate:
    return from_table(word) or Estimate(None, "no estimate: no source reaches it")


def _seems_to_vibrate(item: SceneObject) -> bool:
    return judge(ObjectFacts(clean(item.name), item.size_m, item.surface.flags)).vibrates
