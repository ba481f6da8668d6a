"""The API key is sent only in the header of a request, and appears nowhere else."""

import json
import logging
from pathlib import Path
from typing import Any

import pytest

from llm_asking import ask, failed, openai
from llm_server import KEY, Scripted, refused, said, serving
from openai_schema import openai_serving
from scene2hap import (
    BakeConfig,
    CacheBackend,
    FunctionBackend,
    LexiconBackend,
    OpenAIBackend,
    RecordingBackend,
    bake,
)
from scene2hap.errors import BackendUnavailable, BadAnswer, ConfigError
from scene2hap.llm.protocol import LLMRequest
from scenes import box, scene


def test_key_is_read_from_the_environment_at_call_time(monkeypatch: pytest.MonkeyPatch) -> None:
    with serving(said()) as server:
        backend = openai(server, api_key=None)
        with pytest.raises(BackendUnavailable, match="Set OPENAI_API_KEY") as caught:
            ask(backend)
        monkeypatch.setenv("OPENAI_API_KEY", f"{KEY}\n")  # with the line break of `cat`
        ask(backend)
    assert not caught.value.retryable
    assert [asked.headers["authorization"] for asked in server.asked] == [f"Bearer {KEY}"]


def test_key_with_a_line_break_is_not_quoted() -> None:
    with serving(said()) as server, pytest.raises(ConfigError, match="line breaks") as caught:
        ask(openai(server, api_key="sk-secret\nsk-secret"))
    assert "secret" not in str(caught.value)
    assert caught.value.__cause__ is None


def test_key_that_a_server_echoes_in_a_header(caplog: pytest.LogCaptureFixture) -> None:
    """The HTTP library logs the headers of replies unchanged."""
    with caplog.at_level(logging.DEBUG):
        assert "Request id ******." in str(failed(refused(401, "no", x_request_id=KEY)))
    assert "request id ******" in caplog.text
    assert "(b'x-request-id', b'******')" in caplog.text
    assert KEY not in caplog.text


def test_key_echoed_by_a_server_is_removed_everywhere(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """The key is in no error, repr, log, answer, cache file or recording."""
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
        stack = CacheBackend(RecordingBackend(backend, tmp_path / "tape.jsonl"), tmp_path / "cache")
        for _ in refusals:
            with pytest.raises((BackendUnavailable, BadAnswer)) as caught:
                ask(stack)
            error = caught.value
            shown += [str(error), repr(error), repr(vars(error)), repr(error.__cause__)]
        shown += [ask(stack).text, repr(stack), repr(backend), repr(vars(backend)), str(backend.identity)]
    files = [path for path in tmp_path.rglob("*") if path.is_file()]
    # A recording and an answer. The empty lock file stays, but not on Windows.
    assert len([path for path in files if path.suffix != ".lock"]) == 2
    shown += [path.read_text(encoding="utf-8") for path in files]
    shown.append(caplog.text)
    assert "httpcore" in caplog.text
    assert not [text for text in shown if KEY in text]
    assert "******" in shown[0]


@pytest.mark.parametrize("base_url", [f"http://me:{KEY}@127.0.0.1/v1", f"http://127.0.0.1/v1?key={KEY}"])
def test_key_in_the_address_is_refused_without_showing_it(base_url: str) -> None:
    with pytest.raises(ConfigError, match="give the key as api_key") as caught:
        OpenAIBackend(base_url=base_url)
    assert KEY not in str(caught.value)


def test_redirects_are_not_followed_with_the_key() -> None:
    with serving(said()) as elsewhere:
        location = {"location": f"{elsewhere.base_url}/v1/chat/completions"}
        told = str(failed(Scripted({}, 307, location)))
    assert "answered 307" in told
    assert "It redirects, and a key is sent to base_url alone" in told
    assert not elsewhere.asked


def test_no_key_in_a_bundle_or_its_configuration(tmp_path: Path) -> None:
    """The model echoes the key in each text of its answers; the saved bundle contains no key."""

    async def echo(asked: LLMRequest) -> str:
        answer = json.loads((await LexiconBackend().complete(asked)).text)
        spoken[asked.prompt] = json.dumps(_with(answer, KEY))
        return json.dumps(_with(answer, "******"))

    spoken: dict[str, str] = {}
    desk = scene(box("phone", (0.1, 0.01, 0.1), (3.0, 0.7, 0.4)))
    direct = bake(desk, {"llm": FunctionBackend(echo)})
    with openai_serving(by=lambda asked: said(spoken[asked.prompt])) as server:
        spec = {"kind": "openai", "api_key": KEY, "base_url": f"{server.base_url}/v1"}
        config = BakeConfig(llm={"kind": "retry", "inner": spec})
        baked = bake(desk, config)
    baked.save(tmp_path / "bundle")
    files = [path for path in (tmp_path / "bundle").rglob("*") if path.is_file()]
    assert files
    assert not [path for path in files if KEY.encode() in path.read_bytes()]
    assert any(b"******" in path.read_bytes() for path in files)
    assert KEY not in f"{config!r} {config} {vars(config)} {baked!r}"
    assert baked.objects["phone"].usage == direct.objects["phone"].usage


def _with(answer: dict[str, Any], word: str) -> dict[str, Any]:
    return {
        name: f"{value} {word}" if name in ("usage", "category_reason") else value for name, value in answer.items()
    }
