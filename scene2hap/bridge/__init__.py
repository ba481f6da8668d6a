"""A server for engines in other languages, which send poses and touches over a WebSocket and receive gains."""

from scene2hap.errors import MissingExtra

try:  # here, since every module of the package is imported after this one
    import websockets.asyncio.server  # noqa: F401
except ImportError as _cause:
    raise MissingExtra(
        "the bridge needs the extra `bridge`. Install it with: python -m pip install 'scene2hap[bridge]'"
    ) from _cause

from scene2hap.bridge.config import BridgeConfig
from scene2hap.bridge.server import BridgeServer

__all__ = ["BridgeConfig", "BridgeServer"]
