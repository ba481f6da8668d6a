"""Answer schemas in the two forms that models take: OpenAI's strict subset of JSON schema, and words in a prompt."""

from __future__ import annotations

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
_TYPES = {
    "string": "text",
    "number": "number",
    "integer": "whole number",
    "boolean": "true or false",
    "null": "null",
    "object": "object",
}


def strict_schema(schema: Schema) -> dict[str, Any]:
    """The schema as OpenAI's strict mode wants it; the same for the same input.

    Objects are closed and all their properties required; titles, defaults and lengths go. Bounds are said in the
    description as well, since what a decoder does not enforce the model can still read.
    Raises: ConfigError: the root is not an object, or a keyword has no strict form.
    Source: OpenAI, Structured outputs, "Supported schemas".
    """
    if schema.get("type") != "object":
        raise ConfigError(f"the root of an answer schema is {schema.get('type')!r}; strict output needs an object.")
    return _strict(schema)


def fields_in_words(schema: Schema) -> str:
    """The fields of an answer as a list for a prompt, for servers that never show the schema to the model."""
    lines = _field_lines(schema, schema.get("$defs", {}), "")
    return "\n".join(["Answer with one JSON object and nothing else. It has exactly these fields:", *lines])


def _strict(node: Schema) -> dict[str, Any]:
    unfit = [word for word in _FORBIDDEN if word in node]
    if unfit:
        raise ConfigError(f"an answer schema uses {', '.join(unfit)}; strict output has no such keyword.")
    strict = {key: _strict_part(key, value) for key, value in node.items() if key not in _DROPPED}
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
