"""A session that follows a Panda3D scene graph."""

from __future__ import annotations

from typing import Any

from scene2hap.calls import clear_calls
from scene2hap.engines.link import EngineLink
from scene2hap.scene.engines import panda3d as engine
from scene2hap.scene.grouping import Grouping
from scene2hap.scene.pose import Pose
from scene2hap.session import HapticSession


@clear_calls
class Panda3DLink(EngineLink):
    """Follows the nodes below a NodePath: `link.update(touches)` once per frame.

    Nodes are looked up once, here; one that the game takes out of the graph stays where it was until
    `session.remove(id)`. Panda3D says neither what touches nor where hands are, so contacts are found from geometry and
    touches are given.

    Parameters: render, group : as `scene.engines.panda3d.snapshot` had them.
    Raises: MissingExtra; SceneError: the session is of another graph.
    """

    def __init__(self, render: Any, session: HapticSession, *, group: Grouping = "authored") -> None:
        super().__init__(_Panda3D(render, group), session)


class _Panda3D:
    """See `EngineAdapter`."""

    def __init__(self, render: Any, group: Grouping) -> None:
        self._reader = engine.PoseReader(render, group=group)

    def poses(self) -> dict[str, Pose]:
        return self._reader.read()

    def touches(self) -> tuple[()]:
        return ()

    def contacts(self) -> None:
        return None
