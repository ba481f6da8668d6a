"""Recording and replaying answers: keys, files, and misses."""

import asyncio
import dataclasses
import hashlib
import json
import os
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings, strategies as st

from scene2hap.errors import BackendError, BadAnswer, ConfigError, ReplayMiss
from scene2hap.llm.backends.replay import RecordingBackend, ReplayBackend
from scene2hap.llm.protocol import LLMBackend, LLMReply, LLMRequest
from scene2hap.llm.request_key import request_key

REQUEST = LLMRequest(
    component="object_analyzer",
    subject="fridge#1",
    prompt="What is the fridge?",
    facts={"object_name": "fridge", "length_m": 1.8, "neighbour_names": ["floor"]},
    answer_schema={"type": "object"},
    prompt_version="1",
    images=(b"png one", b"png two"),
)


class Echo:
    """A backend that echoes the subject of each request, and counts requests."""

    def __init__(self) -> None:
        self.calls = 0

    async def complete(self, request: LLMRequest) -> LLMReply:
        self.calls += 1
        await asyncio.sleep(0)
        return LLMReply(json.dumps(dict(request.facts)), "echo", usage={"total_tokens": 7})


def ask(backend: LLMBackend, request: LLMRequest = REQUEST, **changes: Any) -> LLMReply:
    return asyncio.run(backend.complete(dataclasses.replace(request, **changes)))


def record(path: Path, *requests: LLMRequest) -> Path:
    backend = RecordingBackend(Echo(), path)
    for request in requests or (REQUEST,):
        ask(backend, request)
    return path


# --- keys -------------------------------------------------------------------------------------------------------------


def test_key_is_the_digest_of_the_canonical_request() -> None:
    request = LLMRequest("scene_analyzer", "", "p", {"b": 1.0, "a": "ü"}, {}, "1", (), 0.5)
    canonical = (
        '{"answer_schema":{},"component":"scene_analyzer","facts":{"a":"ü","b":1},"images":[],"prompt":"p",'
        '"temperature":0.5}'
    )
    assert request_key(request) == f"v1:{hashlib.sha256(canonical.encode()).hexdigest()}"


@pytest.mark.parametrize(
    "changes",
    [
        {"component": "scene_analyzer"},
        {"prompt": "What is the fridge"},
        {"facts": {"object_name": "fridge", "length_m": 1.8001, "neighbour_names": ["floor"]}},
        {"answer_schema": {"type": "array"}},
        {"temperature": 0.3},
        {"images": (b"png one",)},
        {"images": (b"png two", b"png one")},
    ],
    ids=lambda changes: next(iter(changes)),
)
def test_key_changes_with_every_field_that_affects_the_answer(changes: dict[str, Any]) -> None:
    assert request_key(dataclasses.replace(REQUEST, **changes)) != request_key(REQUEST)


@pytest.mark.parametrize(
    "changes",
    [
        {"subject": "fridge#2"},
        {"prompt_version": "2"},
        {"facts": {"neighbour_names": ("floor",), "length_m": 1.8, "object_name": "fridge"}},
    ],
    ids=lambda changes: next(iter(changes)),
)
def test_key_ignores_fields_that_do_not_affect_the_answer(changes: dict[str, Any]) -> None:
    assert request_key(dataclasses.replace(REQUEST, **changes)) == request_key(REQUEST)


@pytest.mark.parametrize("fact", [float("inf"), float("nan"), object(), "\ud800"])
def test_request_that_is_not_json_has_no_key(fact: Any) -> None:
    with pytest.raises(BackendError, match="no JSON"):
        request_key(dataclasses.replace(REQUEST, facts={"fact": fact}))


# --- round trip -------------------------------------------------------------------------------------------------------

_JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=8,
)


