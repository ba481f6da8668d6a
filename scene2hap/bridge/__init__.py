"""A server for engines in other languages, which send poses and touches over a WebSocket and receive gains."""

from scene2hap.bridge.config import BridgeConfig
from scene2hap.bridge.server import BridgeServer

__all__ = ["BridgeConfig", "BridgeServer"]
