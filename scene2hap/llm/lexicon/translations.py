"""Everyday words of other languages, and usual abbreviations of English ones, as English words of the table of objects.

Words have the form that `word_split.split_words` returns: lower case, without accents. A word with an English meaning
in the lexicon is looked up here only if an object of that meaning cannot be so large (`name_checks.meant_abroad`).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from functools import cache, lru_cache

from scene2hap.common.printable import without_accents
from scene2hap.llm.lexicon.table import rows_of

# Foreign words that are also English words: a number, a state, a tool's cube, a colour, or another object.
_ENGLISH = frozenset(
    {"bank", "chat", "cubo", "four", "kop", "lit", "nave", "pastel", "piso", "siege", "support", "tabla", "toboggan"}
    | {"tele", "tonne", "trap", "wand"}
)

SHARED = frozenset(
    {"bar", "bus", "cd", "container", "dvd", "garage", "golf", "hotel", "laptop", "metro", "pc", "piano", "pizza"}
    | {"radio", "robot", "sauna", "scooter", "sofa", "tablet", "taxi", "tennis", "tv"}
)
"""English nouns that Romance languages have too: a "mando_tv" is the remote of a TV, but a "bureau_drawer" a drawer."""

COMPOUNDING = ("de", "nl")
"""Languages that put the kind before the object, as English does."""

ROMANCE = frozenset({"es", "fr", "it", "pt"})
"""Languages that put the kind after the object: a "rueda camion" is the wheel of a truck."""

_SHORTEST_PIECE = 3  # letters
_SHORTEST_KIND = 2  # letters; "oil" in "olkanister"
_SHORTEST_HEAD = 5  # letters; shorter words of German end hundreds of English words ("furni-tur")
_LINKS = ("", "n", "s", "en", "es", "e")

_PLURALS: dict[str, dict[str, tuple[str, ...]]] = {
    "de": {"en": ("",), "er": ("",), "e": ("",), "n": ("",), "s": ("",)},
    "nl": {"en": ("",), "n": ("",), "s": ("",)},
    "es": {"es": ("",), "s": ("",)},
    "pt": {"oes": ("ao",), "es": ("",), "s": ("",)},
    "fr": {"s": ("",), "x": ("",)},
    "it": {"i": ("o", "e"), "e": ("a",)},
    "pl": {"y": ("a", ""), "i": ("a", ""), "a": ("o",), "e": ("",)},
    "ru": {"ы": ("а", ""), "и": ("а", "ь", ""), "а": ("о",)},
    "ja": {},
    "en": {},
}
"""Endings of plurals by language, and the endings of their singulars. An umlaut is an accent, which is removed."""

LANGUAGES = frozenset(_PLURALS)

OF = frozenset({"de", "du", "des", "di", "del", "della", "da", "do", "a", "al", "alla", "au", "aux"})
"""Words of Romance languages between an object and its kind: "porte de garage" is a garage door, "TV a muro" one for a
wall."""

ARTICLES = frozenset({"la", "le", "les", "el", "los", "las", "il", "lo", "gli"})


@cache
def english() -> dict[str, tuple[str, ...]]:
    """Return the English words by foreign word. If two languages share a word, the first one in the file is used."""
    found: dict[str, tuple[str, ...]] = {}
    for language, word, meaning in _rows():
        for spelled in _spellings(language, word):
            if spelled not in _ENGLISH:
                found.setdefault(spelled, meaning)
    return found


@lru_cache(maxsize=4096)
def by_language(word: str) -> Mapping[str, tuple[str, ...]]:
    """Return the English words of a word or of its singular in each language that has it."""
    found = {name: known.get(_folded(name, word)) or _plural_in(name, word) for name, known in _dictionaries().items()}
    return {name: meaning for name, meaning in found.items() if meaning}


def plural(word: str) -> tuple[str, ...]:
    """Return the English words of a foreign plural ("stuhle": chair), () if no language has its singular."""
    if word in english():
        return ()
    return next((meaning for language in _PLURALS if (meaning := _plural_in(language, word))), ())


def compound(word: str, is_english: Callable[[str], bool]) -> tuple[str, ...]:
    """Return the English words of a German or Dutch compound ("gartenstuhl"), () if its last piece is unknown.

    The last piece is the object, as in English; it may be a plural. A linking "n", "s", "en" or "es" may follow the
    first piece, and its last "e" may be missing ("duschwand"). It may be an English word ("laserdrucker"). An unknown
    first piece is returned as it is, since it is only the kind of the object ("puppenhaus").
    """
    return next((found for language in COMPOUNDING if (found := _compound_in(language, word, is_english))), ())


def _compound_in(language: str, word: str, is_english: Callable[[str], bool]) -> tuple[str, ...]:
    kind_of: tuple[str, ...] = ()
    pieces, word = _dictionaries()[language], _folded(language, word)
    for end in range(_SHORTEST_KIND, len(word) - _SHORTEST_PIECE + 1):
        head, tail = word[:end], word[end:]
        singular = pieces.get(tail)
        last = singular or _plural_in(language, tail)
        if not last:
            continue
        stems = [head + "e", *(head.removesuffix(link) for link in _LINKS if head.endswith(link))]
        first = next((pieces[stem] for stem in stems if stem in pieces), None)
        if first is None and len(head) > _SHORTEST_PIECE and tail not in _ENGLISH and is_english(head):
            first = (head,)
        if first is not None:
            return (*first, *last)
        is_long = len(head) >= _SHORTEST_PIECE and len(tail) >= _SHORTEST_HEAD + (0 if singular else 2)
        if not kind_of and is_long and tail not in _ENGLISH:
            kind_of = (head, *last)
    return kind_of


def _plural_in(language: str, word: str) -> tuple[str, ...]:
    """Return the English words of a plural of one language, () if it is none."""
    word = _folded(language, word)
    singulars = (
        word.removesuffix(ending) + singular
        for ending, replaced in _PLURALS[language].items()
        if word.endswith(ending)
        for singular in replaced
    )
    known = _dictionaries()[language]
    return next((known[word] for word in singulars if word in known and word not in _ENGLISH), ())


@cache
def _dictionaries() -> dict[str, dict[str, tuple[str, ...]]]:
    """Return the English words by foreign word, for each language."""
    found: dict[str, dict[str, tuple[str, ...]]] = {language: {} for language in _PLURALS}
    for language, word, meaning in _rows():
        if len(word) >= _SHORTEST_PIECE:
            found[language].setdefault(_folded(language, word), meaning)
    return found


def _spellings(language: str, word: str) -> tuple[str, ...]:
    """Return the ways to write a word: umlauts as one letter or two, long vowels of Japanese as one or two.

    The "n" of Japanese before a "p" or "b" is also written "m" ("senpuuki", "sempuki").
    """
    folded = _folded(language, word)
    return word, folded, re.sub("n(?=[pb])", "m", folded) if language == "ja" else folded


def _folded(language: str, word: str) -> str:
    """Return a German word with its umlauts as plain letters, a Japanese one in Latin letters with short vowels."""
    if language == "ja":
        return re.sub(r"o[ou]|([aiue])\1", lambda long: long[0][0], word)
    return word.replace("ae", "a").replace("oe", "o").replace("ue", "u") if language == "de" else word


def _rows() -> Iterator[tuple[str, str, tuple[str, ...]]]:
    """Yield language, word and meaning. A noun of several words ("lave linge") is written together."""
    for row in rows_of("translations.csv"):
        for pair in row["words"].split(";"):
            word, meaning = pair.split("=")
            yield row["language"], without_accents(word).replace(" ", ""), tuple(meaning.split())
