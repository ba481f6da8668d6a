"""Table from objects and verbs to voices."""

from __future__ import annotations

from functools import cache

from scene2hap.audio.sources.synth.patch import Patch
from scene2hap.audio.sources.synth.table import MOTOR, TABLE
from scene2hap.audio.sources.word_stems import noun_phrase, stems


def patch_for(category: str, *phrases: str) -> Patch:
    """Return the patch whose name fits a category best, given phrases that may have the verb; `MOTOR` if none fits.

    The order of preference: names that have the category's head noun, names that share another word, patches made for
    the verb, names that share more words.
    """
    nouns = noun_phrase(category)
    # A boiling frying pan does not fry: words of the name are no verbs.
    spoken = {stem for phrase in phrases for stem in stems(phrase)}.difference(nouns)
    best, best_fit = MOTOR, (False, False, False, 0)
    for name, verbs, patch in _rows():
        if verbs and not verbs & spoken:
            continue
        if not name <= set(nouns):
            continue
        fit = (bool(name.intersection(nouns[-1:])), bool(name), bool(verbs), len(name))
        if fit > best_fit:
            best, best_fit = patch, fit
    return best


def patches() -> tuple[Patch, ...]:
    """Return every patch of the table, and `MOTOR`."""
    return (*dict.fromkeys(patch for _, _, patch in TABLE), MOTOR)


@cache
def _rows() -> tuple[tuple[frozenset[str], frozenset[str], Patch], ...]:
    """Return one row for each name, in stems."""
    return tuple(
        (frozenset(stems(name)), frozenset(stems(verbs)), patch)
        for names, verbs, patch in TABLE
        for name in names.split(",")
    )
