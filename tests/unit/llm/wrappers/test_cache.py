"""CacheBackend: equality of requests, files and locks."""

import asyncio
import dataclasses
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from llm_server import GOOD, PNG, request
from scene2hap import (
    BackendWarning,
    CacheBackend,
    FunctionBackend,
    LexiconBackend,
    LLMReply,
    LLMRequest,
    LocalBackend,
    OpenAIBackend,
    RetryBackend,
)
from scene2hap.errors import BackendUnavailable, ConfigError

ANSWER = LLMReply(json.dumps(GOOD["scene_analyzer"]), "m", usage={"prompt_tokens": 7})


def plain(reply: LLMReply) -> LLMReply:
    """The reply without its cache key."""
    return dataclasses.replace(reply, key="")


def answering(reply: LLMReply = ANSWER, model: str = "m") -> FunctionBackend:
    return FunctionBackend(lambda _: reply, model=model)


def ask(backend: CacheBackend, asked: LLMRequest | None = None) -> LLMReply:
    return asyncio.run(backend.complete(asked or request()))


def files(folder: Path) -> list[Path]:
    """The stored entries, without the empty lock files."""
    return sorted(path for path in folder.rglob("*") if path.is_file() and path.parent.name != "locks")


# --- hits and misses --------------------------------------------------------------------------------------------------


def test_cache_answers_a_repeated_request_from_disk(tmp_path: Path) -> None:
    inner = answering()
    assert plain(ask(CacheBackend(inner, tmp_path))) == ANSWER
    again = CacheBackend(inner, tmp_path)
    reply = ask(again)
    assert (reply.text, reply.model, reply.usage) == (ANSWER.text, "m", {})
    assert reply.is_kept
    assert reply.key == files(tmp_path)[0].stem
    assert len(inner.requests) == 1
    assert again.report() == {"calls": 1, "hits": 1, "stored": 0, "rejected": 0, "unreadable": 0}


@pytest.mark.parametrize(
    "changes",
    [
        {"prompt": "other"},
        {"images": (PNG,)},
        {"images": (PNG + b"2",)},
        {"answer_schema": {"type": "object"}},
        {"temperature": 0.3},
        {"facts": {}},
    ],
    ids=lambda changes: next(iter(changes)),
)
def test_cache_misses_when_a_deciding_field_changes(tmp_path: Path, changes: dict[str, Any]) -> None:
    inner = answering()
    backend = CacheBackend(inner, tmp_path)
    ask(backend)
    ask(backend, request(**changes))
    assert len(inner.requests) == 2


def test_cache_separates_models(tmp_path: Path) -> None:
    ask(CacheBackend(answering(), tmp_path))
    other = answering(model="another")
    ask(CacheBackend(other, tmp_path))
    assert len(other.requests) == 1


@pytest.mark.parametrize(
    "other",
    [
        OpenAIBackend("gpt-4.1"),
        OpenAIBackend(base_url="http://127.0.0.1/v1"),
        OpenAIBackend(detail="high"),
        OpenAIBackend(seed=1),
        OpenAIBackend(max_tokens=9),
        OpenAIBackend(top_p=0.5),
        OpenAIBackend(reasoning_effort="none"),
        LocalBackend("gpt-4o", base_url="https://api.openai.com/v1"),
    ],
    ids=repr,
)
def test_identity_includes_model_address_and_deciding_settings(other: OpenAIBackend | LocalBackend) -> None:
    assert other.identity != OpenAIBackend().identity


@pytest.mark.parametrize(
    "settings",
    [
        {"num_ctx": 8192},
        {"max_tokens": 9},
        {"top_p": 0.5},
        {"seed": 1},
        {"reasoning_effort": "none"},
        {"chat_template_kwargs": {"enable_thinking": False}},
        {"extra": {"top_k": 1}},
    ],
    ids=str,
)
def test_identity_of_a_local_backend_includes_all_deciding_settings(settings: dict[str, Any]) -> None:
    one, other = LocalBackend("m", base_url="http://a"), LocalBackend("m", base_url="http://a", **settings)
    assert one.identity != other.identity
    json.dumps(other.identity)  # the cache writes it as JSON


def test_identity_excludes_settings_that_do_not_affect_answers() -> None:
    assert OpenAIBackend(api_key="sk-one").identity == OpenAIBackend(api_key="sk-two", timeout_s=5).identity


