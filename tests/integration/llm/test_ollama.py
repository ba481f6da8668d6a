"""Ollama through its native chat interface."""

import base64

import pytest

from llm_asking import ask, local, ollama
from llm_server import PNG, ollama_said, refused, request, said, serving
from scene2hap import (
    BackendWarning,
)
from scene2hap.errors import BackendUnavailable, BadAnswer


def test_native_message_contains_all_images() -> None:
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


def test_ollama_falls_back_through_its_native_formats() -> None:
    with serving(refused(400, "invalid format"), refused(400, "invalid format"), ollama_said()) as server:
        ask(ollama(server))
    assert [body.get("format", "none") for body in server.bodies][1:] == ["json", "none"]


@pytest.mark.parametrize("dialect", ["openai", "ollama"])
def test_silently_dropped_images_warn(dialect: str) -> None:
    """Fewer than half of the tokens were read: the prompt and 8 pictures have at least 8 * 256."""
    few = ollama_said(prompt_eval_count=1_000) if dialect == "ollama" else said()
    if dialect == "openai":
        few.body["usage"]["prompt_tokens"] = 1_000
    with serving(few) as server:
        backend = (ollama if dialect == "ollama" else local)(server)
        with pytest.warns(BackendWarning, match=r"read 1000 tokens .* with 8 pictures"):
            ask(backend, request(images=(PNG,) * 8))
        ask(backend, request(images=(PNG,) * 8))  # a second warning would be an error here


def test_read_images_do_not_warn() -> None:
    with serving(ollama_said(prompt_eval_count=1_100), ollama_said(prompt_eval_count=5)) as server:
        ask(ollama(server), request(images=(PNG,) * 8))
        ask(ollama(server), request())


def test_ollama_errors_are_plain_texts() -> None:
    named = r"model 'qwen2.5vl' not found\. Check base_url and the name"
    with serving(refused(404, "model 'qwen2.5vl' not found")) as server, pytest.raises(BackendUnavailable, match=named):
        ask(ollama(server))


def test_truncated_reply_of_ollama_is_an_error() -> None:
    with serving(ollama_said('{"scene', done_reason="length")) as server, pytest.raises(BadAnswer, match="cut off"):
        ask(ollama(server))


def test_ollama_dialect_at_another_server_is_reported() -> None:
    with serving(said()) as server, pytest.raises(BadAnswer, match="Check base_url and the dialect"):
        ask(ollama(server))


def test_thinking_is_off_by_default_and_options_are_sent() -> None:
    with serving(ollama_said()) as server:
        ask(ollama(server, reasoning_effort="none"))
        ask(ollama(server, reasoning_effort="high", top_p=0.9, extra={"top_k": 1}))
    assert [body["think"] for body in server.bodies] == [False, "high"]
    assert (server.bodies[1]["options"]["top_p"], server.bodies[1]["options"]["top_k"]) == (0.9, 1)
    assert "top_p" not in server.bodies[0]["options"]
