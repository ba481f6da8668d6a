"""The text-to-audio source: one process per description, whose takes are stored on disk before they are used."""

from __future__ import annotations

import json
import os
import shutil
import tempfile
import threading
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from scene2hap.audio.clip import AudioClip, Credit
from scene2hap.audio.files import SUFFIXES
from scene2hap.audio.select import MIN_DURATION_S
from scene2hap.audio.sources.candidates import MAX_CANDIDATES, how_many
from scene2hap.audio.sources.disk_cache import MAX_CLIP_S, Store, digest, plain_line
from scene2hap.audio.sources.text_to_audio.contract import Reply, Request, read_file, read_reply
from scene2hap.audio.sources.text_to_audio.process import CannotStart, ProgramLimits, environment, run, scrubbed
from scene2hap.common import checks
from scene2hap.common.calls import not_pickled
from scene2hap.common.settings import cache_folder
from scene2hap.common.warning import warn_of
from scene2hap.common.web import is_safe
from scene2hap.errors import AudioError, BackendError, BadAnswer, ConfigError
from scene2hap.haptics import VibrationDescription

RUNNERS = ("audiogen", "stable_audio")

_RUNNER_FOLDER = Path(__file__).parents[1] / "runners"
_PATIENCE = 2
"""Failures in a row after which the program is not started again."""
_ENTRY = "takes.json"
_ORIGIN = "text_to_audio"


class UnusableTake(UserWarning):
    """A generated sound cannot be used; the other sounds of its request are used."""


