"""The word by which its author calls an object, for sources that search sounds by name."""

from __future__ import annotations

import re

from scene2hap.audio.sources.word_stems import says_nothing, stems
from scene2hap.llm.lexicon.names import read_name


def own_word(name: str, category: str) -> str:
    """Return the author's word for an object: "windmill" of "SM_Windmill_02", a turbine.

    A name that the lexicon cannot read, that it translates, or that it takes for another object stays whole, without
    its numbers. Returns "" if the category is the same word, or if the word may be anything, such as "machine".
    """
    reading = read_name(name)
    is_read = reading.row is not None and reading.row.noun == category and set(stems(reading.head)) <= set(stems(name))
    word = reading.head if is_read else " ".join(re.findall(r"[^\W\d_]+", name))
    said = stems(word)
    return "" if set(said) == set(stems(category)) or all(map(says_nothing, said)) else word
