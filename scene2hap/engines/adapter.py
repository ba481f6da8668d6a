"""The data that an engine gives in each frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol, runtime_checkable

from scene2hap.scene.objects import Contact
from scene2hap.scene.pose import Pose
from scene2hap.session.frame import Touch


@runtime_checkable
class EngineAdapter(Protocol):
    """An engine as a session follows it: world coordinates, metres, the ids and the up axis of the session's scene."""

    def poses(self) -> Mapping[str, Pose]:
        """Where objects are now, by id: all of them, also those at rest; a `PoseTable` is read fastest."""
        ...

    def touches(self) -> Sequence[Touch]:
        """Where hands touch objects now; empty if the engine has no hands."""
        ...

    def contacts(self) -> Sequence[Contact] | None:
        """Which objects touch now, None to have the session find that from geometry."""
        ...