@settings(max_examples=50)
@given(st.dictionaries(st.text(), _JSON, max_size=4), st.text(), st.lists(st.binary(), max_size=2))
def test_round_trip(tmp_path_factory: pytest.TempPathFactory, facts: Any, prompt: str, images: list[bytes]) -> None:
    request = dataclasses.replace(REQUEST, facts=facts, prompt=prompt, images=tuple(images))
    path = tmp_path_factory.mktemp("replay") / "answers.jsonl"
    recorded = ask(RecordingBackend(Echo(), path), request)
    assert ask(ReplayBackend(path), request) == dataclasses.replace(recorded, is_kept=True)
    assert recorded.key == request_key(request)


def test_reply_is_recorded_before_it_is_returned(tmp_path: Path) -> None:
    path = tmp_path / "answers.jsonl"

    async def complete() -> int:
        await RecordingBackend(Echo(), path).complete(REQUEST)
        return path.read_bytes().count(b"\n")

    assert asyncio.run(complete()) == 1


def test_concurrent_recordings_write_whole_lines(tmp_path: Path) -> None:
    path = tmp_path / "answers.jsonl"
    requests = [dataclasses.replace(REQUEST, prompt="x" * 3000 + str(i)) for i in range(40)]

    async def all_at_once() -> None:
        backend = RecordingBackend(Echo(), path)
        await asyncio.gather(*(backend.complete(request) for request in requests))

    asyncio.run(all_at_once())
    assert len(path.read_text(encoding="utf-8").splitlines()) == len(requests)
    replay = ReplayBackend(path)
    for request in requests:
        ask(replay, request)


def test_recording_appends_to_an_existing_file(tmp_path: Path) -> None:
    other = dataclasses.replace(REQUEST, prompt="another")
    path = record(tmp_path / "answers.jsonl")
    path.write_bytes(path.read_bytes().rstrip(b"\n"))  # as after an edit
    record(path, other)
    replay = ReplayBackend(path)
    assert ask(replay, other).text == ask(replay).text


def test_replay_uses_the_last_of_several_answers(tmp_path: Path) -> None:
    path = record(tmp_path / "answers.jsonl")
    again = json.loads(path.read_text(encoding="utf-8")) | {"text": "{}"}
    path.write_text(path.read_text(encoding="utf-8") + json.dumps(again) + "\n\n", encoding="utf-8")
    assert ask(ReplayBackend(path)).text == "{}"


def test_recording_writes_only_the_listed_fields(tmp_path: Path) -> None:
    line = json.loads(record(tmp_path / "answers.jsonl").read_text(encoding="utf-8"))
    assert set(line) == {
        *("asked_model", "parts"),
        *("key", "component", "subject", "prompt_version", "facts", "text", "model", "finish_reason", "usage"),
    }
    assert "png one" not in json.dumps(line)


def test_request_that_cannot_be_recorded_is_not_sent(tmp_path: Path) -> None:
    inner = Echo()
    with pytest.raises(BackendError, match="no JSON"):
        ask(RecordingBackend(inner, tmp_path / "answers.jsonl"), facts={"length_m": float("nan")})
    assert inner.calls == 0


# --- misses and broken files ------------------------------------------------------------------------------------------


def test_miss_names_the_nearest_entry_and_its_differences(tmp_path: Path) -> None:
    far = dataclasses.replace(REQUEST, subject="far", facts={"object_name": "pan", "length_m": 0.3})
    replay = ReplayBackend(record(tmp_path / "answers.jsonl", far, REQUEST))
    asked = {"object_name": "fridge", "length_m": 1.9, "neighbour_names": ["floor"]}
    with pytest.raises(ReplayMiss) as caught:
        ask(replay, facts=asked)
    message = str(caught.value)
    assert caught.value.key == request_key(dataclasses.replace(REQUEST, facts=asked))
    assert caught.value.key in message
    assert request_key(REQUEST) in message
    assert "facts.length_m differ" in message
    assert "facts.object_name" not in message


@pytest.mark.parametrize(
    ("part", "value"),
    [("images", ()), ("answer_schema", {"type": "array"}), ("temperature", 0.9), ("prompt", "What is that fridge?")],
)
def test_miss_names_the_part_that_changed(tmp_path: Path, part: str, value: Any) -> None:
    replay = ReplayBackend(record(tmp_path / "answers.jsonl"))
    with pytest.raises(ReplayMiss, match=f"where {part} differ"):
        ask(replay, **{part: value})


