"""A server for engines in other languages: they send poses and touches, and get gains, over a WebSocket."""

from scene2hap.bridge.config import BridgeConfig
from scene2hap.bridge.server import BridgeServer

__all__ = ["BridgeConfig", "BridgeServer"]
