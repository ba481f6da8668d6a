"""Files of corrections that a report page has saved."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from scene2hap import Box, SceneObject, SceneSnapshot, bake, rebake
from scene2hap.cli import main
from scene2hap.errors import BundleError, UnknownObject
from scenes import table_with_two_phones


def saved(path: Path, overrides: Any, **changes: Any) -> Path:
    path.write_text(json.dumps({"format": "scene2hap/overrides", "version": 1, "overrides": overrides, **changes}))
    return path


def test_corrections_have_the_effect_of_overrides(tmp_path: Path) -> None:
    bundle = table_with_two_phones()[1]
    file = saved(tmp_path / "c.json", {"phone": {"gain_db": -6.0, "locked": True}, "table": {"material": "steel"}})
    corrected = bundle.corrected(file)
    assert corrected.gain_db("phone") == -6.0
    assert corrected.overrides["phone"].locked
    assert corrected.objects["table"].material is not None
    assert corrected.objects["table"].material.name == "steel"
    assert not bundle.overrides


def test_an_error_names_the_file_and_the_object(tmp_path: Path) -> None:
    file = saved(tmp_path / "c.json", {"table": {"material": "steel"}, "phone": {"gain_db": 90.0}})
    with pytest.raises(BundleError, match="c.json: 'phone': gain_db is 90 dB"):
        table_with_two_phones()[1].corrected(file)


def test_rebake_and_edit_apply_a_file_of_corrections(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    phone = SceneObject("phone", geometry=Box((0.07, 0.01, 0.15)))
    bundle = bake(SceneSnapshot.build([phone], name="room"))
    file = saved(tmp_path / "c.json", {"phone": {"gain_db": -6.0}})
    assert rebake(bundle, corrections=file).gain_db("phone") == -6.0
    bundle.save(tmp_path / "b.bundle")
    assert main(["edit", str(tmp_path / "b.bundle"), "apply", str(file)]) == 0
    assert json.loads((tmp_path / "b.bundle" / "overrides.json").read_text())["phone"]["gain_db"] == -6.0
    assert main(["edit", str(tmp_path / "b.bundle"), "apply", str(tmp_path / "absent.json")]) == 1
    assert "absent.json cannot be read" in capsys.readouterr().err


def test_a_name_in_a_file_of_corrections_is_applied_and_shown(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cube = SceneObject("Cube.012", geometry=Box((0.6, 0.6, 0.85)))
    bundle = bake(SceneSnapshot.build([cube], name="room"))
    file = saved(tmp_path / "c.json", {"Cube.012": {"name": "washing machine"}})
    assert rebake(bundle, corrections=file).objects["Cube.012"].object_category == "washing machine"
    folder = str(bundle.save(tmp_path / "b.bundle"))
    assert main(["edit", folder, "apply", str(file)]) == 0
    assert "Cube.012, name: - -> washing machine" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("{", "cannot be read"),
        ("[]", "no file of corrections"),
        ('{"format": "scene2hap/scene"}', "no file of corrections"),
        ('{"format": "scene2hap/overrides", "version": 2}', "version 2; this scene2hap reads version 1"),
        ('{"format": "scene2hap/overrides", "version": true, "overrides": {}}', "version True; this scene2hap reads"),
        ('{"format": "scene2hap/overrides", "version": 1}', "overrides must map ids"),
        ('{"format": "scene2hap/overrides", "version": 1, "overrides": {"phone": 3}}', "overrides must map ids"),
        ('{"format": "scene2hap/overrides", "version": 1, "overrides": {"phone": {"gain": 3}}}', "'gain'.*gain_db"),
        (
            '{"format": "scene2hap/overrides", "version": 1, "overrides": {"phone": {"clip": "a.wav"}}}',
            "no field 'clip'",
        ),
        ('{"format": "scene2hap/overrides", "version": 1, "overrides": {"phone": {"gain_db": "x"}}}', "gain_db is 'x'"),
    ],
)
def test_invalid_corrections_file_is_refused(content: str, told: str, tmp_path: Path) -> None:
    (tmp_path / "c.json").write_text(content)
    with pytest.raises(BundleError, match=told):
        table_with_two_phones()[1].corrected(tmp_path / "c.json")


def test_error_names_a_missing_object(tmp_path: Path) -> None:
    with pytest.raises(UnknownObject, match="phon"):
        table_with_two_phones()[1].corrected(saved(tmp_path / "c.json", {"phon": {"gain_db": 1.0}}))
