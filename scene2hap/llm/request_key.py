"""Keys of requests: digests of the parts that affect the answer, and of no others."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from typing import Any

from scene2hap.errors import BackendError
from scene2hap.llm.protocol import LLMRequest


def request_key(request: LLMRequest) -> str:
    """Return the digest of all parts of a request that affect its answer: "v1:" and a SHA-256.

    Subject and prompt version are left out. The same question about another object has the same answer, and so has a
    new prompt version with the same words.
    Raises: BackendError: a fact has no JSON (an infinity, an object of Python).
    """
    content = {
        "component": request.component,
        "prompt": request.prompt,
        "facts": request.facts,
        "answer_schema": request.answer_schema,
        "temperature": request.temperature,
        "images": [{"sha256": hashlib.sha256(png).hexdigest(), "type": "image/png"} for png in request.images],
    }
    return f"v1:{hashlib.sha256(canonical(content).encode()).hexdigest()}"


def canonical(value: Any) -> str:
    """Return the canonical JSON of a value: sorted keys, no spaces, whole floats as integers (1.0 becomes 1)."""
    try:
        text = json.dumps(plain(value), sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
        text.encode()
    except (TypeError, ValueError) as cause:
        raise BackendError(
            f"no JSON for this request: {cause}. Use texts, finite numbers, lists and objects."
        ) from cause
    return text


def plain(value: Any) -> Any:
    """Return a JSON value in which equal numbers have equal text."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float) and value.is_integer():
        return int(value)
    return value


def part_names(request: LLMRequest) -> dict[str, str]:
    """Return a digest of each long part of a request. The error for a missing answer names the part that changed."""
    parts = {
        "prompt": request.prompt,
        "answer_schema": request.answer_schema,
        "temperature": request.temperature,
        "images": [hashlib.sha256(png).hexdigest() for png in request.images],
    }
    return {name: hashlib.sha256(canonical(part).encode()).hexdigest()[:16] for name, part in parts.items()}
