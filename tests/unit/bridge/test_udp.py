"""Datagrams of strangers: dropped without an answer, since a session's key is its only proof."""

import pytest

from scene2hap.bridge.udp import FrameDatagrams


@pytest.mark.parametrize("data", [b"", b"SHF1", bytes(64)])
def test_a_datagram_without_the_key_of_a_session_is_dropped(data: bytes) -> None:
    asked: list[bytes] = []
    # Outside of an event loop, anything else would be an error.
    FrameDatagrams(asked.append).datagram_received(data, ("127.0.0.1", 9))
    assert len(asked) == 1
