"""The word by which its author calls an object, for sources that search sounds by name."""

from __future__ import annotations

import re
from functools import cache

from scene2hap.audio.sources.word_stems import noun_phrase, says_nothing, stems
from scene2hap.llm.lexicon import word_split
from scene2hap.llm.lexicon.names import read_name
from scene2hap.llm.lexicon.table import table
from scene2hap.llm.lexicon.words import MATERIAL_WORDS, TOOL_WORDS


def own_word(name: str, category: str) -> str:
    """Return the author's word for an object: "windmill" of "SM_Windmill_02", a wind turbine.

    A name that the lexicon cannot read, that it translates, or that it takes for another kind of object stays whole,
    but for numbers, single letters and the words of tools, as in "SM_Zorgon_A(Clone)". Returns "" if the category is
    the same word, or if no word says which object it is: "machine" may be anything, and "Running_Metal_Left" too.
    """
    reading = read_name(name)
    is_read = (
        reading.row is not None
        and noun_phrase(reading.row.noun)[-1:] == noun_phrase(category)[-1:]
        and set(stems(reading.head)) <= set(stems(name))
    )
    word = reading.head if is_read else " ".join(filter(_may_name, re.findall(r"[^\W\d_]+", name)))
    said = stems(word)
    tells = is_read or not _beside_nouns().issuperset(one for one in said if not says_nothing(one))
    return word if tells and set(said) != set(stems(category)) and not all(map(says_nothing, said)) else ""


def _may_name(word: str) -> bool:
    is_letter = len(word) == 1 and word.isascii()  # a Japanese noun may be one character
    return not is_letter and word.casefold() not in TOOL_WORDS


@cache
def _beside_nouns() -> frozenset[str]:
    """Return the stems of words for sides, colours, materials, places, states and movements that are no nouns too."""
    moves = {word for row in table() for state in row.states for word in (state.name, state.verb)}
    nouns = {stem for noun in word_split.nouns() for stem in stems(noun)}
    words = moves | word_split.side_words() | MATERIAL_WORDS.keys()
    return frozenset(stem for word in words for stem in stems(word)) - nouns
