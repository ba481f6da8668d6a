"""Likely mistakes in a scene, such as sizes that cannot be metres."""

from __future__ import annotations

from typing import Literal, NamedTuple

Kind = Literal[
    "units", "half-sizes", "bottoms", "quaternions", "up-axis", "floating", "sunk", "mass", "merged", "hinge"
]


class Finding(NamedTuple):
    """A probable mistake: its kind, the ids of the objects that show it, and a sentence."""

    kind: Kind
    object_ids: tuple[str, ...]
    sentence: str

    def __str__(self) -> str:
        return self.sentence
