"""Words of authored names: cut at capitals and between run-together words, plurals and slips seen through."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence
from functools import cache, lru_cache

from scene2hap.llm.lexicon import translations, words
from scene2hap.llm.lexicon.table import ObjectRow, table

# How far a word can be trusted that had to be translated, cut or mended. Assumed.
_TRANSLATED = 0.9
_RUN_TOGETHER = 0.9
_SLIP = 0.6

_SHORTEST_PIECE = 3  # letters; shorter pieces cut up any word
_SHORT_PIECES = frozenset({"tv", "pc"})
_LONGEST_RUN = 40  # letters; nobody writes longer words
_SHORTEST_SLIP = 8  # letters; in shorter words one letter is another word too often (certain, curtain)


def read_words(name: str) -> tuple[list[str], float]:
    """The words of a name, foreign ones translated, run-together ones cut, slips mended; and the trust in it [0..1]."""
    trust = 1.0
    tokens: list[str] = []
    for word in _without_shades(split_words(name)):
        pieces, factor = _known_pieces(word)
        tokens.extend(pieces)
        trust *= factor
    return tokens, trust


def split_words(name: str) -> list[str]:
    """The words of a name in lower case, without digits, accents and signs."""
    plain = "".join(letter for letter in unicodedata.normalize("NFKD", name) if not unicodedata.combining(letter))
    return [part.casefold() for run in re.findall(r"[^\W\d_]+", plain) for part in _at_capitals(run)]


def _without_shades(tokens: Sequence[str]) -> list[str]:
    """The words without "light" or "dark" before a colour, which would read as a lamp."""
    return [
        word
        for word, after in zip(tokens, (*tokens[1:], ""), strict=False)
        if word not in ("light", "dark") or after not in words.COLOURS
    ]


def _at_capitals(run: str) -> Iterator[str]:
    """ "RoomWindow" -> Room, Window; "TVCabinet" -> TV, Cabinet; the plural "TVs" stays whole."""
    start = 0
    for i in range(1, len(run)):
        begins_word = run[i].isupper() and run[i - 1].islower()
        ends_initials = run[i].isupper() and run[i - 1].isupper() and run[i + 1 : i + 2].islower()
        if begins_word or (ends_initials and run[i + 1 :] != "s"):
            yield run[start:i]
            start = i
    yield run[start:]


def is_known(word: str) -> bool:
    """Return True if the lexicon knows the word, as part of a noun or beside one."""
    if len(word) < 3:
        return True  # a serial, a side (L, R) or an exporter's mark
    return any(form in _vocabulary() or form in side_words() for form in words.forms(word))


@lru_cache(maxsize=4096)
def _known_pieces(word: str) -> tuple[tuple[str, ...], float]:
    """A word as the known words it is made of, and how far that can be trusted; itself where that fails."""
    if is_known(word) or len(word) > _LONGEST_RUN:
        return (word,), 1.0
    meaning = translations.english().get(word)
    if meaning:
        return meaning, _TRANSLATED
    pieces = _cut(word)
    if pieces:
        return pieces, _RUN_TOGETHER
    meant = _meant(word)
    return ((meant,), _SLIP) if meant else ((word,), 1.0)


def _cut(word: str) -> tuple[str, ...]:
    """The fewest known pieces that make up a run-together word, the last one as long as can be; () where none do."""
    best: list[tuple[str, ...] | None] = [()] + [None] * len(word)
    for end in range(1, len(word) + 1):
        for start in range(end):
            head, piece = best[start], word[start:end]
            if head is None or not _is_piece(piece):
                continue
            current = best[end]
            if current is None or len(head) + 1 < len(current):
                best[end] = (*head, piece)
    return best[-1] or ()


@lru_cache(maxsize=4096)
def _is_piece(text: str) -> bool:
    """Return True if a word can stand in a run-together one: a noun of its own or a word beside nouns, no fragment."""
    if text in _SHORT_PIECES:
        return True
    if len(text) < _SHORTEST_PIECE or text in words.PREPOSITIONS:
        return False
    return any(form in _whole_words() and _is_long_enough(form) for form in words.forms(text))


def _is_long_enough(form: str) -> bool:
    # Three letters of an exporter ("con", "env", "ver") are found in any word.
    return len(form) > _SHORTEST_PIECE or (len(form) == _SHORTEST_PIECE and form not in words.TOOL_WORDS)


def _meant(word: str) -> str | None:
    """The one long word of the table that `word` is a slip away from."""
    near = {known for known in _slip_targets() if _is_slip(word, known)}
    return near.pop() if len(near) == 1 else None


def _is_slip(written: str, known: str) -> bool:
    """Return True if one letter is missing, surplus, swapped with its neighbour, or another vowel.

    A consonant for another one is left out: that is more often a different word (painter, printer).
    """
    if abs(len(written) - len(known)) > 1 or written[0] != known[0]:
        return False
    start = next((i for i, (a, b) in enumerate(zip(written, known, strict=False)) if a != b), None)
    if start is None:
        return len(written) != len(known)
    a, b = written[start:], known[start:]
    missing, surplus = a == b[1:], a[1:] == b
    swapped = a[:2] == b[1::-1] and a[2:] == b[2:]
    vowel = a[1:] == b[1:] and a[0] in "aeiouy" and b[0] in "aeiouy"
    return missing or surplus or swapped or vowel


@cache
def nouns() -> dict[str, tuple[ObjectRow, tuple[str, ...]]]:
    """Every noun and synonym, written together -> its row and its words."""
    spelled = ((name.replace("-", " ").split(), row) for row in table() for name in (row.noun, *row.synonyms))
    return {"".join(parts): (row, tuple(parts)) for parts, row in spelled}


@cache
def _vocabulary() -> frozenset[str]:
    """Every word that can be part of a noun or names its place or material."""
    parts = {part for _, spelled in nouns().values() for part in spelled}
    return frozenset({*nouns(), *parts, *words.PLACE_WORDS, *words.MATERIAL_WORDS})


@cache
def _whole_words() -> frozenset[str]:
    return frozenset({*nouns(), *words.MATERIAL_WORDS}) | side_words()


@cache
def _slip_targets() -> tuple[str, ...]:
    return tuple(word for word in sorted(_vocabulary()) if len(word) >= _SHORTEST_SLIP)


@cache
def side_words() -> frozenset[str]:
    """Words that stand beside a noun and are no object themselves."""
    return (
        words.TOOL_WORDS
        | words.MODIFIERS
        | words.COLOURS
        | words.TOY_WORDS
        | words.PREPOSITIONS
        | frozenset(words.PLACE_WORDS)
    )
