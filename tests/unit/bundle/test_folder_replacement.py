"""Folders that a bundle may replace, files that stay in them, and leftovers of earlier saves."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from files_of import files_of
from scene2hap import HapticBundle
from scene2hap.bundle import folder_replacement
from scene2hap.bundle.checking import BundleWarning
from scene2hap.bundle.folder_replacement import require_replaceable, save_stamp
from scene2hap.bundle.folder_swap import exchange
from scene2hap.bundle.overrides_file import read_overrides
from scene2hap.bundle.writing import write_bundle
from scene2hap.errors import BundleChanged, BundleError, BundleIncomplete, BundleVersionError
from scenes import table_with_two_phones
from systems import needs_links, needs_long_names, needs_modes


def a_bundle() -> HapticBundle:
    return table_with_two_phones()[1]


@pytest.fixture(params=["exchange", "renames"])
def both_ways(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Run a test with the system's exchange of folders, and with renames instead."""
    if request.param == "renames":
        monkeypatch.setattr(folder_replacement, "exchange", lambda one, other: False)


# --- folders that may be replaced -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "manifest",
    [
        "{}",
        '{"name": "my JavaScript"}',
        "[]",
        "",
        "no JSON",
        '{"format": "scene2hap/scene", "version": 1}',
        '{"format": "scene2hap/bundle"}',
        '{"format": "scene2hap/bundle", "version": true}',
        '{"format": "scene2hap/bundle", "version": "1"}',
        '{"format": "scene2hap/bundle", "version": 0}',
        '{"format": "scene2hap/bundle", "version": 1, "files": "thesis.txt"}',
        '{"format": "scene2hap/bundle", "version": 2}',
        '{"format": "scene2hap/bundle", "version": 1e400}',
    ],
)
def test_folder_with_a_foreign_bundle_json_is_not_replaced(tmp_path: Path, manifest: str) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "bundle.json").write_text(manifest)
    (tmp_path / "mine" / "thesis.txt").write_text("ten years")
    before = files_of(tmp_path)
    with pytest.raises(BundleError, match="mine"):
        a_bundle().save(tmp_path / "mine")
    assert files_of(tmp_path) == before


def test_a_newer_bundle_is_neither_replaced_nor_half_read(tmp_path: Path) -> None:
    folder = a_bundle().override("phone", gain_db=3.0).save(tmp_path / "room")
    manifest = json.loads((folder / "bundle.json").read_text())
    (folder / "bundle.json").write_text(json.dumps({**manifest, "version": 2}))
    before = files_of(tmp_path)
    for attempt in (lambda: a_bundle().save(folder), lambda: HapticBundle.load(folder), lambda: read_overrides(folder)):
        with pytest.raises(BundleVersionError, match="bundle version 2"):
            attempt()
    assert files_of(tmp_path) == before


def test_overrides_of_a_foreign_folder_are_not_read(tmp_path: Path) -> None:
    (tmp_path / "overrides.json").write_text('{"margin": "10px"}')
    assert read_overrides(tmp_path) == {}


def test_files_with_names_outside_the_format_are_not_deleted(tmp_path: Path) -> None:
    folder = a_bundle().save(tmp_path / "room")
    (folder / "sounds" / "thesis.txt").write_text("ten years")
    (tmp_path / "outside.ply").write_text("not yours")
    manifest = json.loads((folder / "bundle.json").read_text())
    manifest["files"] += ["sounds/thesis.txt", "meshes/../../outside.ply", "../outside.ply", "/etc/passwd"]
    (folder / "bundle.json").write_text(json.dumps(manifest))
    a_bundle().save(folder)
    assert (folder / "sounds" / "thesis.txt").read_text() == "ten years"
    assert (tmp_path / "outside.ply").read_text() == "not yours"


def test_saving_to_the_working_directory_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = a_bundle().save(tmp_path / "room")
    (tmp_path / "empty").mkdir()
    for here in (folder, folder / "sounds", tmp_path / "empty"):
        monkeypatch.chdir(here)
        before = sorted(tmp_path.rglob("*"))
        with pytest.raises(BundleError, match=r"Change to another one, and save to .*(room|empty)"):
            a_bundle().save("." if here.name != "sounds" else "..")
        assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.usefixtures("both_ways")
