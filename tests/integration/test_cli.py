"""The command line: demo, bake, render, inspect, and error messages."""

import json
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import soundfile
import trimesh
from PIL import Image

from files_of import files_of
from scene2hap import Box, HapticBundle, Pose, SceneObject, SceneSnapshot, bake
from scene2hap.cli import command_parser, main
from scene2hap.demo import kitchen_path
from scene2hap.render.safety import FADE_OUT_S

SOURCES = {
    "refrigerator",
    "cooker_hood",
    "microwave",
    "washing_machine",
    "electric_toothbrush",
    "smartphone",
    "handheld_fan",
}


@pytest.fixture(scope="module")
def demo(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, object]]:
    """Run the demo once in a separate process and folder. Returns its output folder and its JSON output."""
    folder = tmp_path_factory.mktemp("demo")
    run = subprocess.run(
        [sys.executable, "-m", "scene2hap", "demo", "--json"], cwd=folder, capture_output=True, text=True, check=True
    )
    return folder / "scene2hap-demo", json.loads(run.stdout)


def test_demo_writes_bundle_wav_and_picture(demo: tuple[Path, dict[str, object]]) -> None:
    folder, _ = demo
    samples, rate = soundfile.read(folder / "tour.wav")
    assert samples.shape == (15 * rate + round(FADE_OUT_S * rate), 2)
    assert np.abs(samples).max() <= 1.0
    with Image.open(folder / "tour.png") as picture:
        assert np.asarray(picture).std() > 10
    assert (folder / "bundle" / "bundle.json").is_file()


def test_demo_finds_the_seven_sources_and_no_other(demo: tuple[Path, dict[str, object]]) -> None:
    _, outcome = demo
    assert {key for key, said in outcome["objects"].items() if said["vibrates"]} == SOURCES
    assert outcome["scene_category"] == "kitchen"


def test_demo_tour_lets_hands_feel_its_sources(demo: tuple[Path, dict[str, object]]) -> None:
    _, outcome = demo
    felt: list[dict] = outcome["felt"]
    touched = {row["on"] for row in felt if row["felt_db"].get(row["on"]) == 0.0}
    assert touched == SOURCES
    worktop = [row["felt_db"]["microwave"] for row in felt if row["on"] == "worktop"]
    assert len(worktop) == 4
    assert worktop == sorted(worktop, reverse=True)
    table = [row["felt_db"] for row in felt if row["on"] == "dining_table"]
    assert "smartphone" in table[0]
    assert "smartphone" not in table[1]
    assert "electric_toothbrush" in table[-1]


def test_demo_twice_gives_the_same_bytes(demo: tuple[Path, dict[str, object]], tmp_path: Path) -> None:
    folder, _ = demo
    assert main(["demo", "-o", str(tmp_path / "again"), "--quiet"]) == 0
    assert files_of(tmp_path / "again") == files_of(folder)


@pytest.fixture
def room(tmp_path: Path) -> Path:
    """The file of a scene with two sources and a table."""
    sizes_m = {"microwave": (0.5, 0.3, 0.35), "refrigerator": (0.7, 1.8, 0.7), "dining_table": (1.6, 0.74, 0.9)}
    things = [
        SceneObject(name, name.replace("_", " "), Pose((2.0 * i, size_m[1] / 2, 0.0)), Box(size_m))
        for i, (name, size_m) in enumerate(sizes_m.items())
    ]
    path = tmp_path / "room.json"
    path.write_text(SceneSnapshot.build(things, name="room").to_json(), encoding="utf-8")
    return path


