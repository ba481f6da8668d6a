"""OpenAIBackend and LocalBackend against a scripted server on the loopback interface."""

import asyncio
import base64
import dataclasses
import json
import logging
import warnings
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from referencing import Registry, Resource
from referencing.jsonschema import DRAFT202012

from llm_server import GOOD, KEY, PNG, Asked, Scripted, Server, ollama_said, refused, request, said, serving
from scene2hap import (
    BackendWarning,
    CacheBackend,
    FunctionBackend,
    LexiconBackend,
    LocalBackend,
    OpenAIBackend,
    RecordingBackend,
    RepairBackend,
    infer_haptics,
)
from scene2hap.errors import BackendUnavailable, BadAnswer, ConfigError
from scene2hap.llm.protocol import LLMBackend, LLMReply, LLMRequest
from scenes import box, scene

OPENAI_SCHEMA = Path(__file__).parents[2].parent / "shared" / "formats" / "openai" / "chat_completions.schema.json"


@pytest.fixture(autouse=True)
def _plain_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY", "OPENAI_API_KEY"):
        monkeypatch.delenv(name, raising=False)
        monkeypatch.delenv(name.lower(), raising=False)


def ask(backend: LLMBackend, asked: LLMRequest | None = None) -> LLMReply:
    return asyncio.run(backend.complete(asked or request()))


def openai(server: Server, **settings: Any) -> OpenAIBackend:
    return OpenAIBackend(**{"api_key": KEY, "base_url": f"{server.base_url}/v1", **settings})


def local(server: Server, **settings: Any) -> LocalBackend:
    return LocalBackend("llava", base_url=f"{server.base_url}/v1", **settings)


def ollama(server: Server, **settings: Any) -> LocalBackend:
    return LocalBackend("qwen2.5vl", base_url=server.base_url, dialect="ollama", **settings)


def failed(*script: Scripted, **settings: Any) -> BackendUnavailable:
    with serving(*script) as server, pytest.raises(BackendUnavailable) as caught:
        ask(openai(server, **settings))
    return caught.value


def assert_openai_takes(body: dict[str, Any]) -> None:
    if not OPENAI_SCHEMA.exists():
        pytest.skip("needs ../shared/formats/openai, which is not beside this repository")
    spec = json.loads(OPENAI_SCHEMA.read_text(encoding="utf-8"))
    registry = Registry().with_resource("urn:openai", Resource(spec, DRAFT202012))
    chat_request = "urn:openai#/components/schemas/CreateChatCompletionRequest"
    jsonschema.Draft202012Validator({"$ref": chat_request}, registry=registry).validate(body)
    assert set(body) <= known_keys(spec, {"$ref": "#/components/schemas/CreateChatCompletionRequest"})


def known_keys(spec: dict[str, Any], node: dict[str, Any]) -> set[str]:
    if "$ref" in node:
        return known_keys(spec, spec["components"]["schemas"][node["$ref"].rsplit("/", 1)[1]])
    return set(node.get("properties", {})).union(*(known_keys(spec, part) for part in node.get("allOf", ())))


# --- OpenAI: requests -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "component", ["scene_analyzer", "object_analyzer", "material_estimator", "vibration_describer"]
)
@pytest.mark.parametrize("settings", [{}, {"detail": "high", "max_tokens": 300, "seed": 1}], ids=["plain", "all"])
def test_request_bodies_fit_the_openai_schema(component: Any, settings: dict[str, Any]) -> None:
    with serving(said()) as server:
        ask(openai(server, **settings), request(component, images=(PNG, PNG)))
    assert_openai_takes(server.bodies[0])


def test_the_schema_check_can_fail() -> None:
    body = {"model": "gpt-4o", "messages": [{"role": "user", "content": "a"}]}
    assert_openai_takes(body)
    with pytest.raises(jsonschema.ValidationError):
        assert_openai_takes({**body, "temperature": "warm"})
    with pytest.raises(AssertionError):
        assert_openai_takes({**body, "images": []})


def test_request_carries_model_key_temperature_and_strict_format() -> None:
    with serving(said()) as server:
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
    with serving(said()) as server:
        ask(openai(server, detail=detail), request(images=images))
    first, *pictures = server.bodies[0]["messages"][0]["content"]
    assert first == {"type": "text", "text": "What kind of place is this?"}
    assert [picture["image_url"]["detail"] for picture in pictures] == [detail] * 3
    urls = [picture["image_url"]["url"] for picture in pictures]
    assert [base64.b64decode(url.removeprefix("data:image/png;base64,"), validate=True) for url in urls] == [*images]


