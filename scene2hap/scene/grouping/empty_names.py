"""Names that say nothing: those that exporters and modelling tools give when nobody has named an object."""

from __future__ import annotations

from dataclasses import replace

from scene2hap.scene.copies import name_words
from scene2hap.scene.snapshot import SceneSnapshot

_WORDS = (
    "object objects obj body link base root world node mesh geom geometry group default scene model main visual "
    "vis collision col part entity untitled unnamed noname polygon poly surface shape primitive "
    "pivot offset locator null empty game transform wrapper "
    "cube sphere icosphere uvsphere cylinder plane circle cone torus capsule"
)
_EMPTY = frozenset(_WORDS.split())
"""Words without information about an object. "box" is not among them: a box is a thing."""


def says_nothing(name: str) -> bool:
    """Return True if no word of a name tells what the object is: "object", "base_link", "Cube.001", "world/body1"."""
    return all(word in _EMPTY for word in name_words(name))


def named_after_file(snapshot: SceneSnapshot, stem: str) -> SceneSnapshot:
    """Give the only object of a file the file's name, if its own says nothing. Its id stays, for links to engines."""
    item = snapshot.objects[0]
    if len(snapshot.objects) > 1 or not says_nothing(item.name) or says_nothing(stem):
        return snapshot
    return replace(snapshot, objects=(replace(item, name=stem),))
