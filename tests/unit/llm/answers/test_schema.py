"""Answer schemas: conversion to OpenAI's strict subset, to local servers' subsets, and to words."""

import json
from collections.abc import Iterator
from typing import Any

import jsonschema
import pytest

from llm_server import GOOD
from scene2hap.errors import ConfigError
from scene2hap.llm.answers.schema import fields_in_words, local_schema, strict_schema
from scene2hap.llm.validation import ANSWERS

SCHEMAS = {component: shape.model_json_schema() for component, shape in ANSWERS.items()}


def nodes(schema: Any) -> Iterator[dict[str, Any]]:
    """Yield every schema within a schema, itself first; values of properties are schemas, their names are not."""
    yield schema
    for key in ("properties", "$defs"):
        for inner in schema.get(key, {}).values():
            yield from nodes(inner)
    for inner in [*schema.get("anyOf", []), *([schema["items"]] if "items" in schema else [])]:
        yield from nodes(inner)


@pytest.mark.parametrize("component", SCHEMAS)
def test_strict_schemas_use_only_the_allowed_subset(component: str) -> None:
    for node in nodes(strict_schema(SCHEMAS[component])):
        assert not {"title", "default", "minLength", "maxLength", "allOf", "oneOf"} & set(node)
        assert "$ref" not in node or len(node) == 1
        if node.get("type") == "object":
            assert node["additionalProperties"] is False
            assert node["required"] == list(node["properties"])


@pytest.mark.parametrize("component", GOOD)
def test_strict_schemas_accept_only_valid_answers(component: str) -> None:
    strict = strict_schema(SCHEMAS[component])
    validator = jsonschema.Draft202012Validator(strict)
    assert validator.is_valid(GOOD[component])
    assert not validator.is_valid({**GOOD[component], "more": 1})
    assert not validator.is_valid(dict(list(GOOD[component].items())[1:]))


def test_bounds_are_kept_and_stated_in_the_description() -> None:
    density = strict_schema(SCHEMAS["material_estimator"])["properties"]["density_kg_m3"]
    assert density == {
        "type": "number",
        "minimum": 1.0,
        "maximum": 25000.0,
        "description": "At least 1, at most 25000.",
    }


def test_description_text_precedes_the_bounds() -> None:
    schema = {"type": "object", "properties": {"a": {"type": "string", "description": "A word.", "maxLength": 5}}}
    assert strict_schema(schema)["properties"]["a"]["description"] == "A word. Length at most 5."


def test_a_property_may_be_named_like_a_keyword() -> None:
    schema = {"type": "object", "properties": {"title": {"type": "string", "title": "Title", "default": ""}}}
    assert strict_schema(schema) == {
        "type": "object",
        "properties": {"title": {"type": "string"}},
        "required": ["title"],
        "additionalProperties": False,
    }


def test_references_have_no_siblings_and_alternatives_use_any_of() -> None:
    schema = {
        "type": "object",
        "properties": {"a": {"$ref": "#/$defs/A", "description": "one"}, "b": {"oneOf": [{"type": "null"}]}},
        "$defs": {"A": {"type": "integer", "title": "A"}},
    }
    strict = strict_schema(schema)
    assert strict["properties"]["a"] == {"anyOf": [{"$ref": "#/$defs/A"}], "description": "one."}
    assert strict["properties"]["b"] == {"anyOf": [{"type": "null"}]}
    assert strict["$defs"] == {"A": {"type": "integer"}}


def test_conversion_is_repeatable_and_leaves_the_original_unchanged() -> None:
    schema = SCHEMAS["object_analyzer"]
    before = json.dumps(schema)
    assert json.dumps(strict_schema(schema)) == json.dumps(strict_schema(json.loads(before)))
    assert json.dumps(schema) == before


@pytest.mark.parametrize("schema", [{}, {"type": "array"}, {"anyOf": [{"type": "object"}]}])
def test_root_must_be_an_object(schema: dict[str, Any]) -> None:
    with pytest.raises(ConfigError, match="needs an object"):
        strict_schema(schema)


