"""Detection of a local server's model and of its vision support, by requests to the server."""

import asyncio
import json
from pathlib import Path
from typing import Any

import pytest

from llm_asking import ask, local, ollama
from llm_server import PNG, Scripted, ollama_said, request, said, serving
from scene2hap import BackendWarning, CacheBackend
from scene2hap.errors import BackendUnavailable, ConfigError


def models(*listed: dict[str, Any]) -> dict[str, Scripted]:
    return {"/v1/models": Scripted({"object": "list", "data": [{"object": "model", **item} for item in listed]})}


def tags(*listed: dict[str, Any]) -> dict[str, Scripted]:
    return {"/api/tags": Scripted({"models": list(listed)})}


def test_the_only_model_of_a_server_needs_no_name() -> None:
    with serving(said(), pages=models({"id": "gemma-3-4b", "owned_by": "llamacpp"})) as server:
        backend = local(server, model=None)
        ask(backend)
        ask(backend)
    assert [body["model"] for body in server.bodies] == ["gemma-3-4b"] * 2
    assert server.got == ["/v1/models"]


def test_the_only_model_of_ollama_needs_no_name() -> None:
    with serving(ollama_said(), pages=tags({"name": "qwen2.5vl:latest", "model": "qwen2.5vl:latest"})) as server:
        ask(ollama(server, model=None))
    assert server.bodies[0]["model"] == "qwen2.5vl:latest"


def test_model_name_is_required_with_several_models() -> None:
    with (
        serving(said(), pages=models({"id": "a"}, {"id": "b"})) as server,
        pytest.raises(ConfigError, match=r"serves 2 models \(a, b\); give `model`"),
    ):
        ask(local(server, model=None))
    assert not server.asked


@pytest.mark.parametrize(
    "page", [Scripted({"data": []}), Scripted(b"<html>"), Scripted({}, 404), Scripted({"data": 3})]
)
def test_server_without_models_is_refused(page: Scripted) -> None:
    with (
        serving(said(), pages={"/v1/models": page}) as server,
        pytest.raises(BackendUnavailable, match="names no model"),
    ):
        ask(local(server, model=None))


def test_cache_separates_models_served_at_one_address(tmp_path: Path) -> None:
    with serving(by=lambda asked: said({"scene_category": asked.body["model"]})) as server:
        for name in ("old", "new"):
            server.pages = models({"id": name})
            backend = local(server, model=None)
            stack = CacheBackend(backend, tmp_path)
            assert backend.identity["model"] is None
            assert json.loads(ask(stack).text) == {"scene_category": name}
            assert stack.identity["model"] == name
    assert len(server.asked) == 2


def test_llama_cpp_without_vision_is_detected() -> None:
    listed = {"id": "llava", "architecture": {"input_modalities": ["text"]}}
    with serving(said(), pages=models(listed)) as server:
        backend = local(server)
        with pytest.raises(BackendUnavailable, match="llava at .* takes no pictures") as caught:
            ask(backend, request(images=(PNG,)))
        assert not caught.value.retryable
        assert not server.asked
        ask(backend, request())
    assert len(server.asked) == 1


@pytest.mark.parametrize(
    "listed",
    [
        {"id": "llava", "architecture": {"input_modalities": ["text", "image"]}},
        {"id": "llava"},
        {"id": "another", "architecture": {"input_modalities": ["text"]}},
        {"id": "llava", "architecture": {"input_modalities": "text"}},
    ],
    ids=["sees", "does not tell", "another", "odd"],
)
def test_vision_support_is_checked_once_and_may_be_unknown(listed: dict[str, Any]) -> None:
    with serving(said(), pages=models(listed)) as server:
        backend = local(server)
        ask(backend, request(images=(PNG,)))
        ask(backend, request(images=(PNG,)))
    assert len(server.asked) == 2
    assert server.got == ["/v1/models"]


@pytest.mark.parametrize("page", [Scripted(drop=True), Scripted(reset=True), Scripted({}, 501), Scripted(b"?")])
def test_server_without_model_list_is_queried(page: Scripted) -> None:
    with serving(said(), pages={"/v1/models": page}) as server:
        ask(local(server), request(images=(PNG,)))
    assert len(server.asked) == 1


@pytest.mark.parametrize("name", ["qwen2.5vl", "qwen2.5vl:latest"])
def test_capabilities_are_read_from_the_model_list_of_newer_ollama(name: str) -> None:
    with (
        serving(ollama_said(), pages=tags({"name": name, "capabilities": ["completion"]})) as server,
        pytest.raises(BackendUnavailable, match="takes no pictures"),
    ):
        ask(ollama(server), request(images=(PNG,)))
    assert not server.asked


@pytest.mark.parametrize("capabilities", [["completion"], ["completion", "vision"]])
def test_capabilities_are_read_from_show_of_older_ollama(capabilities: list[str]) -> None:
    with serving(Scripted({"capabilities": capabilities}), ollama_said(), pages=tags({"name": "qwen2.5vl"})) as server:
        if "vision" in capabilities:
            ask(ollama(server), request(images=(PNG,)))
        else:
            with pytest.raises(BackendUnavailable, match="takes no pictures"):
                ask(ollama(server), request(images=(PNG,)))
    assert server.asked[0].path == "/api/show"
    assert server.asked[0].body == {"model": "qwen2.5vl"}


def test_openai_endpoint_of_ollama_warns() -> None:
    """At this endpoint each image becomes a separate message, and the first ones are dropped if they do not fit."""
    with serving(said(), pages=models({"id": "llava", "owned_by": "library"})) as server:
        backend = local(server)
        with pytest.warns(BackendWarning, match="Use dialect='ollama'"):
            ask(backend, request(images=(PNG,)))
        ask(backend, request(images=(PNG,)))


def test_concurrent_first_calls_all_know_the_model() -> None:
    with serving(said(), pages=models({"id": "gemma"})) as server:
        backend = local(server, model=None)

        async def all_at_once() -> None:
            await asyncio.gather(*(backend.complete(request()) for _ in range(6)))

        asyncio.run(all_at_once())
    assert {body["model"] for body in server.bodies} == {"gemma"}
