"""The temporary folder of a server: deleted with it, or by a later one if it was killed."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from scene2hap.bridge.temporary_folder import TemporaryFolder
from systems import needs_links

# Makes a folder and dies without cleaning up, as a process that is killed.
KILLED = """
import os
from scene2hap.bridge.temporary_folder import TemporaryFolder
folder = TemporaryFolder()
print(folder.path, flush=True)
os._exit(1)
"""


@pytest.fixture(autouse=True)
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setenv("TEMP", str(tmp_path))
    return tmp_path


def left_behind(*, age_s: float = 3600.0) -> Path:
    """The folder of a killed process, with a file in it."""
    answer = subprocess.run([sys.executable, "-c", KILLED], stdout=subprocess.PIPE, text=True)
    folder = Path(answer.stdout.strip())
    (folder / "scene-1.json").write_text("{}")
    _age(folder, age_s)
    return folder


def _age(folder: Path, age_s: float) -> None:
    (lock,) = (path for path in folder.iterdir() if path.suffix != ".json")
    os.utime(lock, (lock.stat().st_mtime - age_s,) * 2)


def test_the_folder_of_a_killed_server_goes_with_the_next_server() -> None:
    gone = left_behind()
    assert gone.is_dir()
    TemporaryFolder().delete()
    assert not gone.exists()


def test_the_folder_of_a_running_server_stays() -> None:
    running = TemporaryFolder()
    _age(running.path, 3600.0)
    subprocess.run([sys.executable, "-c", KILLED], stdout=subprocess.PIPE, check=False)
    assert running.path.is_dir()
    running.delete()
    assert not running.path.exists()


def test_a_new_folder_stays_since_its_server_may_not_hold_it_yet() -> None:
    new = left_behind(age_s=0.0)
    TemporaryFolder().delete()
    assert new.is_dir()


@needs_links
def test_other_folders_and_links_stay(temporary: Path) -> None:
    gone, elsewhere, other = left_behind(), temporary / "documents", temporary / "scene2hap-bridge-notes"
    gone.rename(elsewhere)
    (temporary / "scene2hap-bridge-link").symlink_to(elsewhere)
    other.mkdir()
    TemporaryFolder().delete()
    assert (elsewhere / "scene-1.json").is_file()
    assert other.is_dir()
