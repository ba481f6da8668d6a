"""RepairBackend: sends an invalid answer back to the model, with its errors."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.errors import BadAnswer, ConfigError
from scene2hap.llm.answers.json_text import answer_object
from scene2hap.llm.answers.usable import UnusableAnswer, question_of, require_answer, unusable
from scene2hap.llm.protocol import LLMReply, LLMRequest
from scene2hap.llm.stack import Spec, Wrapper
from scene2hap.llm.validation import Fault, find_fault

_LONGEST_QUOTED = 4000
"""Most characters of a bad answer that are sent back (assumed: three times the longest good one)."""


@clear_construction
class RepairBackend(Wrapper):
    """Validate each reply as its component's answer; repeat the request up to `repairs` times if it is invalid.

    A repair holds the original question and only the last invalid answer, so that its cost does not grow. Pictures are
    left out if only numbers were wrong. Replies that were cut short, empty, filtered or refused are not repaired. The
    usage of the reply, or of the error, is the sum over all attempts.
    """

    def __init__(self, inner: Spec, repairs: int = 2) -> None:
        super().__init__(inner)
        checks.number("repairs", repairs, "-", at_least=0, error=ConfigError)
        self._repairs = repairs
        self._calls = self._n_repairs = self._given_up = 0

    async def complete(self, request: LLMRequest) -> LLMReply:
        """Return a valid answer. Raises: BadAnswer: none came, with the last raw text; errors of the inner backend."""
        self._calls += 1
        question, usage, left = request, Counter[str](), self._repairs
        usable: LLMReply | None = None  # an answer with a minor fault, kept in case its repair fails
        while True:
            try:
                reply = await self._whole(question, usage)
            except BadAnswer:
                if usable is None:
                    raise
                return replace(usable, usage=dict(usage))
            text = answer_object(reply.text) or reply.text
            fault = find_fault(request.component, text, request.facts)
            if fault is None or (fault.is_minor and left == 0):
                return replace(reply, text=text, usage=dict(usage))
            if usable is not None:
                return replace(usable, usage=dict(usage))
            if fault.is_minor:
                usable = replace(reply, text=text)
            elif left == 0:
                self._given_up += 1
                message = f"{question_of(request)}: still wrong after {self._repairs} repairs: {fault.reason}. "
                message += "Choose a model that keeps to the form, or raise `repairs`."
                raise unusable(replace(reply, usage=dict(usage)), message, reply.text)
            left -= 1
            self._n_repairs += 1
            question = _repair(request, text, fault)

    async def _whole(self, question: LLMRequest, usage: Counter[str]) -> LLMReply:
        """Return an answer that is whole. Adds its tokens to `usage`; an error for an answer states their sum."""
        try:
            reply = await self.inner.complete(question)
        except UnusableAnswer as problem:
            usage.update(problem.usage)
            problem.usage = dict(usage)
            raise
        usage.update(reply.usage)
        require_answer(replace(reply, usage=dict(usage)), question_of(question))
        return reply

    def report(self) -> dict[str, int]:
        """Return counts: calls, repairs, and calls that failed after all repairs."""
        return {"calls": self._calls, "repairs": self._n_repairs, "given_up": self._given_up}


def _repair(request: LLMRequest, text: str, fault: Fault) -> LLMRequest:
    prompt = (
        f"{request.prompt}\n\nYour last answer was:\n{text[:_LONGEST_QUOTED]}\n\n"
        f"It cannot be used: {fault.reason}.\nAnswer again, as one whole JSON object with these faults mended."
    )
    return replace(request, prompt=prompt, images=request.images if fault.needs_images else ())
