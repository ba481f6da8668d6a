"""Text messages: valid ones are accepted, and others get an error reply."""

import json
from dataclasses import fields
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from scene2hap.bridge.messages import MODELS, parse_request, read_document, request_id
from scene2hap.bridge.schema import Source, schema
from scene2hap.errors import BridgeError
from scene2hap.session.mix.sources import SourceInfo

DOCS = Path(__file__).parents[3] / "docs"
PAGE = (DOCS / "bridge-protocol.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "no JSON object"),
        ("[]", "no JSON object"),
        ('{"type": "hello"', "no JSON object"),
        ('{"type": "leave", "type": "stats"}', "the key 'type' is given twice in one object; remove one"),
        ('{"type": "play", "scene": {"name": "a", "name": "b"}}', "the key 'name' is given twice"),
        ("[" * 200_000, "nested too deeply"),
        ('{"type": "hello", "client": "\\ud800"}', "half of a surrogate pair"),
        ("{}", "the type of the message is None"),
        ('{"type": 3}', "the type of the message is 3"),
        ('{"type": "plai"}', "Did you mean 'play'"),
        ('{"type": "leave", "now": true}', "leave has no field 'now'"),
        ('{"type": "set_source", "surce": "a"}', "source"),
        ('{"type": "set_source", "source": "a", "gain_db": "loud"}', "gain_db of set_source"),
        ('{"type": "set_user", "gain_db": NaN}', "gain_db of set_user"),
        ('{"type": "play", "hands": []}', "hands of play"),
        ('{"type": "play", "keep_s": 1e9}', "keep_s of play"),
        ('{"type": "resume", "session": "a", "key": "short"}', "key of resume"),
        ('{"type": "leave", "id": -1}', "id of leave"),
    ],
)
def test_error_reply_describes_the_wrong_field(text: str, says: str) -> None:
    with pytest.raises(BridgeError, match=says):
        parse_request(read_document(text))


def test_a_request_keeps_its_id() -> None:
    assert request_id({"id": 7}) == 7
    assert parse_request({"type": "leave", "id": 7}).id == 7


@pytest.mark.parametrize("given", [7, 7.0, 1e3, 0, None])
def test_every_id_that_is_accepted_is_answered(given: object) -> None:
    """A client would wait for ever otherwise. JSON of some languages has no integers: GDScript and Lua write 7.0."""
    document = {"type": "leave", "id": given}
    assert request_id(document) == parse_request(document).id


@pytest.mark.parametrize("given", ["x", "7", True, 1.5, [], {}])
def test_an_id_that_is_no_integer_is_refused(given: object) -> None:
    assert request_id({"id": given}) is None
    with pytest.raises(BridgeError, match="id of leave: it must be a whole number, got"):
        parse_request({"type": "leave", "id": given})


def test_every_request_is_documented_on_the_page() -> None:
    table = PAGE.split("## Requests")[1].split("## ")[0]
    for kind, model in MODELS.items():
        assert f"`{kind}`" in table, f"docs/bridge-protocol.md lacks {kind}"
        row = next(line for line in table.splitlines() if line.startswith("|") and f"`{kind}`" in line.split("|")[1])
        for field in set(model.model_fields) - {"type", "id"}:
            assert f"`{field}`" in row, f"the row of {kind} lacks {field}"


def test_the_schema_of_a_source_has_every_field_that_is_sent() -> None:
    assert {*Source.model_fields} == {field.name for field in fields(SourceInfo)} - {"is_running", "progress"}


def test_the_published_schema_is_up_to_date_and_sound() -> None:
    published = json.loads((DOCS / "bridge.schema.json").read_text(encoding="utf-8"))
    assert published == schema(), "run: python -m scene2hap.bridge.schema > docs/bridge.schema.json"
    Draft202012Validator.check_schema(published)
    checked = Draft202012Validator(published)
    checked.validate({"type": "hello", "version": 1, "client": "x"})
    assert not checked.is_valid({"type": "hello", "version": 1})
    assert not checked.is_valid({"type": "no such"})


def test_the_page_s_example_fits_the_schema() -> None:
    example = json.loads(PAGE.split("```json\n")[1].split("```")[0])
    Draft202012Validator(schema()).validate(example)
