"""Everyday words of other languages, translated into the English words of the table of objects.

Words have the form that `word_split.split_words` returns: lower case, without accents. A word with an English meaning
in the lexicon is never looked up here.
"""

from __future__ import annotations

import csv
import unicodedata
from collections.abc import Iterator
from functools import cache
from importlib.resources import files

# Foreign words that are also English words: a number, a state, a tool's cube, or another object.
_ENGLISH = frozenset({"four", "lit", "cubo", "piso", "bank", "trap", "kop", "wand"})

_COMPOUNDING = ("de", "nl")
_SHORTEST_PIECE = 3  # letters
_LINKS = ("", "n", "s", "en", "es", "e")


@cache
def english() -> dict[str, tuple[str, ...]]:
    """Return the English words by foreign word. If two languages share a word, the first one in the file is used."""
    found: dict[str, tuple[str, ...]] = {}
    for _, word, meaning in _rows():
        if word not in _ENGLISH:
            found.setdefault(word, meaning)
    return found


def compound(word: str) -> tuple[str, ...]:
    """Return the English words of a German or Dutch compound ("gartenstuhl"), () if a piece of it is unknown.

    The last piece is the object, as in English. A linking "n", "s", "en" or "es" may follow the other pieces.
    """
    for pieces in _pieces().values():
        for end in range(len(word) - _SHORTEST_PIECE, _SHORTEST_PIECE - 1, -1):
            head, last = word[:end], pieces.get(word[end:])
            if last is None:
                continue
            stems = (head.removesuffix(link) for link in _LINKS if head.endswith(link))
            first = next((pieces[stem] for stem in stems if stem in pieces), None)
            if first is not None:
                return (*first, *last)
    return ()


@cache
def _pieces() -> dict[str, dict[str, tuple[str, ...]]]:
    """Return the words of each language that writes compounds as one word."""
    found: dict[str, dict[str, tuple[str, ...]]] = {language: {} for language in _COMPOUNDING}
    for language, word, meaning in _rows():
        if language in found and len(word) >= _SHORTEST_PIECE:
            found[language].setdefault(word, meaning)
    return found


def _rows() -> Iterator[tuple[str, str, tuple[str, ...]]]:
    """Yield language, word and meaning. A noun of several words ("lave linge") is written together."""
    text = files(__package__).joinpath("translations.csv").read_text(encoding="utf-8")
    for row in csv.DictReader(text.splitlines()):
        for pair in row["words"].split(";"):
            word, meaning = pair.split("=")
            yield row["language"], _without_accents(word).replace(" ", ""), tuple(meaning.split())


def _without_accents(word: str) -> str:
    return "".join(letter for letter in unicodedata.normalize("NFKD", word) if not unicodedata.combining(letter))
