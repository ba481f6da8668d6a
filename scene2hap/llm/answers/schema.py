"""Answer schemas in three forms: OpenAI's strict subset of JSON schema, the same without references for local servers,
and words in a prompt."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

from scene2hap.errors import ConfigError

Schema = Mapping[str, Any]

_DROPPED = ("title", "default", "examples", "minLength", "maxLength", "uniqueItems", "oneOf")
_FORBIDDEN = ("allOf", "not", "if", "then", "else", "dependentRequired", "dependentSchemas", "patternProperties")
_BOUNDS = {
    "minimum": "at least {}",
    "exclusiveMinimum": "above {}",
    "maximum": "at most {}",
    "exclusiveMaximum": "below {}",
    "minLength": "length at least {}",
    "maxLength": "length at most {}",
    "minItems": "at least {} items",
    "maxItems": "at most {} items",
}
_LOOKAROUND = re.compile(r"\(\?<?[=!]")
_MOST_PROPERTIES = 5000
_MOST_LEVELS = 10
_MOST_CHOICES = 1000
_MOST_CHARACTERS = 120_000
"""Most characters of all names, choices and constants. Source: OpenAI, Structured outputs, "Limitations"."""

_TYPES = {
    "string": "text",
    "number": "number",
    "integer": "whole number",
    "boolean": "true or false",
    "null": "null",
    "object": "object",
}


def strict_schema(schema: Schema) -> dict[str, Any]:
    """Return the schema for OpenAI's strict mode; equal input gives equal schemas.

    Objects are closed and all their properties required. Titles, defaults, lengths and patterns with look-around are
    removed. Descriptions repeat the bounds, so that the model reads bounds that a decoder does not enforce.
    Raises: ConfigError: the root is not an object, a keyword has no strict form, or the schema is too large.
    Source: OpenAI, Structured outputs, "Supported schemas".
    """
    if schema.get("type") != "object":
        raise ConfigError(f"the root of an answer schema is {schema.get('type')!r}; strict output needs an object.")
    strict = _strict(schema)
    _require_small(strict)
    return strict


def local_schema(schema: Schema) -> dict[str, Any]:
    """Return the strict schema without references, and without patterns that are not anchored on both sides.

    The grammars of llama.cpp handle nested references wrongly and reject unanchored patterns.
    Raises: ConfigError: as `strict_schema`, or the schema refers to itself.
    """
    strict = strict_schema(schema)
    definitions = strict.pop("$defs", {})
    written: dict[str, Any] = _written_out(strict, definitions, _MOST_LEVELS)
    return written


def fields_in_words(schema: Schema) -> str:
    """List the fields of an answer for a prompt, for servers that never show the schema to the model."""
    lines = _field_lines(schema, schema.get("$defs", {}), "")
    return "\n".join(["Answer with one JSON object and nothing else. It has exactly these fields:", *lines])


def _strict(node: Schema) -> dict[str, Any]:
    unfit = [word for word in _FORBIDDEN if word in node]
    if unfit:
        raise ConfigError(f"an answer schema uses {', '.join(unfit)}; strict output has no such keyword.")
    strict = {key: _strict_part(key, value) for key, value in node.items() if key not in _DROPPED}
    if _LOOKAROUND.search(str(node.get("pattern", ""))):
        del strict["pattern"]
    alternatives = [*node.get("anyOf", ()), *node.get("oneOf", ())]
    if alternatives:
        strict["anyOf"] = [_strict(alternative) for alternative in alternatives]
    if "properties" in node:
        strict["required"] = list(node["properties"])
    if node.get("type") == "object":
        strict["additionalProperties"] = False
    described = ". ".join(part for part in (str(node.get("description", "")).rstrip("."), _bounds(node)) if part)
    if described:
        strict["description"] = f"{described}."
    if "$ref" in strict and len(strict) > 1:
        strict = {"anyOf": [{"$ref": strict.pop("$ref")}], **strict}
    return strict


def _strict_part(key: str, value: Any) -> Any:
    if key in ("properties", "$defs"):
        return {name: _strict(part) for name, part in value.items()}
    return _strict(value) if key == "items" else value


def _require_small(strict: Schema) -> None:
    objects = [node for node in _nodes(strict) if "properties" in node]
    names = [name for node in objects for name in node["properties"]]
    choices = [choice for node in _nodes(strict) for choice in node.get("enum", ())]
    characters = sum(map(len, names)) + sum(len(json.dumps(choice)) for choice in choices)
    for what, size, most in (
        ("properties", len(names), _MOST_PROPERTIES),
        ("choices", len(choices), _MOST_CHOICES),
        ("characters in names and choices", characters, _MOST_CHARACTERS),
        ("levels", _levels(strict), _MOST_LEVELS),
    ):
        if size > most:
            raise ConfigError(f"an answer schema has {size} {what}; strict output allows {most}.")


def _nodes(node: Schema) -> Iterator[Schema]:
    yield node
    for inner in _inner(node):
        yield from _nodes(inner)


def _inner(node: Schema) -> list[Schema]:
    named = [part for key in ("properties", "$defs") for part in node.get(key, {}).values()]
    return [*named, *node.get("anyOf", ()), *([node["items"]] if "items" in node else ())]


def _levels(node: Schema) -> int:
    own = 1 if node.get("type") in ("object", "array") else 0
    return own + max((_levels(inner) for inner in _inner(node)), default=0)


def _written_out(node: Any, definitions: Schema, levels_left: int) -> Any:
    if isinstance(node, list):
        return [_written_out(item, definitions, levels_left) for item in node]
    if not isinstance(node, dict):
        return node
    if set(node) == {"$ref"}:
        if levels_left == 0:
            raise ConfigError(f"an answer schema refers to itself ({node['$ref']}); local servers need it written out.")
        return _written_out(_resolved(node, definitions), definitions, levels_left - 1)
    return {
        key: _written_out(value, definitions, levels_left)
        for key, value in node.items()
        if key != "pattern" or not isinstance(value, str) or (value.startswith("^") and value.endswith("$"))
    }


def _bounds(node: Schema) -> str:
    words = ", ".join(wording.format(f"{node[bound]:g}") for bound, wording in _BOUNDS.items() if bound in node)
    return words[:1].upper() + words[1:]


def _field_lines(node: Schema, definitions: Schema, indent: str) -> Iterator[str]:
    for name, field in node.get("properties", {}).items():
        bounds = _bounds(field).lower()
        words = _type_words(field, definitions)
        yield f"{indent}- {name}: {words}{f' ({bounds})' if bounds else ''}"
        inner = _resolved(field.get("items", field), definitions)
        yield from _field_lines(inner, definitions, f"{indent}  ")


def _type_words(field: Schema, definitions: Schema) -> str:
    field = _resolved(field, definitions)
    if "anyOf" in field:
        return " or ".join(_type_words(part, definitions) for part in field["anyOf"])
    if "enum" in field:
        return "one of " + ", ".join(map(repr, field["enum"]))
    if field.get("type") == "array":
        return f"list of {_type_words(field.get('items', {}), definitions)}s"
    return _TYPES.get(str(field.get("type")), "any value")


def _resolved(node: Schema, definitions: Schema) -> Schema:
    found: Schema = definitions.get(str(node.get("$ref", "")).removeprefix("#/$defs/"), node)
    return found
