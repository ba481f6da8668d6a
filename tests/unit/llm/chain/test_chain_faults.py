"""The inference chain with invalid answers and failing backends."""

import asyncio
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

import pytest

from scene2hap import (
    CacheBackend,
    LLMReply,
    LLMRequest,
    RecordingBackend,
    RepairBackend,
    ReplayBackend,
    infer_haptics,
    materials,
)
from scene2hap.errors import BackendUnavailable, BadAnswer, BudgetExceeded, ReplayMiss, RequestRejected
from scene2hap.llm.answers.usable import UnusableAnswer
from scene2hap.llm.chain import infer_scene
from scene2hap.llm.chain.questions import MOST_UNANSWERED
from scene2hap.llm.chain.report import InferenceReport
from scenes import box, scene
from scripted_backend import SCENE, Scripted, run

STATE = {"name": "on", "intensity": 0.5, "needs_contact": None}


def test_unknown_material_leaves_other_answers_valid() -> None:
    backend = Scripted(
        object_analyzer=lambda request, answer: {**answer, "material_category": "unobtainium"},
        material_estimator=lambda request, answer: {**answer, "youngs_modulus_gpa": 70e9},
    )
    found = run(backend)
    assert found.objects["table"].material is None
    assert "youngs_modulus_gpa" in found.objects["table"].provenance["material"]
    assert "youngs_modulus_gpa" in found.report.errors["unobtainium"]


@pytest.mark.parametrize("zeros", [{"density_kg_m3": 0.0}, {"youngs_modulus_gpa": 0.0}, {"poisson_ratio": 0.5}])
def test_impossible_constants_are_replaced_by_the_table_and_flagged(zeros: dict[str, float]) -> None:
    found = run(Scripted(material_estimator=lambda request, answer: {**answer, **zeros}))
    oak = materials.lookup("oak")
    assert found.objects["table"].material == replace(oak, name="oak")
    assert found.objects["table"].provenance["material"] == "table of materials"
    assert next(iter(zeros)) in found.report.flags["oak"][0]
    assert "table" in found.objects["table"].reasons["material"]


def test_constants_outside_the_material_range_are_replaced_and_flagged() -> None:
    oak = materials.lookup("oak")
    wrong = {"density_kg_m3": 0.75 * 10, "youngs_modulus_gpa": 9000.0 / 10}  # g/cm3 of lead, megapascal
    found = run(Scripted(material_estimator=lambda request, answer: {**answer, **wrong, "damping_ratio": 0.02}))
    material = found.objects["table"].material
    assert material is not None
    assert (material.density_kg_m3, material.youngs_modulus_pa) == (oak.density_kg_m3, oak.youngs_modulus_pa)
    assert material.loss_factor == pytest.approx(0.04)  # plausible values of the model are kept
    told = found.report.flags["oak"]
    assert [flag.split(":")[0] for flag in told] == ["density_kg_m3", "youngs_modulus_gpa"]
    assert "7.5 kg/m3" in told[0]
    assert "the table's constant is used" in told[0]
    assert "table of materials" in found.objects["table"].provenance["material"]


def test_bad_answer_affects_only_its_object() -> None:
    def change(request: LLMRequest, answer: dict[str, Any]) -> dict[str, Any]:
        return {**answer, "confidence": 7.0} if request.subject == "cup" else answer

    found = run(Scripted(object_analyzer=change))
    assert found.objects["table"].object_category == "table"
    cup = found.objects["cup"]
    assert (cup.object_category, cup.vibrates, cup.confidence, cup.material) == ("unknown", False, 0.0, None)
    assert "confidence" in cup.provenance["object_category"]
    assert list(found.report.errors) == ["cup"]


def test_an_unusable_answer_that_was_billed_is_in_the_account() -> None:
    def change(request: LLMRequest, answer: dict[str, Any]) -> dict[str, Any]:
        if request.subject == "cup":
            raise UnusableAnswer("cut", model="m", usage={"prompt_tokens": 9})
        return answer

    assert run(Scripted(object_analyzer=change)).report.tokens == {"m": {"prompt_tokens": 9}}


