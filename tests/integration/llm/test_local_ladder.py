"""Local servers that reject an answer format are sent a simpler format, which is remembered."""

import json

import pytest

from llm_asking import ask, local, ollama
from llm_server import GOOD, KEY, PNG, ollama_said, refused, request, said, serving
from openai_schema import assert_openai_takes
from scene2hap import BackendWarning, RepairBackend
from scene2hap.errors import BackendUnavailable

REJECTS_JSON_OBJECT = refused(400, "'response_format.type' must be 'json_schema' or 'text'")


def test_ladder_goes_down_and_is_remembered() -> None:
    script = (refused(400, {"message": "bad grammar"}), REJECTS_JSON_OBJECT, said(), said())
    with serving(*script) as server:
        backend = local(server)
        ask(backend)
        ask(backend)
    formats = [body.get("response_format", {}).get("type") for body in server.bodies]
    assert formats == ["json_schema", "json_object", None, None]
    assert backend.response_format == "prompt"


def test_ladder_stops_where_the_server_agrees() -> None:
    with serving(refused(422, "no"), said()) as server:
        backend = local(server)
        ask(backend)
    assert backend.response_format == "json_object"


def test_rejected_parameters_give_way_before_the_format_does() -> None:
    """As for OpenAI: reasoning models behind a local address take no temperature, and name their limit otherwise."""
    script = [
        refused(400, {"message": f"Unsupported parameter: '{name}'", "param": param})
        for name, param in (("temperature", "temperature"), ("max_tokens", None))
    ]
    with serving(*script, said(), said()) as server:
        backend = local(server, max_tokens=300)
        with pytest.warns(BackendWarning) as caught:
            ask(backend)
        ask(backend)
    assert [str(one.message).partition(";")[0] for one in caught] == [
        "llava does not take 'temperature'",
        "llava does not take 'max_tokens'",
    ]
    for body in server.bodies[2:]:
        assert body["max_completion_tokens"] == 300
        assert not {"temperature", "max_tokens"} & set(body)
    assert backend.response_format == "json_schema"


def test_failure_at_every_format_is_not_remembered() -> None:
    with serving(refused(400, "context length exceeded")) as server:
        backend = local(server)
        with pytest.raises(BackendUnavailable, match="context length exceeded"):
            ask(backend)
    assert backend.response_format == "json_schema"


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


def test_llama_cpp_without_vision_is_not_retried() -> None:
    script = refused(
        500, {"code": 500, "message": "image input is not supported - hint: mmproj", "type": "server_error"}
    )
    with serving(script) as server, pytest.raises(BackendUnavailable, match="--mmproj") as caught:
        ask(local(server), request(images=(PNG,)))
    assert not caught.value.retryable


@pytest.mark.parametrize(
    ("status", "message"),
    [
        (400, "llava is not a multimodal model"),
        (400, "Model does not support images."),
        (404, "No endpoints found that support image input"),  # of OpenRouter
    ],
)
def test_a_refusal_of_pictures_says_how_to_bake_without(status: int, message: str) -> None:
    with serving(*[refused(status, message)] * 3) as server, pytest.raises(BackendUnavailable, match="--no-pictures"):
        ask(local(server), request(images=(PNG,)))


def test_a_model_that_is_gone_is_no_refusal_of_pictures_although_its_name_speaks_of_them() -> None:
    gone = "The model `llama-3.2-11b-vision-preview` has been decommissioned."
    with serving(*[refused(400, gone)] * 3) as server, pytest.raises(BackendUnavailable) as caught:
        ask(local(server), request(images=(PNG,)))
    assert "decommissioned" in str(caught.value)
    assert "pictures" not in str(caught.value)


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


def test_llama_cpp_gets_no_references_and_no_patterns_that_it_cannot_read() -> None:
    with serving(said(GOOD["object_analyzer"])) as server:
        ask(local(server), request("object_analyzer"))
    sent = json.dumps(server.bodies[0]["response_format"])
    assert "$ref" not in sent
    assert "$defs" not in sent
    states = server.bodies[0]["response_format"]["json_schema"]["schema"]["properties"]["states"]
    assert states["items"]["required"] == ["name", "intensity", "needs_contact"]


def test_vllm_has_no_guided_parameters_any_more() -> None:
    with serving(said()) as server:
        ask(local(server, top_p=0.9, reasoning_effort="low"))
    assert not [name for name in server.bodies[0] if name.startswith("guided_")]
    assert_openai_takes(server.bodies[0])


def test_vllm_picture_limit_is_reported() -> None:
    few = refused(400, {"message": "At most 1 image(s) may be provided in one prompt.", "code": 400})
    with serving(few) as server, pytest.raises(BackendUnavailable, match=r"At most 1 image\(s\)") as caught:
        ask(local(server), request(images=(PNG, PNG)))
    assert not caught.value.retryable


def test_lm_studio_gets_pictures_without_a_schema() -> None:
    crash = refused(400, "The model has crashed without additional information. (Exit code: 11)")
    with serving(crash, REJECTS_JSON_OBJECT, said()) as server:
        backend = local(server)
        ask(backend, request(images=(PNG,)))
    assert backend.response_format == "prompt"


def test_errors_of_lm_studio_are_plain_texts() -> None:
    with (
        serving(refused(404, "No models loaded")) as server,
        pytest.raises(BackendUnavailable, match="No models loaded"),
    ):
        ask(local(server))


def test_a_full_queue_of_ollama_can_be_retried() -> None:
    with (
        serving(refused(503, "server busy, please try again. maximum pending requests exceeded")) as server,
        pytest.raises(BackendUnavailable, match="server busy") as caught,
    ):
        ask(ollama(server))
    assert caught.value.retryable


def test_settings_are_passed_on() -> None:
    settings = {
        "top_p": 0.9,
        "reasoning_effort": "none",
        "chat_template_kwargs": {"enable_thinking": False},
        "extra": {"cache_prompt": False},  # with the prompt cache, answers of llama.cpp differ between runs
        "max_tokens": 300,
        "seed": 7,
    }
    with serving(said(), said()) as server:
        ask(local(server, **settings))
        ask(local(server))
    sent = server.bodies[0]
    assert {name: sent[name] for name in settings if name != "extra"} == {
        name: value for name, value in settings.items() if name != "extra"
    }
    assert sent["cache_prompt"] is False
    assert not {"top_p", "reasoning_effort", "chat_template_kwargs", "cache_prompt"} & set(server.bodies[1])
    # Without these, servers use a temperature of 1 (Ollama's /v1) and unlimited answers.
    assert {"temperature", "max_tokens", "seed"} <= set(server.bodies[1])


def test_pictures_go_as_data_and_never_as_addresses() -> None:
    """Ollama answers 400 to an image address, and a remote server could not open it."""
    with serving(said()) as server:
        ask(local(server), request(images=(PNG, PNG)))
    parts = server.bodies[0]["messages"][0]["content"][1:]
    assert [part["image_url"]["url"][:22] for part in parts] == ["data:image/png;base64,"] * 2


def test_llama_cpp_enforces_bounds_of_integers_only() -> None:
    wrong = {**GOOD["material_estimator"], "poisson_ratio": 0.7}
    with serving(said(wrong), said(GOOD["material_estimator"])) as server:
        reply = ask(RepairBackend(local(server)), request("material_estimator"))
    assert json.loads(reply.text) == GOOD["material_estimator"]
    assert len(server.asked) == 2
