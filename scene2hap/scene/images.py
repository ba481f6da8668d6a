"""Pictures of a scene: PNG files, each rendered at its first access."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Protocol, overload

from scene2hap.common.calls import clear_attributes


@dataclass(frozen=True)
class Shot:
    """One picture to render: of the scene (`subject` is None), or of an object, alone or among others."""

    kind: Literal["scene", "isolated", "context"]
    subject: str | None
    azimuth_deg: float
    elevation_deg: float

    @property
    def label(self) -> str:
        """Text for the angle, such as "above 30°"."""
        side = "above" if self.elevation_deg > 0 else "below"
        return f"{side} {self.azimuth_deg % 360:g}°"


class ImageSource(Protocol):
    """Interface of renderers that cache their pictures. Calls from several threads are safe."""

    def image(self, shot: Shot) -> bytes:
        """Return the picture as a PNG file."""
        ...


@clear_attributes
class ImageSet(Sequence[bytes]):
    """Pictures of one object or scene from several angles, each rendered at its first access.

    `shots` gives the angles without rendering a picture.
    """

    def __init__(self, source: ImageSource, shots: Sequence[Shot]) -> None:
        self.source = source
        self.shots: tuple[Shot, ...] = tuple(shots)

    def __len__(self) -> int:
        return len(self.shots)

    @overload
    def __getitem__(self, index: int) -> bytes: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[bytes, ...]: ...
    def __getitem__(self, index: int | slice) -> bytes | tuple[bytes, ...]:
        if isinstance(index, slice):
            return tuple(self.source.image(shot) for shot in self.shots[index])
        return self.source.image(self.shots[index])

    def __repr__(self) -> str:
        return f"ImageSet({', '.join(shot.label for shot in self.shots)})"


@dataclass(frozen=True, eq=False)
class ObjectImages:
    """Pictures of an object alone, and among its surroundings with an outline around it, from the same angles."""

    isolated: ImageSet
    context: ImageSet

    @property
    def together(self) -> ImageSet:
        """All pictures, isolated ones first, in the order of the prompts."""
        return ImageSet(self.isolated.source, (*self.isolated.shots, *self.context.shots))