def test_the_account_of_two_runs_has_the_answers_of_both() -> None:
    runs = []
    for cup_tokens, is_kept in ((9, False), (5, True)):
        report = InferenceReport()
        report.calls["object_analyzer"] += 2
        report.take(LLMReply("{}", "m", usage={"prompt_tokens": cup_tokens}))
        report.take(LLMReply("{}", "m", usage={"prompt_tokens": 100}, is_kept=is_kept))
        report.take(LLMReply("{}", "m"))
        runs.append(report)
    first, last = runs
    last.add_answers_of(first)
    assert (last.calls["object_analyzer"], last.kept, last.unmetered) == (4, 1, 2)
    assert last.tokens == {"m": {"prompt_tokens": 9 + 100 + 5}}
    assert first.tokens == {"m": {"prompt_tokens": 9 + 100}}


def test_failing_describer_keeps_the_state() -> None:
    found = run(Scripted(vibration_describer=lambda request, answer: {**answer, "keywords": "phone vibrating"}))
    state = found.objects["phone"].states[0]
    assert (state.sentence, state.keywords) == ("phone ringing", "phone ringing")
    assert sorted(found.report.errors) == ["phone, state alarm", "phone, state ringing"]


@pytest.mark.parametrize(
    "refusal",
    [
        BudgetExceeded("no money left"),
        ReplayMiss("no answer"),
        BackendUnavailable("the key is refused"),
        OSError("of another library"),
    ],
    ids=lambda error: type(error).__name__,
)
def test_error_common_to_all_calls_ends_the_run_after_running_calls(refusal: Exception) -> None:
    class Refusing(Scripted):
        answered = 0

        async def complete(self, request: LLMRequest) -> LLMReply:
            if request.subject == "table":
                raise refusal
            reply = await super().complete(request)
            await asyncio.sleep(0.01)
            self.answered += 1
            return reply

    backend = Refusing()
    with pytest.raises(type(refusal), match=str(refusal)):
        run(backend, {"concurrency": 2})
    assert backend.answered == len(backend.asked)  # running calls were completed
    assert not [request for request in backend.asked if request.component == "vibration_describer"]


def test_such_an_error_at_the_materials_which_are_asked_for_last_is_raised() -> None:
    def refuse(request: LLMRequest, answer: dict[str, Any]) -> dict[str, Any]:
        raise BudgetExceeded("no money left")

    with pytest.raises(BudgetExceeded, match="no money left"):
        run(Scripted(material_estimator=refuse), {"inference": "lazy"})


@pytest.mark.parametrize("wrapper", [CacheBackend, RecordingBackend])
def test_an_answer_that_is_paid_for_is_stored_before_a_foreign_error_is_raised(
    tmp_path: Path, wrapper: Callable[[Any, Path], Any]
) -> None:
    """One of two calls at a time fails while the answer to the other one is on its way."""

    class Failing(Scripted):
        identity: ClassVar = {"model": "scripted"}

        async def complete(self, request: LLMRequest) -> LLMReply:
            if request.component == "object_analyzer" and len(self.asked) > 1:
                raise OSError("of another library")
            reply = await super().complete(request)
            await asyncio.sleep(0.05)
            return reply

    backend, kept = Failing(), tmp_path / "kept"
    with pytest.raises(OSError, match="of another library"):
        run(wrapper(backend, kept), {"concurrency": 2})
    assert [request.component for request in backend.asked] == ["scene_analyzer", "object_analyzer"]
    stored = list(kept.glob("*.json")) if kept.is_dir() else kept.read_text().splitlines()
    assert len(stored) == 2


def test_lost_connection_affects_only_the_running_request() -> None:
    class Flaky(Scripted):
        async def complete(self, request: LLMRequest) -> LLMReply:
            if request.subject == "cup":
                raise BackendUnavailable("connection reset", retryable=True)
            return await super().complete(request)

    found = run(Flaky())
    assert found.report.errors == {"cup": "connection reset"}
    assert found.objects["phone"].vibrates


