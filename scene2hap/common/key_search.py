"""Find a key in a text, in every spelling that software commonly gives it.

The text is stripped of escapes repeatedly, and the result is reduced to letters and digits without case. In it the key
is searched as it is, backwards, and in codes of letters and digits (hex, base64, base32, decimal and binary numbers; of
UTF-8, UTF-16 and UTF-32; some applied twice). So line folds, separators, quotes and padding do not matter. Three
quarters of the key in a row count as the key.

Codes with punctuation (base85, uuencode), ciphers, compression and hashes are not found: a malicious server has endless
ways to reveal its clients' keys. Shorter parts, such as a key split over two headers, are not found either.
"""

from __future__ import annotations

import base64
import html
import re
from bisect import bisect_right
from collections.abc import Iterator
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

from scene2hap.common.checks import MASK

_ROUNDS = 5
"""Most levels of nested escapes that are undone; assumed."""
_SHORTEST = 8
"""Least letters and digits of a key for this search. A shorter key is only searched as a plain string."""
_FOLD = 8
"""Most white space within a key that is folded over lines."""
_CERTAIN = 12
"""Letters and digits that cannot match by accident; assumed. A key with fewer must match completely."""

# Every repetition is bounded. Otherwise a text of backslashes or zeros would take quadratic time.
_ESCAPE = re.compile(
    r"""\x1b\[[0-9;]{0,20}[A-Za-z]                       # what a terminal obeys
    | %([0-9A-Fa-f]{2})                                  # addresses
    | \\{1,8}(?:u\{?0{0,8}([0-9A-Fa-f]{2,4})\}?|U0{0,6}([0-9A-Fa-f]{2})|x([0-9A-Fa-f]{2})|([0-7]{3})|[nrtbf0])
    | \\{1,8}                                            # JSON, C, Python
    | &\#0{0,8}([0-9]{2,3}); | &\#[xX]0{0,8}([0-9A-Fa-f]{2}); | (&[A-Za-z]{2,8};)
    | =\r?\n | =([0-9A-F]{2})                            # quoted-printable
    | 0x(?=[0-9A-Fa-f]{2}(?![0-9A-Fa-f]))
    | ([\uff01-\uff5e])                                  # the full width of East Asian texts
    """,
    re.VERBOSE,
)
_BASES = {1: 16, 2: 16, 3: 16, 4: 16, 5: 8, 6: 10, 7: 16, 9: 16}
_NAMED, _WIDE = 8, 10
_LETTERS = re.compile(r"[A-Za-z0-9]+")


def masked(text: str, key: str) -> str:
    """Replace each occurrence of the key in a text by `MASK`, in any spelling."""
    spans = [(found.start(), found.end()) for found in re.finditer(re.escape(key), text)] if key else []
    needles = _needles(key)
    levels: list[_Level] = []
    for _ in range(_ROUNDS if needles else 0):
        read = levels[-1].text if levels else text
        letters = _only_letters(read)
        for start, end in _found(letters.text.lower(), read, letters, needles, key):
            for level in reversed(levels):
                start, end = level.span(start, end)
            spans.append((start, end))
        if (bare := _unescaped(read)) is None:
            break
        levels.append(bare)
    return _with_mask(text, spans)


class _Level(NamedTuple):
    """A text made from another, as pieces: where each begins in both texts, and where it ends in the other one."""

    text: str
    begins: list[int]
    origins: list[int]
    ends: list[int]

    def span(self, start: int, end: int) -> tuple[int, int]:
        """Return the span in the other text for the span from `start` to before `end` in this one."""
        first, last = bisect_right(self.begins, start) - 1, bisect_right(self.begins, end - 1) - 1
        return self._at(first, start), max(self._at(last, end - 1) + 1, self._whole(last))

    def _at(self, piece: int, place: int) -> int:
        return min(self.origins[piece] + place - self.begins[piece], self.ends[piece] - 1)

    def _whole(self, piece: int) -> int:
        """Return the end of a piece that is an escape, which stands for one character; 0 for a copied piece."""
        after = self.begins[piece + 1] if piece + 1 < len(self.begins) else len(self.text)
        is_escape = after - self.begins[piece] < self.ends[piece] - self.origins[piece]
        return self.ends[piece] if is_escape else 0


def _unescaped(text: str) -> _Level | None:
    """Undo one round of escapes in a text. Returns None if there are none."""
    pieces: list[tuple[int, int, str]] = []
    at = 0
    for found in _ESCAPE.finditer(text):
        if found.start() > at:
            pieces.append((at, found.start(), text[at : found.start()]))
        pieces.append((found.start(), found.end(), _meaning(found)))
        at = found.end()
    if not pieces:
        return None
    pieces.append((at, len(text), text[at:]))
    return _level(pieces)


def _meaning(found: re.Match[str]) -> str:
    group = found.lastindex
    if group is None:
        return ""
    if group == _NAMED:
        meant = html.unescape(found[0])
        return meant if len(meant) == 1 else " "
    if group == _WIDE:
        return chr(ord(found[0]) - 0xFEE0)
    code = int(found[group], _BASES[group])
    return chr(code) if code < 0x80 else " "


def _only_letters(text: str) -> _Level:
    return _level([(found.start(), found.end(), found[0]) for found in _LETTERS.finditer(text)])


