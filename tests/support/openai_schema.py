"""Check requests and scripted answers against OpenAI's published schema of a chat completion."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

import jsonschema
from referencing import Registry
from referencing.jsonschema import DRAFT202012

from llm_server import Scripted, Server, serving
from others import SHARED, needed

SCHEMA = SHARED / "formats" / "openai" / "chat_completions.schema.json"


@cache
def _spec() -> dict[str, Any]:
    found: dict[str, Any] = json.loads(needed(SCHEMA).read_text(encoding="utf-8"))
    return found


@cache
def _validator(name: str) -> jsonschema.Draft202012Validator:
    registry = Registry().with_resource("urn:openai", DRAFT202012.create_resource(_spec()))
    return jsonschema.Draft202012Validator({"$ref": f"urn:openai#/components/schemas/{name}"}, registry=registry)


def assert_openai_takes(body: dict[str, Any]) -> None:
    """Check a request body against the schema, and that it has no unknown keys, which OpenAI rejects."""
    _validator("CreateChatCompletionRequest").validate(body)
    assert set(body) <= _known_keys({"$ref": "#/components/schemas/CreateChatCompletionRequest"})


def assert_openai_says(reply: Scripted) -> None:
    if reply.claims:
        _validator(reply.claims).validate(reply.body)


@contextmanager
def openai_serving(*script: Scripted, **how: Any) -> Iterator[Server]:
    """Run `serving`, then check each request, and each answer that names the schema it claims to follow."""
    with serving(*script, **how) as server:
        yield server
    if SCHEMA.exists():
        for body in server.bodies:
            assert_openai_takes(body)
        for reply in server.answered:
            assert_openai_says(reply)


def _known_keys(node: dict[str, Any]) -> set[str]:
    if "$ref" in node:
        return _known_keys(_spec()["components"]["schemas"][node["$ref"].rsplit("/", 1)[1]])
    return set(node.get("properties", {})).union(*(_known_keys(part) for part in node.get("allOf", ())))