def test_an_empty_folder_is_replaced(tmp_path: Path) -> None:
    (tmp_path / "room").mkdir()
    a_bundle().save(tmp_path / "room")
    assert HapticBundle.load(tmp_path / "room").gain_db("phone") == 0.0
    assert [path.name for path in tmp_path.iterdir()] == ["room"]


@pytest.mark.parametrize("name", ["", "a\0b", "x" * 300, "file/below"])
def test_invalid_folder_name_is_refused(tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("")
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(BundleError):
        a_bundle().save(name)
    assert sorted(tmp_path.rglob("*")) == before


def test_a_drive_that_does_not_exist_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """On Windows, a drive may be unplugged, and then not even the root of a path exists."""
    monkeypatch.setattr(os.path, "exists", lambda path: False)
    with pytest.raises(BundleError, match="there is no drive or share"):
        require_replaceable(tmp_path / "room")


@needs_long_names
def test_long_folder_name_is_accepted(tmp_path: Path) -> None:
    for _ in range(2):
        a_bundle().save(tmp_path / ("x" * 250))
    assert len(list(tmp_path.iterdir())) == 1


# --- files that stay --------------------------------------------------------------------------------------------------


@pytest.mark.usefixtures("both_ways")
@needs_long_names
def test_too_long_name_is_refused_before_a_bake(tmp_path: Path) -> None:
    with pytest.raises(BundleError, match=r"cannot be written: .* Give a shorter name\."):
        require_replaceable(tmp_path / ("b" * 256))


def test_foreign_files_are_kept_by_every_save(tmp_path: Path) -> None:
    folder = a_bundle().save(tmp_path / "room")
    theirs = {
        "README.md": b"read me",
        "sounds/takes/one.wav": b"RIFF",
        "meshes/chair.blend": b"BLENDER",
        ".hidden": b"",
    }
    for name, said in theirs.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(said)
    (folder / "empty").mkdir()
    inode = (folder / "README.md").stat().st_ino
    for _ in range(3):
        a_bundle().override("phone", gain_db=1.0).save(folder)
        assert {name: (folder / name).read_bytes() for name in theirs} == theirs
    assert (folder / "empty").is_dir()
    assert (folder / "README.md").stat().st_ino == inode
    assert [path.name for path in tmp_path.iterdir()] == ["room"]
    assert HapticBundle.load(folder).gain_db("phone") == 1.0


@needs_links
@needs_modes
def test_links_and_modes_of_foreign_files_are_kept(tmp_path: Path) -> None:
    folder = a_bundle().save(tmp_path / "room")
    (folder / "README.md").write_bytes(b"read me")
    (folder / "README.md").chmod(0o600)
    (folder / "link").symlink_to("README.md")
    for _ in range(3):
        a_bundle().override("phone", gain_db=1.0).save(folder)
    assert os.readlink(folder / "link") == "README.md"
    assert (folder / "README.md").stat().st_mode & 0o777 == 0o600


@pytest.mark.usefixtures("both_ways")
def test_files_are_copied_where_hard_links_are_unsupported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise OSError(1, "Operation not permitted")

    monkeypatch.setattr(os, "link", refuse)
    folder = a_bundle().save(tmp_path / "room")
    (folder / "thesis.txt").write_text("ten years")
    a_bundle().save(folder)
    assert (folder / "thesis.txt").read_text() == "ten years"
    assert [path.name for path in tmp_path.iterdir()] == ["room"]


def test_foreign_file_with_a_bundle_file_name_is_renamed(tmp_path: Path) -> None:
    bundle = a_bundle()
    folder = bundle.save(tmp_path / "room")
    manifest = json.loads((folder / "bundle.json").read_text())
    manifest["files"].remove("credits.txt")
    (folder / "bundle.json").write_text(json.dumps(manifest))
    (folder / "credits.txt").write_text("for my supervisor")
    for _ in range(2):
        bundle.save(folder)
    assert (folder / "credits-kept.txt").read_text() == "for my supervisor"
    assert "Sounds in this bundle" in (folder / "credits.txt").read_text()


@pytest.mark.usefixtures("both_ways")
def test_file_saved_by_an_editor_during_a_save_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Editors write a new file and rename it, so that the name then belongs to another file than the linked one."""
    folder = a_bundle().save(tmp_path / "room")
    (folder / "thesis.txt").write_text("ten years")
    carry_over = folder_replacement.carry_over

    def and_then_edit(old: Path, new: Path) -> None:
        carry_over(old, new)
        (tmp_path / "beside").write_text("eleven years")
        (tmp_path / "beside").replace(folder / "thesis.txt")
        (folder / "new.txt").write_text("a chapter")

    monkeypatch.setattr(folder_replacement, "carry_over", and_then_edit)
    a_bundle().save(folder)
    assert (folder / "new.txt").read_text() == "a chapter"
    assert {(folder / name).read_text() for name in ("thesis.txt", "thesis-kept.txt")} == {"ten years", "eleven years"}


@needs_links
def test_a_link_to_a_folder_stays_a_link(tmp_path: Path) -> None:
    a_bundle().save(tmp_path / "elsewhere" / "room")
    (tmp_path / "link").symlink_to(tmp_path / "elsewhere" / "room")
    a_bundle().override("phone", gain_db=2.0).save(tmp_path / "link")
    assert (tmp_path / "link").is_symlink()
    assert HapticBundle.load(tmp_path / "elsewhere" / "room").gain_db("phone") == 2.0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["elsewhere", "link"]


@needs_modes
def test_the_folder_s_mode_stays(tmp_path: Path) -> None:
    folder = a_bundle().save(tmp_path / "room")
    folder.chmod(0o750)
    a_bundle().save(folder)
    assert folder.stat().st_mode & 0o777 == 0o750


@needs_modes
def test_a_write_protected_folder_is_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, both_ways: None) -> None:
    """Root may write anywhere, so the mode is read where the old folder is removed."""
    folder, modes = a_bundle().save(tmp_path / "room"), []
    folder.chmod(0o500)
    discard = folder_replacement.discard

    def discard_and_tell(old: Path, new: Path) -> None:
        modes.append(old.stat().st_mode & 0o700)
        discard(old, new)

    monkeypatch.setattr(folder_replacement, "discard", discard_and_tell)
    a_bundle().save(folder)
    assert modes == [0o700]
    assert folder.stat().st_mode & 0o777 == 0o500
    assert [path.name for path in tmp_path.iterdir()] == ["room"]


@pytest.mark.skipif(os.name != "posix", reason="only POSIX writes folders to the disk")
def test_the_new_name_is_on_the_disk_when_a_save_returns(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    fsync, written = os.fsync, []

    def fsync_and_tell(descriptor: int) -> None:
        fsync(descriptor)
        if os.path.samestat(os.fstat(descriptor), tmp_path.stat()):
            written.append(sorted(path.name for path in tmp_path.iterdir()))

    monkeypatch.setattr(os, "fsync", fsync_and_tell)
    a_bundle().save(tmp_path / "room")
    assert written[-1:] == [["room"]]


# --- leftovers of earlier saves ---------------------------------------------------------------------------------------

DIES = """
import os, sys
from scene2hap.bundle import folder_replacement, writing
from scenes import table_with_two_phones
if sys.argv[2] == "between":
    folder_replacement.exchange = lambda one, other: False
    rename, count = folder_replacement.Path.rename, [0]
    def dying(self, target):
        if self.suffix == ".new":
            os._exit(9)
        return rename(self, target)
    folder_replacement.Path.rename = dying
else:
    def hanging(bundle, draft):
        (draft / "half").write_text("written")
        print("writing", flush=True)
        sys.stdin.readline()
        os._exit(9)
    writing._write = hanging
table_with_two_phones()[1].override("phone", gain_db=-7.0).save(sys.argv[1])
"""


def dying(folder: Path, where: str) -> subprocess.Popen[str]:
    """Start a process that begins to save to a folder and dies, on command or between the two renames."""
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2] / "support")}
    arguments = [sys.executable, "-c", DIES, str(folder), where]
    return subprocess.Popen(arguments, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


@pytest.mark.skipif(os.name != "posix", reason="folders cannot be locked")
def test_drafts_of_dead_processes_are_removed_and_live_drafts_kept(tmp_path: Path) -> None:
    with dying(tmp_path / "room", "writing") as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "writing\n"
        a_bundle().save(tmp_path / "room")
        assert len(list(tmp_path.iterdir())) == 2
        process.communicate("\n")
    assert len(list(tmp_path.iterdir())) == 2
    a_bundle().save(tmp_path / "room")
    assert [path.name for path in tmp_path.iterdir()] == ["room"]


@pytest.mark.skipif(os.name != "posix", reason="folders cannot be locked")
def test_a_draft_that_was_never_written_to_is_removed(tmp_path: Path) -> None:
    (tmp_path / ".room.scene2hap-0123abcd").mkdir()
    a_bundle().save(tmp_path / "room")
    assert [path.name for path in tmp_path.iterdir()] == ["room"]


def test_folders_that_only_look_alike_stay(tmp_path: Path) -> None:
    names = [".room-abcdefgh", ".room.scene2hap-mine", ".room.scene2hap-0123abcd", ".room.scene2hap-0123abcd-77.old"]
    for name in names:
        (tmp_path / name).mkdir()
        (tmp_path / name / "thesis.txt").write_text("ten years")
    for _ in range(2):
        a_bundle().save(tmp_path / "room")
    assert all((tmp_path / name / "thesis.txt").is_file() for name in names)


@pytest.mark.parametrize("look", [HapticBundle.load, read_overrides], ids=["load", "read_overrides"])
def test_missing_bundle_is_restored_by_the_next_reader(tmp_path: Path, look: object) -> None:
    folder = a_bundle().save(tmp_path / "room")
    (folder / "thesis.txt").write_text("ten years")
    with dying(folder, "between") as process:
        process.communicate()
    assert not folder.exists()
    with pytest.warns(BundleWarning, match="being replaced when that process died"):
        look(folder)
    assert HapticBundle.load(folder).gain_db("phone") == -7.0
    assert (folder / "thesis.txt").read_text() == "ten years"
    assert [path.name for path in tmp_path.iterdir()] == ["room"]


def test_removed_bundle_is_not_restored(tmp_path: Path) -> None:
    folder = a_bundle().save(tmp_path / "room")
    with dying(folder, "writing") as process:
        process.communicate("\n")
    shutil.rmtree(folder)
    with pytest.raises(BundleIncomplete, match="there is no folder"):
        HapticBundle.load(folder)


def test_failed_second_rename_restores_the_old_bundle(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = a_bundle().save(tmp_path / "room")
    monkeypatch.setattr(folder_replacement, "exchange", lambda one, other: False)
    rename = Path.rename

    def refuse(self: Path, target: Path) -> Path:
        if self.suffix == ".new":
            raise OSError(28, "No space left on device")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", refuse)
    with pytest.raises(BundleError, match="No space left"):
        a_bundle().override("phone", gain_db=1.0).save(folder)
    monkeypatch.undo()
    assert HapticBundle.load(folder).gain_db("phone") == 0.0
    assert [path.name for path in tmp_path.iterdir()] == ["room"]


def test_a_bundle_with_an_open_file_is_neither_replaced_nor_harmed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Windows does not move a folder with an open file, as one that an audio editor has open."""
    folder = a_bundle().save(tmp_path / "room")
    (folder / "thesis.txt").write_text("ten years")
    before = files_of(folder)
    monkeypatch.setattr(folder_replacement, "exchange", lambda one, other: False)
    rename = Path.rename

    def reject(self: Path, target: Path) -> Path:
        if self == folder:
            problem = PermissionError(13, "Access is denied")
            problem.winerror = 5
            raise problem
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", reject)
    with pytest.raises(BundleError, match=r"cannot be written: .* Close the program that has it .*open"):
        a_bundle().override("phone", gain_db=1.0).save(folder)
    monkeypatch.undo()
    assert files_of(folder) == before
    assert [path.name for path in tmp_path.iterdir()] == ["room"]
    a_bundle().override("phone", gain_db=1.0).save(folder)
    assert HapticBundle.load(folder).gain_db("phone") == 1.0


def test_write_protected_files_of_a_bundle_are_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Perforce checks files out write-protected, and Windows then keeps them from being removed."""
    folder = a_bundle().save(tmp_path / "room")
    (folder / "thesis.txt").write_text("ten years")
    for path in folder.rglob("*"):
        if path.is_file():
            path.chmod(0o444)
    unlink = Path.unlink

    def as_on_windows(self: Path, missing_ok: bool = False) -> None:
        if self.exists() and not self.stat().st_mode & 0o200:
            raise PermissionError(13, "Access is denied")
        unlink(self, missing_ok)

    monkeypatch.setattr(Path, "unlink", as_on_windows)
    monkeypatch.setattr(folder_replacement, "exchange", lambda one, other: False)
    a_bundle().override("phone", gain_db=1.0).save(folder)
    assert HapticBundle.load(folder).gain_db("phone") == 1.0
    assert (folder / "thesis.txt").read_text() == "ten years"
    assert not (folder / "thesis.txt").stat().st_mode & 0o200
    assert [path.name for path in tmp_path.iterdir()] == ["room"]


@pytest.mark.parametrize("is_torn", [False, True])
def test_a_bundle_that_is_replaced_while_it_is_read_is_read_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, is_torn: bool
) -> None:
    """What was read by then may be of both bundles, and fit together or not."""
    folder = a_bundle().save(tmp_path / "room")
    other = a_bundle().override("phone", gain_db=-7.0)
    from scene2hap.bundle import reading

    read, times = reading._read_scene, []

    def and_replace(place: Path) -> object:
        times.append(place)
        if len(times) == 1:
            other.save(folder)
            if is_torn:
                raise BundleError("the manifest names a file of the bundle before")
        return read(place)

    monkeypatch.setattr(reading, "_read_scene", and_replace)
    assert HapticBundle.load(folder).gain_db("phone") == -7.0
    assert len(times) == 2


# --- the exchange -----------------------------------------------------------------------------------------------------


@pytest.mark.skipif(not sys.platform.startswith(("linux", "darwin")), reason="this system has no exchange")
def test_exchange_swaps_two_folders(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / name).write_text("")
    assert exchange(tmp_path / "a", tmp_path / "b")
    assert [path.name for path in (tmp_path / "a").iterdir()] == ["b"]
    with pytest.raises(FileNotFoundError):
        exchange(tmp_path / "a", tmp_path / "nowhere")


def test_exchange_returns_false_where_unsupported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "win32")
    assert not exchange(tmp_path / "a", tmp_path / "b")


def test_a_bundle_that_another_process_saved_is_not_replaced_unseen(tmp_path: Path) -> None:
    target = tmp_path / "b"
    a_bundle().save(target)
    read = save_stamp(target)
    write_bundle(a_bundle().override("phone", gain_db=-1.0), target, since=read)
    with pytest.raises(BundleChanged, match="another process"):
        write_bundle(a_bundle().override("phone", gain_db=-2.0), target, since=read)
    assert HapticBundle.load(target).gain_db("phone") == -1.0
    assert [path.name for path in tmp_path.iterdir()] == ["b"]


def test_a_place_that_cannot_be_written_is_refused_before_a_bake(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(BundleError, match=r"file is no folder of yours\. Choose another place"):
        folder_replacement.require_replaceable(tmp_path / "file" / "below" / "kitchen.bundle")
    folder_replacement.require_replaceable(tmp_path / "new" / "kitchen.bundle")
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(BundleError, match="is no folder of yours"):
        folder_replacement.require_replaceable(tmp_path / "new" / "kitchen.bundle")