def test_replay_for_another_model_misses(tmp_path: Path) -> None:
    path = record(tmp_path / "answers.jsonl")
    assert ask(ReplayBackend(path, model="echo")).model == "echo"
    with pytest.raises(ReplayMiss, match=r"model \('echo' recorded, 'gpt-4o' requested\)"):
        ask(ReplayBackend(path, model="gpt-4o"))


def test_replay_finds_a_model_by_the_name_that_was_asked_for(tmp_path: Path) -> None:
    """Services answer with dated names."""
    path = record(tmp_path / "answers.jsonl")
    row = json.loads(path.read_text(encoding="utf-8"))
    path.write_text(json.dumps({**row, "model": "echo-2026-01-31", "asked_model": "echo"}) + "\n", encoding="utf-8")
    assert ask(ReplayBackend(path, model="echo")).model == "echo-2026-01-31"


def test_miss_names_another_prompt_version(tmp_path: Path) -> None:
    replay = ReplayBackend(record(tmp_path / "answers.jsonl"))
    with pytest.raises(ReplayMiss, match=r"prompt_version \('1' recorded, '2' requested\)"):
        ask(replay, prompt="new words", prompt_version="2")


def test_miss_names_a_component_without_recordings(tmp_path: Path) -> None:
    with pytest.raises(ReplayMiss, match="none for this component"):
        ask(ReplayBackend(record(tmp_path / "answers.jsonl")), component="scene_analyzer")


@pytest.mark.parametrize(
    ("line", "named"),
    [
        ("not json", "whole line"),
        ("[]", "whole line"),
        ("{}", "key"),
        ('{"key": "v1:0"', "whole line"),
    ],
)
@pytest.mark.parametrize(
    "opened", [ReplayBackend, lambda path: RecordingBackend(Echo(), path)], ids=["replay", "record"]
)
def test_error_names_a_broken_line(tmp_path: Path, line: str, named: str, opened: Any) -> None:
    path = record(tmp_path / "answers.jsonl")
    path.write_text(path.read_text(encoding="utf-8") + line + "\n", encoding="utf-8")
    with pytest.raises(BadAnswer, match=rf"answers\.jsonl, line 2: .*{named}") as caught:
        opened(path)
    assert caught.value.raw_text == line


def test_extra_and_missing_fields_are_broken_lines(tmp_path: Path) -> None:
    path = record(tmp_path / "answers.jsonl")
    whole = json.loads(path.read_text(encoding="utf-8"))
    for broken, named in (
        ({**whole, "authorization": "secret"}, "authorization"),
        ({key: value for key, value in whole.items() if key != "text"}, "text"),
    ):
        path.write_text(json.dumps(broken), encoding="utf-8")
        with pytest.raises(BadAnswer, match=f"line 1: {named}"):
            ReplayBackend(path)


def test_unreadable_or_unwritable_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="cannot read the recording"):
        ReplayBackend(tmp_path / "none.jsonl")
    with pytest.raises(ConfigError, match="the recording .* cannot be written"):
        RecordingBackend(Echo(), tmp_path / "no folder" / "answers.jsonl")


@pytest.mark.skipif(os.name != "posix", reason="a limit on the size of files, as a full disk")
def test_a_full_disk_keeps_the_answers_before_it(tmp_path: Path) -> None:
    import resource

    path = record(tmp_path / "answers.jsonl")
    before = path.read_bytes()
    recording = RecordingBackend(Echo(), path)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (len(before) * 3 // 2, limits[1]))
    try:
        with pytest.raises(ConfigError, match=r"answers\.jsonl cannot be written: .*Make room on its disk"):
            asyncio.run(recording.complete(dataclasses.replace(REQUEST, subject="kettle#1")))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert path.read_bytes() == before
    asyncio.run(recording.complete(dataclasses.replace(REQUEST, subject="kettle#1")))
    ReplayBackend(path)
