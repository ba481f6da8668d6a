"""docs/bundle-format.md names exactly the fields that are written."""

from __future__ import annotations

import json
import re
from dataclasses import fields
from pathlib import Path

import pytest

from scene2hap import Material, ObjectHaptics, Override
from scene2hap.audio.run_curve import RunCurve
from scene2hap.haptics import SourceState
from scenes import table_with_two_phones

TEXT = (Path(__file__).parents[3] / "docs" / "bundle-format.md").read_text(encoding="utf-8")


def named(part: str) -> set[str]:
    """The fields in the first column of a table."""
    rows = re.findall(r"^\| (`.*?`) \|", part, re.MULTILINE)
    return {field for row in rows for field in re.findall(r"`(\w+)`", row)}


@pytest.mark.parametrize("kind", [ObjectHaptics, Material, SourceState, RunCurve, Override])
def test_tables_have_the_fields_of_their_class(kind: type) -> None:
    part = TEXT.partition(f"<!-- fields: {kind.__name__} -->\n")[2].partition("\n\n")[0]
    assert named(part) == {field.name for field in fields(kind)}


def test_files_have_the_fields_that_are_written(tmp_path: Path) -> None:
    _, bundle = table_with_two_phones()
    folder = bundle.save(tmp_path / "b")

    def section(name: str) -> set[str]:
        return named(TEXT.partition(f"## {name}\n")[2].partition("\n## ")[0].partition("\n### ")[0])

    assert section("bundle.json") == set(json.loads((folder / "bundle.json").read_text(encoding="utf-8")))
    loops = json.loads((folder / "loops.json").read_text(encoding="utf-8"))
    written = {field for states in loops.values() for row in states.values() for field in row}
    assert (
        written
        <= section("loops.json")
        <= written | {"source", "choice", "felt", "fingerprint", "credit", "start_up", "wind_down"}
    )
