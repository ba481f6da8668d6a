"""The sound files of a bundle: equal sounds are one file, which several sources share.

A file has the name of its first source, and the number of other sources: `fan.on+94.audible.wav` serves 95. loops.json
lists the sources of each file. A change of a shared file affects all of them. To change one source alone, give it a
separate file in loops.json, or override its clip. Saving a bundle shares and splits files by their content.
"""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from scene2hap.audio.clip import AudioClip, Credit
from scene2hap.audio.encoding import encoded, fits_flac, sound_digest
from scene2hap.audio.files import read_clip
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.run_curve import RunCurve
from scene2hap.audio.sensation import Sensation
from scene2hap.bundle.contents import BundleContents
from scene2hap.bundle.files import own_file
from scene2hap.common.printable import without_accents

_KINDS = ("audible", "tactile", "source")
_RUNS = ("start_up", "wind_down")
_RESERVED = re.compile("con|prn|aux|nul|com[0-9]|lpt[0-9]", re.IGNORECASE)
"""Names that no file of Windows can have, also before a suffix."""


def write_loops(bundle: BundleContents, put: Callable[[str, bytes], None]) -> dict[str, dict[str, Any]]:
    """Write the sounds of all loops; `put` writes a file, by its name and content. Returns the rows of loops.json."""
    digests: dict[int, str] = {}
    users: dict[tuple[str, str], list[str]] = {}
    for stem, loop in _stems(bundle):
        for kind, clip in _clips(loop).items():
            digest = digests.setdefault(id(clip), "") or f"{sound_digest(clip)} {clip.loop}"
            digests[id(clip)] = digest
            users.setdefault((kind, digest), []).append(stem)
    names: dict[tuple[str, str], str] = {}
    rows: dict[str, dict[str, Any]] = {object_id: {} for object_id in bundle.loops}
    for object_id, states in bundle.loops.items():
        for state, loop in states.items():
            row: dict[str, Any] = {}
            for kind, clip in _clips(loop).items():
                key = kind, digests[id(clip)]
                if key not in names:
                    names[key] = _write(put, users[key], kind, clip)
                row[kind] = names[key]
            row["frequency_raw_hz"] = loop.frequency_raw_hz
            row["frequency_tactile_hz"] = loop.frequency_tactile_hz
            if loop.felt is not None:
                row["felt"] = asdict(loop.felt)
            for name in _RUNS:
                if (curve := getattr(loop, name)) is not None:
                    row[name] = asdict(curve)
            row["credit"] = asdict(loop.audible.credit)
            if loop.fingerprint:
                row["fingerprint"] = dict(loop.fingerprint)
            if why := bundle.choices.get(object_id, {}).get(state):
                row["choice"] = why.splitlines()
            rows[object_id][state] = row
    return rows


class SoundReader:
    """Read the loops in rows of loops.json, each file once."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._clips: dict[tuple[Path, Credit], AudioClip] = {}
        self._files: dict[Path, AudioClip] = {}

    def loop(self, row: Mapping[str, Any]) -> HapticLoop:
        """Read one loop. Raises: AudioError: a sound cannot be used; BundleError: its file; KeyError, TypeError."""
        credit = Credit(**row["credit"])
        audible, tactile = (self._clip(row[kind], credit) for kind in ("audible", "tactile"))
        source = self._clip(row["source"], credit, marked=True) if "source" in row else None
        fingerprint = row.get("fingerprint", {})
        if not isinstance(fingerprint, dict) or not all(isinstance(value, str) for value in fingerprint.values()):
            raise TypeError("'fingerprint', which must be an object of texts")
        felt = Sensation(**row["felt"]) if "felt" in row else None
        frequencies = row["frequency_raw_hz"], row["frequency_tactile_hz"]
        start_up, wind_down = (RunCurve(**row[name]) if name in row else None for name in _RUNS)
        return HapticLoop(audible, tactile, *frequencies, source, fingerprint, felt, start_up, wind_down)

    def _clip(self, name: str, credit: Credit, *, marked: bool = False) -> AudioClip:
        """Return a sound, with its marked loop only on request: other files are loops as a whole."""
        path = own_file(self._folder, name)
        if (path, credit) not in self._clips:
            if path not in self._files:
                self._files[path] = read_clip(path, credit)
            read = self._files[path]
            self._clips[path, credit] = replace(read, credit=credit, loop=read.loop if marked else None)
        return self._clips[path, credit]


def file_stem(text: str) -> str:
    """Return a file name of ASCII letters for any id. Ids with equal plain letters get different short digests."""
    plain = re.sub(r"[^A-Za-z0-9_-]+", "-", without_accents(text)).strip("-")[:60]
    return plain if plain == text and not _RESERVED.fullmatch(plain) else f"{plain or 'x'}-{_digest(text)}"


def file_stems(texts: Iterable[str]) -> dict[str, str]:
    """Return a file name for each of several ids.

    Ids that differ in case only get digests, since Windows and macOS take such names for one.
    """
    stems = {text: file_stem(text) for text in texts}
    alike = Counter(stem.casefold() for stem in stems.values())
    return {text: stem if alike[stem.casefold()] == 1 else f"{stem}-{_digest(text)}" for text, stem in stems.items()}


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:8]


def _stems(bundle: BundleContents) -> list[tuple[str, HapticLoop]]:
    objects = file_stems(bundle.loops)
    return [
        (f"{objects[object_id]}.{stem}", states[state])
        for object_id, states in bundle.loops.items()
        for state, stem in file_stems(states).items()
    ]


def _clips(loop: HapticLoop) -> dict[str, AudioClip]:
    return {kind: clip for kind in _KINDS if (clip := getattr(loop, kind)) is not None}


def _write(put: Callable[[str, bytes], None], stems: list[str], kind: str, clip: AudioClip) -> str:
    shared = f"{stems[0]}+{len(stems) - 1}" if len(stems) > 1 else stems[0]  # no stem holds a plus sign
    # Loops are WAV, since people edit them. The longer source sounds are only kept, so they are compressed.
    # FLAC keeps no mark of a loop.
    if kind == "source" and clip.loop is None and fits_flac(clip.sample_rate_hz):
        name = f"sounds/{shared}.{kind}.flac"
        put(name, encoded(clip.samples, clip.sample_rate_hz, container="FLAC", path=Path(name)))
    else:
        name = f"sounds/{shared}.{kind}.wav"
        put(name, encoded(clip.samples, clip.sample_rate_hz, path=Path(name), is_loop=kind != "source", loop=clip.loop))
    return name
