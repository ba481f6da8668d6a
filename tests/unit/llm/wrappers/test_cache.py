"""CacheBackend: what counts as the same question, and what happens to the files."""

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
    """The reply without the name under which it is kept."""
    return dataclasses.replace(reply, key="")


def answering(reply: LLMReply = ANSWER, model: str = "m") -> FunctionBackend:
    return FunctionBackend(lambda _: reply, model=model)


def ask(backend: CacheBackend, asked: LLMRequest | None = None) -> LLMReply:
    return asyncio.run(backend.complete(asked or request()))


def files(folder: Path) -> list[Path]:
    """What is kept; the files of locks stay behind, empty."""
    return sorted(path for path in folder.rglob("*") if path.is_file() and path.parent.name != "locks")


# --- hits and misses --------------------------------------------------------------------------------------------------


def test_second_question_is_answered_from_disk(tmp_path: Path) -> None:
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
def test_no_wrong_hits(tmp_path: Path, changes: dict[str, Any]) -> None:
    inner = answering()
    backend = CacheBackend(inner, tmp_path)
    ask(backend)
    ask(backend, request(**changes))
    assert len(inner.requests) == 2


def test_models_do_not_answer_for_each_other(tmp_path: Path) -> None:
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
def test_identity_is_model_and_address_and_whatever_decides(other: OpenAIBackend | LocalBackend) -> None:
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
def test_identity_of_a_local_backend_is_all_that_decides(settings: dict[str, Any]) -> None:
    one, other = LocalBackend("m", base_url="http://a"), LocalBackend("m", base_url="http://a", **settings)
    assert one.identity != other.identity
    json.dumps(other.identity)  # a cache writes it


def test_identity_has_nothing_that_does_not_decide() -> None:
    assert OpenAIBackend(api_key="sk-one").identity == OpenAIBackend(api_key="sk-two", timeout_s=5).identity


def test_key_of_a_reply_names_its_file_from_the_first(tmp_path: Path) -> None:
    reply = ask(CacheBackend(answering(), tmp_path))
    assert not reply.is_kept
    assert [reply.key] == [path.stem for path in files(tmp_path)]


def test_identity_is_asked_for_when_it_is_known(tmp_path: Path) -> None:
    """A local backend learns its model from the server, which may serve another one tomorrow."""

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


def test_what_is_learnt_while_answering_is_in_the_key(tmp_path: Path) -> None:
    """A guest's wrapper may hand `identity` on but not `ready`."""

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


def test_backend_that_does_not_tell_who_it_is(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="no `identity`"):
        CacheBackend(LexiconBackend(), tmp_path)


@pytest.mark.parametrize(
    "reply",
    [LLMReply("{}", "m"), LLMReply("no JSON", "m"), LLMReply(ANSWER.text, "m", "length")],
    ids=lambda reply: reply.text[:8] + reply.finish_reason,
)
def test_bad_answers_are_handed_on_but_never_kept(tmp_path: Path, reply: LLMReply) -> None:
    backend = CacheBackend(answering(reply), tmp_path)
    assert ask(backend) == reply
    assert backend.report()["rejected"] == 1
    assert files(tmp_path) == []


def test_failures_leave_nothing_behind_and_pass_through(tmp_path: Path) -> None:
    error = BackendUnavailable("away", retryable=True)

    def fail(_: LLMRequest) -> LLMReply:
        raise error

    with pytest.raises(BackendUnavailable) as caught:
        ask(CacheBackend(FunctionBackend(fail), tmp_path))
    assert caught.value is error
    assert files(tmp_path) == []


# --- files ------------------------------------------------------------------------------------------------------------


def test_nothing_but_the_listed_fields_is_written(tmp_path: Path) -> None:
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


def test_an_answer_that_a_stricter_rule_forbids_is_asked_for_again(tmp_path: Path) -> None:
    """Rules that are not in the schema, as for words, may change without changing the key."""
    inner = answering()
    backend = CacheBackend(inner, tmp_path)
    ask(backend)
    (entry,) = files(tmp_path)
    kept = json.loads(entry.read_text(encoding="utf-8"))
    entry.write_text(json.dumps({**kept, "text": '{"scene_category": ""}'}), encoding="utf-8")
    assert ask(backend).text == ANSWER.text
    assert len(inner.requests) == 2


def test_write_that_fails_half_way_leaves_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(ConfigError, match="cannot write the cache .*No space left"):
        ask(CacheBackend(answering(), tmp_path))
    assert files(tmp_path) == []


def test_folder_that_cannot_be(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(ConfigError, match="cannot write the cache"):
        CacheBackend(answering(), tmp_path / "file" / "cache")


def test_folder_that_has_gone_is_made_again(tmp_path: Path) -> None:
    backend = CacheBackend(answering(), tmp_path / "cache")
    shutil.rmtree(tmp_path / "cache")
    assert plain(ask(backend)) == ANSWER
    assert len(files(tmp_path / "cache")) == 1


def test_folder_that_cannot_be_locked(tmp_path: Path) -> None:
    backend = CacheBackend(answering(), tmp_path / "cache")
    shutil.rmtree(tmp_path / "cache")
    (tmp_path / "cache").write_text("")
    with pytest.raises(ConfigError, match="cannot lock"):
        ask(backend)


# --- locks ------------------------------------------------------------------------------------------------------------


def test_equal_questions_at_the_same_time_are_asked_once(tmp_path: Path) -> None:
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
    """A process that holds the lock of the one answer in the folder, which it writes after a while, or never."""
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


def test_another_run_is_waited_for(tmp_path: Path) -> None:
    inner = answering()
    ask(CacheBackend(inner, tmp_path))
    answer = json.dumps(json.loads(files(tmp_path)[0].read_bytes()))
    with other_run(tmp_path, answer):
        assert ask(CacheBackend(inner, tmp_path)).text == ANSWER.text
    assert len(inner.requests) == 1


def test_lock_of_a_run_that_died_is_free(tmp_path: Path) -> None:
    inner = answering()
    ask(CacheBackend(inner, tmp_path))
    with other_run(tmp_path) as process:
        process.kill()
        process.wait()
        assert plain(ask(CacheBackend(inner, tmp_path))) == ANSWER
    assert len(inner.requests) == 2