def test_bake_then_render_then_inspect(room: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bundle, wav, touches = tmp_path / "b", tmp_path / "out.wav", tmp_path / "t.csv"
    touches.write_text("time_s,hand,touch\n0.1,right,microwave\n1.0,,\n")
    assert main(["bake", str(room), "-o", str(bundle)]) == 0
    assert "3 objects, 2 sources" in capsys.readouterr().out
    command = ["render", str(bundle), "--touches", str(touches), "-o", str(wav)]
    assert main(command) == 0
    samples, rate = soundfile.read(wav)
    assert len(samples) == rate + round(FADE_OUT_S * rate)
    assert not samples[:, 0].any()
    assert np.abs(samples[rate // 2 :, 1]).max() > 0.05
    assert main([*command, "--propagation", "no_propagation", "--quiet"]) == 0
    assert main(["inspect", str(bundle), "--json"]) == 0
    said = json.loads(capsys.readouterr().out.partition("{")[2].join(["{", ""]))
    assert said["counts"] == {"objects": 3, "sources": 2, "unknown": said["counts"]["unknown"]}
    assert main(["inspect", str(room)]) == 0
    assert "dining_table" in capsys.readouterr().out


def test_your_own_sounds_come_first(room: Path, tmp_path: Path) -> None:
    sounds = tmp_path / "sounds"
    sounds.mkdir()
    t = np.arange(4 * 48000) / 48000
    soundfile.write(sounds / "microwave_humming.wav", 0.3 * np.sin(2 * np.pi * 120 * t), 48000)
    assert main(["bake", str(room), "-o", str(tmp_path / "b"), "--sounds", str(sounds), "-q"]) == 0
    loops = json.loads((tmp_path / "b" / "loops.json").read_text())
    assert loops["microwave"]["on"]["frequency_raw_hz"] == pytest.approx(120, abs=0.05)
    assert loops["microwave"]["on"]["credit"]["author"] == "unknown"
    assert loops["refrigerator"]["on"]["credit"]["author"] == "scene2hap synthesizer"


def test_an_edit_while_a_bake_runs_is_kept(
    room: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A bake with a model takes minutes, and a designer has a second terminal."""
    folder = tmp_path / "b"
    assert main(["bake", str(room), "-o", str(folder), "-q"]) == 0
    calls = json.loads(Path(f"{folder}.account.json").read_text())["calls"]
    baked = []

    def bake_and_be_overtaken(*given: object, **settings: object) -> HapticBundle:
        baked.append(bake(*given, **settings))
        if len(baked) == 1:
            assert main(["edit", str(folder), "gain", "microwave", "-6", "-q"]) == 0
        return baked[-1]

    monkeypatch.setattr("scene2hap.cli.bake.bake", bake_and_be_overtaken)
    assert main(["bake", str(room), "-o", str(folder)]) == 0
    assert "was edited in the meantime; baking again, with the edit" in " ".join(capsys.readouterr().out.split())
    assert HapticBundle.load(folder).gain_db("microwave") == -6.0
    assert len(baked) == 2
    both = json.loads(Path(f"{folder}.account.json").read_text())["calls"]
    assert both == {component: 2 * n for component, n in calls.items()}


def test_a_bake_after_an_interrupted_save_keeps_the_bundle_before(tmp_path: Path) -> None:
    """The save died between two renames, on a system that cannot swap folders: both bundles are beside the target."""
    table = SceneObject("table", geometry=Box((1.6, 0.74, 0.9)))
    path, folder = tmp_path / "room.json", tmp_path / "b"
    path.write_text(SceneSnapshot.build([table]).to_json())
    assert main(["bake", str(path), "-o", str(folder), "-q"]) == 0
    shutil.copytree(folder, tmp_path / ".b.scene2hap-0123abcd-1.old")
    folder.rename(tmp_path / ".b.scene2hap-0123abcd-1.new")
    path.write_text(SceneSnapshot.build([table, SceneObject("chair", geometry=Box((0.4, 0.9, 0.4)))]).to_json())
    assert main(["bake", str(path), "-o", str(folder), "-q"]) == 0
    assert [*HapticBundle.load(f"{folder}.before").objects] == ["table"]


def test_only_a_bake_that_changes_something_keeps_the_bundle_before(tmp_path: Path) -> None:
    table = SceneObject("table", pose=Pose((0.0, 0.37, 0.0)), geometry=Box((1.6, 0.74, 0.9)))
    path, before = tmp_path / "room.json", tmp_path / "b.before"
    for name, is_kept in (("table", False), ("table", False), ("glass table", True)):
        path.write_text(SceneSnapshot.build([replace(table, name=name)]).to_json(), encoding="utf-8")
        assert main(["bake", str(path), "-o", str(tmp_path / "b"), "-q"]) == 0
        assert before.exists() == is_kept


def test_model_and_converter_of_a_bake_may_have_settings(room: Path, tmp_path: Path) -> None:
    """As for `--sink` and `--converter`, an object in JSON has a kind and its settings."""
    made = tmp_path / "made.bundle"
    tactile = '{"kind": "auto", "q": 3.0}'
    assert main(["bake", str(room), "-o", str(made), "--llm", '{"kind": "lexicon"}', "--tactile", tactile]) == 0
    assert json.loads((made / "bundle.json").read_text())["made_with"]["tactile"]["q"] == 3.0


def test_settings_from_a_file(room: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    settings = tmp_path / "s.toml"
    settings.write_text('[bake]\ntactile = {kind = "svf_bandpass", center_hz = 120.0}\n[session]\nbands = "loud"\n')
    assert main(["bake", str(room), "-o", str(tmp_path / "b"), "--settings", str(settings), "-q"]) == 0
    touches = tmp_path / "t.csv"
    touches.write_text("time_s,hand,touch\n0.1,right,microwave\n1.0,,\n")
    command = ["render", str(tmp_path / "b"), "--touches", str(touches), "-o", str(tmp_path / "o.wav")]
    assert main([*command, "--settings", str(settings)]) == 1
    assert "session setting bands" in capsys.readouterr().err
    settings.write_text("[bake]\n")
    assert main([*command, "--settings", str(settings)]) == 1
    assert "there is no table 'session'" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["bake", "nowhere.glb", "-o", "b"], "nowhere.glb"),
        (["inspect", "nowhere.glb"], "nowhere.glb"),
        (["inspect", "."], "has no bundle.json"),
        (["render", ".", "--touches", "t.json", "-o", "o.wav"], "t.json cannot be read as touches"),
        (["bake", str(kitchen_path()), "-o", "b", "--settings", "none.toml"], "none.toml cannot be read"),
        (["bake", str(kitchen_path()), "-o", "b", "--unit-m", "-1"], "unit_m is -1 m"),
        (["bake", str(kitchen_path()), "-o", "b", "--sounds", "none"], "none"),
    ],
)
def test_error_is_one_line_with_the_next_step(
    arguments: list[str],
    sentence: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 1
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.startswith("scene2hap: error: ")
    assert sentence in said.err
    assert said.err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_bake_counts_further_warnings_of_one_kind(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = trimesh.Scene()
    for i in range(12):
        at = trimesh.transformations.translation_matrix((i, 0.45, 0.0))
        model.add_geometry(trimesh.creation.box((0.5, 0.9, 0.5)), node_name=f"wooden chair {i}", transform=at)
    model.export(tmp_path / "chairs.glb")
    # At a hundred metres per unit, every mass is implausible for its size.
    assert main(["bake", str(tmp_path / "chairs.glb"), "--unit-m", "100", "-q", "-o", str(tmp_path / "bundle")]) == 0
    account = json.loads((tmp_path / "bundle.account.json").read_text())
    heavy = [name for name, doubts in account["doubts"].items() if "mass" in str(doubts)]
    lines = [line for line in capsys.readouterr().err.splitlines() if "warning" in line]
    assert len(heavy) > 10
    assert sum("mass: " in line for line in lines) == 5
    assert f"{len(account['doubts']) - 5} more like this" in lines[-1]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((), "required: COMMAND, one of demo, bake, bake-many"),
        (("bak",), "Did you mean 'bake' or 'bake-many'?"),
        (("edit", "some.bundle"), "required: VERB, one of name, gain, intensity, pitch"),
        (("edit", "some.bundle", "gian", "fan", "3"), "Did you mean 'gain'?"),
        (("list", "material"), "Did you mean 'materials'?"),
        (("settings", "sesion"), "Did you mean 'session'?"),
    ],
)
def test_wrong_usage_names_the_words_that_are_meant(
    words: tuple[str, ...], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as caught:
        main(words)
    assert caught.value.code == 2
    assert said in capsys.readouterr().err


def test_wrong_usage_is_status_2(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["bake"])
    assert caught.value.code == 2
    assert "usage: scene2hap bake" in capsys.readouterr().err


def test_inspect_names_likely_mistakes_and_thin_sheets(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    things = [
        SceneObject("floor", pose=Pose((0, 0, 0)), geometry=Box((4, 0.0004, 4))),
        SceneObject("lamp", pose=Pose((0, 2, 0)), geometry=Box((0.3, 0.3, 0.3))),
    ]
    path = tmp_path / "room.json"
    path.write_text(SceneSnapshot.build(things, name="room").to_json(), encoding="utf-8")
    assert main(["inspect", str(path)]) == 0
    out, err = capsys.readouterr()
    assert "'lamp' floats" in err
    assert "0.0004" in out
    assert main(["inspect", str(path), "--json", "-q"]) == 0
    (warning,) = json.loads(capsys.readouterr().out)["warnings"]
    assert "'lamp' floats" in warning


def test_numbers_in_any_spelling_are_no_options(capsys: pytest.CaptureFixture[str]) -> None:
    for number in ("-6", "-.5", "-1e1", "-inf"):
        assert main(["edit", "no.bundle", "gain", "fan", number]) == 1
        assert "there is no folder 'no.bundle'" in capsys.readouterr().err


@pytest.mark.parametrize("level", ["-6dB", "-6.5 db"])
def test_a_level_with_its_unit_is_explained(capsys: pytest.CaptureFixture[str], level: str) -> None:
    with pytest.raises(SystemExit):
        main(["edit", "some.bundle", "gain", "fan", level])
    said = capsys.readouterr().err
    assert f"{level!r} is not a number; write it without its unit, as {level.split('d')[0].strip()}" in said
    assert "read as an option" not in said


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("bake", "room.glb", "--unit-m", "1cm"), "'1cm' is no number; write it as 0.5, without a unit"),
        (("bridge", "--port", "80a"), "'80a' is no whole number; write it as 5, without a unit"),
    ],
)
def test_a_text_for_a_number_is_explained(
    capsys: pytest.CaptureFixture[str], words: tuple[str, ...], says: str
) -> None:
    with pytest.raises(SystemExit):
        main([*words])
    assert capsys.readouterr().err.endswith(f"argument {words[-2]}: {says}\n")


@pytest.mark.parametrize("words", [("inspect", "-x.glb"), ("edit", "some.bundle", "mute", "-fan")])
def test_a_name_like_an_option_is_explained(capsys: pytest.CaptureFixture[str], words: tuple[str, ...]) -> None:
    with pytest.raises(SystemExit):
        main(words)
    assert f"'{words[-1]}' is read as an option; write -- before names" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["bake", "x.glb", "-o", "b.bundle", "--actuater", "lra"], "--actuater lra. Did you mean '--actuator'?"),
        (["edit", "b.bundle", "sound", "fan", "x.wav", "--wach"], "--wach. Did you mean '--watch'?"),
        (["bake", "x.glb", "-o", "b.bundle", "--zzz"], "unrecognized arguments: --zzz\n"),
        (["bakke", "x.glb", "-o", "b.bundle"], "Did you mean 'bake'"),
    ],
)
def test_an_unknown_option_does_not_blame_a_known_one(
    words: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        main(words)
    said = capsys.readouterr().err
    assert told in said
    assert "'-o' is read as an option" not in said


@pytest.mark.parametrize(
    ("words", "which"),
    [
        (("bake", "x.glb", "-o", "b.bundle", "--sounds", ""), "--sounds"),
        (("bake", "x.glb", "-o", "b.bundle", "--assets-root="), "--assets-root"),
        (("inspect", ""), "SCENE|BUNDLE"),
        (("export", "b.bundle", "-o", ""), "-o/--output"),
        (("edit", "b.bundle", "sound", "fan", ""), "FILE"),
    ],
)
def test_an_empty_value_is_an_error(capsys: pytest.CaptureFixture[str], words: tuple[str, ...], which: str) -> None:
    with pytest.raises(SystemExit):
        main(words)
    assert f"argument {which}: its value is empty" in capsys.readouterr().err


def test_an_option_that_is_no_json_is_not_shown(room: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It may hold a key, and the output of a build is kept."""
    key = "sk-test-0123456789abcdefghij"
    assert main(["bake", str(room), "-o", "b", "--llm", f'{{"kind": "openai", "api_key": "{key}"']) == 1
    said = capsys.readouterr().err
    assert "--llm is no JSON (line 1, column" in said
    assert key not in said


def test_values_that_may_be_empty(room: Path, tmp_path: Path) -> None:
    """Without a wish, a script passes an empty prompt; --loop-back alone means any input."""
    assert main(["bake", str(room), "-o", str(tmp_path / "b"), "--prompt", "", "--dry-run", "-q"]) == 0
    arguments = command_parser().parse_args(["doctor", "--sweep", "soundcard", "--loop-back"])
    assert arguments.loop_back == ""


def test_a_dry_run_counts_given_pictures(
    room: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """They need no renderer: an engine has made them."""
    monkeypatch.setattr("scene2hap.cli.bake.capture_images", lambda scene: pytest.fail("pictures are rendered"))
    Image.new("RGB", (64, 64)).save(tmp_path / "above.png")
    row = {"kind": "scene", "view": "above", "file": "above.png"}
    (tmp_path / "pictures.json").write_text(json.dumps([row]))
    words = ["bake", str(room), "--dry-run", "--llm", "openai:gpt-4o", "--pictures-from", str(tmp_path), "--json"]
    assert main(words) == 0
    assert json.loads(capsys.readouterr().out)["images"] == 1


def test_pictures_that_cannot_be_made_are_an_error_before_any_table(
    room: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    taken = tmp_path / "taken"
    taken.write_text("")
    assert main(["inspect", str(room), "--pictures", str(taken)]) == 1
    said = capsys.readouterr()
    assert (said.out, "taken cannot be written" in said.err) == ("", True)
    monkeypatch.setitem(sys.modules, "embreex", None)
    monkeypatch.setitem(sys.modules, "embreex.mesh_construction", None)
    monkeypatch.delitem(sys.modules, "scene2hap.scene.capture.embree", raising=False)
    assert main(["inspect", str(room), "--pictures", str(tmp_path / "p")]) == 1
    said = capsys.readouterr()
    assert (said.out, "pip install 'scene2hap[pictures]'" in said.err) == ("", True)


@pytest.mark.parametrize(
    ("words", "usage"),
    [(("bake", "x.glb", "b.bundle"), "scene2hap bake [-h]"), (("edit", "b", "gain", "fan", "-6", "dB"), "gain [-h]")],
)
def test_a_word_too_many_shows_the_usage_of_its_command(
    capsys: pytest.CaptureFixture[str], words: tuple[str, ...], usage: str
) -> None:
    with pytest.raises(SystemExit):
        main(words)
    said = capsys.readouterr().err
    assert usage in said
    assert said.endswith(f"error: unrecognized arguments: {words[-1]}\n")


def test_an_option_of_commands_before_the_command_is_explained(capsys: pytest.CaptureFixture[str]) -> None:
    for words, is_told in ((["--json", "inspect", "x.glb"], True), (["inspect", "x.glb", "--json", "--bogus"], False)):
        with pytest.raises(SystemExit):
            main(words)
        assert ("Write --json after the command" in capsys.readouterr().err) == is_told
