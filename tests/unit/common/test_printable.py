"""Output of untrusted names: control characters and lone surrogates are escaped."""

import json
import subprocess
import sys
from pathlib import Path, PureWindowsPath

import pytest

from scene2hap import load_scene
from scene2hap.cli import main
from scene2hap.common.json_texts import printable_json
from scene2hap.common.printable import aligned, printable, quoted, writable
from scene2hap.errors import SceneError

TITLE = "\x1b]0;owned\x07\x1b[2J"
NASTY = {"escape": TITLE, "C1": "\x9b2J", "newline": "a\nscene2hap: error: b", "bidi": "\u202eabc", "return": "a\rb"}
OBJECT = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def is_quiet(text: str) -> bool:
    return all(letter.isprintable() or letter == "\n" for letter in text)


def test_control_characters_are_escaped() -> None:
    assert printable(f"a{TITLE}b") == r"a\x1b]0;owned\x07\x1b[2Jb"
    assert printable("Küche 台所 🍳") == "Küche 台所 🍳"
    assert printable("a\tb\nc", lines=True) == "a\tb\nc"
    assert printable("\ud800") == r"\ud800"


def test_a_path_is_quoted_as_the_user_wrote_it(tmp_path: Path) -> None:
    assert quoted(PureWindowsPath(r"C:\Users\Ann\kitchen.glb")) == r"'C:\Users\Ann\kitchen.glb'"
    assert quoted("Ann's room.glb") == '"Ann\'s room.glb"'
    assert quoted("a\x1bb") == r"'a\x1bb'"
    with pytest.raises(SceneError) as refused:
        load_scene(tmp_path / r"rooms\kitchen.glb")
    assert r"rooms\kitchen.glb'" in str(refused.value)


def test_escaped_json_keeps_its_meaning() -> None:
    told = {"a\x9b": f"{TITLE}\u202e\ud800ü"}
    text = printable_json(json.dumps(told, ensure_ascii=False, indent=1))
    assert json.loads(text) == told
    assert is_quiet(text)
    assert "ü" in text


def test_lone_surrogates_are_replaced() -> None:
    assert writable("a\udcffb") == "a\ufffdb"
    assert writable("\ud83c\udf73") == "🍳"


@pytest.mark.parametrize("form", NASTY)
@pytest.mark.parametrize("json_", [False, True])
def test_inspect_shows_names_as_data(tmp_path: Path, form: str, json_: bool, capfd: pytest.CaptureFixture[str]) -> None:
    node = {"name": NASTY[form], "mesh": 0}
    gltf = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"type": "VEC3", "componentType": 5126, "count": 3, "bufferView": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"uri": NASTY[form]}],
        "nodes": [node],
    }
    path = tmp_path / "a.gltf"
    path.write_text(json.dumps(gltf))
    assert main(["inspect", str(path), *(["--json"] if json_ else [])]) == 0
    shown = capfd.readouterr()
    assert is_quiet(shown.out)
    assert is_quiet(shown.err)
    node["mesh"] = 7
    path.write_text(json.dumps(gltf))
    assert main(["inspect", str(path)]) == 1
    shown = capfd.readouterr()
    assert is_quiet(shown.err)
    assert shown.err.count("\n") == 1


def test_arguments_are_shown_as_data(capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["inspect", "a.glb", "--no-such", TITLE])
    assert is_quiet(capfd.readouterr().err)


def test_name_with_a_lone_surrogate_is_read(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text(OBJECT)
    text = load_scene(tmp_path / "a.obj").to_json().replace('"name": "a"', '"name": "\\ud800"')
    (tmp_path / "a.json").write_text(text)
    assert load_scene(tmp_path / "a.json").objects[0].name == "\ufffd"


@pytest.mark.skipif(sys.platform == "win32", reason="file names are Unicode there")
def test_file_name_that_is_not_utf_8_is_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "a\udcff\x1b.obj"
    try:
        path.write_text(OBJECT)
    except OSError:
        pytest.skip("this file system takes UTF-8 alone")
    scene = load_scene(path)
    scene.name.encode("utf-8")
    done = subprocess.run([sys.executable, "-m", "scene2hap", "inspect", path], capture_output=True)
    assert done.returncode == 0, done.stderr
    assert is_quiet(done.stdout.decode("utf-8"))
    assert main(["inspect", str(path), "--json"]) == 0
    said = capsys.readouterr().out
    assert is_quiet(said)
    said.encode("utf-8")


def test_columns_align_in_any_writing() -> None:
    """A Chinese character is two columns wide, an accent of its own none; names in them shifted the rest of a row."""
    rows = [("冷蔵庫 fridge", "x"), ("Ku\u0308hlschrank", "x"), ("fan", "x")]
    heading, wide, accents, plain = aligned(("sound", "s"), rows)
    assert wide == "冷蔵庫 fridge  x"
    assert accents == "Ku\u0308hlschrank    x"
    assert plain == "fan            x"
    assert heading == "sound          s"
