"""Queries for a sound, from the fullest wording to the shortest.

Freesound requires every word to match, so fewer words find more. The last query is the object's name alone, unless that
is too general ("machine").
"""

from __future__ import annotations

import re
import unicodedata

from scene2hap.audio.sources.word_stems import says_nothing, spelled_phrase
from scene2hap.haptics import VibrationDescription

LONGEST_QUERY = 80


def queries_for(description: VibrationDescription) -> tuple[str, ...]:
    """Return queries in the order to try: all key words; category; head noun with verb; head noun. It may be empty."""
    keywords = _words(description.keywords)
    name, head = spelled_phrase(description.object_category)
    spoken = tuple(word for word in keywords if word not in name)
    wordings = [keywords, name, (*head, *spoken), head]
    kept = [words for words in wordings if words and not (len(words) == 1 and says_nothing(words[0]))]
    return tuple(dict.fromkeys(" ".join(words)[:LONGEST_QUERY].strip() for words in kept))


def _words(text: str) -> tuple[str, ...]:
    """Return words without signs: a minus would exclude the next word, quotation marks would join words to a phrase."""
    return tuple(re.findall(r"[^\W_]+", unicodedata.normalize("NFC", text.lower())))
