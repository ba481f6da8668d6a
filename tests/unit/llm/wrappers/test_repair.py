"""RepairBackend: content, number and cost of repair requests."""

import asyncio
import json
from dataclasses import replace
from typing import Any

import pytest

from llm_server import GOOD, PNG, request
from scene2hap import FunctionBackend, LLMReply, LLMRequest, RepairBackend
from scene2hap.errors import BadAnswer
from scene2hap.llm.answers.usable import UnusableAnswer
from scene2hap.llm.validation import ANSWERS, find_fault

OAK = GOOD["material_estimator"]
ASKED = request("material_estimator", images=(PNG,))


def scripted(*texts: str | LLMReply) -> FunctionBackend:
    replies = iter(texts)

    def answer(_: LLMRequest) -> LLMReply:
        reply = next(replies)
        return reply if isinstance(reply, LLMReply) else LLMReply(reply, "m", usage={"prompt_tokens": 10})

    return FunctionBackend(answer)


def oak(**changes: Any) -> str:
    return json.dumps({**OAK, **changes})


def test_valid_answers_pass_unchanged() -> None:
    inner = scripted(oak())
    backend = RepairBackend(inner)
    assert asyncio.run(backend.complete(ASKED)) == LLMReply(oak(), "m", usage={"prompt_tokens": 10})
    assert inner.requests == [ASKED]
    assert backend.report() == {"calls": 1, "repairs": 0, "given_up": 0}


def test_modulus_in_pascal_is_requested_again_and_never_rescaled() -> None:
    inner = scripted(oak(youngs_modulus_gpa=1.1e10), oak())
    reply = asyncio.run(RepairBackend(inner).complete(ASKED))
    assert json.loads(reply.text)["youngs_modulus_gpa"] == 11.0
    assert (
        "youngs_modulus_gpa: Input should be less than or equal to 1300, got 11000000000.0" in inner.requests[1].prompt
    )
    assert "pascal or megapascal? give gigapascal" in inner.requests[1].prompt


def test_a_field_that_is_given_twice_is_requested_again() -> None:
    inner = scripted(oak().replace("{", '{"density_kg_m3": 7850.0, ', 1), oak())
    reply = asyncio.run(RepairBackend(inner).complete(ASKED))
    assert json.loads(reply.text) == OAK
    assert "density_kg_m3: the field is given twice; give it once" in inner.requests[1].prompt


@pytest.mark.parametrize("wrong", ["2700 kg/m^3", "about 700", 0.0, 30000.0, None, float("nan")])
def test_invalid_numbers_are_requested_again_without_images(wrong: Any) -> None:
    inner = scripted(oak(density_kg_m3=wrong), oak())
    asyncio.run(RepairBackend(inner).complete(ASKED))
    assert "density_kg_m3" in inner.requests[1].prompt
    assert inner.requests[1].images == ()


@pytest.mark.parametrize(
    "wrong", ["no JSON", '{"density_kg_m3": 700}', "[]", '{"density_kg_m3": 700, "damping_ratio": 7}']
)
def test_other_faults_are_requested_again_with_images(wrong: str) -> None:
    inner = scripted(wrong, oak())
    asyncio.run(RepairBackend(inner).complete(ASKED))
    assert inner.requests[1].images == (PNG,)


def test_repair_request_quotes_only_the_last_failure() -> None:
    inner = scripted(oak(damping_ratio=7.0), oak(poisson_ratio=0.9), oak())
    asyncio.run(RepairBackend(inner).complete(ASKED))
    first, second = (asked.prompt for asked in inner.requests[1:])
    assert first.startswith(ASKED.prompt)
    assert second.startswith(ASKED.prompt)
    assert "damping_ratio: Input" in first
    assert "poisson_ratio: Input" in second
    assert "7.0" not in second
    assert len(second) < len(first) + 50


def test_usage_includes_all_attempts() -> None:
    backend = RepairBackend(scripted("no", "no", oak()))
    assert asyncio.run(backend.complete(ASKED)).usage == {"prompt_tokens": 30}
    assert backend.report() == {"calls": 1, "repairs": 2, "given_up": 0}


def test_repair_gives_up_with_the_last_raw_text() -> None:
    inner = scripted("no", "no", "still no")
    backend = RepairBackend(inner)
    with pytest.raises(BadAnswer, match=r"about 'the scene': still wrong after 2 repairs.*Choose a model") as caught:
        asyncio.run(backend.complete(ASKED))
    assert caught.value.raw_text == "still no"
    assert len(inner.requests) == 3
    assert backend.report() == {"calls": 1, "repairs": 2, "given_up": 1}


def test_error_includes_the_usage_of_all_attempts() -> None:
    with pytest.raises(UnusableAnswer) as caught:
        asyncio.run(RepairBackend(scripted("no", "no", "still no")).complete(ASKED))
    assert (caught.value.model, caught.value.usage) == ("m", {"prompt_tokens": 30})


