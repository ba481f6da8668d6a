"""Questions to a model: filled template, limit of concurrent calls, validated answer, report."""

from __future__ import annotations

import asyncio
import inspect
from collections import Counter
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

from pydantic import ValidationError

from scene2hap.common import checks
from scene2hap.common.counted import counted
from scene2hap.common.warning import warn_of
from scene2hap.errors import BackendUnavailable, BadAnswer, ConfigError, RequestRejected
from scene2hap.llm.answers import Answer, AnswerType, read_answer
from scene2hap.llm.answers.json_text import answer_object
from scene2hap.llm.answers.usable import UnusableAnswer, question_of, require_answer
from scene2hap.llm.chain.report import InferenceReport
from scene2hap.llm.prompts import Prompts
from scene2hap.llm.protocol import AnswerPending, BackendWarning, Component, LLMBackend, LLMReply, LLMRequest

MOST_UNANSWERED = 8
"""Questions of one component in a row without an answer that stop a run (assumed: all that run at once by default)."""


class ConcurrencyLimit:
    """Limit of concurrent questions, which the questions of several scenes can share.

    `n_running` questions are with the backend now; `is_stopping` is true once a cancellation has been reported.
    """

    def __init__(self, n_at_once: int) -> None:
        self.free: asyncio.Semaphore = asyncio.Semaphore(n_at_once)
        self.n_running: int = 0
        self.is_stopping: bool = False


