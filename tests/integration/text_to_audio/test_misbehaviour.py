"""Generators that hang, crash, write too much or break the contract; and invalid settings."""

from __future__ import annotations

import os
import sys
import time
import traceback
from pathlib import Path
from typing import Any

import pytest

from generator_asking import assert_nothing_left, describe, failed, generator, posix, runs
from scene2hap.audio.sources import SOURCES
from scene2hap.audio.sources.text_to_audio import TextToAudio, UnusableTake
from scene2hap.errors import BackendError, BackendUnavailable, BadAnswer, ConfigError


def test_hanging_generator_is_killed(tmp_path: Path) -> None:
    start = time.monotonic()
    assert "did not finish within 0.3 s" in str(failed(tmp_path, "hang", timeout_s=0.3))
    assert time.monotonic() - start < 30.0, "the program sleeps for a minute"


@posix
@pytest.mark.parametrize("ends", [True, False])
def test_child_processes_of_a_generator_are_killed(tmp_path: Path, ends: bool) -> None:
    pid = tmp_path / "pid"
    if ends:
        generator(tmp_path, "orphan", timeout_s=60.0).find(describe())
    else:
        code = (
            "import os, subprocess, sys, time;"
            "child = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(60)']);"
            "open(os.environ['FAKE_PID'], 'w').write(str(child.pid)); time.sleep(60)"
        )
        for timeout_s in (1.0, 5.0, 25.0):  # a busy machine may start the child after the first of them
            runner = TextToAudio([sys.executable, "-S", "-c", code], timeout_s=timeout_s, cache=tmp_path / "cache")
            with pytest.raises(BackendUnavailable, match="did not finish"):
                runner.find(describe())
            if pid.exists():
                break
    child = int(pid.read_text())
    deadline = time.monotonic() + 60.0
    while is_running(child):
        assert time.monotonic() < deadline, "the child runs on"
        time.sleep(0.01)


def is_running(process: int) -> bool:
    """Whether a process exists and is not a zombie."""
    try:
        stat = Path(f"/proc/{process}/stat")
        if Path("/proc/self/stat").exists():
            return stat.read_text().rsplit(")", 1)[1].split()[0] != "Z"
        os.kill(process, 0)
    except (FileNotFoundError, ProcessLookupError):
        return False
    return True


def test_error_quotes_a_crashed_generator_without_its_key(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HF_TOKEN", "hf_0123456789abcdef")
    error = failed(tmp_path, "die")
    assert "ended with status 3. It said last: loading the model CUDA out of memory, key ******" in str(error)
    assert "hf_0123456789abcdef" not in "".join(traceback.format_exception(error))


@posix
def test_killed_generator_is_reported(tmp_path: Path) -> None:
    assert "was ended by signal 9 (out of memory?)" in str(failed(tmp_path, "killed"))


@pytest.mark.parametrize(
    ("manner", "said"),
    [
        ("gigabytes", "above 1000 files or 20 MB"),
        ("sparse", "files of 10000 MB in all"),
        ("flood", "above 1000 files or 20 MB"),
        ("litter", "wrote 1001 files"),
    ],
)
def test_generator_that_writes_too_much_is_killed(tmp_path: Path, manner: str, said: str) -> None:
    assert said in str(failed(tmp_path, manner, max_bytes=20_000_000))


@pytest.mark.parametrize(
    ("manner", "said"),
    [
        ("silent", "left no reply.json"),
        ("not-json", "reply.json of the generator"),
        ("huge-reply", "left no reply.json .*at most 1000000 are read"),
        ("other-version", "version 2; it must be"),
        ("no-number-of-version", "version: it must be a whole number"),
        ("no-files", "names no files"),
        ("error", "the generator says: no GPU for you"),
    ],
)
def test_generator_that_breaks_the_contract_is_refused(tmp_path: Path, manner: str, said: str) -> None:
    with pytest.raises(BackendError, match=said):
        raise failed(tmp_path, manner)


@pytest.mark.parametrize(
    ("manner", "said"),
    [
        ("junk-sounds", "is not a readable sound"),
        ("long", "lasts 61 s; it must be at most 60 s"),
        ("not-finite", "every sample must be finite"),
        ("outside", "must be a plain name in the reply's folder"),
        ("absent", "cannot be read"),
        pytest.param("link", "is not a plain file", marks=posix),
        pytest.param("pipe", "is not a plain file", marks=posix),
    ],
)
def test_generator_without_valid_sounds_is_refused(tmp_path: Path, manner: str, said: str) -> None:
    with pytest.warns(UnusableTake, match=said):
        error = failed(tmp_path, manner)
    assert isinstance(error, BadAnswer)
    assert "can be used" in str(error)


def test_missing_generator_is_tried_once(tmp_path: Path) -> None:
    source = TextToAudio(["/no/such/program"], cache=tmp_path / "cache")
    for _ in range(2):
        with pytest.raises(BackendUnavailable, match=r"cannot start '/no/such/program': .+Check `command`"):
            source.find(describe())
    assert_nothing_left(tmp_path)


def test_generator_that_fails_twice_is_not_started_again(tmp_path: Path) -> None:
    source = generator(tmp_path, "silent")
    for _ in range(4):
        with pytest.raises(BadAnswer, match=r"left no reply\.json"):
            source.find(describe())
    assert len(runs(tmp_path)) == 2


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"command": ["a"], "runner": "audiogen"},
        {"command": "python run.py"},
        {"command": []},
        {"command": ["python", 3]},
        {"runner": "musicgen"},
        {"command": ["a"], "count": 6},
        {"command": ["a"], "count": 1.5},
        {"command": ["a"], "duration_s": 2.0},
        {"command": ["a"], "timeout_s": 0.0},
        {"command": ["a"], "max_bytes": 0},
    ],
    ids=str,
)
def test_invalid_settings_are_refused(settings: dict[str, Any]) -> None:
    with pytest.raises(ConfigError, match="command|runner|count|duration_s|timeout_s|max_bytes"):
        SOURCES.build({"kind": "text_to_audio", **settings})
