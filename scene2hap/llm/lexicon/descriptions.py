"""Description of one state of a vibrating object: a sentence to generate its sound, keywords to search for it."""

from __future__ import annotations

from scene2hap.llm.answers import LONGEST_NAME, VibrationAnswer
from scene2hap.llm.lexicon.names import read_name
from scene2hap.llm.lexicon.places import UNDEFINED
from scene2hap.llm.lexicon.start_times import starting_of
from scene2hap.llm.lexicon.table import StateRow

_CATEGORY_WORDS, _STATE_WORDS, _PLACE_WORDS = 4, 2, 2
_MAX_LETTERS = 24  # of one word; a longer string is not a word and would exceed the answer's bound
_ANYTHING = StateRow("", 0.0, "humming")

# Upper bounds of intensity and the adverb up to each. Assumed, on the scale of haptics.SourceState.
_STRENGTHS = ((0.15, "softly"), (0.35, "gently"), (0.65, "firmly"), (1.0, "strongly"))
_RHYTHMS = {"ticking": "regularly", "ringing": "in bursts", "alerting": "in bursts", "sounding": "in bursts"}


def describe(category: str, state_name: str, scene_category: str = "") -> VibrationAnswer:
    """Describe a state: "refrigerator humming softly and steadily while switched on in the kitchen".

    A category that is not in the table, for example from a language model, is described by its state alone.
    """
    thing = _words(category, _CATEGORY_WORDS) or "object"
    name = _words(state_name, _STATE_WORDS)
    state = _state(category, state_name)
    verb = state.verb
    if state is _ANYTHING and name.endswith("ing"):
        verb = name.split()[-1]
    rhythm = _RHYTHMS.get(state_name, "steadily")
    strength = next((adverb for bound, adverb in _STRENGTHS if 0.0 < state.intensity <= bound), "")
    parts = [thing, verb, f"{strength} and {rhythm}" if strength else rhythm]
    if name and name != verb:
        parts.append(f"while {'switched on' if name == 'on' else name}")
    place = _words(scene_category, _PLACE_WORDS)
    if place and place != UNDEFINED:
        parts.append(f"in the {place}")
    keywords = f"{thing[: LONGEST_NAME - len(verb) - 1].rstrip()} {verb}"
    starting = starting_of(read_name(category).row, verb)
    return VibrationAnswer(sentence=" ".join(parts), keywords=keywords, **starting)


def _state(category: str, state_name: str) -> StateRow:
    row = read_name(category).row
    return next((state for state in row.states if state.name == state_name), _ANYTHING) if row else _ANYTHING


def _words(text: str, most: int) -> str:
    """Return the first words of a text, without forms of "vibrate": they describe no particular movement."""
    kept = [word[:_MAX_LETTERS] for word in text.split() if "vibrat" not in word.casefold()]
    return " ".join(kept[:most])