def test_reply_key_is_the_file_name_from_the_first_request(tmp_path: Path) -> None:
    reply = ask(CacheBackend(answering(), tmp_path))
    assert not reply.is_kept
    assert [reply.key] == [path.stem for path in files(tmp_path)]


def test_cache_reads_the_identity_after_the_backend_is_ready(tmp_path: Path) -> None:
    """A local backend gets its model from the server, which may serve another model later."""

    class Learning(FunctionBackend):
        name = "first"

        async def ready(self) -> None:
            self.model = self.name

    inner = Learning(lambda _: ANSWER, model="unknown")
    backend = CacheBackend(RetryBackend(inner), tmp_path)
    ask(backend)
    inner.name = "second"
    ask(backend)
    assert len(inner.requests) == 2
    assert [json.loads(path.read_text())["identity"]["model"] for path in files(tmp_path)] != ["unknown"] * 2


def test_cache_key_includes_identity_learnt_while_answering(tmp_path: Path) -> None:
    """A plugin's wrapper may pass on `identity` but not `ready`."""

    def answer(_: LLMRequest) -> LLMReply:
        inner.model = "learnt"
        return ANSWER

    inner = FunctionBackend(answer, model="unknown")
    ask(CacheBackend(inner, tmp_path))
    assert [json.loads(path.read_text())["identity"] for path in files(tmp_path)] == [{"model": "learnt"}]
    assert ask(CacheBackend(answering(model="learnt"), tmp_path)).is_kept
    inner.model = "unknown"
    ask(CacheBackend(inner, tmp_path))
    assert len(inner.requests) == 2


def test_backend_without_identity_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="no `identity`"):
        CacheBackend(LexiconBackend(), tmp_path)


@pytest.mark.parametrize(
    "reply",
    [LLMReply("{}", "m"), LLMReply("no JSON", "m"), LLMReply(ANSWER.text, "m", "length")],
    ids=lambda reply: reply.text[:8] + reply.finish_reason,
)
def test_bad_answers_are_returned_but_not_stored(tmp_path: Path, reply: LLMReply) -> None:
    backend = CacheBackend(answering(reply), tmp_path)
    assert ask(backend) == reply
    assert backend.report()["rejected"] == 1
    assert files(tmp_path) == []


def test_an_answer_is_stored_if_it_ended_by_itself_in_the_words_of_another_service(tmp_path: Path) -> None:
    ask(CacheBackend(answering(LLMReply(ANSWER.text, "m", "end_turn")), tmp_path))
    assert ask(CacheBackend(answering(LLMReply("asked again", "m")), tmp_path)).text == ANSWER.text


def test_failures_are_raised_and_not_stored(tmp_path: Path) -> None:
    error = BackendUnavailable("away", retryable=True)

    def fail(_: LLMRequest) -> LLMReply:
        raise error

    with pytest.raises(BackendUnavailable) as caught:
        ask(CacheBackend(FunctionBackend(fail), tmp_path))
    assert caught.value is error
    assert files(tmp_path) == []


# --- files ------------------------------------------------------------------------------------------------------------


def test_cache_writes_only_the_listed_fields(tmp_path: Path) -> None:
    ask(CacheBackend(answering(), tmp_path), request(images=(PNG,)))
    (entry,) = files(tmp_path)
    written = json.loads(entry.read_text(encoding="utf-8"))
    assert set(written) == {
        *("key", "identity", "component", "subject", "prompt_version", "text", "model", "finish_reason", "usage")
    }
    assert written["key"] == entry.stem
    assert "PNG" not in json.dumps(written)


@pytest.mark.parametrize("damage", [b"", b"{", b"[]", b"\xff", b'{"key": "a"}', "other key"], ids=repr)
def test_file_that_cannot_be_read_back_is_written_again(tmp_path: Path, damage: Any) -> None:
    inner = answering()
    backend = CacheBackend(inner, tmp_path)
    ask(backend)
    (entry,) = files(tmp_path)
    whole = entry.read_bytes()
    entry.write_bytes(whole.replace(entry.stem.encode(), b"0" * 64) if damage == "other key" else damage)
    assert plain(ask(backend)) == ANSWER
    assert entry.read_bytes() == whole
    assert backend.report()["unreadable"] == 1


def test_stored_answer_that_violates_a_newer_rule_is_requested_again(tmp_path: Path) -> None:
    """Rules outside the schema, such as those on words, may change without a change of the key."""
    inner = answering()
    backend = CacheBackend(inner, tmp_path)
    ask(backend)
    (entry,) = files(tmp_path)
    kept = json.loads(entry.read_text(encoding="utf-8"))
    entry.write_text(json.dumps({**kept, "text": '{"scene_category": ""}'}), encoding="utf-8")
    assert ask(backend).text == ANSWER.text
    assert len(inner.requests) == 2