class Rejecting(Scripted):
    """Raise `error` for each object of `subjects`, or from the question with number `after` on."""

    def __init__(self, error: Exception, subjects: tuple[str, ...] = (), after: int = 10**9) -> None:
        super().__init__()
        self.error, self.subjects, self.after = error, subjects, after

    async def complete(self, request: LLMRequest) -> LLMReply:
        reply = await super().complete(request)
        if request.subject in self.subjects or len(self.asked) > self.after:
            raise self.error
        return reply


MANY = scene(*(box(f"box {i}", (0.1 + 0.01 * i, 0.1, 0.1), (float(i), 0.05, 0.0)) for i in range(40)))
REJECTED = RequestRejected("answered 400 (invalid_image_format)")
AWAY = BackendUnavailable("answered 503", retryable=True)


@pytest.mark.parametrize("first", ["table", "phone", "cup"])
def test_a_rejected_question_affects_only_its_object(first: str) -> None:
    found = run(Rejecting(REJECTED, (first,)), {"concurrency": 3})
    assert found.report.errors == {first: str(REJECTED)}
    assert found.objects[first].object_category == "unknown"


def test_a_rejected_question_about_the_place_leaves_it_undefined() -> None:
    found = run(Rejecting(REJECTED, ("",)))
    assert found.scene_category == "undefined"
    assert found.objects["table"].object_category == "table"


def test_many_rejected_questions_beside_answers_do_not_stop_a_run() -> None:
    rejected = tuple(f"box {i}" for i in range(20, 40))
    found = asyncio.run(infer_scene(MANY, Rejecting(REJECTED, rejected), config={"concurrency": 1}))
    assert set(found.report.errors) == set(rejected)


@pytest.mark.parametrize("error", [REJECTED, AWAY], ids=["rejects all", "is away"])
def test_a_service_that_rejects_every_question_gets_few(error: Exception) -> None:
    backend = Rejecting(error, after=1)
    with pytest.raises(BackendUnavailable, match="8 questions of the object_analyzer in a row .*answered [45]0[03]"):
        asyncio.run(infer_scene(MANY, backend, config={"concurrency": 1}))
    assert len(backend.asked) == 1 + MOST_UNANSWERED


def test_a_service_that_goes_away_ends_the_run_in_place_of_silencing_all_other_objects() -> None:
    backend = Rejecting(AWAY, after=12)
    with pytest.raises(BackendUnavailable, match="no more are sent"):
        asyncio.run(infer_scene(MANY, backend, config={"concurrency": 4}))
    assert len(backend.asked) <= 12 + MOST_UNANSWERED + 4


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda request, answer: {**answer, "confidence": 7}, r"object_analyzer about '\w+': confidence is 7: "),
        (lambda request, answer: {**answer, "colour": "red", "usage": 7}, "usage is 7"),
        (
            lambda request, answer: LLMReply("I think it is a table.", "scripted"),
            r"'I think.*Invalid JSON.*must be JSON of",
        ),
        (lambda request, answer: LLMReply(json.dumps(answer)[:40], "scripted", "length"), "ended by 'length'"),
        (lambda request, answer: {**answer, "states": [STATE, {**STATE, "name": " On"}]}, "states .* repeat a name"),
    ],
)
def test_error_describes_an_invalid_answer(change: object, sentence: str) -> None:
    with pytest.raises(BadAnswer, match=sentence) as caught:
        infer_haptics(SCENE, Scripted(object_analyzer=change))
    assert caught.value.raw_text