def test_error_names_keywords_without_a_strict_form() -> None:
    with pytest.raises(ConfigError, match="uses allOf, not"):
        strict_schema({"type": "object", "properties": {"a": {"allOf": [], "not": {}}}})


def test_schema_fields_are_described_in_words() -> None:
    words = fields_in_words(SCHEMAS["object_analyzer"]).splitlines()
    assert words[0] == "Answer with one JSON object and nothing else. It has exactly these fields:"
    assert "- object_category: text (length at least 1, length at most 60)" in words
    assert "- vibrates: true or false" in words
    at = words.index("- states: list of objects")
    assert words[at + 1 : at + 4] == [
        "  - name: text (length at least 1, length at most 40)",
        "  - intensity: number (at least 0, at most 1)",
        "  - needs_contact: text or null",
    ]
    named = {line.strip("- ").split(":")[0] for line in words[1:]}
    assert named >= set(SCHEMAS["object_analyzer"]["properties"])


@pytest.mark.parametrize("pattern", ["(?=a)b", "a(?!b)", "(?<=a)b", "(?<!a)b"])
def test_patterns_with_lookaround_are_removed(pattern: str) -> None:
    schema = {"type": "object", "properties": {"a": {"type": "string", "pattern": pattern}}}
    assert "pattern" not in strict_schema(schema)["properties"]["a"]
    plain = {"type": "object", "properties": {"a": {"type": "string", "pattern": "(?:a|b)+"}}}
    assert strict_schema(plain)["properties"]["a"]["pattern"] == "(?:a|b)+"


def nested(levels: int) -> dict[str, Any]:
    inner = {"type": "object", "properties": {"a": {"type": "string"}}}
    return inner if levels == 1 else {"type": "object", "properties": {"a": nested(levels - 1)}}


def wide(properties: int, length: int = 1) -> dict[str, Any]:
    return {"type": "object", "properties": {f"{i:0{length}d}": {"type": "string"} for i in range(properties)}}


def choosing(choices: int) -> dict[str, Any]:
    return {"type": "object", "properties": {"a": {"enum": list(range(choices))}}}


@pytest.mark.parametrize(
    ("fits", "breaks", "named"),
    [
        (nested(10), nested(11), "11 levels"),
        (wide(5000), wide(5001), "5001 properties"),
        (choosing(1000), choosing(1001), "1001 choices"),
        (wide(1200, 100), wide(1201, 100), "120100 characters"),
    ],
    ids=["levels", "properties", "choices", "characters"],
)
def test_schemas_stay_within_the_limits_of_strict_output(
    fits: dict[str, Any], breaks: dict[str, Any], named: str
) -> None:
    strict_schema(fits)
    with pytest.raises(ConfigError, match=f"an answer schema has {named}.*; strict output allows"):
        strict_schema(breaks)


@pytest.mark.parametrize("component", GOOD)
def test_schemas_for_local_servers_are_equivalent_without_references(component: str) -> None:
    local = local_schema(SCHEMAS[component])
    assert "$ref" not in json.dumps(local)
    assert "$defs" not in local
    validator = jsonschema.Draft202012Validator(local)
    assert validator.is_valid(GOOD[component])
    assert not validator.is_valid({**GOOD[component], "more": 1})


@pytest.mark.parametrize(("pattern", "stays"), [("^a+$", True), ("a+", False), ("^a+", False)])
def test_patterns_for_llama_cpp_are_anchored(pattern: str, stays: bool) -> None:
    schema = {"type": "object", "properties": {"a": {"type": "string", "pattern": pattern}}}
    assert ("pattern" in local_schema(schema)["properties"]["a"]) is stays


def test_property_named_pattern_is_kept() -> None:
    schema = {"type": "object", "properties": {"pattern": {"type": "string"}}}
    assert list(local_schema(schema)["properties"]) == ["pattern"]


def test_recursive_schema_cannot_be_expanded() -> None:
    tree = {"type": "object", "properties": {"child": {"$ref": "#/$defs/Tree"}}}
    with pytest.raises(ConfigError, match="refers to itself"):
        local_schema({**tree, "$defs": {"Tree": tree}})
