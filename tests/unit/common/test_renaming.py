"""Renames that Windows rejects as long as a program has a file open. Elsewhere its errors are simulated."""

import errno
import os
import sys
from pathlib import Path

import pytest

from scene2hap.common import files
from scene2hap.errors import unwritable


def rejection(winerror: int) -> PermissionError:
    """Return an error as Python raises it on Windows: errno is EACCES, for an open and for a protected file alike."""
    problem = PermissionError(13, "The process cannot access the file because it is being used by another process")
    problem.winerror = winerror
    return problem


@pytest.mark.parametrize("winerror", [5, 32])
def test_a_rename_is_repeated_until_a_scanner_has_closed_the_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, winerror: int
) -> None:
    (tmp_path / "draft").write_text("new")
    (tmp_path / "file").write_text("old")
    pauses: list[float] = []
    monkeypatch.setattr(files.time, "sleep", pauses.append)
    replace = os.replace

    def while_scanned(source: Path, target: Path) -> None:
        if len(pauses) < 3:
            raise rejection(winerror)
        replace(source, target)

    monkeypatch.setattr(os, "replace", while_scanned)
    files.replace(tmp_path / "draft", tmp_path / "file")
    assert (tmp_path / "file").read_text() == "new"
    assert len(pauses) == 3


def test_a_file_that_stays_open_is_an_error_in_the_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pauses: list[float] = []
    monkeypatch.setattr(files.time, "sleep", pauses.append)

    def open_for_ever(source: Path, target: Path) -> None:
        raise rejection(32)

    monkeypatch.setattr(Path, "rename", open_for_ever)
    with pytest.raises(PermissionError):
        files.rename(tmp_path / "a", tmp_path / "b")
    assert 0.5 < sum(pauses) < 2.0


@pytest.mark.parametrize("problem", [FileNotFoundError(2, "No such file"), PermissionError(13, "Permission denied")])
def test_other_errors_are_raised_at_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, problem: OSError) -> None:
    tries: list[Path] = []

    def fail(source: Path, target: Path) -> None:
        tries.append(source)
        raise problem

    monkeypatch.setattr(Path, "rename", fail)
    with pytest.raises(type(problem)):
        files.rename(tmp_path / "a", tmp_path / "b")
    assert len(tries) == 1


def test_a_write_protected_target_is_an_error_at_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Windows rejects it with the number that it has for open files too, and no pause would help."""
    (tmp_path / "draft").write_text("new")
    (tmp_path / "file").write_text("old")
    (tmp_path / "file").chmod(0o444)
    tries: list[Path] = []

    def reject(source: Path, target: Path) -> None:
        tries.append(source)
        raise rejection(5)

    monkeypatch.setattr(os, "replace", reject)
    with pytest.raises(PermissionError):
        files.replace(tmp_path / "draft", tmp_path / "file")
    (tmp_path / "file").chmod(0o644)
    assert len(tries) == 1


@pytest.mark.skipif(sys.platform != "win32", reason="only Windows rejects renames of open files")
def test_windows_rejects_the_replacement_of_an_open_file(tmp_path: Path) -> None:
    (tmp_path / "draft").write_text("new")
    (tmp_path / "file").write_text("old")
    with (tmp_path / "file").open(), pytest.raises(PermissionError) as caught:
        files.replace(tmp_path / "draft", tmp_path / "file")
    assert "open" in unwritable("file", caught.value)
    files.replace(tmp_path / "draft", tmp_path / "file")
    assert (tmp_path / "file").read_text() == "new"


@pytest.mark.parametrize(("n_characters", "step"), [(259, "Choose a folder"), (260, "A path in it has 260 characters")])
def test_a_path_that_is_too_long_for_windows_is_called_so(
    monkeypatch: pytest.MonkeyPatch, n_characters: int, step: str
) -> None:
    """Windows says that there is no such file."""
    monkeypatch.setattr(sys, "platform", "win32")
    path = os.path.abspath(os.sep).ljust(n_characters, "x")
    cause = FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), path)
    assert f"No such file or directory. {step}" in unwritable("room.bundle", cause)


@pytest.mark.parametrize(
    ("winerror", "step"),
    [
        (5, "Close the program that has it or a file in it open, or remove its write protection."),
        (32, "Close the program that has it open."),
        (33, "Close the program that has it open."),
        (123, 'Use no < > : " | ? * in a name, and no name of a device, as con, aux or nul.'),
        (267, 'Use no < > : " | ? * in a name, and no name of a device, as con, aux or nul.'),
        (206, "Give a shorter path."),
        (3, "Choose a folder that exists and is yours."),
    ],
)
def test_the_message_says_what_to_do_on_windows(winerror: int, step: str) -> None:
    assert unwritable("room", rejection(winerror)).endswith(f"by another process. {step}")
