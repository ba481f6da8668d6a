"""The folder of an export: its files are replaced together, and those of sources that no longer exist are removed."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from scene2hap.bundle.manifest import MANIFEST
from scene2hap.common import checks
from scene2hap.common.counted import counted
from scene2hap.common.files import put_in_place, require_place
from scene2hap.common.json_texts import parse_json
from scene2hap.common.warning import warn_of
from scene2hap.errors import ExportError, unwritable
from scene2hap.export.draft_set import DraftSet
from scene2hap.export.fidelity import fidelity
from scene2hap.export.manifest import FORMAT, NAME, Manifest
from scene2hap.export.protocol import Exported, Exporter, json_bytes
from scene2hap.export.report import ExportReport, FileReport
from scene2hap.export.track import Track

REPORT = "report.json"
Progress = Callable[[str, str, int, int], None]


def checked_folder(folder: str | os.PathLike[str], *names: str) -> Path:
    """Return the folder as a path.

    Raises: ExportError: it cannot be written, is a bundle, or one of these names in it is a file of another program,
    such as the manifest of a web page or the report of `bake-many`. All are found before long work.
    """
    place = checks.path("folder", folder, error=ExportError)
    try:
        require_place(place / NAME)
        if (place / MANIFEST).is_file():
            raise ExportError(f"{place} is a bundle; an export is no part of it. Export into a folder of its own.")
        for name in names:
            if (place / name).is_file() and not _is_of_an_export((place / name).read_bytes()):
                raise ExportError(
                    f"{place / name} was not written by an export of scene2hap, which would replace it. Export into a "
                    "folder of its own, or move that file away."
                )
    except OSError as cause:
        raise ExportError(unwritable(place, cause)) from cause
    return place


def _is_of_an_export(content: bytes) -> bool:
    """Return True if a JSON text is a manifest or a report of an export, of this or of another version."""
    try:
        found = parse_json(content)
    except ValueError:
        return False
    return isinstance(found, dict) and (found.get("format") == FORMAT or {"folder", "files"} <= found.keys())


def write_tracks(
    tracks: Sequence[Track],
    exporters: Mapping[str, Exporter],
    folder: Path,
    manifest: Callable[[ExportReport], bytes] | None,
    progress: Progress | None,
) -> ExportReport:
    """Write all tracks in all formats, and the reports; `manifest` returns that of a bundle, None for a clip.

    Raises: ExportError: as `export_bundle`, which also says what is replaced, removed and warned of.
    """
    rows: list[FileReport] = []
    total, done = len(tracks) * len(exporters), 0
    with DraftSet() as drafts:
        for track in tracks:
            for kind, exporter in exporters.items():
                made = exporter.export(track)
                for name, content in made.files.items():
                    _draft(drafts, folder / kind, name, content)
                rows += _rows(kind, track, made)
                done += 1
                if progress is not None:
                    progress("exporting", f"{track.name} to {kind}", done, total)
        report = ExportReport(str(folder), tuple(rows))
        before = _files_of_sources(folder) if manifest is not None else None
        _draft(drafts, folder, REPORT, json_bytes(report.to_data()))
        _draft(drafts, folder, "report.txt", f"{report}\n".encode())
        if manifest is not None:
            _draft(drafts, folder, NAME, manifest(report))
        for draft, path in drafts.drafts:
            with _writing(path):
                put_in_place(draft, path)
    if manifest is not None:
        now = _files_of_sources(folder)
        if before is not None and now is not None and before[0] == now[0]:
            gone = sorted(name for name in before[1] - {*report.files} if name.partition("/")[0] in exporters)
            report = replace(report, removed=tuple(name for name in gone if _remove(folder, name)))
        if before is not None:
            _warn_of_unlisted(folder, before[0], before[1] - {*report.files, *report.removed})
    return report


def _files_of_sources(folder: Path) -> tuple[str, set[str]] | None:
    """Return the scene and the files of its sources in a folder's manifest, None without one that can be read."""
    try:
        found = Manifest.model_validate_json((folder / NAME).read_bytes())
    except (OSError, ValueError):
        return None
    states = [state for source in found.sources for state in source.states]
    return found.scene, {name for state in states for entry in state.files for name in entry.files}


def _warn_of_unlisted(folder: Path, scene: str, names: set[str]) -> None:
    """Warn of files of an earlier export that stay, but that the new manifest does not list. Warns: SceneWarning."""
    left = sorted(name for name in names if (folder / name).is_file())
    if left:
        kinds = ", ".join(dict.fromkeys(name.partition("/")[0] for name in left))
        warn_of(
            f"{folder / NAME} no longer lists {counted(len(left), 'file')} of an earlier export of {scene!r}, which "
            f"{'stays' if len(left) == 1 else 'stay'} in the folder: {kinds}. Export all kinds of a scene in one call, "
            "and each scene into a folder of its own."
        )


def _remove(folder: Path, name: str) -> bool:
    """Remove an exported file, KIND/NAME. Returns False if it is not there, or elsewhere."""
    path = folder / name
    if name.count("/") != 1 or "\\" in name or ".." in path.parts or path.is_symlink():
        return False
    try:
        path.unlink()
    except OSError:
        return False
    return True


def _rows(kind: str, track: Track, made: Exported) -> list[FileReport]:
    rows = []
    for name, channel in track.channels.items():
        mine = [one for one in made.files if one.startswith(f"{track.name}.{name}.")] if name else list(made.files)
        files = tuple(f"{kind}/{one}" for one in mine or made.files)
        played = made.played.get(name)
        error = fidelity(channel, played) if played is not None else None
        rows.append(FileReport(kind, track.name, name, files, channel.duration_s, error))
    return rows


def _draft(drafts: DraftSet, folder: Path, name: str, content: bytes) -> None:
    path = folder / name
    if path.parent != folder or not name:
        raise ExportError(f"an exporter names a file {name!r}; it must be a name without a folder.")
    with _writing(path):
        drafts.write(path, content)


@contextmanager
def _writing(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as cause:
        raise ExportError(unwritable(path, cause)) from cause
