"""Finding JSON within other text of a model's answer."""

import json
from typing import Any

import pytest
from hypothesis import given, settings, strategies as st

from scene2hap.llm.answers.json_text import answer_object, fields_of, first_object

_JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=8,
)
_PROSE = st.text(alphabet="abc \n.,:}[]'`", max_size=30)


@settings(max_examples=80)
@given(
    st.dictionaries(st.text(), _JSON, min_size=1, max_size=4),
    st.dictionaries(st.sampled_from("ab"), st.text(alphabet='{}"\\', max_size=4), max_size=2),
    _PROSE,
    _PROSE,
    st.booleans(),
)
def test_first_object_finds_json_in_any_surrounding_text(
    answer: dict[str, Any], draft: dict[str, Any], before: str, after: str, fenced: bool
) -> None:
    text = json.dumps(answer, indent=1)
    shown = f"```json\n{text}\n```" if fenced else text
    assert first_object(f"<think>{json.dumps(draft)}</think>{before}{shown}{after}{{}}") == text


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ('{"a": "}"}', '{"a": "}"}'),
        (' {"a": "x <think> y </think>"}\n', '{"a": "x <think> y </think>"}'),
        ('{"a": 1} and {"b": 2}', '{"a": 1}'),
        ('a set {1, 2} and {x}: {"a": "\\"}"} {', '{"a": "\\"}"}'),
        ('{"draft",} then {"a": 1}', '{"a": 1}'),
        ('{"a": 1,}', '{"a": 1,}'),
        ('<think>{"a": 1}', '{"a": 1}'),
        ('<THINK>{"a": 1}</THINK>{"a": 2}', '{"a": 2}'),
        ('a draft {"a": 1}</think> and {"a": 2}', '{"a": 2}'),
        ('{"a": 1}<think>no</think> but {"a": 2}</think>{"a": 3}', '{"a": 3}'),
        ("{}", "{}"),
        ('{"a": {"b": 1}', None),
        ('[1, "{"]', None),
        ("no braces", None),
        ("", None),
    ],
)
def test_first_object_handles_nested_and_broken_json(text: str, found: str | None) -> None:
    assert first_object(text) == found


def test_first_object_handles_endless_nesting_fast() -> None:
    assert first_object('{"a":' * 50_000) is None
    assert first_object("{" * 200_000) is None
    assert first_object('{"a":' * 50_000 + "1" + "}" * 50_000) is not None


@pytest.mark.parametrize(
    "wrapped", ['{"answer": %s}', '{"object_analyzer":%s }', 'Sure:\n```json\n{"a {": %s}\n```', '[{"result": %s}]']
)
def test_object_in_a_wrapper_is_found_as_written(wrapped: str) -> None:
    inner = '{"name": "a } b", "size": {"x": 1.50}}'
    assert answer_object(wrapped % inner) == inner


@pytest.mark.parametrize("text", ['{"answer": "no"}', '{"a": {"b": 1}, "c": 2}', '{"a": [{}]}', "{}"])
def test_object_with_other_contents_is_not_unwrapped(text: str) -> None:
    assert answer_object(text) == text


@pytest.mark.parametrize("n_digits", [20, 400, 5000])
def test_whole_numbers_of_any_length_are_read_as_floats(n_digits: int) -> None:
    digits = "1" + "0" * (n_digits - 1)
    found = fields_of(f'{{"mass_kg": {digits}}}')
    assert found == {"mass_kg": float(digits)}
    assert isinstance(found["mass_kg"], float)
