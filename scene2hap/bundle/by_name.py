"""Mappings of a bundle whose error for a missing key names the most similar key."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NoReturn, TypeVar

from scene2hap.common import checks
from scene2hap.common.counted import first_of
from scene2hap.errors import UnknownObject

Thing = TypeVar("Thing")


class ByName(dict[str, Thing]):
    """A dictionary that raises UnknownObject, a kind of KeyError, for a missing key.

    Parameters: what, of_what : description of the keys, such as "state" and "of 'phone'".
    """

    def __init__(
        self, entries: Mapping[str, Thing] | Iterable[tuple[str, Thing]] = (), what: str = "entry", of_what: str = ""
    ) -> None:
        super().__init__(entries)
        self.what = what
        self.of_what = of_what

    def __missing__(self, key: object) -> NoReturn:
        known = first_of([*map(repr, self)], _MOST_NAMED) or "none"
        near = checks.did_you_mean(key, self, f"There are {known}.")
        missing = f"{self.what} {checks.represented(key)} {self.of_what}".rstrip()
        raise UnknownObject(f"the bundle has no {missing}. {near}")


def by_name(entries: Mapping[str, Thing], what: str, of_what: str = "") -> ByName[Thing]:
    """Wrap entries in a `ByName`. A `ByName` is returned unchanged."""
    return entries if isinstance(entries, ByName) else ByName(entries, what, of_what)


_MOST_NAMED = 10