def test_a_name_that_is_not_utf8_can_be_asked_about() -> None:
    with serving(said()) as server:
        ask(openai(server), request(prompt="What is the \ud800 käse?"))
    assert server.bodies[0]["messages"][0]["content"][0]["text"] == "What is the ? käse?"


def test_reply_echoes_model_and_usage() -> None:
    with serving(said()) as server:
        reply = ask(openai(server))
    assert json.loads(reply.text) == GOOD["scene_analyzer"]
    assert (reply.model, reply.finish_reason) == ("gpt-4o-2024-08-06", "stop")
    assert reply.usage == {"prompt_tokens": 1000, "completion_tokens": 20, "total_tokens": 1020}


# --- OpenAI: parameters that give way ---------------------------------------------------------------------------------


def no_parameter(name: str, code: str | None = "unsupported_value") -> Scripted:
    error = {"message": f"Unsupported value: '{name}'", "type": "invalid_request_error", "param": name, "code": code}
    return refused(400, error)


@pytest.mark.parametrize("code", ["unsupported_value", None])
def test_reasoning_models_reject_temperature(code: str | None) -> None:
    with serving(no_parameter("temperature", code), said(), said()) as server:
        backend = openai(server, model="o3")
        with pytest.warns(BackendWarning, match="o3 does not take 'temperature'; it is no longer sent"):
            ask(backend)
        ask(backend)
    assert ["temperature" in body for body in server.bodies] == [True, False, False]


def test_max_tokens_is_renamed_and_seed_dropped() -> None:
    script = (no_parameter("max_tokens", "unsupported_parameter"), no_parameter("seed"), said())
    with serving(*script) as server:
        backend = openai(server, max_tokens=300, seed=1)
        with pytest.warns(BackendWarning) as caught:
            ask(backend)
    assert len(caught) == 2
    assert server.bodies[0]["max_tokens"] == 300
    assert server.bodies[2]["max_completion_tokens"] == 300
    assert not {"max_tokens", "seed"} & set(server.bodies[2])
    assert_openai_takes(server.bodies[2])


def test_many_calls_under_way_learn_and_warn_once() -> None:
    def strict(asked: Asked) -> Scripted:
        return no_parameter("temperature") if "temperature" in asked.body else said()

    with serving(by=strict) as server:
        backend = openai(server)

        async def all_at_once() -> None:
            await asyncio.gather(*(backend.complete(request()) for _ in range(6)))

        with pytest.warns(BackendWarning) as caught:
            asyncio.run(all_at_once())
    assert len(caught) == 1


@pytest.mark.parametrize("param", ["temperature", "response_format", "messages", ""])
def test_a_parameter_gives_way_once_and_others_never(param: str) -> None:
    warnings.simplefilter("ignore", BackendWarning)
    with serving(no_parameter(param)) as server, pytest.raises(BackendUnavailable, match="answered 400") as caught:
        ask(openai(server))
    assert not caught.value.retryable
    assert len(server.asked) == (2 if param == "temperature" else 1)


# --- OpenAI: what must not be parsed ----------------------------------------------------------------------------------


def test_length_comes_before_everything_else() -> None:
    script = said('{"scene_category": "kit', "length", refusal="no")
    with serving(script) as server, pytest.raises(BadAnswer, match="cut off at its token limit") as caught:
        ask(openai(server))
    assert caught.value.raw_text == '{"scene_category": "kit'


def test_content_filter_comes_before_refusal() -> None:
    script = said(None, "content_filter", refusal="no")
    with serving(script) as server, pytest.raises(BadAnswer, match="content filter"):
        ask(openai(server))


def test_refusal_is_told_and_not_repaired() -> None:
    script = said(None, refusal="I cannot help with that.")
    with serving(script) as server, pytest.raises(BadAnswer, match="refused: I cannot help with that") as caught:
        ask(RepairBackend(openai(server)))
    assert caught.value.raw_text == "I cannot help with that."
    assert len(server.asked) == 1


def test_null_content_is_a_bad_answer() -> None:
    with serving(said(None)) as server, pytest.raises(BadAnswer, match="without content"):
        ask(openai(server))


