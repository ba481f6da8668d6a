"""Everyday words of other languages, translated into the English words of the table of objects.

Words have the form that `word_split.split_words` returns: lower case, without accents. A word with an English meaning
in the lexicon is never looked up here.
"""

from __future__ import annotations

import csv
import unicodedata
from functools import cache
from importlib.resources import files

# Foreign words that are also English words: a number, a state, a tool's cube, or another object.
_ENGLISH = frozenset({"four", "lit", "cubo", "piso", "bank", "trap", "kop", "wand"})


@cache
def english() -> dict[str, tuple[str, ...]]:
    """Return the English words by foreign word. If two languages share a word, the first one in the file is used."""
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
