"""The end of a connection, without a server."""

from __future__ import annotations

import asyncio
import io
import json
from collections.abc import AsyncIterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

from PIL import Image

from bridge_frames import encode_picture
from scene2hap.bridge.connection import Connection


class ClosedSocket:
    """A socket without further messages."""

    async def __aiter__(self) -> AsyncIterator[bytes]:
        for message in ():
            yield message


def test_a_client_that_is_gone_watches_nothing_and_leaves_no_pictures(tmp_path: Path) -> None:
    file = io.BytesIO()
    Image.new("RGB", (16, 16), "red").save(file, "PNG")
    about = {"object": "radio", "kind": "isolated", "view": "front"}
    picture = encode_picture(json.dumps(about).encode(), file.getvalue())

    async def scenario() -> None:
        host = SimpleNamespace(jobs=SimpleNamespace(folder=tmp_path), as_told=str)
        connection = Connection(cast("Any", ClosedSocket()), cast("Any", host))
        client = connection.client
        watched: Any = SimpleNamespace(watchers={client})
        client.watched = watched
        client.pictures.take(picture)
        assert list(tmp_path.iterdir())
        await connection.run()
        assert watched.watchers == set()

    asyncio.run(scenario())
    assert not list(tmp_path.iterdir())