def _level(pieces: list[tuple[int, int, str]]) -> _Level:
    kept = [piece for piece in pieces if piece[2]]
    begins, length = [], 0
    for _, _, made in kept:
        begins.append(length)
        length += len(made)
    return _Level("".join(made for _, _, made in kept), begins, [p[0] for p in kept], [p[1] for p in kept])


class _Needle(NamedTuple):
    """Letters and digits to search, the least match in a row, and how many neighbours hold bits of the key."""

    letters: str
    enough: int
    around: int
    is_backwards: bool


def _found(lower: str, read: str, letters: _Level, needles: tuple[_Needle, ...], key: str) -> Iterator[tuple[int, int]]:
    """Yield the spans of the needles in the text `read`; `lower` has its letters and digits in lower case."""
    before, after = _punctuation(key)
    for needle in needles:
        width = (needle.enough + 1) // 2
        for offset in range(0, len(needle.letters) - width + 1, width):
            seed, at = needle.letters[offset : offset + width], -1
            while (at := lower.find(seed, at + 1)) >= 0:
                low, high = _grown(lower, needle.letters, at, offset, width)
                if high - low < needle.enough:
                    continue
                start, end = letters.span(low, high)
                if needle.around:
                    yield _with_neighbours(read, start, end, needle.around)
                else:
                    left, right = (after, before) if needle.is_backwards else (before, after)
                    yield _past(read, start, -1, left), _past(read, end, 1, right)
                at = high - 1


def _grown(lower: str, needle: str, at: int, offset: int, width: int) -> tuple[int, int]:
    """Extend a matching part of a needle to both sides as far as the text matches. Returns its span."""
    low, high, left, right = at, at + width, offset, offset + width
    while low > 0 and left > 0 and lower[low - 1] == needle[left - 1]:
        low, left = low - 1, left - 1
    while high < len(lower) and right < len(needle) and lower[high] == needle[right]:
        high, right = high + 1, right + 1
    return low, high


def _with_neighbours(read: str, start: int, end: int, around: int) -> tuple[int, int]:
    """Extend a span to the characters beside a code that hold bits of the key, and to its padding."""
    while around and start > 0 and (read[start - 1].isalnum() or read[start - 1] in "+/-_"):
        start, around = start - 1, around - 1
    right = re.compile(r"[\w+/-]{0,3}={0,6}").match(read, end)
    return start, right.end() if right else end


def _past(read: str, place: int, step: int, punctuation: str) -> int:
    """Return the position past the punctuation at an end of a key, as far as it is there, even if folded."""
    reached, left = place, len(punctuation)
    while left and 0 <= (at := place if step > 0 else place - 1) < len(read):
        if read[at] in punctuation:
            left, reached = left - 1, place + step
        elif not read[at].isspace() or abs(place - reached) > _FOLD:
            break
        place += step
    return reached


def _punctuation(key: str) -> tuple[str, str]:
    """Return the characters before a key's first and after its last letter or digit."""
    found = list(_LETTERS.finditer(key))
    return (key[: found[0].start()], key[found[-1].end() :]) if found else ("", "")


@lru_cache(maxsize=8)
def _needles(key: str) -> tuple[_Needle, ...]:
    if len(_skeleton(key)) < _SHORTEST:
        return ()
    made = {_skeleton(text): (around, text == key[::-1]) for text, around in reversed(list(_spelled(key)))}
    return tuple(_Needle(letters, _enough(letters), *how) for letters, how in made.items())


def _enough(letters: str) -> int:
    return max(-(-len(letters) * 3 // 4), min(len(letters), _CERTAIN))


def _spelled(key: str) -> Iterator[tuple[str, int]]:
    """Yield the key in codes of letters and digits, each with the number of neighbours that hold bits of it."""
    for plain in (key, key[::-1]):
        raw = plain.encode("utf-8", "replace")
        yield plain, 0
        yield "".join(f"{byte}" for byte in raw), 0
        yield "".join(f"{byte:08b}" for byte in raw), 0
        # Big-endian codes match too: they differ from little-endian ones only by one byte at the end.
        for data in (raw, plain.encode("utf-16-le", "replace"), plain.encode("utf-32-le", "replace")):
            yield data.hex(), 0
            yield from ((code, 2) for code in _base_n(data, 6))
            yield from ((code, 2) for code in _base_n(data, 5))
    raw = key.encode("utf-8", "replace")
    once = [raw.hex(), *_base_n(raw, 6)]
    for code in once:
        yield code.encode().hex(), 2
        yield from ((twice, 3) for twice in _base_n(code.encode(), 6))


def _base_n(data: bytes, bits: int) -> Iterator[str]:
    """Yield base64 (6 bits) or base32 (5) of data at each offset in a group, without characters shared with others."""
    encode, group = (base64.b64encode, 3) if bits == 6 else (base64.b32encode, 5)
    for before in range(group):
        first, last = -(-before * 8 // bits), (before + len(data)) * 8 // bits
        yield encode(bytes(before) + data).decode("ascii")[first:last]


def _skeleton(text: str) -> str:
    return "".join(_LETTERS.findall(text)).lower()


def _with_mask(text: str, spans: list[tuple[int, int]]) -> str:
    merged: list[tuple[int, int]] = []
    for start, end in sorted(spans):
        if merged and start <= merged[-1][1]:
            merged[-1] = merged[-1][0], max(end, merged[-1][1])
        else:
            merged.append((start, end))
    edges = [0, *(edge for span in merged for edge in span), len(text)]
    return MASK.join(text[start:end] for start, end in list(pairwise(edges))[::2])
