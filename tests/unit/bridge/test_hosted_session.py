"""A session between its players, without a server."""

from __future__ import annotations

import asyncio
from types import SimpleNamespace
from typing import Any, cast

from scene2hap.bridge.hosted_session import HostedSession, Receiver


def test_a_player_that_was_replaced_is_lost_without_a_pause() -> None:
    paused: list[bool] = []

    async def scenario() -> None:
        session = SimpleNamespace(pause=lambda: paused.append(True))
        played = cast("Any", SimpleNamespace(session=session))
        old, new = cast("Receiver", object()), cast("Receiver", object())
        hosted = HostedSession(lambda tell: played, "newest", 60.0, lambda ended: None)
        await hosted.open(old)
        hosted.player = new
        await hosted.lose(old)
        assert hosted.player is new

    asyncio.run(scenario())
    assert paused == []
