"""Sessions that follow a running simulation. One object reads poses, contacts and touches from an engine in each frame.

`MuJoCoLink` and `Panda3DLink` are `EngineLink` with built-in adapters; docs/engines.md shows how to write another.
"""

from scene2hap.engines.adapter import EngineAdapter
from scene2hap.engines.link import EngineLink
from scene2hap.engines.mujoco import MuJoCoLink
from scene2hap.engines.panda3d import Panda3DLink

__all__ = ["EngineAdapter", "EngineLink", "MuJoCoLink", "Panda3DLink"]
