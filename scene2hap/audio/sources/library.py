"""Sound source: a folder of the user's own sound files."""

from __future__ import annotations

import csv
import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from scene2hap.audio.clip import AudioClip, Credit
from scene2hap.audio.files import SUFFIXES, read_clip
from scene2hap.audio.select import MIN_DURATION_S
from scene2hap.audio.sources.candidates import MAX_CANDIDATES, is_long_enough
from scene2hap.audio.sources.word_stems import is_anything, joined_stems, noun_phrase, says_nothing, stems
from scene2hap.common import checks
from scene2hap.common.csv_tables import csv_reader
from scene2hap.common.files import read_small_text
from scene2hap.common.warning import warn_of
from scene2hap.errors import AudioError, ConfigError, reason_of
from scene2hap.haptics import VibrationDescription

INDEX_NAME = "sounds.csv"


class UnreadableSound(UserWarning):
    """A file of the library that cannot be used was skipped."""


class ShortSound(UserWarning):
    """All files of the library that name an object are too short to be used."""


@dataclass(frozen=True)
class FolderLibrary:
    """Find sounds in a folder, and in its subfolders, by the words of their names.

    If the folder holds a `sounds.csv`, its rows are the library instead. Columns: file (relative to the folder),
    keywords (the file's name if empty), title, author, licence, address; all but the first may be missing.
    Raises: ConfigError: the folder is missing, or its `sounds.csv` is not such a table or names a file outside of it.
    """

    folder: Path

    def __post_init__(self) -> None:
        object.__setattr__(self, "folder", Path(self.folder))
        self._require_folder()

    def find(self, description: VibrationDescription) -> list[AudioClip]:
        """Return up to five sounds whose words name the object, those with most words of the description first.

        A sound whose whole name is that of the object is taken before all others, whatever it says. Then come sounds
        with the author's word for the object, then those that also name what the object does. If one of them is long
        enough to be chosen, sounds that say less are left out. A sound with the right verb but another object does not
        match: a boiling kettle is no boiling pan. Nor does one that shares only a word for anything: a sewing machine
        is no vending machine, and of a "box" only sounds without other words match, such as "box shaking". Sounds that
        are too short come last, as rows for the table of the choice.
        Raises: ConfigError: see `FolderLibrary`.
        Warns: UnreadableSound: a file that cannot be read was skipped; ShortSound: no sound is long enough.
        """
        self._require_folder()
        nouns, own = noun_phrase(description.object_category), set(stems(description.own_word))
        wanted = {*nouns, *own, *stems(description.keywords)}
        doing = set(stems(description.keywords)) - set(nouns)
        head = set(nouns[-2:] if nouns and says_nothing(nouns[-1]) else nouns[-1:])

        def has_name(path: Path) -> bool:
            return bool(description.name) and path.stem.casefold() == description.name.casefold()

        def rank(path: Path, words: set[str]) -> tuple[bool, bool, bool]:
            is_own = own <= words
            # Of a "boiling pot", the verb is a word of the name as well.
            return not has_name(path), not is_own, not doing & (words - own if is_own else words)

        said = _words(f"{description.own_word} {description.keywords} {description.object_category}")
        names = [(name, all(map(is_anything, name))) for name in (own, head) if name]
        matches = [
            entry
            for entry in self._entries()
            if has_name(entry[0])
            or any(name <= entry[1] and (entry[1] <= said or not may_be_any) for name, may_be_any in names)
        ]
        matches.sort(key=lambda match: (*rank(*match[:2]), -len(wanted & match[1]), match[0].as_posix()))
        found: list[AudioClip] = []
        short: list[AudioClip] = []
        best: tuple[bool, bool, bool] | None = None
        for path, words, credit in matches:
            if len(found) == MAX_CANDIDATES or (best is not None and rank(path, words) > best):
                break
            try:
                clip = read_clip(path, replace(credit, query=description.keywords, origin="library"))
            except AudioError as cause:
                warn_of(f"skipped: {cause}", UnreadableSound)
                continue
            if is_long_enough(clip):
                found.append(clip)
                best = best or rank(path, words)
            elif len(short) < MAX_CANDIDATES:
                short.append(clip)
        if short and not found:
            # Sorted, so that all states of an object have the same warning, which Python shows once.
            titles = ", ".join(sorted(repr(clip.credit.title) for clip in short))
            warn_of(
                f"{self.folder} has sounds of {description.own_word or description.object_category!r}, but none lasts "
                f"more than {MIN_DURATION_S:g} s without its silent ends, so that none is used: {titles}. Record it "
                "longer, or repeat it in an audio editor.",
                ShortSound,
            )
        return [*found, *short][:MAX_CANDIDATES]

    def names(self) -> frozenset[str]:
        """Return the names of the sound files, without folder and suffix. Raises: ConfigError: see `FolderLibrary`."""
        self._require_folder()
        return frozenset(path.stem.casefold() for path, _, _ in self._entries())

    def _require_folder(self) -> None:
        if not os.path.isdir(self.folder):
            raise ConfigError(f"the sound library {self.folder} is not a folder. Create it, or choose another source.")

    def _entries(self) -> Iterator[tuple[Path, set[str], Credit]]:
        """Yield path, words and credit of every sound."""
        index = self.folder / INDEX_NAME
        if index.is_file():
            yield from self._listed(index)
            return
        for path in self.folder.rglob("*"):
            if path.suffix.lower() in SUFFIXES:
                yield path, _words(path.stem), Credit(path.stem, "unknown", "unknown")

    def _listed(self, index: Path) -> Iterator[tuple[Path, set[str], Credit]]:
        try:
            text = read_small_text(index)
        except (OSError, ValueError) as cause:
            raise ConfigError(
                f"{index}: cannot be read as UTF-8 text ({reason_of(cause)}). Save it as CSV in UTF-8."
            ) from cause
        table = csv_reader(text)
        try:
            named, *rows = [row for row in table if row] or [[]]
        except csv.Error as cause:  # a field of more than 131,072 characters
            raise ConfigError(f"{index}: cannot be read as CSV ({cause}). Shorten that field.") from cause
        if "file" not in named:
            raise ConfigError(
                f"{index}: the first line is {checks.represented(named)}; it must name the columns, "
                "at least 'file', separated by commas."
            )
        for row in rows:
            cells = dict(zip(named, row, strict=False))  # a short row lacks the last ones
            name, keywords, title, author, licence, address = (
                cells.get(column, "").strip()
                for column in ("file", "keywords", "title", "author", "licence", "address")
            )
            if name:
                path = Path(os.path.normpath(self.folder / name))
                if not path.is_relative_to(os.path.normpath(self.folder)):
                    raise ConfigError(
                        f"{index}: file is {name!r}, which lies outside {self.folder}; only files inside it are read. "
                        "Copy it there."
                    )
                credit = Credit(title or path.stem, author or "unknown", licence or "unknown", address)
                yield path, _words(keywords or path.stem), credit


def _words(name: str) -> set[str]:
    """Return the stems of a name, also those of two words as one: "WindMill" is a windmill."""
    return {*stems(name), *joined_stems(name)}
