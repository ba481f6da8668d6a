"""BatchBackend: answers from finished batches, and collects new questions for the next batch."""

from __future__ import annotations

import hashlib
import json
import warnings
from collections import Counter
from dataclasses import replace
from typing import Any, get_args

from scene2hap.common.web import WebReply
from scene2hap.errors import BackendUnavailable, BadAnswer, Scene2HapError
from scene2hap.llm.answers.usable import question_of
from scene2hap.llm.backends import chat
from scene2hap.llm.backends.openai import OpenAIBackend
from scene2hap.llm.batch.folder import BatchFolder, Outcome, RequestWriter, Stage, keys_in
from scene2hap.llm.chain.dry_run import estimated_cost_usd
from scene2hap.llm.protocol import AnswerPending, BackendWarning, LLMReply, LLMRequest
from scene2hap.llm.request_key import canonical
from scene2hap.llm.wrappers.prices import PriceList

TIER = "batch"
"""The price tier of batches."""
_TRIES = 3
"""Most attempts for a request that fails on the server. A request that expired or was cancelled is always repeated."""
_NO_FAULT = frozenset({"batch_expired", "batch_cancelled"})


class BatchBackend:
    """Answers of `model` from a folder of batches.

    A question without an answer is written once for the next batch, unless an open batch has it. Parameters that the
    model has rejected are not sent again.
    """

    def __init__(self, model: OpenAIBackend, folder: BatchFolder, prices: PriceList) -> None:
        self._model, self._prices = model, prices
        self._answers: dict[str, WebReply] = {}
        self._failures: Counter[str] = Counter()
        self._why: dict[str, str] = {}
        rows = folder.rows()
        self._sent = set(keys_in(rows, "written", "uploaded", "begun"))
        self._writer = RequestWriter(folder)
        own = keys_in(rows, *get_args(Stage))
        for key, outcome in folder.outcomes():
            if key in own:
                self._take(key, outcome)

    @property
    def identity(self) -> dict[str, Any]:
        """The identity of the model, since an answer in a batch equals the answer to a single call."""
        return self._model.identity

    @property
    def cost_usd(self) -> float | None:
        """Cost of all answers in the folder; None if a price or a usage is unknown."""
        costs = []
        for reply in self._answers.values():
            said = chat.read_chat(reply, self._model.model)
            has_usage = {"prompt_tokens", "completion_tokens"} <= said.usage.keys()
            costs.append(self._prices.cost_usd(said.model, said.usage, TIER) if has_usage else None)
        return None if None in costs else sum(cost for cost in costs if cost is not None)

    @property
    def n_answers(self) -> int:
        """The number of answered requests."""
        return len(self._answers)

    async def complete(self, request: LLMRequest) -> LLMReply:
        """Return the answer. Raises: AnswerPending: there is none yet; BadAnswer: it failed, or is unusable."""
        body = self._body(request)
        key = _key(body)
        about = question_of(request)
        if key in self._answers:
            said = chat.read_chat(self._answers[key], self._model.model)
            return self._model.judged(request, replace(said, service_tier=TIER))
        if self._failures[key] >= _TRIES:
            raise BadAnswer(f"{about}: batches brought no answer: {self._why.get(key, 'no reason given')}.")
        if key not in self._sent:
            self._sent.add(key)
            cost_usd = estimated_cost_usd(request, self._model.model, self._detail, self._prices, TIER)
            self._writer.add(key, body, cost_usd)
        raise AnswerPending(f"{about}: no batch has answered yet.")

    def close(self) -> None:
        """Complete the file of new requests."""
        self._writer.close()

    @property
    def _detail(self) -> str:
        return str(self.identity.get("detail", "low"))

    def _body(self, request: LLMRequest) -> dict[str, Any]:
        # A batch has its own tier, so no other tier is sent.
        return {name: value for name, value in self._model.body(request).items() if name != "service_tier"}

    def _take(self, key: str, outcome: Outcome) -> None:
        """Store the result of a request: an answer, a rejected parameter, or a failure. Ignores expired requests."""
        if outcome.code:
            if outcome.code not in _NO_FAULT:
                self._failures[key] += 1
                self._why[key] = f"{outcome.code}: {outcome.message}"
            return
        url = f"{self._model.endpoint.base_url}/chat/completions"
        reply = WebReply(url, outcome.status, json.dumps(outcome.body).encode())
        try:
            chat.read_chat(reply, self._model.model)
        except BackendUnavailable as problem:
            with warnings.catch_warnings():
                # Every later run reads this line again and would repeat the warning.
                warnings.simplefilter("ignore", BackendWarning)
                is_lesson = self._model.learns(reply)
            # The question without the rejected parameter has another key, so this key is not retried.
            self._failures[key] += 1 if problem.retryable or is_lesson else _TRIES
            self._why[key] = str(problem)
        except Scene2HapError as problem:
            self._failures[key] += _TRIES
            self._why[key] = str(problem)
        else:
            self._answers[key] = reply


def _key(body: dict[str, Any]) -> str:
    """Return a digest of the whole request."""
    return hashlib.sha256(canonical(body).encode()).hexdigest()
