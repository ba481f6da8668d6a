"""LocalBackend: answers of a model on one's own machine or network.

Local servers promise structured output and keep the promise by halves: the fields of the answer are therefore in the
prompt as well, what a server rejects is asked for less strictly, and the answer is looked for within what came back.
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any, Literal

from scene2hap import checks
from scene2hap.errors import BadAnswer, ConfigError
from scene2hap.llm import chat
from scene2hap.llm.http_client import Endpoint, HttpReply, Secret
from scene2hap.llm.json_text import first_object
from scene2hap.llm.protocol import LLMReply, LLMRequest
from scene2hap.llm.schema import fields_in_words, strict_schema

if TYPE_CHECKING:
    from scene2hap.llm.http_client import Transport

Rung = Literal["json_schema", "json_object", "prompt"]
LADDER: tuple[Rung, ...] = ("json_schema", "json_object", "prompt")
"""How strictly the form of the answer is asked for, strictest first; the prompt alone at last."""

_FORM_REJECTED = frozenset({400, 422, 501})
_CHARACTERS_PER_TOKEN = 4.0
_TOKENS_PER_IMAGE = 256
"""Both assumed: usual for English, and what Gemma 3 makes of one picture; most models make more."""
_FAR_BELOW = 0.5


class LocalBackend:
    """Answers of a local server.

    model : its name on the server; base_url : with "/v1" for dialect "openai" (vLLM, llama.cpp, LM Studio), without
    for "ollama" (http://127.0.0.1:11434); num_ctx : context in tokens, for Ollama, whose default of 4096 loses
    pictures; max_tokens : of one answer (assumed: answers stay below 600, a model that runs away does not);
    timeout_s : queueing included, since most answer one request at a time; api_key : where the server wants one, never
    taken from the environment; transport : for tests.
    Raises: ConfigError: a setting that cannot work.
    """

    def __init__(
        self,
        model: str,
        *,
        base_url: str,
        dialect: Literal["openai", "ollama"] = "openai",
        num_ctx: int = 16384,
        max_tokens: int = 2048,
        seed: int = 0,
        timeout_s: float = 600.0,
        api_key: str | None = None,
        transport: Transport | None = None,
    ) -> None:
        if dialect not in ("openai", "ollama"):
            raise ConfigError(f"dialect is {dialect!r}; it must be 'openai' or 'ollama'.")
        for name, value in (("num_ctx", num_ctx), ("max_tokens", max_tokens)):
            checks.number(name, value, "tokens", at_least=1, error=ConfigError)
        self.model = model
        self._dialect = dialect
        self._num_ctx = num_ctx
        self._max_tokens = max_tokens
        self._seed = seed
        self._endpoint = Endpoint(base_url, Secret(api_key), timeout_s, transport)
        self._rung = 0
        self._warned = False

    def __repr__(self) -> str:
        return f"LocalBackend({self.model!r}, base_url={self._endpoint.base_url!r}, dialect={self._dialect!r})"

    @property
    def identity(self) -> dict[str, Any]:
        """What decides the answer besides the request; never a key."""
        return {
            "model": self.model,
            "base_url": self._endpoint.base_url,
            "num_ctx": self._num_ctx,
            "max_tokens": self._max_tokens,
            "seed": self._seed,
        }

    @property
    def rung(self) -> Rung:
        """How the form of the answer is asked for: what this server has last accepted."""
        return LADDER[self._rung]

    async def complete(self, request: LLMRequest) -> LLMReply:
        """The model's answer: the JSON object in it, or all that it wrote where there is none.

        Raises: BackendUnavailable: no answer; tells whether trying again can help. BadAnswer: cut short or empty.
        """
        said = await self._ask(request)
        chat.require_whole(said, chat.about(request))
        text = first_object(said.content) or said.content or first_object(said.thoughts)
        if not text:
            raise BadAnswer(
                f"{chat.about(request)}: {said.model} answered without content. Switch off its reasoning.",
                said.thoughts,
            )
        self._look_for_lost_images(request, said)
        return LLMReply(text, said.model, said.finish_reason, said.usage)

    async def _ask(self, request: LLMRequest) -> chat.Said:
        for rung in range(self._rung, len(LADDER)):
            reply = await self._post(request, LADDER[rung])
            if reply.status not in _FORM_REJECTED:
                break
        if reply.ok:
            # Only success teaches: a request that no rung can save (too long a prompt) says nothing about the form.
            self._rung = max(self._rung, rung)
        return self._read(reply)

    async def _post(self, request: LLMRequest, rung: Rung) -> HttpReply:
        text = f"{request.prompt}\n\n{fields_in_words(request.answer_schema)}"
        if self._dialect == "ollama":
            return await self._endpoint.post("api/chat", self._ollama_body(request, text, rung))
        body: dict[str, Any] = {
            "model": self.model,
            "messages": [chat.user_message(request, text)],
            "temperature": request.temperature,
            "seed": self._seed,
            "max_tokens": self._max_tokens,
        }
        if rung == "json_schema":
            body["response_format"] = chat.json_schema_format(request, strict_schema(request.answer_schema))
        elif rung == "json_object":
            body["response_format"] = {"type": "json_object"}
        return await self._endpoint.post("chat/completions", body)

    def _ollama_body(self, request: LLMRequest, text: str, rung: Rung) -> dict[str, Any]:
        """The native form: its /v1 makes a message of each picture, drops the first of them where they do not fit,
        and cannot be told how large the context is."""
        body: dict[str, Any] = {
            "model": self.model,
            "messages": [{"role": "user", "content": text, "images": [chat.as_base64(png) for png in request.images]}],
            "stream": False,
            "think": False,
            "truncate": False,
            "options": {
                "num_ctx": self._num_ctx,
                "num_predict": self._max_tokens,
                "temperature": request.temperature,
                "seed": self._seed,
            },
        }
        if rung == "json_schema":
            body["format"] = strict_schema(request.answer_schema)
        elif rung == "json_object":
            body["format"] = "json"
        return body

    def _read(self, reply: HttpReply) -> chat.Said:
        if self._dialect == "openai":
            return chat.read_chat(reply, self.model)
        body = chat.json_object(reply)
        message = body.get("message")
        if not isinstance(message, dict):
            raise BadAnswer(f"{reply.url} sent no chat message. Check base_url and the dialect.", reply.text)
        renamed = {"prompt_tokens": body.get("prompt_eval_count"), "completion_tokens": body.get("eval_count")}
        return chat.Said(
            content=chat.text_of(message.get("content")),
            model=chat.text_of(body.get("model")) or self.model,
            finish_reason=chat.text_of(body.get("done_reason")) or "stop",
            usage=chat.counts(renamed),
            thoughts=chat.text_of(message.get("thinking")),
        )

    def _look_for_lost_images(self, request: LLMRequest, said: chat.Said) -> None:
        expected = len(request.prompt) / _CHARACTERS_PER_TOKEN + _TOKENS_PER_IMAGE * len(request.images)
        read = said.usage.get("prompt_tokens")
        if self._warned or not request.images or read is None or read >= _FAR_BELOW * expected:
            return
        self._warned = True
        warnings.warn(
            f"{chat.about(request)}: {said.model} read {read} tokens where about {expected:.0f} were sent with "
            f"{len(request.images)} pictures. It may not have seen them: raise the server's context (num_ctx), and "
            "check that the model sees.",
            chat.BackendWarning,
            stacklevel=2,
        )
