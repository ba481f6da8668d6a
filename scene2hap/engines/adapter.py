"""The data that an engine gives in each frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol, runtime_checkable

from scene2hap.scene.objects import Contact
from scene2hap.scene.pose import Pose
from scene2hap.session.frame import Touch


@runtime_checkable
class EngineAdapter(Protocol):
    """Interface of an engine for a session: metres in the world, and the ids and the up axis of the session's scene."""

    def poses(self) -> Mapping[str, Pose]:
        """Return the current poses of all objects by id, also of those at rest. A `PoseTable` is read fastest."""
        ...

    def touches(self) -> Sequence[Touch]:
        """Return the current touches of hands on objects; empty if the engine has no hands."""
        ...

    def contacts(self) -> Sequence[Contact] | None:
        """Return all current contacts of objects; None if the session must find them from geometry.

        After a first list, None means that this frame has no report; see `HapticSession.update`.
        """
        ...