@not_pickled(ConfigError, "its program is started once at a time")
class TextToAudio:
    """Generate sounds by a text-to-audio model, which a program of your choice runs in its own process.

    command : words of the program's command line; {request} and {folder} stand for the two paths of the contract (added
    at the end if missing); or runner : "audiogen" or "stable_audio", scripts of this package, started by `python`, the
    interpreter of the model's environment, with further `options`. count : number of takes, 1..5; duration_s : of each
    take [s]; timeout_s, max_bytes : limits at which the program is ended; keep_env : environment variables that the
    program gets although their names end in key or token; cache : folder of generated sounds.
    Raises: ConfigError: a setting that cannot work.
    """

    def __init__(
        self,
        command: Sequence[str] | None = None,
        *,
        runner: str | None = None,
        python: str = "python3",
        options: Sequence[str] = (),
        count: int = MAX_CANDIDATES,
        duration_s: float = 5.0,
        timeout_s: float = 900.0,
        max_bytes: int = 300_000_000,
        keep_env: Sequence[str] = ("HF_TOKEN",),
        cache: str | os.PathLike[str] | None = None,
    ) -> None:
        checks.number("duration_s", duration_s, "s", above=MIN_DURATION_S, at_most=MAX_CLIP_S, error=ConfigError)
        checks.number("timeout_s", timeout_s, "s", above=0.0, error=ConfigError)
        checks.number("max_bytes", max_bytes, "bytes", at_least=1, error=ConfigError)
        self._command = _command(command, runner, python, options)
        # The interpreter's path does not affect the sound; a model in `options` does.
        self._identity = list(command) if command else [f"runner:{runner}", *options]
        self._count = how_many("count", count)
        self._duration_s = float(duration_s)
        self._allowance = ProgramLimits(float(timeout_s), int(max_bytes))
        self._keep_env = tuple(keep_env)
        self._store = Store(cache if cache is not None else cache_folder("text_to_audio"))
        self._turn = threading.Lock()
        self._failures = 0
        self._last_failure: BackendError | None = None

    def __repr__(self) -> str:
        return f"TextToAudio({self._identity!r})"

    def find(self, description: VibrationDescription) -> list[AudioClip]:
        """Return the takes that can be used, in the program's order; empty for a description without words.

        A take that cannot be used is skipped with an `UnusableTake` warning.
        Raises: BackendUnavailable: the program cannot be started, failed, took too long or wrote too much; BadAnswer:
        its output breaks the contract; ConfigError: the cache cannot be written.
        """
        prompt = plain_line(description.sentence or description.keywords, 500)
        if not prompt:
            return []
        request = Request(prompt, self._count, self._duration_s, description.seed)
        key = digest({"program": self._identity, "request": request.to_document()})
        # One at a time: a GPU that holds one model seldom holds two.
        with self._turn:
            kept = self._kept(key)
            return kept if kept is not None else self._generated(request, key)

    def _generated(self, request: Request, key: str) -> list[AudioClip]:
        if self._failures >= _PATIENCE and self._last_failure is not None:
            raise self._last_failure
        try:
            clips = self._run(request, key)
        except BackendError as failure:
            self._failures = _PATIENCE if isinstance(failure, CannotStart) else self._failures + 1
            self._last_failure = failure
            raise
        self._failures = 0
        return clips

    def _run(self, request: Request, key: str) -> list[AudioClip]:
        work = Path(tempfile.mkdtemp(prefix="scene2hap-"))
        try:
            folder = work / "sounds"
            folder.mkdir()
            request_file = work / "request.json"
            request_file.write_text(json.dumps(request.to_document()), encoding="utf-8")
            paths = {"{request}": str(request_file), "{folder}": str(folder)}
            command = [_filled(word, paths) for word in self._command]
            variables = environment(self._keep_env, os.environ)
            run(command, work, self._allowance, variables)
            reply = read_reply(folder, lambda text: scrubbed(text, variables))
            return self._adopted(folder, reply, request, key)
        finally:
            shutil.rmtree(work, ignore_errors=True)

    def _adopted(self, folder: Path, reply: Reply, request: Request, key: str) -> list[AudioClip]:
        """Store and return the takes that can be used; the entry that names them is written last."""
        clips: list[AudioClip] = []
        names: list[str] = []
        for index, name in enumerate(reply.files[: request.count]):
            suffix = Path(name).suffix if Path(name).suffix in SUFFIXES else ".wav"
            try:
                content = read_file(folder, name)
                clips.append(self._store.keep_clip(f"{key}/{index}{suffix}", content, _credit(request, reply, index)))
            except (AudioError, BadAnswer) as cause:
                warn_of(f"skipped take {index + 1}: {cause}", UnusableTake)
                continue
            names.append(f"{index}{suffix}")
        if not clips:
            raise BadAnswer(f"none of the {len(reply.files)} files of the generator can be used.", "")
        credits_ = [asdict(clip.credit) for clip in clips]
        entry = {"program": self._identity, "request": request.to_document(), "files": names, "credits": credits_}
        self._store.keep_document(f"{key}/{_ENTRY}", entry)
        return clips

    def _kept(self, key: str) -> list[AudioClip] | None:
        """Return the takes of an earlier run for the same request; None if any of them is missing."""
        entry: Any = self._store.document(f"{key}/{_ENTRY}")
        try:
            names = [str(name) for name in entry["files"]]
            credits_ = [Credit(**{field: str(text) for field, text in row.items()}) for row in entry["credits"]]
        except (TypeError, KeyError, AttributeError):
            return None
        if not names or len(names) != len(credits_) or not all(name == Path(name).name for name in names):
            return None
        clips = [self._store.clip(f"{key}/{name}", credit) for name, credit in zip(names, credits_, strict=True)]
        whole = [clip for clip in clips if clip is not None]
        return whole if len(whole) == len(names) else None


def _credit(request: Request, reply: Reply, index: int) -> Credit:
    """Return the credit of a take, from the cleaned text of an untrusted reply."""
    return Credit(
        f"{plain_line(request.prompt, 120)}, take {index + 1}",
        plain_line(reply.model) or "an unnamed model",
        plain_line(reply.licence) or "unknown",
        plain_line(reply.address) if is_safe(reply.address) else "",
        request.prompt,
        _ORIGIN,
    )


def _command(command: Sequence[str] | None, runner: str | None, python: str, options: Sequence[str]) -> list[str]:
    if (command is None) == (runner is None):
        raise ConfigError("text_to_audio wants either a command or a runner; give one of them.")
    if command is not None:
        if isinstance(command, str) or not command or not all(isinstance(word, str) and word for word in command):
            raise ConfigError(f"command is {command!r}; it must be a list of words, the program first.")
        words = list(command)
    else:
        if runner not in RUNNERS:
            raise ConfigError(f"runner is {runner!r}; it must be one of {', '.join(RUNNERS)}, or give a command.")
        words = [python, str(_RUNNER_FOLDER / f"{runner}.py"), *map(str, options)]
    named = " ".join(words)
    return [*words, *(mark for mark in ("{request}", "{folder}") if mark not in named)]


def _filled(word: str, paths: dict[str, str]) -> str:
    for mark, path in paths.items():
        word = word.replace(mark, path)
    return word
