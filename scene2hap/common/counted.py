"""Numbers with their nouns, and the first of many names, in messages: "1 file", "'a', 'b' and 3 more"."""

from collections.abc import Collection
from itertools import islice


def counted(number: int, noun: str) -> str:
    """Return a number with its noun, which gets an s unless there is exactly one."""
    return f"{number:,} {noun}" if number == 1 else f"{number:,} {noun}s"


def first_of(names: Collection[str], most: int) -> str:
    """Return the first `most` names, and the number of the others."""
    left = len(names) - most
    return ", ".join(islice(names, most)) + (f" and {left:,} more" if left > 0 else "")
