"""A model's message as an answer: whole, and no refusal. Errors for messages that were billed and cannot be used."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from scene2hap.errors import AnswerRefused, BadAnswer
from scene2hap.llm.answers.finish_reasons import is_cut, is_filtered, is_whole
from scene2hap.llm.answers.refusals import refusal_in
from scene2hap.llm.prompts.quoting import shown
from scene2hap.llm.protocol import LLMReply, LLMRequest

AFTER_REFUSAL = "It gets no second try; rename or hide what it objects to, send no pictures, or choose another model."


class UnusableAnswer(BadAnswer):
    """A bad answer that was billed: by `model`, with `usage` in tokens if known, in tier `service_tier`.

    `finish_reason` states why it ended.
    """

    def __init__(
        self,
        message: str,
        raw_text: str = "",
        *,
        model: str = "",
        usage: Mapping[str, int] | None = None,
        service_tier: str = "",
        finish_reason: str = "stop",
    ) -> None:
        super().__init__(message, raw_text)
        self.model = model
        self.usage: dict[str, int] = dict(usage or {})
        self.service_tier = service_tier
        self.finish_reason = finish_reason


class RefusedAnswer(UnusableAnswer, AnswerRefused):
    """A refusal that was billed."""


@dataclass(frozen=True)
class RawReply(LLMReply):
    """A model's message before any check. Some servers put the answer into `thoughts` by mistake."""

    thoughts: str = ""
    refusal: str = ""


def question_of(request: LLMRequest) -> str:
    """Describe the question of a request for a message."""
    return f"{request.component} about {shown(request.subject or 'the scene')}"


def require_whole(said: RawReply, about: str) -> None:
    """Reject an answer that must not be parsed, even if its content looks valid.

    Raises: UnusableAnswer: cut short, with the partial answer; RefusedAnswer: filtered or refused.
    """
    if is_cut(said.finish_reason):
        raise unusable(
            said,
            f"{about}: {said.model} was cut off at its token limit. Raise max_tokens (or num_ctx), or switch off "
            "its reasoning.",
            said.text,
        )
    _require_willing(said, about, said.refusal)


def require_answer(said: LLMReply, about: str) -> None:
    """Reject a message that is no whole answer. Raises: UnusableAnswer: empty, or ended early; RefusedAnswer."""
    _require_willing(said, about)
    if not said.text.strip():
        raise unusable(said, f"{about}: {said.model} answered without content.", said.text)
    if not is_whole(said.finish_reason):
        raise unusable(said, f"{about}: the answer ended by {said.finish_reason!r}, not by itself.", said.text)


def _require_willing(said: LLMReply, about: str, refusal: str = "") -> None:
    """Reject a refusal: in its own field, as finish reason, or as the text itself. Raises: RefusedAnswer."""
    if is_filtered(said.finish_reason):
        message = f"{about}: the answer of {said.model} was withheld by a content filter ({said.finish_reason})."
        raise RefusedAnswer(f"{message} {AFTER_REFUSAL}", said.text, **_paid(said))
    if words := refusal or refusal_in(said.text):
        message = f"{about}: {said.model} refused to answer: {shown(words)}. {AFTER_REFUSAL}"
        raise RefusedAnswer(message, words, **_paid(said))


def unusable(said: LLMReply, message: str, raw_text: str) -> UnusableAnswer:
    """Return the error for a model's message, with its model, usage and tier."""
    return UnusableAnswer(message, raw_text, **_paid(said))


def _paid(said: LLMReply) -> dict[str, Any]:
    tier, reason = said.service_tier, said.finish_reason
    return {"model": said.model, "usage": said.usage, "service_tier": tier, "finish_reason": reason}
