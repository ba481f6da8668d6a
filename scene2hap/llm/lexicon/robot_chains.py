"""Reading the names of a robot's links from the chain that hinges join them to.

Few links are named for what they are: a hand has a "palm", a Sawyer an arm of "right_l0" to "right_l6" and a "screen".

1. A chain is a robot's if some of its names are those of robots' links and few name other objects: a lamp has arms too.
   The word "link" is added to each name, since a hinge makes an object a link: "right_wrist", "palm", "head_roll".
2. So is a chain whose names say nothing at all, if its series is as long as an arm's.
3. In a robot's chain, a name that says nothing is a robot's link. A name of something else stays: a wheel, a camera.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from scene2hap.llm.lexicon import word_split, words
from scene2hap.llm.lexicon.names import NameReading, read_name
from scene2hap.llm.lexicon.table import Role

_OUTNUMBER = 3
"""Names of robots' links for each name of another object, above which a chain is a robot's; assumed. Desk lamps have up
to three arms."""
_SERIES_OF_AN_ARM = range(6, 13)
"""Objects in an arm's longest series, each held on the one before; assumed. Six joints reach any pose. Nothing else has
so many joints in a row, but ropes and chains, which have more or are called so."""

# Assumed, below the confidence in names that say what an object is, and above that in unknown ones.
_BY_NAMES, _BY_SERIES = 0.5, 0.3


def link_of_robot(reading: NameReading, chain_names: Sequence[str], n_in_series: int) -> tuple[NameReading, str] | None:
    """Return the reading of an object as a robot's link by its chain, and the reason; None if its own name tells, or
    the chain is not a robot's.

    Parameters: chain_names : the names of all objects of its chain, empty without one; n_in_series : objects in its
    longest series, each held on the one before.
    """
    if not _is_ambiguous(reading):
        return None
    links = _links(tuple(chain_names), n_in_series)
    if links is None:
        return None
    others = [name for name in links if name != reading.name] or links
    seen = f"it with {', '.join(map(repr, others[:3]))}" if links else f"a series of {n_in_series} objects here"
    why = f"Hinges join {seen}, so it is taken for a robot's link."
    trust = _BY_NAMES if links else _BY_SERIES
    row = word_split.nouns()["robotpart"][0]
    return replace(reading, row=row, confidence=trust, head="", unread=(), whole=None), why


@lru_cache(maxsize=256)
def _links(chain_names: tuple[str, ...], n_in_series: int) -> tuple[str, ...] | None:
    """Return the names of a chain that are those of robots' links, () if only its length says that it is a robot's;
    None if it is not."""
    links = tuple(name for name in chain_names if _is_link(name))
    if links:
        # A wheel or a door belongs to something in the chain, be it a robot or not.
        n_others = sum(role != "part" for role in map(_other_role, chain_names) if role is not None)
        return links if len(links) > _OUTNUMBER * n_others else None
    says_nothing = all(_other_role(name) is None for name in chain_names)
    return () if says_nothing and n_in_series in _SERIES_OF_AN_ARM else None


def _is_link(name: str) -> bool:
    """Return True if a name is that of a robot or of its link, with the word "link" or without. An arm or a leg alone
    is none: lamps and tables have them."""
    reading = read_name(name)
    if reading.row is None or reading.head in words.LINK_NOUNS:
        reading = _as_link(name)
        if not words.ROBOT_LIMBS.keys().isdisjoint(reading.words) and words.ROBOT_JOINTS.isdisjoint(reading.words):
            return False
    return reading.row is not None and reading.row.noun in words.ROBOTS and not reading.toy


def _other_role(name: str) -> Role | None:
    """Return the role of the object that a name tells; None if it tells none, or may be a robot's link."""
    reading = read_name(name)
    if reading.row is None or reading.row.noun in words.ROBOTS or _is_ambiguous(reading):
        return None
    return reading.row.role


def _is_ambiguous(reading: NameReading) -> bool:
    """Return True if a name says nothing, or may be that of a robot's link."""
    if reading.row is None or reading.head in words.LINK_NOUNS:
        return True
    linked = _as_link(reading.name).row
    return reading.row.noun not in words.ROBOTS and linked is not None and linked.noun in words.ROBOTS


def _as_link(name: str) -> NameReading:
    return read_name(f"{name} link")
