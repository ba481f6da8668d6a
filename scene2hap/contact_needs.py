"""Match of an object with the contact that a state needs, by meaning: "stove" also matches a "gas hob".

Language models and people write such a need in everyday words, while the category of the object may use other words. A
comparison of the texts alone would rarely match.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache

_NO_NEED = frozenset(
    {"", "none", "null", "nil", "nothing", "no", "not needed", "not required", "not applicable", "n a", "na", "false"}
)
"""Words for no need of a contact."""

_SAME = (
    "stove; stove top; stovetop; cooktop; cook top; cooker top; hob; cooker; cooking plate; cooking surface; "
    "cooking appliance; range; range cooker; range top; hot plate; hotplate; heating plate; burner; ring burner; "
    "gas ring; cooking ring; cooking zone; heater; heating element; heat source; heated surface; oven; camp fire; "
    "campfire; fire; fire pit; flame; heat; fireplace; grill; barbecue; furnace; wood burner; electric plate; "
    "induction plate",
    "table; desk; table top; tabletop; desktop; desk top",
    "worktop; work top; countertop; counter top; counter; bench top; benchtop; work surface; work bench; workbench",
    "road; street; roadway; asphalt; pavement; tarmac",
    "floor; ground; flooring",
    "sofa; couch; settee",
    "refrigerator; fridge",
    "television; tv; tv set",
    "faucet; tap",
    "sink; basin; washbasin; wash basin",
    "mains; socket; wall socket; power socket; outlet; power outlet; electrical outlet; wall outlet; plug socket",
    "charger; charging station; charging base; charging dock; charging pad; docking station; dock",
)
"""Groups of everyday nouns that are equivalent as a needed object. Assumed."""

_TOY = frozenset({"toy", "miniature", "fake", "model", "replica", "doll"})
_BESIDE = frozenset({"a", "an", "the", "any", "some", "its", "on", "in", "at", "with", "of", "touching", "contact"})
_UNKNOWN = frozenset(
    {"unknown", "undefined", "unidentified", "unclear", "undetermined", "uncertain", "unbekannt", "inconnu", "inconnue",
     "desconocido", "desconocida", "desconhecido", "desconhecida", "sconosciuto", "sconosciuta", "onbekend", "nieznany",
     "\u672a\u77e5", "\u4e0d\u660e", "\u043d\u0435\u0438\u0437\u0432\u0435\u0441\u0442\u043d\u043e"}
)  # fmt: skip
"""First words of a category that names nothing; models answer in the language of a user's prompt. Assumed."""
_NO_CATEGORY = frozenset({"", "none", "null", "n/a", "na", "not applicable", "?", "-"})
_LONGEST = 200  # most letters of a need or a category that are read; assumed

Words = tuple[str, ...]


def is_unknown(category: str) -> bool:
    """Return True if a category, of an object or of a material, is a word for unknown, such as "unknown material"."""
    text = category.casefold().strip()
    return text in _NO_CATEGORY or text.split()[0].strip(".,;:()") in _UNKNOWN


def stated(needed: str | None) -> str | None:
    """Return a need, or None if its words mean that there is none ("", "none", "null")."""
    if needed is None or " ".join(_words(needed)) in _NO_NEED:
        return None
    return needed


@lru_cache(maxsize=4096)
def meets(needed: str, object_id: str, category: str) -> bool:
    """Return True if an object is the needed one, by its id or its category. If the category is unknown, the words of
    its id are compared.

    Either object meets "stove or oven". "gas stove", "stove" and "hob" meet each other. A toy stove or a stove door
    meets none of them.
    """
    if needed == object_id or _words(needed) == _words(object_id):
        return True
    thing = _words(object_id if is_unknown(category) else category)
    return any(_are_same(wanted, thing) for wanted in _alternatives(needed))


def unmet(needed: str, categories: Mapping[str, str], of: str) -> bool:
    """Return True if no object except `of` is the needed one, given the category of each object by id."""
    return not any(meets(needed, object_id, category) for object_id, category in categories.items() if object_id != of)


def _are_same(wanted: Words, thing: Words) -> bool:
    if not wanted or not thing or bool(_TOY & set(thing)) != bool(_TOY & set(wanted)):
        return False
    # "plate" is the last word of "hot plate", but another object. If a group applies, only the group counts.
    if (kind := _kind(wanted)) is not None or _kind(thing) is not None:
        return kind == _kind(thing)
    shorter, longer = sorted((wanted, thing), key=len)
    return longer[len(longer) - len(shorter) :] == shorter


def _kind(words: Words) -> int | None:
    """Return the group of synonyms of the last words of a phrase, None if there is none."""
    return next((found for start in range(len(words)) if (found := _GROUPS.get(words[start:])) is not None), None)


def _alternatives(needed: str) -> list[Words]:
    plain = re.sub(r"\([^)]*\)", " ", needed[:_LONGEST])
    return [tuple(word for word in _words(part) if word not in _BESIDE) for part in re.split(r"\bor\b|[/,;|]", plain)]


def _words(text: str) -> Words:
    """Return the words of a text in lower case and singular, split at signs, digits and capitals."""
    apart = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", text[:_LONGEST])
    return tuple(map(_singular, re.findall(r"[^\W\d_]+", apart.casefold())))


def _singular(word: str) -> str:
    if len(word) < 4 or not word.endswith("s") or word.endswith(("ss", "us", "is")):
        return word
    return word[:-2] if word.endswith(("ches", "shes", "sses", "xes")) else word[:-1]


_GROUPS: Mapping[Words, int] = {_words(noun): number for number, nouns in enumerate(_SAME) for noun in nouns.split(";")}
