"""Send many concurrent requests with one fault through the standard LLM stack, and record the outcome of each."""

from __future__ import annotations

import asyncio
import itertools
import json
import logging
import re
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Awaitable, Callable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from llm_asking import local, ollama, openai
from llm_faults import Fault, as_ollama, good
from llm_server import GOOD, KEY, Asked, Scripted, Server, request, serving
from openai_schema import openai_serving
from scene2hap import RecordingBackend
from scene2hap.errors import Scene2HapError
from scene2hap.llm.protocol import Component, LLMBackend, LLMReply, LLMRequest
from scene2hap.llm.validation import find_fault
from scene2hap.llm.wrappers import reports, standard_stack

BACKENDS: dict[str, Callable[..., LLMBackend]] = {"openai": openai, "local": local, "ollama": ollama}
CONCURRENCY = 8
_NUMBER = re.compile(r"Question (\d+)\.")


@dataclass
class Outcome:
    """The outcome of the requests of one fault."""

    requests: int = 0
    ends: Counter[str] = field(default_factory=Counter)
    calls: list[int] = field(default_factory=list)
    foreign: list[str] = field(default_factory=list)
    asked_again: int = 0
    leaks: list[str] = field(default_factory=list)
    seconds: float = 0.0


class Play:
    """The script of one campaign: each question meets its fault `times` times, then a good answer."""

    def __init__(self, fault: Fault, times: float, kind: str) -> None:
        self.calls: Counter[int] = Counter()
        self.valid: set[int] = set()
        self.asked_again = 0
        self._fault = fault
        self._times = times
        self._kind = kind

    def answer(self, asked: Asked) -> Scripted:
        number = int(_NUMBER.findall(asked.prompt)[0])
        component = component_of(self._fault, number)
        if number in self.valid:
            self.asked_again += 1
        self.calls[number] += 1
        reply = self._fault.reply(component) if self.calls[number] <= self._times else good(component)
        return as_ollama(reply) if self._kind == "ollama" else reply


def component_of(fault: Fault, number: int) -> Component:
    return fault.components[number % len(fault.components)]


def run(
    fault: Fault,
    kind: str,
    folder: Path,
    *,
    n: int,
    for_good: bool = False,
    retries: int = 2,
    sleep: Callable[[float], Awaitable[object]] = asyncio.sleep,
) -> Outcome:
    """Send `n` requests through the standard stack, twice over the same cache; then search all output for the key."""
    outcome = Outcome(requests=n)
    play = Play(fault, float("inf") if for_good else 1, kind)
    began_s = time.monotonic()
    shown: list[str] = []
    with _listening(shown), _serving(play, kind) as server:
        backend = BACKENDS[kind](server, api_key=KEY, timeout_s=fault.timeout_s)
        for pass_number in range(2):
            tape = folder / f"tape{pass_number}.jsonl"
            inner = standard_stack(backend, folder / "cache", retries=retries, rate_limit_retries=retries, sleep=sleep)
            stack = RecordingBackend(inner, tape)
            left = [number for number in range(n) if pass_number == 0 or number in play.valid]
            asyncio.run(_all(stack, fault, left, play, outcome if pass_number == 0 else Outcome(), shown))
            shown += [repr(stack), repr(vars(stack)), json.dumps(reports(inner)), str(stack.identity)]
        shown += [repr(backend), repr(vars(backend))]
    outcome.seconds = time.monotonic() - began_s
    outcome.asked_again = play.asked_again
    outcome.calls = [play.calls[number] for number in range(n)]
    shown += [path.read_text(encoding="utf-8") for path in folder.rglob("*") if path.is_file()]
    outcome.leaks = [text for text in shown if KEY in text]
    return outcome


async def _all(
    stack: LLMBackend, fault: Fault, numbers: list[int], play: Play, outcome: Outcome, shown: list[str]
) -> None:
    lanes = asyncio.Semaphore(CONCURRENCY)

    async def one(number: int) -> None:
        component = component_of(fault, number)
        async with lanes:
            try:
                reply = await stack.complete(_question(component, number))
            except Scene2HapError as error:
                shown.extend(_all_of(error))
                outcome.ends[type(error).__name__] += 1
            except Exception as error:  # the campaign searches for such errors
                outcome.foreign.append(repr(error))
            else:
                shown.append(repr(reply))
                if _is_good(component, reply):
                    play.valid.add(number)
                outcome.ends["valid" if _is_good(component, reply) else "invalid"] += 1

    await asyncio.gather(*map(one, numbers))


def _question(component: Component, number: int) -> LLMRequest:
    return request(component, subject=f"object {number}", prompt=f"Question {number}. What is it?")


def _is_good(component: Component, reply: LLMReply) -> bool:
    return find_fault(component, reply.text) is None and json.loads(reply.text) == GOOD[component]


def _all_of(error: BaseException) -> list[str]:
    """All texts that an error reporter might show of an error, its causes and contexts, with local variables."""
    frames = error.__traceback__
    while frames is not None and frames.tb_frame.f_code.co_filename == __file__:
        frames = frames.tb_next  # frames of this module hold everything shown before
    whole = "".join(traceback.TracebackException(type(error), error, frames, capture_locals=True).format())
    chain = list(itertools.islice(_chain(error), 20))
    return [whole, *map(str, chain), *map(repr, chain), *(repr(vars(link)) for link in chain)]


def _chain(error: BaseException | None) -> Iterator[BaseException]:
    while error is not None:
        yield error
        if error.__context__ is not error.__cause__:
            yield from _chain(error.__context__)
        error = error.__cause__


class _listening(logging.Handler):
    """Append all log records from DEBUG up and all warnings to `shown`."""

    def __init__(self, shown: list[str]) -> None:
        super().__init__(logging.DEBUG)
        self._shown = shown
        self._warnings = warnings.catch_warnings(record=True)

    def emit(self, record: logging.LogRecord) -> None:
        self._shown.append(f"{record.getMessage()} {record.args!r}")

    def __enter__(self) -> None:
        self._level = logging.root.level
        logging.root.addHandler(self)
        logging.root.setLevel(logging.DEBUG)
        self._caught = self._warnings.__enter__()
        warnings.simplefilter("always")

    def __exit__(self, *how: Any) -> None:
        self._warnings.__exit__(*how)
        self._shown.extend(str(warning.message) for warning in self._caught or ())
        logging.root.removeHandler(self)
        logging.root.setLevel(self._level)


def _serving(play: Play, kind: str) -> AbstractContextManager[Server]:
    """Serve the play; check requests and answers of OpenAI's kind against its schema, as others may have other keys."""
    return (openai_serving if kind == "openai" else serving)(by=play.answer)
