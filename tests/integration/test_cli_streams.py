"""The command line with closed, full or unread output streams, with small encodings, and with hostile names."""

import io
import json
import os
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest

from scene2hap import load_scene
from scene2hap.cli import console, main
from scene2hap.scene import json as scene_json
from scenes import box, scene

posix = pytest.mark.skipif(os.name != "posix", reason="shells and /dev/full")
ESCAPES = "\x1b]0;changed\x07\x1b[2J\x9b2J\u202egnp"


@pytest.fixture(scope="module")
def room(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A scene of a hundred objects, some with control characters or characters missing in most encodings."""
    folder = tmp_path_factory.mktemp("scene")
    names = ["冷蔵庫", f"box{ESCAPES}", "[red]table[/red]", "line\nbreak", *(f"box {i}" for i in range(100))]
    snapshot = scene(*(box(name, (0.3,) * 3, (i, 0, 0)) for i, name in enumerate(names)))
    (folder / "room.json").write_text(scene_json.dump(snapshot), encoding="utf-8")
    assert len(load_scene(folder / "room.json").objects) == len(names)
    return folder / "room.json"


def run(command: str, *arguments: object) -> subprocess.CompletedProcess[str]:
    """Run a shell command in which `$run` stands for scene2hap with `arguments`."""
    words = " ".join(f"'{word}'" for word in ("-m", "scene2hap", *arguments))
    return subprocess.run(
        ["bash", "-c", "set -o pipefail; " + command.replace("$run", f"'{sys.executable}' {words}")],
        env={**os.environ, "PYTHONUNBUFFERED": ""},
        capture_output=True,
        encoding="utf-8",
        errors="surrogateescape",
        timeout=120,
        check=False,
    )


@posix
@pytest.mark.parametrize("options", [(), ("--json",)], ids=["tables", "json"])
def test_closed_pipe_is_no_error(room: Path, options: tuple[str, ...]) -> None:
    outcome = run("$run | head -c 1", "inspect", room, *options)
    assert (outcome.returncode, outcome.stderr) == (0, "")


@posix
@pytest.mark.parametrize("arguments", [("inspect", "ROOM"), ("inspect", "ROOM", "--json"), ("--help",), ("--version",)])
def test_full_disk_gives_a_one_line_error(room: Path, arguments: tuple[str, ...]) -> None:
    outcome = run("$run > /dev/full", *(str(room) if word == "ROOM" else word for word in arguments))
    assert outcome.returncode == 1
    assert "standard output cannot be written: No space left on device" in outcome.stderr
    assert outcome.stderr.count("\n") == 1


@posix
@pytest.mark.parametrize(
    ("closed", "arguments"),
    [
        (">&-", ("inspect", "ROOM")),  # which writes nothing to the other stream
        ("2> /dev/full", ("inspect", "nowhere.glb")),
        ("<&- >&- 2>&-", ("inspect", "ROOM")),
        ("<&- >&- 2>&-", ("inspect", "nowhere.glb")),
        *((closed, ("bad",)) for closed in (">&-", "2> /dev/full", "<&- >&- 2>&-")),
    ],
)
def test_commands_work_with_closed_streams(room: Path, closed: str, arguments: tuple[str, ...]) -> None:
    outcome = run(f"$run {closed}", *(str(room) if word == "ROOM" else word for word in arguments))
    assert outcome.returncode == {"nowhere.glb": 1, "bad": 2}.get(arguments[-1], 0)
    assert "Traceback" not in outcome.stderr
    assert "Exception ignored" not in outcome.stderr


@posix
def test_wrong_usage_exits_with_2_when_stderr_is_unwritable() -> None:
    """The patch makes argparse behave as in Python 3.11.2 of Debian 12."""
    program = (
        "import argparse, sys\n"
        "def write(self, message, file=None): (file or sys.stderr).write(message)\n"
        "argparse.ArgumentParser._print_message = write\n"
        "from scene2hap.cli import main\n"
        "sys.exit(main())"
    )
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    with open("/dev/full", "w") as full:
        assert subprocess.run([sys.executable, "-c", program, "bad"], stderr=full, env=environment).returncode == 2


@posix
def test_command_completes_without_a_reader(room: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with suppress(OSError), open("/dev/full", "w") as full:  # closing it writes the rest
        monkeypatch.setattr(sys, "stdout", full)
        assert main(["bake", str(room), "-o", str(tmp_path / "bundle")]) == 1
    assert (tmp_path / "bundle" / "bundle.json").is_file()


@pytest.mark.parametrize("encoding", ["cp1252", "utf-8"])
def test_any_encoding_can_show_any_name(room: Path, encoding: str, monkeypatch: pytest.MonkeyPatch) -> None:
    shown = []
    for options in ([], ["--json"]):
        written = io.BytesIO()
        monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(written, encoding))
        assert main(["inspect", str(room), *options]) == 0
        sys.stdout.flush()
        shown.append(written.getvalue().decode(encoding))
    tables, document = shown
    assert "冷蔵庫" in json.dumps(json.loads(document), ensure_ascii=False)
    assert ("冷蔵庫" in tables) or (r"\u51b7\u8535\u5eab" in tables)


def test_names_with_control_characters_are_escaped(room: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for arguments in (["inspect", str(room)], ["inspect", str(room), "--json"], ["inspect", f"{ESCAPES}.glb"]):
        main(arguments)
        shown = capsys.readouterr()
        assert not {"\x1b", "\x07", "\x9b", "\u202e"} & set(shown.out + shown.err)
        assert "x1b" in shown.out + shown.err or "u001b" in shown.out
    main(["inspect", str(room)])
    shown = capsys.readouterr()
    assert "[red]table[/red]" in shown.out
    assert r"line\nbreak" in shown.out


def test_an_error_stays_one_line_of_bounded_length(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["inspect", "a\n" * 100_000 + ".glb"]) == 1
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert len(told) < 5000


@posix
def test_file_name_that_is_not_utf_8_is_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["inspect", os.fsdecode(os.fsencode(tmp_path) + b"/\xff\xfe.glb")]) == 1
    told = capsys.readouterr().err
    assert told.startswith("scene2hap: error:")
    assert told.count("\n") == 1


def test_invalid_bake_is_refused_before_it_begins(
    room: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "thesis").mkdir()
    (tmp_path / "thesis" / "bundle.json").write_text('{"name": "a JavaScript bundle"}')

    def never(*_: object, **__: object) -> None:
        raise AssertionError("baked for nothing")

    monkeypatch.setattr("scene2hap.cli.bake.bake", never)
    assert main(["bake", str(room), "-o", str(tmp_path / "thesis")]) == 1
    assert "is not a bundle" in capsys.readouterr().err


@pytest.mark.parametrize("group", ["²", "9" * 5000, "-1", "1e3"])
def test_invalid_grouping_is_refused(room: Path, group: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["inspect", str(room), f"--group={group}"]) in (0, 1)
    assert "Traceback" not in capsys.readouterr().err


def test_a_quiet_console_lays_out_no_table(monkeypatch: pytest.MonkeyPatch) -> None:
    """The layout of thousands of rows would take seconds, for no output."""
    monkeypatch.setattr(console, "Table", None)
    console.Console(quiet=True).table("objects", ("id",), [("a",)])
    with pytest.raises(TypeError):
        console.Console(quiet=False).table("objects", ("id",), [("a",)])
