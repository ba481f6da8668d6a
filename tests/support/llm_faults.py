"""Faults of an LLM server, as scripted replies by name."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from llm_server import GOOD, KEY, Scripted, refused, said
from scene2hap.llm.protocol import COMPONENTS, Component

WAIT_MS = 60
"""The wait that the scripted rate limit demands."""
DRIP_S = 30.0


@dataclass(frozen=True)
class Fault:
    """A faulty reply for the components that it concerns.

    `ends` is the outcome of a request if the server recovers: "valid", or the name of an error. `calls` is the number
    of calls that this takes. `breaks_for_good` is the outcome if the server never recovers.
    """

    reply: Callable[[Component], Scripted]
    ends: str = "valid"
    calls: int = 2
    breaks_for_good: str = "BackendUnavailable"
    components: tuple[Component, ...] = COMPONENTS
    timeout_s: float = 20.0


def good(component: Component) -> Scripted:
    return said(GOOD[component])


def _retried(*, timeout_s: float = 20.0, **how: Any) -> Fault:
    return Fault(lambda _: Scripted(**how), timeout_s=timeout_s)


def _fatal(reply: Scripted, error: str) -> Fault:
    return Fault(lambda _: reply, error, 1, error)


def _read_through(text: Callable[[str], str]) -> Fault:
    """A reply that the library accepts: the valid answer among other words."""
    return Fault(lambda component: said(text(json.dumps(GOOD[component]))), "valid", 1, "valid")


def _mended(component: Component, **wrong: Any) -> Fault:
    return _repaired(lambda _: said({**GOOD[component], **wrong}), component)


def _repaired(reply: Callable[[Component], Scripted], *components: Component) -> Fault:
    return Fault(reply, breaks_for_good="UnusableAnswer", components=components or COMPONENTS)


def _first_field_is(value: Any) -> Callable[[Component], Scripted]:
    return lambda component: said({**GOOD[component], next(iter(GOOD[component])): value})


def _without_first_field(component: Component) -> Scripted:
    return said(dict(list(GOOD[component].items())[1:]))


def _cut(component: Component) -> Scripted:
    text = json.dumps(GOOD[component])
    return said(text[: len(text) // 2])


def _size_as_list(component: Component) -> Scripted:
    answer = {name: value for name, value in GOOD[component].items() if not name.startswith("estimated_")}
    return said({**answer, "estimated_size_m": [0.7, 0.7, 1.8]})


_BODY = json.dumps(good("scene_analyzer").body).encode()
_LIMITED = {"message": f"Rate limit reached for {KEY}", "type": "requests", "code": "rate_limit_exceeded"}
_QUOTA = {"message": "You exceeded your current quota", "type": "insufficient_quota", "code": "insufficient_quota"}
_HTML = f"<html><body>proxy of {KEY}</body></html>".encode()
_30_WORDS = " ".join(["The old fridge hums and its compressor shakes the floor"] * 3)
_LONG = said('{"scene', "length")
_LOADING = {"message": "Loading model", "type": "unavailable_error", "code": "503"}

FAULTS: Mapping[str, Fault] = {
    "connection reset": _retried(reset=True),
    "connection dropped": _retried(drop=True),
    "slow drip": _retried(body=_BODY, drip_s=DRIP_S, timeout_s=0.4),
    "time-out": _retried(hang=True, timeout_s=0.4),
    "429 with Retry-After": Fault(lambda _: refused(429, _LIMITED, retry_after_ms=str(WAIT_MS))),
    "429 without Retry-After": Fault(lambda _: refused(429, _LIMITED)),
    "429 quota": _fatal(refused(429, _QUOTA, retry_after="1"), "BackendUnavailable"),
    "401 that echoes the key": _fatal(
        refused(
            401,
            {"message": f"Incorrect API key provided: {KEY}", "code": "invalid_api_key"},
            x_request_id=KEY,
            x_echo=f"Bearer {KEY}",
        ),
        "BackendUnavailable",
    ),
    "500": Fault(lambda _: refused(500, {"message": f"internal error for Bearer {KEY}", "type": "server_error"})),
    "503 while loading": Fault(lambda _: refused(503, _LOADING)),
    "HTML under 200": _fatal(Scripted(_HTML), "BackendUnavailable"),
    "HTML under 502": _retried(body=_HTML, status=502),
    "truncated JSON": _retried(body=_BODY[:60]),
    "body cut short": _retried(body=_BODY[:60], headers={"content-length": "5000"}),
    "truncated JSON in the answer": _repaired(_cut),
    "fenced JSON": _read_through(lambda answer: f"Here you are:\n```json\n{answer}\n```\nAnything else?"),
    "thinking first": _read_through(lambda answer: f"<think>Is it {{a}} or {{}}?</think>\n{answer}"),
    "wrong types": _repaired(_first_field_is([1])),
    "missing fields": _repaired(_without_first_field),
    "no JSON object": _repaired(lambda _: said("I would say it is a kitchen.")),
    "refusal": _fatal(said(None, refusal=f"I cannot help {KEY} with that."), "RefusedAnswer"),
    "refusal as plain text": _fatal(said(f"I'm sorry, but I can't help {KEY} with that."), "RefusedAnswer"),
    "length stop": _fatal(_LONG, "UnusableAnswer"),
    "content filter": _fatal(said("", "content_filter"), "RefusedAnswer"),
    "empty content": _fatal(said(""), "UnusableAnswer"),
    "null content": _fatal(said(None), "UnusableAnswer"),
    "size as a list": _repaired(_size_as_list, "object_analyzer"),
    "density with its unit": _mended("material_estimator", density_kg_m3="2700 kg/m^3"),
    "modulus in pascal": _mended("material_estimator", youngs_modulus_gpa=1.1e10),
    "zeros": _mended("material_estimator", **dict.fromkeys(GOOD["material_estimator"], 0.0)),
    "keywords with vibrate": _mended("vibration_describer", keywords="fridge vibrate"),
    "30 words": _mended("vibration_describer", sentence=_30_WORDS),
}


NOT_OF_OLLAMA = frozenset({"429 quota"})
"""Faults that Ollama does not have: it has no quota, and its errors are bare texts without a code."""


def as_ollama(reply: Scripted) -> Scripted:
    """The same reply in the format of Ollama's native chat, if there is one."""
    if reply.claims == "ErrorResponse":
        return replace(reply, body={"error": reply.body["error"]["message"]}, claims="")
    if reply.claims != "CreateChatCompletionResponse":
        return reply
    choice, usage = reply.body["choices"][0], reply.body["usage"]
    body = {
        "model": "qwen2.5vl",
        "message": {"role": "assistant", "content": choice["message"]["content"] or ""},
        "done": True,
        "done_reason": choice["finish_reason"],
        "prompt_eval_count": usage["prompt_tokens"],
        "eval_count": usage["completion_tokens"],
    }
    return replace(reply, body=body, claims="")