@pytest.mark.parametrize("body", [{}, {"choices": []}, {"choices": [{}]}, {"choices": ["a"]}, {"choices": {"a": 1}}])
def test_success_without_a_chat_completion(body: dict[str, Any]) -> None:
    with serving(Scripted(body)) as server, pytest.raises(BadAnswer, match="no chat completion"):
        ask(openai(server))


@pytest.mark.parametrize("body", [b"<html>hello</html>", b"[1]", b"\xff\xfe", b"[" * 100_000, b""])
def test_success_without_json_is_no_model_server(body: bytes) -> None:
    error = failed(Scripted(body))
    assert "without a JSON object. Check base_url" in str(error)
    assert not error.retryable


def test_an_error_under_status_200_is_an_error() -> None:
    assert "provider is away" in str(failed(refused(200, {"message": "provider is away"})))


# --- OpenAI: failures, retryable or not -------------------------------------------------------------------------------


@pytest.mark.parametrize("status", [408, 409, 429, 500, 502, 503, 529])
def test_retry_as_sdk(status: int) -> None:
    assert failed(refused(status, {"message": "busy", "type": "server_error"})).retryable


@pytest.mark.parametrize("status", [301, 400, 401, 403, 404, 413, 422])
def test_no_retry_on_what_the_caller_did(status: int) -> None:
    assert not failed(refused(status, {"message": "wrong"})).retryable


@pytest.mark.parametrize(
    "error",
    [
        {"type": "insufficient_quota", "code": None},
        {"type": "requests", "code": "insufficient_quota"},
        {"code": "credit_balance_exhausted"},
        {"code": "organization_spend_limit_exceeded"},
        {"code": "project_spend_limit_exceeded"},
        {"code": "organization_usage_limit_exceeded"},
    ],
    ids=str,
)
def test_fail_fast_on_429_without_money(error: dict[str, Any]) -> None:
    caught = failed(
        refused(429, {"message": "You exceeded your quota", **error}, retry_after="1", x_should_retry="true")
    )
    assert not caught.retryable
    assert "The account is used up" in str(caught)


def test_rate_limit_tells_when_to_come_back() -> None:
    caught = failed(refused(429, {"message": "slow", "code": "rate_limit_exceeded"}, retry_after="20"))
    assert (caught.retryable, caught.retry_after_s) == (True, 20.0)


def test_request_id_is_in_the_message_and_the_log(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.DEBUG, "scene2hap"):
        error = failed(refused(500, {"message": "oops"}, x_request_id="req_77"))
    assert "Request id req_77." in str(error)
    assert "req_77" in caplog.text


def test_silence_is_a_timeout_that_can_be_retried() -> None:
    error = failed(Scripted(hang=True), timeout_s=0.04)
    assert error.retryable
    assert "did not answer within 0.04 s" in str(error)


def test_dropped_connection_can_be_retried() -> None:
    error = failed(Scripted(drop=True))
    assert error.retryable
    assert "cannot be reached" in str(error)
    assert error.__cause__ is not None


def test_body_cut_short_can_be_retried() -> None:
    assert failed(Scripted(b'{"choices"', headers={"content-length": "500"})).retryable


def test_nobody_listens() -> None:
    with serving(said()) as server:
        pass
    with pytest.raises(BackendUnavailable, match="cannot be reached") as caught:
        ask(openai(server))
    assert caught.value.retryable


# --- OpenAI: the key --------------------------------------------------------------------------------------------------


def test_key_is_read_from_the_environment_at_call_time(monkeypatch: pytest.MonkeyPatch) -> None:
    with serving(said()) as server:
        backend = openai(server, api_key=None)
        with pytest.raises(BackendUnavailable, match="Set OPENAI_API_KEY") as caught:
            ask(backend)
        monkeypatch.setenv("OPENAI_API_KEY", f"{KEY}\n")  # as `cat` leaves it
        ask(backend)
    assert not caught.value.retryable
    assert [asked.headers["authorization"] for asked in server.asked] == [f"Bearer {KEY}"]


def test_key_with_a_line_break_is_not_quoted() -> None:
    with serving(said()) as server, pytest.raises(ConfigError, match="line breaks") as caught:
        ask(openai(server, api_key="sk-secret\nsk-secret"))
    assert "secret" not in str(caught.value)
    assert caught.value.__cause__ is None


def test_key_that_a_server_echoes_in_a_header(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.DEBUG, "scene2hap"):
        assert "Request id ******." in str(failed(refused(401, "no", x_request_id=KEY)))
    assert "request id ******" in caplog.text
    assert KEY not in caplog.text


