"""Files that replace their earlier versions together, and the drafts of programs that died meanwhile."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from scene2hap.common import folder_locks
from scene2hap.common.files import draft_path
from scene2hap.export.draft_set import DraftSet

WRITES = """
import os, sys
from pathlib import Path
from scene2hap.export.draft_set import DraftSet
with DraftSet() as drafts:
    drafts.write(Path(sys.argv[1]) / "a.wav", b"half")
    print("written", flush=True)
    sys.stdin.readline()
    os._exit(9)
"""


FORKS = """
import os, sys
from contextlib import ExitStack
from pathlib import Path
from scene2hap.export.draft_set import DraftSet
from scene2hap.common.folder_locks import lock_folder
folder = Path(sys.argv[1])
reads, writes = os.pipe()
with DraftSet() as drafts:
    drafts.write(folder / "a.wav", b"half")
    if os.fork() == 0:
        os.close(writes)
        os.read(reads, 1)  # until the parent ends
        os._exit(0)
with ExitStack() as held:
    print(lock_folder(folder, held))
"""


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def write_two(folder: Path) -> None:
    with DraftSet() as drafts:
        drafts.write(folder / "b.wav", b"b")
        drafts.write(folder / "b.json", b"b")
        for draft, path in drafts.drafts:
            draft.replace(path)


@pytest.mark.skipif(os.name != "posix", reason="folders cannot be locked")
def test_drafts_of_a_killed_program_are_removed_and_those_of_a_running_one_stay(tmp_path: Path) -> None:
    """In an earlier version an export that was killed left its drafts for ever."""
    arguments = [sys.executable, "-c", WRITES, str(tmp_path)]
    with subprocess.Popen(arguments, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "written\n"
        write_two(tmp_path)
        assert len(names(tmp_path)) == 3
        process.communicate("\n")
    assert len(names(tmp_path)) == 3
    write_two(tmp_path)
    assert names(tmp_path) == ["b.json", "b.wav"]


def test_files_of_others_stay(tmp_path: Path) -> None:
    """Among them the take of a killed program, which is a whole file, and of a set of the same program."""
    mine = [draft_path(tmp_path / "a.wav").name, ".a.draft.wav", "a.draft", f".a.{'x' * 32}.draft.wav"]
    for name in mine:
        (tmp_path / name).write_bytes(b"ten years")
    with DraftSet() as others:
        others.write(tmp_path / "c.wav", b"c")
        write_two(tmp_path)
        assert len(names(tmp_path)) == len(mine) + 3
    assert names(tmp_path) == sorted([*mine, "b.json", "b.wav"])


def test_without_locks_only_old_drafts_are_removed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scene2hap.export.draft_set.lock_folder", lambda *_, **__: None)
    old, new = draft_path(tmp_path / "a.wav", "draft"), draft_path(tmp_path / "a.wav", "draft")
    for draft in (old, new):
        draft.write_bytes(b"half")
    then = old.stat().st_mtime - folder_locks.ABANDONED_S - 60.0
    os.utime(old, (then, then))
    write_two(tmp_path)
    assert names(tmp_path) == sorted([new.name, "b.json", "b.wav"])


@pytest.mark.skipif(os.name != "posix", reason="folders cannot be locked")
def test_a_folder_that_is_replaced_meanwhile_is_locked_as_well(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As a save does with a bundle. In an earlier version the old folder was locked, and others removed the drafts."""
    folder = tmp_path / "bundle"
    folder.mkdir()
    lock, replaced = folder_locks.fcntl.flock, []

    def replace_and_lock(descriptor: int, kind: int) -> None:
        if kind == folder_locks.fcntl.LOCK_SH and not replaced:
            replaced.append(folder.rename(tmp_path / "old"))
            folder.mkdir()
        lock(descriptor, kind)

    monkeypatch.setattr(folder_locks.fcntl, "flock", replace_and_lock)
    with DraftSet() as drafts:
        drafts.write(folder / "a.wav", b"half")
        write_two(folder)
        assert len(names(folder)) == 3
    assert replaced


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
def test_a_child_that_was_forked_meanwhile_does_not_hold_the_lock(tmp_path: Path) -> None:
    """In an earlier version a save of a bundle waited for a worker that was forked during an export into its folder."""
    run = subprocess.run([sys.executable, "-c", FORKS, str(tmp_path)], capture_output=True, text=True, check=True)
    assert run.stdout == "True\n"


def test_a_folder_that_cannot_be_made_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with DraftSet() as drafts, pytest.raises(OSError):
        drafts.write(tmp_path / "file" / "a.wav", b"half")


@pytest.mark.parametrize("name", ["n" * 251 + ".wav", "\u00fc" * 125 + ".json", "n" * 255])
def test_the_longest_names_that_a_file_may_have_are_written(tmp_path: Path, name: str) -> None:
    with DraftSet() as drafts:
        drafts.write(tmp_path / name, b"half")
        assert len(names(tmp_path)) == 1
    assert names(tmp_path) == []


def test_folders_of_a_failed_set_are_removed_unless_another_needs_them(tmp_path: Path) -> None:
    with pytest.raises(RuntimeError), DraftSet() as drafts:
        drafts.write(tmp_path / "out" / "wav" / "a.wav", b"half")
        raise RuntimeError
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "mine").mkdir()
    with DraftSet() as other:
        with DraftSet() as drafts:
            drafts.write(tmp_path / "mine" / "wav" / "a.wav", b"half")
            drafts.write(tmp_path / "shared" / "a.wav", b"half")
            other.write(tmp_path / "shared" / "b.wav", b"half")
        other.write(tmp_path / "shared" / "c.wav", b"half")
        for draft, path in other.drafts:
            draft.rename(path)
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["b.wav", "c.wav", "mine", "shared"]
