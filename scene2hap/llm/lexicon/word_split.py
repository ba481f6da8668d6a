"""Words of authored names: split at capitals and inside run-together words, with plurals and typing errors resolved."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence
from functools import cache, lru_cache

from scene2hap.llm.lexicon import translations, words
from scene2hap.llm.lexicon.table import ObjectRow, table

# Confidence in a word that was translated, split or corrected. Assumed.
_TRANSLATED = 0.9
_RUN_TOGETHER = 0.9
_SLIP = 0.6

_COUNTED = re.compile(r"(?<!\d)(?:[2-9]|1\d)[\W_]*([^\W\d_]+)")
_ADJECTIVE = re.compile(r"(?<![^\W_])(?:[2-9]|1\d)([^\W\d_]+)")

_HASH = re.compile(
    r"(?<![^\W_])(?:[0-9a-f]{8}(?:[-_][0-9a-f]{4}){3}[-_][0-9a-f]{12}|(?=\d*[a-f]+\d+[a-f])[0-9a-f]{8,})(?![^\W_])",
    re.IGNORECASE,
)
"""UUIDs, and hexadecimal numbers with digits between letters. Their letters spell nouns by chance ("ac", "bed", "cd").
"facade01" is a word with a serial."""

_BETWEEN = words.PREPOSITIONS | translations.OF

_SHORTEST_PIECE = 3  # letters; shorter pieces occur inside almost any word
_SHORT_PIECES = frozenset({"tv", "pc"})
_LONGEST_RUN = 40  # letters; longer words do not occur
_SHORTEST_SLIP = 8  # letters; in shorter words one changed letter often gives another word (certain, curtain)


def read_words(name: str) -> tuple[list[str], float]:
    """Return the words of a name, translated, split and corrected, and the confidence in them [0..1]."""
    trust = 1.0
    tokens: list[str] = []
    for word in _in_english_order(_joined(_without_shades(split_words(name)))):
        pieces, factor = _known_pieces(word)
        tokens.extend(pieces)
        trust *= factor
    return tokens, trust


def counted_words(name: str) -> frozenset[str]:
    """Return the words directly after a number from 2 to 19, as read: "seats" in "Sofa 2 seats".

    Only plurals count. Serials have zeros.
    """
    return frozenset(word for word in _first_words(_COUNTED, name) if len(tuple(words.forms(word))) > 1)


def counting_adjectives(name: str) -> frozenset[str]:
    """Return the singulars that a number is written onto: "door" in "fridge_2door", but not in "Fridge2Door"."""
    return frozenset(word for word in _first_words(_ADJECTIVE, name) if len(tuple(words.forms(word))) == 1)


def _first_words(pattern: re.Pattern[str], name: str) -> Iterator[str]:
    """Yield the first word, as read, of each run of letters that a pattern finds."""
    after = (next(_at_capitals(run)).casefold() for run in pattern.findall(_plain(name)))
    return (_known_pieces(word)[0][0] for word in after)


def split_words(name: str) -> list[str]:
    """Split a name into words in lower case, without digits, accents, signs and the possessive "'s"."""
    plain = re.sub(r"['\u2019]s\b", "", _plain(name))
    return [part.casefold() for run in re.findall(r"[^\W\d_]+", plain) for part in _at_capitals(run)]


def _plain(name: str) -> str:
    """Return a name without hashes and accents. Unicode has no accent for the stroke of the Polish "ł"."""
    letters = unicodedata.normalize("NFKD", _HASH.sub(" ", name).replace("ł", "l").replace("Ł", "L"))
    return "".join(letter for letter in letters if not unicodedata.combining(letter))


def _without_shades(tokens: Sequence[str]) -> list[str]:
    """Remove "light" and "dark" before a colour, since "light" alone would read as a lamp."""
    return [
        word
        for word, after in zip(tokens, (*tokens[1:], ""), strict=False)
        if word not in ("light", "dark") or after not in words.COLOURS
    ]


def _joined(tokens: Sequence[str]) -> list[str]:
    """Join two or three neighbours that are one foreign noun together: "lave", "linge"; "tapis", "de", "course"."""
    joined: list[str] = []
    for word in tokens:
        joined.append(word)
        for n in (3, 2):
            last = joined[-n:]
            if len(last) == n and "".join(last) in translations.english() and not all(map(is_known, last)):
                joined[-n:] = ["".join(last)]
                break
    return joined


def _in_english_order(tokens: Sequence[str]) -> list[str]:
    """Put the kind of a foreign object before it: "porte de garage" becomes "garage porte"."""
    ordered: list[str] = []
    rest = list(tokens)
    while rest:
        word = rest.pop(0)
        kind = 0
        while word in translations.OF and ordered and kind < len(rest) and rest[kind] not in _BETWEEN:
            kind += 1
        if any(map(_is_foreign, (*ordered[-1:], *rest[:kind]))) and kind:
            of = [part for part in rest[:kind] if part not in translations.ARTICLES]
            ordered[-1:] = [*of, ordered[-1]]
            rest = rest[kind:]
        else:
            ordered.append(word)
    return ordered


def _is_foreign(word: str) -> bool:
    return not is_known(word) and bool(translations.english().get(word) or translations.plural(word))


def _at_capitals(run: str) -> Iterator[str]:
    """Split at capitals: "RoomWindow" -> Room, Window; "TVCabinet" -> TV, Cabinet; the plural "TVs" stays whole."""
    start = 0
    for i in range(1, len(run)):
        begins_word = run[i].isupper() and run[i - 1].islower()
        ends_initials = run[i].isupper() and run[i - 1].isupper() and run[i + 1 : i + 2].islower()
        if begins_word or (ends_initials and run[i + 1 :] != "s"):
            yield run[start:i]
            start = i
    yield run[start:]


def is_known(word: str) -> bool:
    """Return True if the lexicon has the word, as part of a noun or beside one."""
    if len(word) < 3 and word.isascii():
        return True  # a serial, a side (L, R) or an exporter's mark; Japanese nouns can be as short
    return any(form in _vocabulary() or form in side_words() for form in words.forms(word))


@lru_cache(maxsize=4096)
def _known_pieces(word: str) -> tuple[tuple[str, ...], float]:
    """Return the known words inside a word, and the confidence in them; the word itself if there are none."""
    if is_known(word) or len(word) > _LONGEST_RUN:
        return (word,), 1.0
    meaning = translations.english().get(word)
    if meaning:
        return meaning, _TRANSLATED
    pieces = _cut(word)
    if pieces:
        return pieces, _RUN_TOGETHER
    meaning = translations.plural(word)
    if meaning:
        return meaning, _TRANSLATED
    meaning = translations.compound(word)
    if meaning:
        return meaning, _TRANSLATED * _RUN_TOGETHER
    meant = _meant(word)
    return ((meant,), _SLIP) if meant else ((word,), 1.0)


def _cut(word: str) -> tuple[str, ...]:
    """Split a run-together word into the fewest known pieces, with the last one longest; () if it cannot be split."""
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
    """Return True if a word can be part of a run-together word: a noun or a word beside nouns, not a fragment."""
    if text in _SHORT_PIECES:
        return True
    if len(text) < _SHORTEST_PIECE:
        return False
    return any(form in _whole_words() and _is_long_enough(form) for form in words.forms(text))


def _is_long_enough(form: str) -> bool:
    # Three-letter words of exporters ("con", "env", "ver") occur inside almost any word.
    return len(form) > _SHORTEST_PIECE or (len(form) == _SHORTEST_PIECE and form not in words.TOOL_WORDS)


def _meant(word: str) -> str | None:
    """Return the only long word of the table that differs from `word` by one typing error; None if not unique."""
    near = {known for known in _slip_targets() if _is_slip(word, known)}
    return near.pop() if len(near) == 1 else None


def _is_slip(written: str, known: str) -> bool:
    """Return True if one letter is missing, surplus, swapped with its neighbour, or another vowel.

    A replaced consonant does not count, since it usually makes a different word (painter, printer).
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
    """Return the row and the words of every noun and synonym, by its words written together."""
    spelled = ((name.replace("-", " ").split(), row) for row in table() for name in (row.noun, *row.synonyms))
    return {"".join(parts): (row, tuple(parts)) for parts, row in spelled}


@cache
def _vocabulary() -> frozenset[str]:
    """Return every word that can be part of a noun or can name its place or material."""
    parts = {part for _, spelled in nouns().values() for part in spelled}
    return frozenset({*nouns(), *parts, *words.PLACE_WORDS, *words.MATERIAL_WORDS})


@cache
def _whole_words() -> frozenset[str]:
    return (frozenset({*nouns(), *words.MATERIAL_WORDS}) | side_words()) - words.PREPOSITIONS


@cache
def _slip_targets() -> tuple[str, ...]:
    return tuple(word for word in sorted(_vocabulary()) if len(word) >= _SHORTEST_SLIP)


@cache
def side_words() -> frozenset[str]:
    """Return the words that stand beside a noun and are not objects themselves."""
    return (
        words.TOOL_WORDS
        | words.MODIFIERS
        | words.COLOURS
        | words.TOY_WORDS
        | frozenset(words.SOUNDING)
        | words.PREPOSITIONS
        | frozenset(words.PLACE_WORDS)
    )