def test_failed_write_leaves_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(ConfigError, match="the cache .* cannot be written: No space left"):
        ask(CacheBackend(answering(), tmp_path))
    assert files(tmp_path) == []


def test_folder_that_cannot_be_created_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(ConfigError, match="the cache .* cannot be written"):
        CacheBackend(answering(), tmp_path / "file" / "cache")


def test_deleted_folder_is_created_again(tmp_path: Path) -> None:
    backend = CacheBackend(answering(), tmp_path / "cache")
    shutil.rmtree(tmp_path / "cache")
    assert plain(ask(backend)) == ANSWER
    assert len(files(tmp_path / "cache")) == 1


def test_folder_that_cannot_be_locked_is_refused(tmp_path: Path) -> None:
    backend = CacheBackend(answering(), tmp_path / "cache")
    shutil.rmtree(tmp_path / "cache")
    (tmp_path / "cache").write_text("")
    with pytest.raises(ConfigError, match="cannot lock"):
        ask(backend)


# --- locks ------------------------------------------------------------------------------------------------------------


def test_concurrent_equal_requests_are_sent_once(tmp_path: Path) -> None:
    async def slow(_: LLMRequest) -> LLMReply:
        await asyncio.sleep(0)
        return ANSWER

    inner = FunctionBackend(slow)
    backend = CacheBackend(inner, tmp_path)

    async def all_at_once() -> None:
        await asyncio.gather(*(backend.complete(request(subject=str(i))) for i in range(8)))

    asyncio.run(all_at_once())
    assert len(inner.requests) == 1
    assert backend.report()["hits"] == 7
    assert backend._turns == {}
    assert len(files(tmp_path)) == 1


HOLDER = """
import json, sys, time
from pathlib import Path
from filelock import FileLock
lock, answer = FileLock(sys.argv[1]), sys.stdin.readline()
with lock:
    print("held", flush=True)
    if not answer.strip():
        time.sleep(60.0)
    time.sleep(0.3)
    Path(sys.argv[2]).write_text(answer)
"""


def other_run(folder: Path, answer: str = "") -> subprocess.Popen[str]:
    """Start a process that holds the lock of the only entry in a folder, and writes the entry later or never."""
    (entry,) = files(folder)
    entry.unlink()
    lock = folder / "locks" / f"{entry.stem}.lock"
    arguments = [sys.executable, "-c", HOLDER, str(lock), str(entry)]
    process = subprocess.Popen(arguments, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert process.stdin is not None
    assert process.stdout is not None
    process.stdin.write(answer + "\n")
    process.stdin.flush()
    assert process.stdout.readline() == "held\n"
    return process


def test_cache_waits_for_the_lock_of_another_run(tmp_path: Path) -> None:
    inner = answering()
    ask(CacheBackend(inner, tmp_path))
    answer = json.dumps(json.loads(files(tmp_path)[0].read_bytes()))
    with other_run(tmp_path, answer):
        assert ask(CacheBackend(inner, tmp_path)).text == ANSWER.text
    assert len(inner.requests) == 1


def test_a_long_wait_for_a_lock_names_the_file_and_the_process(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    inner = answering()
    ask(CacheBackend(inner, tmp_path))
    answer = json.dumps(json.loads(files(tmp_path)[0].read_bytes()))
    monkeypatch.setattr("scene2hap.llm.wrappers.cache.PATIENCE_S", 0.1)
    with other_run(tmp_path, answer) as process, pytest.warns(BackendWarning, match="waiting for an answer") as caught:
        assert ask(CacheBackend(inner, tmp_path)).text == ANSWER.text
    (told,) = (str(one.message) for one in caught)
    assert str(tmp_path / "locks" / "") in told  # Windows removes the file itself when the lock is released
    if Path("/proc/locks").exists() and str(process.pid) in Path("/proc/locks").read_text():
        assert f"process, {process.pid}," in told


def test_lock_of_a_dead_process_is_released(tmp_path: Path) -> None:
    inner = answering()
    ask(CacheBackend(inner, tmp_path))
    with other_run(tmp_path) as process:
        process.kill()
        process.wait()
        assert plain(ask(CacheBackend(inner, tmp_path))) == ANSWER
    assert len(inner.requests) == 2
