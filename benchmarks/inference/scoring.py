"""Scores of answers by hand labels; docs/inference-evaluation.md has the rules."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, fields
from functools import cache

from inference.labels import Label, read_rows
from scene2hap import ObjectHaptics

UNKNOWN = frozenset({"", "unknown", "undefined", "object", "thing", "unidentified"})
_NOTHING = frozenset({"", "unknown", "undefined", "none"})
_STUFF_ENDS = re.compile(r"\b(?:with|and|or|on|over|in|for)\b|[,/;(]")


def is_unknown(category: str) -> bool:
    """Whether a category means that the backend does not know the object."""
    return _plain(category) in UNKNOWN


def same_category(answer: str, accepted: Iterable[str]) -> bool:
    """Whether the answer is an accepted word, or a kind of it: "oak kitchen table" is a "table"."""
    words = _plain(answer).split()
    for text in accepted:
        wanted = _plain(text).split()
        if wanted and words[-len(wanted) :] == wanted:
            return True
    return "".join(words) in {_plain(text).replace(" ", "") for text in accepted}


def family(material: str) -> str | None:
    """Family of a material, by its last known word or words before "with", "and" or another of `_STUFF_ENDS`."""
    for part in _STUFF_ENDS.split(material.lower()):
        words = re.findall(r"[a-z]+", part)
        for end in range(len(words), 0, -1):
            for begin in range(end):
                found = _families().get(" ".join(words[begin:end]))
                if found is not None:
                    return found
    return None


@cache
def _families() -> dict[str, str]:
    return {word: row["family"] for row in read_rows("material_families.csv") for word in row["words"].split(";")}


def _plain(text: str) -> str:
    """Text in lower case, without punctuation, and without a final "s" of longer words."""
    words = re.findall(r"[a-z0-9]+", text.lower())
    return " ".join(
        word[:-1] if len(word) > 3 and word.endswith("s") and word[-2] not in "su" else word for word in words
    )


@dataclass(frozen=True)
class Counts:
    """Numbers of objects by kind of agreement; counts can be added."""

    objects: int = 0
    unknown: int = 0
    category_right: int = 0
    claimed_material: int = 0
    family_right: int = 0
    true_positive: int = 0
    false_positive: int = 0
    false_negative: int = 0
    true_negative: int = 0
    clear_objects: int = 0
    clear_right: int = 0

    def __add__(self, other: Counts) -> Counts:
        return Counts(*(getattr(self, item.name) + getattr(other, item.name) for item in fields(self)))

    @property
    def figures(self) -> dict[str, float | None]:
        """The shares; None where the divisor is 0."""
        known = self.objects - self.unknown
        agreed = self.true_positive + self.true_negative
        return {
            "vibrates_accuracy": _share(agreed, self.objects),
            "vibrates_precision": _share(self.true_positive, self.true_positive + self.false_positive),
            "vibrates_recall": _share(self.true_positive, self.true_positive + self.false_negative),
            "vibrates_accuracy_clear": _share(self.clear_right, self.clear_objects),
            "category_accuracy_known": _share(self.category_right, known),
            "family_accuracy_claimed": _share(self.family_right, self.claimed_material),
            "unknown_share": _share(self.unknown, self.objects),
        }


@dataclass(frozen=True)
class Judgement:
    """An object's answer and its label."""

    label: Label
    category: str
    material: str
    vibrates: bool

    @property
    def counts(self) -> Counts:
        """Counts of this one object."""
        truth, says = self.label.vibrates, self.vibrates
        known, claimed = not is_unknown(self.category), _plain(self.material) not in _NOTHING
        return Counts(
            objects=1,
            unknown=not known,
            category_right=known and same_category(self.category, self.label.categories),
            claimed_material=claimed,
            family_right=claimed and family(self.material) in self.label.families,
            true_positive=truth and says,
            false_positive=says and not truth,
            false_negative=truth and not says,
            true_negative=not truth and not says,
            clear_objects=not self.label.hard,
            clear_right=not self.label.hard and truth == says,
        )

    @property
    def misses(self) -> tuple[str, ...]:
        """Names of the fields that disagree with the label."""
        one = self.counts
        wrong = {
            "unknown": one.unknown,
            "category": not one.unknown and not one.category_right,
            "material": one.claimed_material and not one.family_right,
            "vibrates": self.label.vibrates != self.vibrates,
        }
        return tuple(field for field, is_wrong in wrong.items() if is_wrong)


def judge(label: Label, haptics: ObjectHaptics) -> Judgement:
    """Return the answer for an object with its label."""
    return Judgement(label, haptics.object_category, haptics.material_category, haptics.vibrates)


def _share(part: int, whole: int) -> float | None:
    return part / whole if whole else None