@pytest.mark.parametrize(
    "change",
    [
        lambda request, answer: {**answer, "colour": "red", "sources": [1]},
        lambda request, answer: {**answer, "states": [{**state, "tone_hz": 60} for state in answer["states"]]},
        lambda request, answer: LLMReply(f"Sure:\n```json\n{json.dumps(answer)}\n```", "scripted"),
        lambda request, answer: LLMReply(json.dumps(answer), "scripted", "end_turn"),
        lambda request, answer: {"object_analyzer": answer},
    ],
    ids=["extra fields", "extra fields of a state", "fences", "the name of another service for the end", "a wrapper"],
)
def test_what_does_no_harm_costs_no_answer(change: object) -> None:
    assert infer_haptics(SCENE, Scripted(object_analyzer=change)) == infer_haptics(SCENE, Scripted())


def test_unreachable_backend_raises_connection_error() -> None:
    class Away:
        async def complete(self, request: LLMRequest) -> LLMReply:
            raise BackendUnavailable("the model is away")

    with pytest.raises(ConnectionError, match="away"):
        infer_haptics(SCENE, Away())


def test_a_start_of_minutes_counts_as_the_longest_that_can_be_felt() -> None:
    times = {"start_up_s": 240.0, "wind_down_s": 4.0}
    found = run(Scripted(vibration_describer=lambda request, answer: {**answer, **times}))
    state = found.objects["phone"].states[0]
    assert (state.start_up_s, state.wind_down_s, state.keywords) == (30.0, 4.0, "phone buzzing")
    assert not found.report.errors


def test_a_turn_on_without_a_turn_off_is_no_description() -> None:
    found = run(Scripted(vibration_describer=lambda request, answer: {**answer, "on_s": 4.0}))
    assert "on_s and off_s belong together" in found.report.errors["phone, state ringing"]


def test_a_state_in_which_nothing_moves_is_left_out() -> None:
    still = {"name": "off", "intensity": 0.0, "needs_contact": None}
    found = run(Scripted(object_analyzer=lambda request, answer: {**answer, "states": [*answer["states"], still]}))
    assert [state.name for state in found.objects["phone"].states] == ["ringing", "alarm"]
    assert not found.report.errors
    with pytest.raises(BadAnswer, match="no state has an intensity above 0"):
        infer_haptics(
            SCENE, Scripted(object_analyzer=lambda request, answer: {**answer, "vibrates": True, "states": [still]})
        )


@pytest.mark.parametrize("word", ["Unknown material", "unbekannt", "N/A", "\u4e0d\u660e"])
def test_no_constants_are_requested_for_a_material_that_is_unknown_in_other_words(word: str) -> None:
    backend = Scripted(object_analyzer=lambda request, answer: {**answer, "material_category": word})
    found = run(backend)
    assert "material_estimator" not in {request.component for request in backend.asked}
    assert found.objects["table"].material is None


def test_a_sentence_a_few_words_too_long_is_used() -> None:
    sentence = "phone" + " buzzes" * 19
    found = run(Scripted(vibration_describer=lambda request, answer: {**answer, "sentence": sentence}))
    assert found.objects["phone"].states[0].sentence == sentence
    found = run(Scripted(vibration_describer=lambda request, answer: {**answer, "sentence": f"{sentence} on"}))
    assert "21 words; at most 20 are allowed" in found.report.errors["phone, state ringing"]


def test_a_recorded_run_with_an_unusable_answer_can_be_replayed(tmp_path: Path) -> None:
    def change(request: LLMRequest, answer: dict[str, Any]) -> dict[str, Any] | LLMReply:
        if request.subject == "cup":
            return {**answer, "confidence": 7.0}
        cut = LLMReply(json.dumps(answer), "scripted", "length")
        return cut if request.subject == "phone" else answer

    kept = tmp_path / "answers.jsonl"
    recorded = run(RecordingBackend(RepairBackend(Scripted(object_analyzer=change)), kept))
    assert sorted(recorded.report.errors) == ["cup", "phone"]
    replayed = run(ReplayBackend(kept))
    assert sorted(replayed.report.errors) == ["cup", "phone"]
    assert "confidence" in replayed.report.errors["cup"]
    assert "ended by 'length'" in replayed.report.errors["phone"]
    assert replayed.objects["table"].object_category == recorded.objects["table"].object_category == "table"
