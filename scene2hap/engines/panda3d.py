"""A session that follows a Panda3D scene graph."""

from __future__ import annotations

from typing import Any

from scene2hap.common.calls import clear_calls
from scene2hap.engines.link import EngineLink
from scene2hap.scene.engines import panda3d as engine
from scene2hap.scene.grouping.groups import Grouping
from scene2hap.scene.pose import Pose
from scene2hap.session import HapticSession


@clear_calls
class Panda3DLink(EngineLink):
    """Let a session follow the nodes below a Panda3D NodePath: call `link.update(touches)` once per frame.

    Nodes are looked up once, in the constructor; `follow` adds one that comes later. If the game removes a node from
    the graph, its object keeps its pose until `session.remove(id)`. Panda3D reports no contacts and no hands, so
    contacts are found from geometry, and the game passes the touches.
    Parameters: render, group, unit_m : as for `scene.engines.panda3d.snapshot`. Touches are in metres.
    Raises: MissingExtra; SceneError: the session is of another graph.
    """

    def __init__(
        self, render: Any, session: HapticSession, *, group: Grouping = "authored", unit_m: float = 1.0
    ) -> None:
        self._reader = engine.PoseReader(render, group=group, unit_m=unit_m)
        super().__init__(_Panda3D(self._reader), session)

    def follow(self, object_id: str, node: Any) -> None:
        """Follow a node that came later: its object is in the session from `session.spawn` or `session.add` on.

        The object's pose is that of the one object of `snapshot(node, group=1)`.
        Raises: SceneError: it is no NodePath, or draws no triangles.
        """
        self._reader.follow(object_id, node)

    def object_id(self, node: Any) -> str | None:
        """Return the id of the object that a NodePath or node belongs to, such as one that a ray hits; None if to none.

        Raises: SceneError: it is neither a NodePath nor a node.
        """
        return self._reader.object_id(node)


class _Panda3D:
    """The `EngineAdapter` of Panda3D."""

    def __init__(self, reader: engine.PoseReader) -> None:
        self._reader = reader

    def poses(self) -> dict[str, Pose]:
        return self._reader.read()

    def touches(self) -> tuple[()]:
        return ()

    def contacts(self) -> None:
        return None
