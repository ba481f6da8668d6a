"""Words of authored names: split at capitals and inside run-together words, with plurals and typing errors resolved."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache, lru_cache, partial

from scene2hap.common.printable import without_accents
from scene2hap.llm.lexicon import translations, words
from scene2hap.llm.lexicon.table import ObjectRow, table

# Confidence in a word that was translated, split or corrected. Assumed.
_TRANSLATED = 0.9
_RUN_TOGETHER = 0.9
_SLIP = 0.6

_COUNTED = re.compile(r"(?<!\d)(?:[2-9]|1\d)[\W_]*([^\W\d_]+)")
_ATTACHED = re.compile(r"(?<![^\W_])(?:[2-9]|[1-9]\d+)([^\W\d_]+)")

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
_SHORTEST_WITH_VOWELS = 6  # letters; of words that miss some of their vowels
_SHORTEST_SLIP_BESIDE = 5  # letters; beside the other word of a noun


def read_words(name: str) -> tuple[list[str], float]:
    """Return the words of a name, translated, split and corrected, and the confidence in them [0..1]."""
    trust = 1.0
    tokens: list[str] = []
    for word in _in_english_order(_joined(_without_shades(split_words(name)))):
        pieces, factor = (("automatic",), 1.0) if _is_automatic(word, tokens) else _known_pieces(word)
        tokens.extend(pieces)
        trust *= factor
    for i, meant in _meant_beside(tokens):
        tokens[i] = meant
        trust *= _SLIP
    return tokens, trust


def _is_automatic(word: str, before: Sequence[str]) -> bool:
    """Return True if "auto" says how an object works, as in "door_auto"; alone, or after "toy", it is a foreign car."""
    last = before[-1] if before else ""
    return word == "auto" and last not in words.TOY_WORDS and any(form in nouns() for form in words.forms(last))


def counted_words(name: str) -> frozenset[str]:
    """Return the words directly after a number from 2 to 19, as read: "seats" in "Sofa 2 seats".

    Only plurals count. Serials have zeros.
    """
    return frozenset(word for word in _first_words(_COUNTED, name) if len(tuple(words.forms(word))) > 1)


def words_with_number(name: str) -> frozenset[str]:
    """Return the words that a number is written onto: "door" in "fridge_2door", but not in "Fridge2Door"."""
    return frozenset(_first_words(_ATTACHED, name))


def _first_words(pattern: re.Pattern[str], name: str) -> Iterator[str]:
    """Yield the first word, as read, of each run of letters that a pattern finds."""
    after = (next(_at_capitals(run)).casefold() for run in pattern.findall(_plain(name)))
    return (_known_pieces(word)[0][0] for word in after)


def split_words(name: str) -> list[str]:
    """Split a name into words in lower case, without digits, accents, signs and the possessive "'s"."""
    plain = re.sub(r"['\u2019]s\b", "", _plain(name))
    return [part.casefold() for run in re.findall(r"[^\W\d_]+", plain) for part in _at_capitals(run)]


def _plain(name: str) -> str:
    """Return a name without hashes and accents."""
    return without_accents(_HASH.sub(" ", name))


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
    """Put the kind of a foreign object before it: "porte de garage" becomes "garage porte", "rueda camion" the reverse.

    Without a word like "de", a machine stays before the next word, since packs also write "camion_rueda".
    """
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
        elif ordered and _is_kind_of(ordered[-1], word):
            ordered.insert(-1, word)
        else:
            ordered.append(word)
    return ordered


def _is_kind_of(thing: str, word: str) -> bool:
    """Return True if two words, of which one is foreign, are a thing and then its kind in a Romance language."""
    if not (_is_foreign(thing) or _is_foreign(word)):
        return False
    things, kinds = _nouns_by_language(thing), _nouns_by_language(word)
    shared = things.keys() & kinds.keys()
    entries = [nouns().get("".join(things[name])) for name in shared & translations.ROMANCE]
    is_object = all(entry is not None and not entry[0].vibrates for entry in entries)
    return bool(entries) and is_object and shared.isdisjoint(translations.COMPOUNDING)


def _nouns_by_language(word: str) -> Mapping[str, tuple[str, ...]]:
    """Return the English words of a word in each language that has it; an English noun is foreign only if shared."""
    single = next((form for form in words.forms(word) if form in nouns()), None)
    if single is None:
        return translations.by_language(word)
    return dict.fromkeys(translations.LANGUAGES, (single,)) if single in translations.SHARED else {}


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
    meaning = translations.compound(word, is_known)
    if meaning:
        return meaning, _TRANSLATED * _RUN_TOGETHER
    meant = _with_vowels(word) or _meant(word)
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


def _with_vowels(word: str) -> str | None:
    """Return the only word of a noun that `word` is without some or all vowels ("tbl", "prnter"); None if not unique.

    A word that keeps some vowels is a long one, since short ones differ by as little ("stars", "stairs").
    """
    consonants = _consonants(word)
    if len(consonants) < _SHORTEST_PIECE or (consonants != word and len(word) < _SHORTEST_WITH_VOWELS):
        return None
    near = [known for known in _by_consonants().get(consonants, ()) if known != word and _is_within(word, known)]
    return near[0] if len(near) == 1 else None


def _consonants(word: str) -> str:
    return word[:1] + re.sub("[aeiou]", "", word[1:])


def _is_within(short: str, word: str) -> bool:
    """Return True if `short` is a word without some of its letters."""
    letters = iter(word)
    return all(letter in letters for letter in short)


def _meant_beside(tokens: Sequence[str]) -> Iterator[tuple[int, str]]:
    """Yield each unknown word that is one typing error away from the other word of a noun: "coffe" before "machine".

    Beside the other word a shorter word and a replaced consonant count, too: a "washing mashine" is a machine.
    """
    for i, word in enumerate(tokens):
        if len(word) < _SHORTEST_SLIP_BESIDE or is_known(word):
            continue
        is_slip = partial(_is_slip, word, consonants=True)
        near = {
            *(first for first, last in _pairs() if tokens[i + 1 : i + 2] == [last] and is_slip(first)),
            *(last for first, last in _pairs() if i and tokens[i - 1] == first and is_slip(last)),
        }
        if len(near) == 1:
            yield i, near.pop()


def _is_slip(written: str, known: str, *, consonants: bool = False) -> bool:
    """Return True if one letter is missing, surplus, swapped with its neighbour, or replaced by another vowel.

    A replaced consonant counts only with `consonants`, since it usually makes a different word (painter, printer).
    """
    if abs(len(written) - len(known)) > 1 or written[0] != known[0]:
        return False
    start = next((i for i, (a, b) in enumerate(zip(written, known, strict=False)) if a != b), None)
    if start is None:
        return len(written) != len(known)
    a, b = written[start:], known[start:]
    missing, surplus = a == b[1:], a[1:] == b
    swapped = a[:2] == b[1::-1] and a[2:] == b[2:]
    other = a[1:] == b[1:] and (consonants or (a[0] in "aeiouy" and b[0] in "aeiouy"))
    return missing or surplus or swapped or other


@cache
def nouns() -> dict[str, tuple[ObjectRow, tuple[str, ...]]]:
    """Return the row and the words of every noun and synonym, by its words written together."""
    spelled = ((name.replace("-", " ").split(), row) for row in table() for name in (row.noun, *row.synonyms))
    return {"".join(parts): (row, tuple(parts)) for parts, row in spelled}


@cache
def _pairs() -> tuple[tuple[str, str], ...]:
    """Return the words of every noun of two words."""
    return tuple((spelled[0], spelled[1]) for _, spelled in nouns().values() if len(spelled) == 2)


@cache
def _vocabulary() -> frozenset[str]:
    """Return every word that can be part of a noun or can name its place or material."""
    parts = {part for _, spelled in nouns().values() for part in spelled}
    return frozenset({*nouns(), *parts, *words.PLACE_WORDS, *words.MATERIAL_WORDS})


@cache
def _whole_words() -> frozenset[str]:
    return (frozenset({*nouns(), *words.MATERIAL_WORDS}) | side_words()) - words.PREPOSITIONS


@cache
def _by_consonants() -> dict[str, set[str]]:
    """Return the words of nouns by their first letter and the consonants after it, doubled ones also as one."""
    found: dict[str, set[str]] = {}
    for word in {part for _, spelled in nouns().values() for part in spelled}:
        consonants = _consonants(word)
        for short in {consonants, re.sub(r"(.)\1", r"\1", consonants).replace("ck", "k")}:
            found.setdefault(short, set()).add(word)
    return found


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
