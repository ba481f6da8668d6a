"""The objects, hands and sources behind the numbers in binary frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from scene2hap.common import checks
from scene2hap.errors import BridgeError, UnknownObject
from scene2hap.scene.objects import unknown_object

N_KEPT = 8
"""Number of layouts that are still accepted; older ones are outdated."""


@dataclass(frozen=True)
class Layout:
    """Order of objects, hands and sources. The first `n_moving` objects have a pose in each frame."""

    number: int
    objects: tuple[str, ...]
    n_moving: int
    hands: tuple[str, ...]
    sources: tuple[str, ...]

    @property
    def moving(self) -> tuple[str, ...]:
        """The objects with a pose in each frame."""
        return self.objects[: self.n_moving]


class Layouts:
    """The layouts of a session: the present one, and earlier ones that late frames may still use."""

    def __init__(self) -> None:
        self._kept: dict[int, Layout] = {}
        self._number = 0

    @property
    def now(self) -> Layout:
        """The present layout."""
        return self._kept[self._number]

    def change(
        self, moving: Sequence[str], objects: Sequence[str], hands: tuple[str, ...], sources: tuple[str, ...]
    ) -> Layout:
        """Set a new layout.

        Raises: UnknownObject: `moving` has an object that does not exist; BridgeError: it has an object twice.
        """
        there = dict.fromkeys(objects)
        unknown = next((one for one in moving if one not in there), None)
        if unknown is not None:
            raise UnknownObject(unknown_object(unknown, there))
        if len(set(moving)) < len(moving):
            twice = next(one for one in moving if list(moving).count(one) > 1)
            raise BridgeError(f"moving has {checks.represented(twice)} twice; name each object once.")
        at_rest = there.keys() - set(moving)
        order = (*moving, *(one for one in objects if one in at_rest))
        self._number = self._number % 0xFFFF + 1
        self._kept[self._number] = Layout(self._number, order, len(moving), hands, sources)
        while len(self._kept) > N_KEPT:
            del self._kept[next(iter(self._kept))]
        return self.now

    def of(self, number: int) -> Layout | None:
        """Return a layout by its number, None if it is outdated or unknown."""
        return self._kept.get(number)
