"""The interface of model backends: one request and one reply."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, Protocol, get_args, runtime_checkable

from scene2hap.common.calls import clear_construction
from scene2hap.errors import BackendUnavailable

Component = Literal["scene_analyzer", "object_analyzer", "material_estimator", "vibration_describer"]
"""The four chained components of the paper, section "LLM Workflow and Components"."""

COMPONENTS: tuple[Component, ...] = get_args(Component)


@clear_construction
@dataclass(frozen=True)
class LLMRequest:
    """One question to a language model; its answer must be JSON of `answer_schema`.

    `component` names the kind of question. `prompt` is the filled template. `facts` are its values (JSON values), for
    backends that do not read prose. `answer_schema` is the JSON schema of the answer. `subject` is the object's id, ""
    for the scene. `images` are PNG files in the order in which the prompt names them. They may be rendered only when
    they are read, so that a backend without vision causes no rendering.
    """

    component: Component
    subject: str
    prompt: str
    facts: Mapping[str, Any]
    answer_schema: Mapping[str, Any]
    prompt_version: str
    images: Sequence[bytes] = ()
    temperature: float = 0.2


@clear_construction
@dataclass(frozen=True)
class LLMReply:
    """One answer of a language model: `text` is a JSON document; `model` is its author; `usage` counts tokens if known.

    `usage` has prompt_tokens, completion_tokens and cached_tokens, the prompt tokens from the service's prompt cache.
    `service_tier` is the tier that the service billed, "" for its standard one.
    `key` names the answer in a cache or recording, "" if it is in none. `is_kept` is true if the answer came from there
    and cost nothing now.
    """

    text: str
    model: str
    finish_reason: str = "stop"
    usage: Mapping[str, int] = field(default_factory=dict)
    key: str = ""
    is_kept: bool = False
    service_tier: str = ""


class BackendWarning(UserWarning):
    """A model or its server deviated from the request; the answer may be worse."""


class AnswerPending(BackendUnavailable):
    """The answer comes later: the question is in a batch, or will be in the next one."""

    def __init__(self, message: str) -> None:
        super().__init__(message, retryable=True)


@runtime_checkable
class LLMBackend(Protocol):
    """Interface of language models: `complete` answers a request. Several requests may run at the same time."""

    async def complete(self, request: LLMRequest, /) -> LLMReply:
        """Return the answer. Raises: BackendUnavailable, BadAnswer, ReplayMiss."""
        ...