def test_key_that_a_server_echoes_is_nowhere(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """In no error, repr, log, answer, cache file or recording."""
    shown: list[str] = []
    refusals = [
        refused(401, {"message": f"Incorrect API key provided: {KEY}", "code": KEY}),
        refused(500, f"header was Bearer {KEY}"),
        Scripted(f"<p>{KEY}".encode(), 404),
        said({"scene_category": KEY}, "length"),
        said(None, refusal=KEY),
        Scripted({"choices": [], "key": KEY}),
        Scripted(drop=True),
    ]
    with caplog.at_level(logging.DEBUG), serving(*refusals, said({"scene_category": f"kitchen {KEY}"})) as server:
        backend = openai(server)
        stack = CacheBackend(RecordingBackendWithIdentity(backend, tmp_path / "tape.jsonl"), tmp_path / "cache")
        for _ in refusals:
            with pytest.raises((BackendUnavailable, BadAnswer)) as caught:
                ask(stack)
            error = caught.value
            shown += [str(error), repr(error), repr(vars(error)), repr(error.__cause__)]
        shown += [ask(stack).text, repr(stack), repr(backend), repr(vars(backend)), str(backend.identity)]
    files = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert len(files) == 2
    shown += [path.read_text(encoding="utf-8") for path in files]
    shown.append(caplog.text)
    assert "httpcore" in caplog.text
    assert not [text for text in shown if KEY in text]
    assert "******" in shown[0]


class RecordingBackendWithIdentity(RecordingBackend):
    """A recording does not tell which model it wraps; here it does."""

    @property
    def identity(self) -> dict[str, str]:
        return {"model": "m"}


@pytest.mark.parametrize("base_url", [f"http://me:{KEY}@127.0.0.1/v1", f"http://127.0.0.1/v1?key={KEY}"])
def test_key_within_the_address_is_refused_unseen(base_url: str) -> None:
    with pytest.raises(ConfigError, match="give the key as api_key") as caught:
        OpenAIBackend(base_url=base_url)
    assert KEY not in str(caught.value)


def test_redirects_are_not_followed_with_the_key() -> None:
    with serving(said()) as elsewhere:
        location = {"location": f"{elsewhere.base_url}/v1/chat/completions"}
        assert "answered 307" in str(failed(Scripted({}, 307, location)))
    assert not elsewhere.asked


# --- local servers: the ladder ----------------------------------------------------------------------------------------

REJECTS_JSON_OBJECT = refused(400, "'response_format.type' must be 'json_schema' or 'text'")


def test_ladder_goes_down_and_is_remembered() -> None:
    script = (refused(400, {"message": "bad grammar"}), REJECTS_JSON_OBJECT, said(), said())
    with serving(*script) as server:
        backend = local(server)
        ask(backend)
        ask(backend)
    formats = [body.get("response_format", {}).get("type") for body in server.bodies]
    assert formats == ["json_schema", "json_object", None, None]
    assert backend.rung == "prompt"


def test_ladder_stops_where_the_server_agrees() -> None:
    with serving(refused(422, "no"), said()) as server:
        backend = local(server)
        ask(backend)
    assert backend.rung == "json_object"


def test_what_no_rung_can_save_teaches_nothing() -> None:
    with serving(refused(400, "context length exceeded")) as server:
        backend = local(server)
        with pytest.raises(BackendUnavailable, match="context length exceeded"):
            ask(backend)
    assert backend.rung == "json_schema"


@pytest.mark.parametrize("status", [404, 500, 503])
def test_other_failures_do_not_go_down_the_ladder(status: int) -> None:
    with serving(refused(status, "no")) as server, pytest.raises(BackendUnavailable):
        ask(local(server))
    assert len(server.asked) == 1


def test_the_model_never_sees_the_schema_so_the_fields_are_in_the_prompt() -> None:
    with serving(said(GOOD["material_estimator"]), ollama_said(GOOD["material_estimator"])) as server:
        ask(local(server), request("material_estimator"))
        ask(ollama(server), request("material_estimator"))
    for text in (server.bodies[0]["messages"][0]["content"][0]["text"], server.bodies[1]["messages"][0]["content"]):
        assert text.startswith("What kind of place is this?\n\nAnswer with one JSON object")
        assert "- youngs_modulus_gpa: number (at least 1e-05, at most 1300)" in text


def test_llama_cpp_reads_only_the_nested_json_schema() -> None:
    with serving(said()) as server:
        ask(local(server), request(images=(PNG,)))
    response_format = server.bodies[0]["response_format"]
    assert set(response_format) == {"type", "json_schema"}
    assert response_format["json_schema"]["schema"]["required"] == ["scene_category"]
    assert_openai_takes(server.bodies[0])


def test_llama_cpp_without_eyes_is_not_retried() -> None:
    script = refused(
        500, {"code": 500, "message": "image input is not supported - hint: mmproj", "type": "server_error"}
    )
    with serving(script) as server, pytest.raises(BackendUnavailable, match="--mmproj") as caught:
        ask(local(server), request(images=(PNG,)))
    assert not caught.value.retryable


def test_llama_cpp_that_still_loads_is_retried() -> None:
    script = refused(503, {"code": 503, "message": "Loading model", "type": "unavailable_error"})
    with serving(script) as server, pytest.raises(BackendUnavailable, match="Loading model") as caught:
        ask(local(server))
    assert caught.value.retryable


def test_key_of_openai_is_not_sent_to_local_servers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", KEY)
    with serving(said()) as server:
        ask(local(server))
        ask(local(server, api_key="token-of-vllm"))
    assert [asked.headers.get("authorization") for asked in server.asked] == [None, "Bearer token-of-vllm"]


def test_dummy_keys_are_words_that_answers_may_hold() -> None:
    with serving(said({"scene_category": "lm-studio"})) as server:
        assert json.loads(ask(local(server, api_key="lm-studio")).text) == {"scene_category": "lm-studio"}


# --- local servers: Ollama --------------------------------------------------------------------------------------------


def test_ollama_loses_no_images_in_one_native_message() -> None:
    with serving(ollama_said()) as server:
        reply = ask(ollama(server, num_ctx=8192, max_tokens=300, seed=3), request(images=(PNG, PNG + b"2")))
    (asked,) = server.asked
    assert asked.path == "/api/chat"
    (message,) = asked.body["messages"]
    assert isinstance(message["content"], str)
    assert message["images"] == [base64.b64encode(png).decode() for png in (PNG, PNG + b"2")]
    assert asked.body["options"] == {"num_ctx": 8192, "temperature": 0.2, "seed": 3, "num_predict": 300}
    assert (asked.body["truncate"], asked.body["think"], asked.body["stream"]) == (False, False, False)
    assert asked.body["format"]["additionalProperties"] is False
    assert (reply.model, reply.usage) == ("qwen2.5vl", {"prompt_tokens": 5000, "completion_tokens": 20})


def test_ollama_goes_down_the_ladder_in_its_own_words() -> None:
    with serving(refused(400, "invalid format"), refused(400, "invalid format"), ollama_said()) as server:
        ask(ollama(server))
    assert [body.get("format", "none") for body in server.bodies][1:] == ["json", "none"]


@pytest.mark.parametrize("dialect", ["openai", "ollama"])
def test_images_dropped_silently_are_warned_of(dialect: str) -> None:
    few = ollama_said(prompt_eval_count=90) if dialect == "ollama" else said()
    if dialect == "openai":
        few.body["usage"]["prompt_tokens"] = 90
    with serving(few) as server:
        backend = (ollama if dialect == "ollama" else local)(server)
        with pytest.warns(BackendWarning, match=r"read 90 tokens .* with 8 pictures"):
            ask(backend, request(images=(PNG,) * 8))
        ask(backend, request(images=(PNG,) * 8))  # a second warning would be an error here


def test_images_that_were_read_are_not_warned_of() -> None:
    with serving(ollama_said(prompt_eval_count=8 * 256), ollama_said(prompt_eval_count=5)) as server:
        ask(ollama(server), request(images=(PNG,) * 8))
        ask(ollama(server), request())


def test_ollama_errors_are_plain_texts() -> None:
    named = r"model 'qwen2.5vl' not found\. Check base_url and the name"
    with serving(refused(404, "model 'qwen2.5vl' not found")) as server, pytest.raises(BackendUnavailable, match=named):
        ask(ollama(server))


def test_ollama_cut_short() -> None:
    with serving(ollama_said('{"scene', done_reason="length")) as server, pytest.raises(BadAnswer, match="cut off"):
        ask(ollama(server))


def test_ollama_dialect_against_another_server() -> None:
    with serving(said()) as server, pytest.raises(BadAnswer, match="Check base_url and the dialect"):
        ask(ollama(server))


# --- local servers: 200, but the schema ignored -----------------------------------------------------------------------

ANSWER = json.dumps(GOOD["scene_analyzer"])


@pytest.mark.parametrize(
    "content",
    [
        f"```json\n{ANSWER}\n```",
        f'<think>Maybe {{"scene_category": "shop"}}?</think>{ANSWER}',
        f'it said {{"scene_category": "shop"}}</think>\n{ANSWER}',
        f"Sure, here is {{the}} JSON:\n{ANSWER}\nAnything else? {{}}",
    ],
    ids=["fences", "think", "half a think", "prose"],
)
def test_json_within_what_else_a_model_writes(content: str) -> None:
    with serving(said(content)) as server:
        assert ask(local(server)).text == ANSWER


@pytest.mark.parametrize("place", ["reasoning", "reasoning_content"])
def test_empty_content_is_looked_for_in_the_reasoning(place: str) -> None:
    with serving(said("", **{place: f"I think {ANSWER}"})) as server:
        assert ask(local(server)).text == ANSWER


def test_empty_content_is_looked_for_in_ollamas_thinking() -> None:
    with serving(ollama_said(message={"role": "assistant", "content": "", "thinking": ANSWER})) as server:
        assert ask(ollama(server)).text == ANSWER


def test_nothing_said_at_all() -> None:
    with serving(said("", reasoning="hm")) as server, pytest.raises(BadAnswer, match="without content") as caught:
        ask(local(server))
    assert caught.value.raw_text == "hm"


def test_prose_alone_is_handed_on_for_repair() -> None:
    with serving(said("A kitchen."), said()) as server:
        assert ask(RepairBackend(local(server))).text == ANSWER
    assert "Your last answer was:\nA kitchen." in server.bodies[1]["messages"][0]["content"][0]["text"]


def test_server_that_does_not_say_why_it_stopped() -> None:
    with serving(said(ANSWER, None)) as server:
        assert ask(local(server)).finish_reason == "stop"


# --- a whole scene ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dialect", ["openai", "ollama", "OpenAI itself"])
def test_a_scene_inferred_over_http_is_what_the_model_said(dialect: str) -> None:
    """The lexicon plays the model: it answers the same questions once directly and once behind a server."""
    kitchen = scene(box("fridge", (0.7, 1.8, 0.7), (0.4, 0.9, 0.4)), box("phone", (0.1, 0.01, 0.1), (3.0, 0.7, 0.4)))
    spoken: dict[str, Any] = {}

    async def listen(asked: LLMRequest) -> LLMReply:
        reply = await LexiconBackend().complete(asked)
        spoken[asked.prompt] = json.loads(reply.text)
        return reply

    def repeat(asked: Asked) -> Scripted:
        content = asked.body["messages"][0]["content"]
        prompt = content if isinstance(content, str) else content[0]["text"]
        return (ollama_said if dialect == "ollama" else said)(spoken[prompt.split("\n\nAnswer with one JSON")[0]])

    direct = infer_haptics(kitchen, FunctionBackend(listen))
    with serving(by=repeat) as server:
        backend = {"openai": local, "ollama": ollama, "OpenAI itself": openai}[dialect](server)
        remote = infer_haptics(kitchen, RepairBackend(backend))
    assert len(server.asked) == len(spoken)
    assert any(haptics.vibrates for haptics in remote.values())
    for name, haptics in remote.items():
        assert dataclasses.replace(haptics, provenance=direct[name].provenance) == direct[name]
        assert "prompt 1" in haptics.provenance["object_analyzer"]


# --- settings ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "named"),
    [
        (lambda: OpenAIBackend(detail="original"), "detail is 'original'"),
        (lambda: OpenAIBackend(base_url="api.openai.com"), "base_url is 'api.openai.com'"),
        (lambda: OpenAIBackend(timeout_s=0), "timeout_s is 0 s"),
        (lambda: OpenAIBackend(api_key=b"secret"), "an API key is a bytes"),
        (lambda: LocalBackend("m", base_url="http://a", dialect="tgi"), "dialect is 'tgi'"),
        (lambda: LocalBackend("m", base_url="http://a", num_ctx=0), "num_ctx is 0 tokens"),
    ],
)
def test_settings_that_cannot_work(make: Any, named: str) -> None:
    with pytest.raises(ConfigError, match=named):
        make()
