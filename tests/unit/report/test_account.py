"""The account of a bake in a report: calls, cost, and skipped objects."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from files_of import files_of
from scene2hap import HapticBundle, bake
from scene2hap.bundle.account import account_path, read_account, write_account
from scene2hap.errors import BundleError, ConfigError
from scene2hap.llm.chain.report import InferenceReport
from scene2hap.report import report_document
from scripted_backend import SCENE, Scripted

pytestmark = pytest.mark.usefixtures("short_tones")

ACCOUNT = {
    "calls": {"scene_analyzer": 1, "object_analyzer": 3},
    "kept": 2,
    "skipped": {"copies": 5, "silent": 2, "unreached_material": 0},
    "tokens": {"gpt-4o": {"prompt_tokens": 12_345, "cached_tokens": 4_000, "completion_tokens": 678}},
    "errors": {"<b>cup</b>": "timed out"},
    "flags": {},
    "doubts": {"table": ["too thick", "too long"]},
    "cost_usd": 0.0321,
}


@pytest.fixture(scope="module")
def bundle() -> HapticBundle:
    return bake(SCENE, {"llm": Scripted()})


def told(bundle: HapticBundle, account: object) -> tuple[dict[str, list[str]], list[list[str]]]:
    found = report_document(bundle, most_points=50, account=account)["account"]
    rows: dict[str, list[str]] = {}
    for label, text in found["rows"]:
        rows.setdefault(label, []).append(text)
    return rows, found["problems"]


def test_account_lists_calls_tokens_cost_and_skips(bundle: HapticBundle) -> None:
    rows, problems = told(bundle, ACCOUNT)
    assert rows == {
        "calls": ["4: 1 scene analyzer, 3 object analyzer"],
        "answered from a cache": ["2"],
        "skipped": ["5: copies of another object", "2: silent objects, whose vibration needs no words"],
        "tokens of gpt-4o": ["12,345 read, 4,000 of them at the price of cached input; 678 written"],
        "cost": ["0.032 US dollars"],
    }
    assert problems == [["<b>cup</b>", "timed out"], ["table", "too thick; too long"]]
    assert told(bundle, {**ACCOUNT, "cost_usd": None})[0]["cost"] == ["unknown"]


def test_inference_report_becomes_an_account(bundle: HapticBundle) -> None:
    accounts: list[InferenceReport] = []
    bake(SCENE, {"llm": Scripted()}, on_report=accounts.append)
    rows, _ = told(bundle, accounts[0].as_json())
    assert rows["calls"][0].startswith(f"{sum(accounts[0].calls.values())}: ")
    assert rows["tokens"] == ["none were reported"]
    assert report_document(bundle, most_points=50)["account"] is None


@pytest.mark.parametrize(
    "wrong", [{}, {**ACCOUNT, "kept": "many"}, {**ACCOUNT, "tokens": [1]}, {**ACCOUNT, "calls": 3}]
)
def test_invalid_account_is_refused(wrong: dict[str, object], bundle: HapticBundle) -> None:
    with pytest.raises(ConfigError, match="account of the bake has another shape"):
        report_document(bundle, most_points=50, account=wrong)


def test_account_file_is_written_beside_the_bundle(bundle: HapticBundle, tmp_path: Path) -> None:
    folder = bundle.save(tmp_path / "room.bundle")
    before = files_of(folder)
    assert read_account(folder) is None
    path = write_account(folder, ACCOUNT)
    assert path == account_path(f"{folder}/") == tmp_path / "room.bundle.account.json"
    assert files_of(folder) == before
    found = report_document(folder, most_points=50)["account"]["rows"]
    assert found[0][0] == "baked"
    assert ["answered from a cache", "2"] in found


@pytest.mark.parametrize(
    "content", ["", "[]", "{", json.dumps({**ACCOUNT, "format": "other", "version": 1}), "[" * 9999]
)
def test_damaged_account_file_is_reported(content: str, bundle: HapticBundle, tmp_path: Path) -> None:
    folder = bundle.save(tmp_path / "room.bundle")
    account_path(folder).write_text(content)
    with pytest.raises(BundleError, match=r"room\.bundle\.account\.json .*Remove it"):
        report_document(folder, most_points=50)


def test_skipped_calls_state_a_reason() -> None:
    def failing(request: object, answer: dict[str, object]) -> dict[str, object]:
        return {"nothing": 1} if answer["object_category"] == "cup" else answer

    plain = bake(SCENE, {"llm": Scripted(object_analyzer=failing)}, on_report=lambda report: None)
    assert plain.objects["cup"].provenance["object_category"].startswith("error")
    rows = report_document(plain.override("phone", muted=True, locked=True), most_points=50)["left_out"]
    reasons = {row["why"].partition(":")[0]: row["objects"] for row in rows}
    assert reasons == {
        "not answered": ["cup"],
        "material unknown": ["cup"],
        "muted until a game unmutes it": ["phone"],
        "locked": ["phone"],
        "out of reach": ["table", "phone", "cup"],  # since the source is muted
        "silent": ["table"],
    }
    reached = {
        row["why"].partition(":")[0]: row["objects"] for row in report_document(plain, most_points=50)["left_out"]
    }
    assert reached["out of reach"] == ["cup"]
