"""FunctionBackend: a Python function in place of a model, for tests and for simple backends."""

from __future__ import annotations

import inspect
import json
from collections.abc import Awaitable, Callable, Mapping
from typing import Any

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction, misfit
from scene2hap.errors import ConfigError
from scene2hap.llm.protocol import LLMReply, LLMRequest

Returned = LLMReply | Mapping[str, Any] | str
"""A whole reply, an answer as JSON values, or a text."""


@clear_construction
class FunctionBackend:
    """Answer by calling `function(request)`, which may be async. Its exceptions pass through.

    `requests` holds all requests so far, in order. `model` appears in the replies and in the keys of a cache.
    """

    def __init__(
        self, function: Callable[[LLMRequest], Returned | Awaitable[Returned]], *, model: str = "function"
    ) -> None:
        problem = misfit(function, (None,), {}) if callable(function) else f"It is {checks.represented(function)}."
        if problem:
            raise ConfigError(f"function must take one argument, the LLMRequest, and give the answer. {problem}")
        self._function = function
        self.model = model
        self.requests: list[LLMRequest] = []

    def __repr__(self) -> str:
        return f"FunctionBackend({self.model!r})"

    @property
    def identity(self) -> dict[str, Any]:
        """The settings, besides the request, on which an answer depends."""
        return {"model": self.model}

    async def complete(self, request: LLMRequest) -> LLMReply:
        """Return the result of the function as a reply."""
        self.requests.append(request)
        returned = self._function(request)
        if inspect.isawaitable(returned):
            returned = await returned
        if isinstance(returned, LLMReply):
            return returned
        return LLMReply(returned if isinstance(returned, str) else json.dumps(returned), self.model)

    def report(self) -> dict[str, int]:
        """Return the number of requests so far."""
        return {"calls": len(self.requests)}
