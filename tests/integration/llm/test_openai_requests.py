"""Requests of OpenAIBackend follow the published schema."""

import base64
import json
import re
from typing import Any

import jsonschema
import pytest

from llm_asking import ask, openai
from llm_server import GOOD, KEY, PNG, Scripted, request, said
from openai_schema import SCHEMA, assert_openai_says, assert_openai_takes, openai_serving
from others import needed
from scene2hap import BackendWarning


@pytest.mark.parametrize(
    "component", ["scene_analyzer", "object_analyzer", "material_estimator", "vibration_describer"]
)
@pytest.mark.parametrize(
    "settings",
    [{}, {"detail": "high", "max_tokens": 300, "seed": 1, "top_p": 0.5, "reasoning_effort": "low"}],
    ids=["plain", "all"],
)
def test_request_bodies_fit_the_openai_schema(component: Any, settings: dict[str, Any]) -> None:
    needed(SCHEMA)
    with openai_serving(said()) as server:
        ask(openai(server, **settings), request(component, images=(PNG, PNG)))
    assert_openai_takes(server.bodies[0])
    assert server.asked[0].path == "/v1/chat/completions"  # not /v1/responses, where no local server enforces a schema
    assert re.fullmatch(r"[A-Za-z0-9_-]{1,64}", server.bodies[0]["response_format"]["json_schema"]["name"])


def test_the_schema_check_can_fail() -> None:
    needed(SCHEMA)
    body = {"model": "gpt-4o", "messages": [{"role": "user", "content": "a"}]}
    assert_openai_takes(body)
    with pytest.raises(jsonschema.ValidationError):
        assert_openai_takes({**body, "temperature": "warm"})
    with pytest.raises(AssertionError):
        assert_openai_takes({**body, "images": []})
    with pytest.raises(jsonschema.ValidationError):
        assert_openai_takes({**body, "response_format": {"type": "json_schema", "schema": {}}})
    picture = {"type": "image_url", "image_url": {"url": "data:image/png;base64,AA==", "detail": "original"}}
    with pytest.raises(jsonschema.ValidationError):
        assert_openai_takes({**body, "messages": [{"role": "user", "content": [picture]}]})


@pytest.mark.parametrize(
    "wrong",
    [
        {**said().body, "choices": [{"message": {}}]},
        {**said().body, "id": 1},
        {**said(None, None).body},
    ],
)
def test_the_check_of_scripted_answers_can_fail(wrong: dict[str, Any]) -> None:
    needed(SCHEMA)
    with pytest.raises(jsonschema.ValidationError):
        assert_openai_says(Scripted(wrong, claims="CreateChatCompletionResponse"))


def billed(prompt_tokens: int) -> Scripted:
    reply = said()
    reply.body["usage"]["prompt_tokens"] = prompt_tokens
    return reply


@pytest.mark.parametrize(("detail", "tokens"), [("low", 20_000), ("high", 150_000)])
def test_pictures_billed_as_text_warn(detail: Any, tokens: int) -> None:
    """gpt-5.4-mini has billed the base64 of images as text: 8 tokens for each 12 characters."""
    with openai_serving(billed(tokens)) as server:
        backend = openai(server, detail=detail)
        with pytest.warns(BackendWarning, match=f"billed {tokens} tokens .* 2 pictures"):
            ask(backend, request(images=(PNG, PNG)))
        ask(backend, request(images=(PNG, PNG)))  # a second warning would be an error here


def test_plausible_picture_costs_do_not_warn() -> None:
    """The highest cost of gpt-4o-mini: 2,833 tokens an image, or 48,169 for eight tiles; and prompts without images."""
    with openai_serving(billed(2 * 2_833 + 40), billed(2 * 48_169 + 40), billed(90_000)) as server:
        ask(openai(server), request(images=(PNG, PNG)))
        ask(openai(server, detail="high"), request(images=(PNG, PNG)))
        ask(openai(server), request())


def test_request_carries_model_key_temperature_and_strict_format() -> None:
    with openai_serving(said()) as server:
        ask(openai(server), request(temperature=0.2))
    asked = server.asked[0]
    assert asked.path == "/v1/chat/completions"
    assert asked.headers["authorization"] == f"Bearer {KEY}"
    assert asked.headers["content-type"] == "application/json"
    assert (asked.body["model"], asked.body["temperature"]) == ("gpt-4o", 0.2)
    assert asked.body["response_format"] == {
        "type": "json_schema",
        "json_schema": {
            "name": "scene_analyzer",
            "strict": True,
            "schema": {
                "type": "object",
                "description": 'Scene Analyzer: what kind of place this is, in one or two words, or "undefined".',
                "properties": {
                    "scene_category": {"type": "string", "description": "Length at least 1, length at most 60."}
                },
                "required": ["scene_category"],
                "additionalProperties": False,
            },
        },
    }
    assert not {"seed", "max_tokens", "max_completion_tokens"} & set(asked.body)


@pytest.mark.parametrize("detail", ["low", "high"])
def test_detail_is_always_sent_and_images_keep_their_order(detail: Any) -> None:
    images = (PNG, PNG + b"2", PNG + b"3")
    with openai_serving(said()) as server:
        ask(openai(server, detail=detail), request(images=images))
    first, *pictures = server.bodies[0]["messages"][0]["content"]
    assert first == {"type": "text", "text": "What kind of place is this?"}
    assert [picture["image_url"]["detail"] for picture in pictures] == [detail] * 3
    urls = [picture["image_url"]["url"] for picture in pictures]
    assert [base64.b64decode(url.removeprefix("data:image/png;base64,"), validate=True) for url in urls] == [*images]


def test_name_that_is_not_utf_8_can_be_sent() -> None:
    with openai_serving(said()) as server:
        ask(openai(server), request(prompt="What is the \ud800 käse?"))
    assert server.bodies[0]["messages"][0]["content"][0]["text"] == "What is the ? käse?"


def test_reply_echoes_model_and_usage() -> None:
    with openai_serving(said()) as server:
        reply = ask(openai(server))
    assert json.loads(reply.text) == GOOD["scene_analyzer"]
    assert (reply.model, reply.finish_reason) == ("gpt-4o-2024-08-06", "stop")
    assert reply.usage == {"prompt_tokens": 1000, "completion_tokens": 20, "total_tokens": 1020}