def test_cut_attempt_includes_the_usage_of_earlier_attempts() -> None:
    def answer(asked: LLMRequest) -> LLMReply:
        if "Your last answer was" in asked.prompt:
            raise UnusableAnswer("cut", model="m", usage={"prompt_tokens": 5})
        return LLMReply("no", "m", usage={"prompt_tokens": 10})

    with pytest.raises(UnusableAnswer, match="cut") as caught:
        asyncio.run(RepairBackend(FunctionBackend(answer)).complete(ASKED))
    assert caught.value.usage == {"prompt_tokens": 15}


def test_answers_are_validated_with_zero_repairs() -> None:
    with pytest.raises(BadAnswer, match="0 repairs"):
        asyncio.run(RepairBackend(scripted("no"), 0).complete(ASKED))


def test_code_fences_are_removed_without_a_request() -> None:
    inner = scripted(f"Here:\n```json\n{oak()}\n```")
    assert asyncio.run(RepairBackend(inner).complete(ASKED)).text == oak()
    assert len(inner.requests) == 1


@pytest.mark.parametrize("reason", ["stop", "STOP", "eos_token", "end_turn", "COMPLETE", "tool_calls"])
def test_answers_that_ended_by_themselves_and_have_extra_fields_need_no_repair(reason: str) -> None:
    inner = scripted(LLMReply(oak(more=1), "m", reason))
    assert asyncio.run(RepairBackend(inner).complete(ASKED)).text == oak(more=1)
    assert len(inner.requests) == 1


@pytest.mark.parametrize("reason", ["length", "MAX_TOKENS", "content_filter", "error"])
def test_truncated_answers_are_not_repaired(reason: str) -> None:
    inner = scripted(LLMReply(oak(), "m", reason))
    with pytest.raises(BadAnswer, match=reason):
        asyncio.run(RepairBackend(inner).complete(ASKED))
    assert len(inner.requests) == 1


def test_a_long_bad_answer_is_quoted_in_part() -> None:
    inner = scripted("x" * 1_000_000, oak())
    asyncio.run(RepairBackend(inner).complete(ASKED))
    assert len(inner.requests[1].prompt) < 5000


@pytest.mark.parametrize("component", ANSWERS)
def test_empty_object_is_invalid_for_every_component(component: Any) -> None:
    fault = find_fault(component, "{}")
    assert fault is not None
    assert fault.needs_images
    assert "Field required" in fault.reason


def described(sentence: str) -> str:
    return json.dumps({"sentence": sentence, "keywords": "phone buzzing"})


@pytest.mark.parametrize(
    ("said", "heard", "calls"),
    [
        (["Phone buzzes on the table."], "Phone buzzes on the table.", 1),
        (["A phone buzzes."], "A phone buzzes.", 1),
        (["It buzzes.", "Phone buzzes."], "Phone buzzes.", 2),
        (["It buzzes.", "It still buzzes."], "It buzzes.", 2),
        (["It buzzes.", "word " * 30], "It buzzes.", 2),
        (["word " * 30, "word " * 30, "It buzzes."], "It buzzes.", 3),
    ],
)
def test_sentence_with_another_subject_is_requested_again_once_and_kept(
    said: list[str], heard: str, calls: int
) -> None:
    inner = scripted(*map(described, said))
    asked = replace(ASKED, component="vibration_describer", facts={"object_category": "phone"})
    reply = asyncio.run(RepairBackend(inner).complete(asked))
    assert json.loads(reply.text)["sentence"] == heard
    assert len(inner.requests) == calls


@pytest.mark.parametrize(
    "failed",
    [
        LLMReply(described("Phone buz"), "m", "length", {"prompt_tokens": 10}),
        LLMReply("", "m", usage={"prompt_tokens": 10}),
        LLMReply("I'm sorry, but I can't help with that.", "m", usage={"prompt_tokens": 10}),
        UnusableAnswer("cut", model="m", usage={"prompt_tokens": 10}),
    ],
    ids=["cut", "empty", "refused", "cut by the backend"],
)
def test_an_answer_with_a_minor_fault_outlives_a_failed_repair(failed: LLMReply | Exception) -> None:
    def answer(asked: LLMRequest) -> LLMReply:
        if "Your last answer was" not in asked.prompt:
            return LLMReply(described("It buzzes."), "m", usage={"prompt_tokens": 10})
        if isinstance(failed, Exception):
            raise failed
        return failed

    asked = replace(ASKED, component="vibration_describer", facts={"object_category": "phone"})
    reply = asyncio.run(RepairBackend(FunctionBackend(answer)).complete(asked))
    assert json.loads(reply.text)["sentence"] == "It buzzes."
    assert reply.usage == {"prompt_tokens": 20}


def test_a_category_with_an_article_may_begin_a_sentence_with_or_without_it() -> None:
    for sentence in ("A pan sizzles.", "The pan sizzles.", "Pan sizzles."):
        text = json.dumps({"sentence": sentence, "keywords": "pan sizzling"})
        assert find_fault("vibration_describer", text, {"object_category": "a pan"}) is None
