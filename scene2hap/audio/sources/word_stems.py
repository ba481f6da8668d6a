"""Stems of words, for comparison in sound sources: "Washing machines" equals "washer", "humming" equals "hum".

Stems are keys, not English: both sides of a comparison go through `stems`, so it does not matter that "machine"
becomes "machin".
"""

from __future__ import annotations

import re
import unicodedata
from functools import cache
from itertools import pairwise

# Spelling (plain English) -> the usual short name of the same thing; only where the last word alone is not enough.
_SAME_THING = {
    "air conditioner": "aircon",
    "air conditioning": "aircon",
    "air con": "aircon",
    "automobile": "car",
    "cellphone": "phone",
    "chain saw": "chainsaw",
    "coffee machine": "coffeemaker",
    "coffee maker": "coffeemaker",
    "dish washer": "dishwasher",
    "espresso machine": "coffeemaker",
    "fridge": "refrigerator",
    "game controller": "gamepad",
    "hair drier": "hairdryer",
    "hair dryer": "hairdryer",
    "hoover": "vacuum",
    "laundry machine": "washer",
    "lawn mower": "lawnmower",
    "leaf blower": "leafblower",
    "microwave oven": "microwave",
    "motor bike": "motorcycle",
    "motorbike": "motorcycle",
    "mower": "lawnmower",
    "saucepan": "pan",
    "shaving machine": "shaver",
    "smartphone": "phone",
    "smart watch": "smartwatch",
    "television": "tv",
    "tooth brush": "toothbrush",
    "vacuum cleaner": "vacuum",
    "washing machine": "washer",
}

_ANYTHING = "box item object part piece thing"
_SAYS_NOTHING = (
    f"{_ANYTHING} appliance cleaner device equipment gadget instrument machine maker player system tool unit"
)

_AFTER_THE_HEAD = re.compile(r"\b(?:of|on|in|with|for|at|from|to|by|under|near)\b|[(,;:/]")
_LONGEST_NAME = max(len(name.split()) for name in _SAME_THING)


def stems(text: str) -> tuple[str, ...]:
    """Return the stems of a text or file name in order: lower case, without numbers and endings, one for synonyms."""
    words = [_stem(word) for word in _spelled(text)]
    found: list[str] = []
    while words:
        for n in range(min(_LONGEST_NAME, len(words)), 0, -1):
            name = _names().get(tuple(words[:n]))
            if name is not None or n == 1:
                found.append(name if name is not None else words[0])
                words = words[n:]
                break
    return tuple(found)


def joined_stems(text: str) -> tuple[str, ...]:
    """Return the stems of each two neighbouring words, written as one: the stem of "windmill" for "WindMill"."""
    return tuple(_stem(first + second) for first, second in pairwise(_spelled(text)))


def noun_phrase(category: str) -> tuple[str, ...]:
    """Return the stems of a category's noun phrase, head noun last: ("pan",) for "pan on a heater". Empty if none."""
    phrases = (stems(part) for part in _AFTER_THE_HEAD.split(category.lower()))
    return next((phrase for phrase in phrases if phrase), ())


def says_nothing(word: str) -> bool:
    """Return True if a word, or its stem, names no kind of thing by itself: "machine" may be any machine."""
    return _stem(word.lower()) in _stems_of(_SAYS_NOTHING)


def is_anything(word: str) -> bool:
    """Return True if a word, or its stem, may be any object: "Box_01" may be anything, but no "box fan"."""
    return _stem(word.lower()) in _stems_of(_ANYTHING)


def spelled_phrase(category: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the words of a category's noun phrase, as spelt, and its head: ("washing", "machine"), not "machine"."""
    spelled = unicodedata.normalize("NFC", category.lower())
    phrases = (tuple(re.findall(r"[^\W\d_]+", part)) for part in _AFTER_THE_HEAD.split(spelled))
    words = next((phrase for phrase in phrases if phrase), ())
    for n in range(min(_LONGEST_NAME, len(words)), 1, -1):
        if tuple(map(_stem, words[-n:])) in _names():
            return words, words[-n:]
    return words, words[-1:]


def _spelled(text: str) -> list[str]:
    # File names of macOS have an accent as a character of its own, which would end the word.
    spaced = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", unicodedata.normalize("NFC", text))
    return re.findall(r"[^\W\d_]+", spaced.lower())


@cache
def _stems_of(words: str) -> frozenset[str]:
    return frozenset(map(_stem, words.split()))


@cache
def _names() -> dict[tuple[str, ...], str]:
    return {tuple(map(_stem, spelling.split())): _stem(name) for spelling, name in _SAME_THING.items()}


def _stem(word: str) -> str:
    if len(word) > 4 and word.endswith("ies"):
        word = word[:-3] + "y"
    elif len(word) > 4 and word.endswith(("ches", "shes", "sses", "xes", "zes")):
        word = word[:-2]
    elif len(word) > 3 and word.endswith("s") and not word.endswith(("ss", "us", "is")):
        word = word[:-1]
    # "ring" and "string" have no vowel before -ing, so -ing belongs to the word.
    if word.endswith("ing") and len(word) > 4 and re.search("[aeiouy]", word[:-3]):
        word = word[:-3]
    if len(word) > 2 and word[-1] == word[-2]:
        word = word[:-1]
    return word[:-1] if len(word) > 2 and word.endswith("e") else word