class Questions:
    """Send questions to a backend, as many at once as the limit allows, and keep the report.

    An error that would affect every further question (an exhausted budget, a rejected key, a recording that does not
    match) stops all questions, as do `MOST_UNANSWERED` questions of one component in a row without an answer, and a
    cancellation, as by Ctrl-C. Running calls are completed, so that their answers are kept, and no new call begins. A
    second cancellation ends the running calls too.
    """

    def __init__(
        self,
        backend: LLMBackend,
        prompts: Prompts,
        limit: ConcurrencyLimit,
        *,
        user_prompt: str = "",
        temperature: float = 0.2,
        object_prompts: Mapping[str, str] | None = None,
    ) -> None:
        self.report: InferenceReport = InferenceReport()
        self.closed_by: Exception | None = None
        self._backend = backend
        self._prompts = prompts
        self._limit = limit
        self._user_prompt = user_prompt
        self._temperature = temperature
        self._object_prompts = object_prompts or {}
        self._unanswered: Counter[Component] = Counter()
        self._answered: set[Component] = set()

    async def _completed(self, request: LLMRequest) -> LLMReply:
        """Return the backend's reply. Raises: ConfigError: it is not an `LLMReply`."""
        by, awaited = f"{type(self._backend).__name__}.complete", self._backend.complete(request)
        if not inspect.isawaitable(awaited):
            raise ConfigError(
                f"{by} gave {checks.described(awaited)}; write it as 'async def complete(self, request)'."
            )
        reply = await awaited
        if not isinstance(reply, LLMReply):
            raise ConfigError(f"{by} gave {checks.described(reply)}; it must be an LLMReply(text, model).")
        return reply

    async def _kept(self, request: LLMRequest) -> LLMReply:
        """Return the backend's reply. A cancelled call ends first, since it is paid for and a cache may keep it."""
        self._limit.n_running += 1
        running = asyncio.ensure_future(self._completed(request))
        try:
            return await asyncio.shield(running)
        except asyncio.CancelledError:
            if not running.done():
                self._close_for_cancellation()
                await asyncio.wait([running])
            if not running.cancelled():
                running.exception()  # asyncio would report an error that nobody reads
            raise
        finally:
            running.cancel()  # has an effect only after a second cancellation
            self._limit.n_running -= 1

    def _close_for_cancellation(self) -> None:
        if self.closed_by is not None:
            return
        self.closed_by = BackendUnavailable("the questions were cancelled.")
        if self._limit.is_stopping:
            return
        self._limit.is_stopping = True
        warn_of(
            f"stopping: {counted(self._limit.n_running, 'question')} to the model will be answered first, since the "
            "answers are paid for. Interrupt again to stop at once.",
            BackendWarning,
        )

    async def ask(
        self,
        component: Component,
        subject: str,
        facts: Mapping[str, Any],
        shape: type[AnswerType],
        images: Sequence[bytes] = (),
    ) -> tuple[AnswerType, str]:
        """Return a validated answer, and its provenance: model, prompt version and key in the cache.

        Raises: BadAnswer: the reply was cut short, is not JSON or breaks a bound; it carries the raw text.
        AnswerRefused. Any error of the backend. An earlier error that stopped all questions.
        """
        request = LLMRequest(
            component=component,
            subject=subject,
            prompt=self._prompts.fill(component, facts, self._user_prompt_for(subject)),
            facts=facts,
            answer_schema=_schema(shape),
            prompt_version=self._prompts.version,
            images=images,
            temperature=self._temperature,
        )
        async with self._limit.free:
            reply = await self._counted(request)
        answer = _validated(reply, shape, question_of(request))
        kept_as = f", {reply.key[:19]}" if reply.key else ""
        return answer, f"{reply.model}, prompt {self._prompts.version}{kept_as}"

    async def _counted(self, request: LLMRequest) -> LLMReply:
        """Return the reply, and enter the call into the report. An error may stop all further questions."""
        if self.closed_by is not None:
            raise self.closed_by
        self.report.calls[request.component] += 1
        try:
            reply = await self._kept(request)
        except Exception as problem:  # a backend of a user's own may raise any error
            if isinstance(problem, UnusableAnswer):  # it was billed although it is unusable
                self.report.take(LLMReply("", problem.model, usage=problem.usage, service_tier=problem.service_tier))
            self._close_if_general(request.component, problem)
            raise
        self._answered.add(request.component)
        if not reply.is_kept:  # a stored answer does not show that the service is there
            self._unanswered[request.component] = 0
        self.report.take(reply)
        return reply

    def _close_if_general(self, component: Component, problem: Exception) -> None:
        """Stop all questions if an error concerns more than its own question."""
        if isinstance(problem, BadAnswer):
            self._unanswered[component] = 0
        elif isinstance(problem, RequestRejected) and component in self._answered:
            pass  # other questions of this form were accepted, so the fault is in its pictures or its length
        elif isinstance(problem, RequestRejected) or (isinstance(problem, BackendUnavailable) and problem.retryable):
            self._unanswered[component] += 0 if isinstance(problem, AnswerPending) else 1
            if self._unanswered[component] >= MOST_UNANSWERED and self.closed_by is None:
                self.closed_by = BackendUnavailable(
                    f"{counted(MOST_UNANSWERED, 'question')} of the {component} in a row had no answer, so that no "
                    f"more are sent. The last error: {problem}"
                )
        else:
            self.closed_by = problem

    def has_own_prompt(self, subject: str) -> bool:
        """Return True if the user gave a prompt for this object alone."""
        return bool(self._object_prompts.get(subject))

    def _user_prompt_for(self, subject: str) -> str:
        return " ".join(filter(None, (self._user_prompt, self._object_prompts.get(subject, ""))))


@cache
def _schema(shape: type[Answer]) -> dict[str, Any]:
    return shape.model_json_schema()


def _validated(reply: LLMReply, shape: type[AnswerType], about: str) -> AnswerType:
    """Return the answer in a reply. Raises: BadAnswer, AnswerRefused: see `Questions.ask`."""
    require_answer(reply, about)
    try:
        return read_answer(shape, answer_object(reply.text) or reply.text)
    except ValidationError as cause:
        fault = checks.first_problem(cause)
        given = "" if fault.kind == "missing" else f" is {checks.represented(fault.value)}"
        raise BadAnswer(
            f"{about}: {fault.place or 'the answer'}{given}: {fault.reason}. It must be JSON of the request's "
            "answer_schema.",
            reply.text,
        ) from cause
