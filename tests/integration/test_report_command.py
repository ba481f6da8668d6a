"""The commands `scene2hap report` and `scene2hap bake --dry-run`."""

import json
from pathlib import Path

import pytest

from rooms import ROOMS
from scene2hap import HapticBundle, bake
from scene2hap.cli import main
from scene2hap.demo import kitchen_path
from scripted_backend import SCENE, Scripted
from systems import needs_long_names

pytestmark = pytest.mark.usefixtures("short_tones")


@pytest.fixture
def bundle(tmp_path: Path) -> Path:
    return bake(SCENE, {"llm": Scripted()}).override("phone", gain_db=-6.0).save(tmp_path / "b")


def test_report_names_the_origin_of_each_value(bundle: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report", str(bundle)]) == 0
    said = capsys.readouterr().out
    assert "phone ringing (intensity 0.5)" in said
    assert "scripted, prompt" in said
    assert "vibration: v" in said
    assert "-6 dB" in said
    assert said.count("chosen") == 2  # two states, each with its candidates


def test_report_on_named_objects_as_json(bundle: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report", str(bundle), "table", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["objects"]
    assert list(told) == ["table"]
    assert told["table"]["reasons"]["size"] == "s"


def test_report_on_a_missing_object_is_refused(bundle: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report", str(bundle), "chair"]) == 1
    assert "chair" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ("report B --group leaf", "--group: no effect here. Name the scene file by --scene SCENE."),
        ("report B -o PAGE --unit-m 0.01 --up-axis y", "--unit-m, --up-axis: no effect here. Name the scene file by"),
        ("report B --scene room.glb --model modal_plate", "--scene, --model: no effect here. Add -o PAGE.html or"),
        ("report B table -o PAGE", "table: no effect here. A page shows all objects; leave them out."),
        ("report B -o PAGE --port 80", "--port: no effect here. Add --serve."),
        ("inspect B --group leaf", "b' is a bundle. Bake its scene file again with it."),
    ],
)
def test_an_option_without_effect_is_refused(
    bundle: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], options: str, says: str
) -> None:
    page = tmp_path / "page.html"
    places = {"B": str(bundle), "PAGE": str(page)}
    assert main([places.get(one, one) for one in options.split()]) == 1
    assert says in capsys.readouterr().err
    assert not page.exists()


def test_dry_run_sends_no_request_and_writes_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cache = tmp_path / "cache"
    asked = ["bake", str(kitchen_path()), "--dry-run", "--llm", "openai:gpt-4o", "--no-pictures", "--cache", str(cache)]
    assert main(asked) == 0
    said = capsys.readouterr().out
    assert "calls in all" in said
    assert "US dollars (prices of" in said
    assert not any(cache.glob("*"))


def test_dry_run_finds_that_the_output_cannot_be_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    others = tmp_path / "others.bundle"
    others.mkdir()
    (others / "notes.txt").write_text("mine")
    scene = str(kitchen_path())
    for place in (tmp_path / "notes.txt", others):
        assert main(["bake", scene, "--dry-run", "-o", str(place)]) == 1
        told = capsys.readouterr()
        assert f"{place} is not" in told.err
        assert not told.out
    others.rename(tmp_path / "kitchen.bundle")
    assert main(["bake-many", scene, "--dry-run", "-o", str(tmp_path), "--json"]) == 1
    told = capsys.readouterr()
    assert [one["plan"] for one in json.loads(told.out)["scenes"]] == ["fail"]
    assert "kitchen.bundle is not empty and not a bundle" in told.err


def test_cost_of_a_model_without_price_is_unknown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    address = ["--llm", "local:nobody", "--base-url", "http://127.0.0.1:9/v1", "--cache", str(tmp_path)]
    assert main(["bake", str(kitchen_path()), "--dry-run", "--no-pictures", "--json", *address]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["cost_usd"] is None
    assert told["calls"]["scene_analyzer"] == 1


def test_bake_needs_a_folder(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bake", str(kitchen_path())]) == 1
    assert "-o BUNDLE" in capsys.readouterr().err


@needs_long_names
def test_bundle_whose_name_leaves_no_room_for_an_account_is_baked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The longest name that file systems allow has 255 bytes; that of the account is 13 longer than the bundle's."""
    room = tmp_path / "room.json"
    room.write_text(SCENE.to_json())
    target = tmp_path / ("b" * 250)
    assert main(["bake", str(room), "-o", str(target)]) == 0
    output = capsys.readouterr()
    assert "account.json cannot be written" in output.err
    assert "wrote" in output.out
    HapticBundle.load(target)


def test_page_shows_the_account_of_the_bake(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The command `bake` writes its account beside the bundle, where `report` finds it."""
    scene = tmp_path / "room.json"
    scene.write_text(SCENE.to_json())
    folder, page = tmp_path / "room.bundle", tmp_path / "room.json.json"
    assert main(["bake", str(scene), "-o", str(folder), "--json", "-q"]) == 0
    told = json.loads(capsys.readouterr().out)["inference"]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["room.bundle", "room.bundle.account.json", "room.json"]
    assert main(["report", str(folder), "-o", str(page), "-q"]) == 0
    rows = dict(json.loads(page.read_text())["account"]["rows"])
    assert rows["calls"].startswith(f"{sum(told['calls'].values())}: ")
    assert rows["answered from a cache"] == str(told["kept"])


def test_pictures_come_from_the_scene_as_it_was_baked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file in centimetres, without a unit of its own that is right, and grouped otherwise than by default."""
    file, folder = ROOMS["cubes"].in_units(0.01).write(tmp_path), tmp_path / "room.bundle"
    page = tmp_path / "page.json"
    assert main(["bake", str(file), "-o", str(folder), "--unit-m", "0.01", "--group", "leaf", "-q"]) == 0
    capsys.readouterr()
    shown = ["report", str(folder), "-o", str(page), "--scene", str(file)]
    assert main([*shown, "--unit-m", "0.01", "--group", "leaf"]) == 0
    assert capsys.readouterr().err == ""
    assert all(one["pictures"] for one in json.loads(page.read_text())["objects"])
    assert main([*shown, "--unit-m", "0.01", "--group", "0"]) == 0
    said = capsys.readouterr().err
    assert f"of {len(ROOMS['cubes'].things)} objects are not in the scene of the pictures" in said
    assert "--group" in said


def test_dry_run_with_the_lexicon_costs_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bake", str(kitchen_path()), "--dry-run", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["model"] == "lexicon"
    assert told["cost_usd"] == 0.0
