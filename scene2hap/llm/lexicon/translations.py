"""Everyday words of other languages, as the English words that the table of objects is written in.

Written as `spelling.split_words` leaves them: lower case, without accents. A word that the
lexicon knows in English is never looked up here.
"""

from __future__ import annotations

import csv
import unicodedata
from functools import cache
from importlib.resources import files

# Read in English, where they are a number, a state, a tool's cube, or another thing.
_ENGLISH = frozenset({"four", "lit", "cubo", "piso", "bank", "trap", "kop", "wand"})


@cache
def english() -> dict[str, tuple[str, ...]]:
    """Foreign word -> English words; the first language of the file that has a word decides."""
    text = files(__package__).joinpath("translations.csv").read_text(encoding="utf-8")
    found: dict[str, tuple[str, ...]] = {}
    for row in csv.DictReader(text.splitlines()):
        for pair in row["words"].split(";"):
            word, meaning = pair.split("=")
            plain = _without_accents(word)
            if plain not in _ENGLISH:
                found.setdefault(plain, tuple(meaning.split()))
    return found


def _without_accents(word: str) -> str:
    return "".join(letter for letter in unicodedata.normalize("NFKD", word) if not unicodedata.combining(letter))
