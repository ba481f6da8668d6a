"""Calls that can be skipped: copies of analysed objects, and objects that no vibration reaches."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping
from typing import Any

from scene2hap.contact.graph import ContactGraph
from scene2hap.llm.prompts.quoting import clean
from scene2hap.scene.copies import copy_key
from scene2hap.scene.hinges import KinematicChain
from scene2hap.scene.names import name_words
from scene2hap.scene.objects import VERTICAL, Contact
from scene2hap.scene.snapshot import SceneSnapshot

_DIGITS = 4
"""Decimals of rounded lengths: tenths of a millimetre."""
_BELOW = 0.5
"""Least absolute cosine between the normal of a supporting contact and the vertical."""


def copies(scene: SceneSnapshot, graph: ContactGraph, chains: Mapping[str, KinematicChain]) -> dict[str, str]:
    """Return the representative of each object: the first in scene order with equal kind and equal support.

    Objects of one kind are copies (`scene.copies`). Supports are compared by kind. So six handles on six equal
    drawers have one representative, but a pan on the stove and a pan on the table have two. Of an object without a
    support, the kinds of all objects that touch it are compared. So are those of objects that hinges join.

    Parameters: chains : of `scene.hinges`.
    """
    kinds = {item.id: copy_key(item) for item in scene.objects}
    supports = _supports(scene, graph.contacts)
    chained = dict[str, frozenset[Hashable]]()
    for x, chain in chains.items():
        if x not in chained:
            chained.update(dict.fromkeys(chain.ids, frozenset(kinds[each] for each in chain.ids)))
    first: dict[Hashable, str] = {}
    standing_for = {}
    for item in scene.objects:
        on = supports.get(item.id) or graph.neighbours(item.id)
        key = (kinds[item.id], frozenset(kinds[other] for other in on), chained.get(item.id))
        standing_for[item.id] = first.setdefault(key, item.id)
    return standing_for


def of_any_scene(facts: Mapping[str, Any], name: str) -> dict[str, Any]:
    """Remove the surroundings from the facts about an object, so that equal objects of any scene have equal facts.

    Lengths are rounded to tenths of a millimetre, since a rotated copy of a mesh differs in the last digits.
    """
    lengths = {key: round(value, _DIGITS) for key, value in facts.items() if isinstance(value, float)}
    words = " ".join(name_words(name))
    return {
        **facts,
        **lengths,
        "object_name": clean(words) or facts["object_name"],
        "relative_height_m": None,
        "neighbour_names": [],
    }


def reachable(sources: Iterable[str], graph: ContactGraph) -> frozenset[str]:
    """Return the sources, and all objects that any number of contacts connects to a source."""
    reached, frontier = set[str](), list(sources)
    while frontier:
        object_id = frontier.pop()
        if object_id not in reached:
            reached.add(object_id)
            frontier.extend(graph.neighbours(object_id))
    return frozenset(reached)


def _supports(scene: SceneSnapshot, contacts: Iterable[Contact]) -> Mapping[str, set[str]]:
    up = VERTICAL[scene.up_axis]
    found: dict[str, set[str]] = {}
    for contact in contacts:
        rise = contact.normal[up] if contact.normal is not None else 0.0
        if rise >= _BELOW:  # normals point from a to b
            found.setdefault(contact.b, set()).add(contact.a)
        elif rise <= -_BELOW:
            found.setdefault(contact.a, set()).add(contact.b)
    return found
