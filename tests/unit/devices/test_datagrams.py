"""Datagrams to a socket of this machine."""

from __future__ import annotations

import errno
import socket
from types import SimpleNamespace

import pytest

from scene2hap.devices.datagrams import Datagrams
from scene2hap.errors import DeviceLost


def test_farewell_is_sent_and_the_socket_closed() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(10.0)
        datagrams = Datagrams("127.0.0.1", receiver.getsockname()[1])
        datagrams.connect(b"hello", lambda: False)
        used = datagrams._socket
        datagrams.close(b"one", b"two")
        datagrams.close(b"three")
        assert [receiver.recv(100) for _ in range(4)] == [b"hello", b"hello", b"one", b"two"]
    assert used is not None
    assert used.fileno() == -1
    with pytest.raises(DeviceLost, match="is not open"):
        datagrams.send(b"four")


@pytest.mark.parametrize("code", [errno.EAGAIN, errno.ENOBUFS])
def test_a_datagram_that_finds_the_queue_full_is_counted(code: int) -> None:
    def full(data: bytes) -> None:
        raise OSError(code, "no room")

    datagrams = Datagrams("127.0.0.1", 9)
    datagrams._socket = SimpleNamespace(send=full, recv=lambda size: b"")  # type: ignore[assignment]
    datagrams.send(b"lost")
    assert datagrams.not_sent == 1


@pytest.mark.parametrize("report", [ConnectionRefusedError(111, "refused"), ConnectionResetError(10054, "reset")])
def test_a_closed_port_is_found_where_only_a_read_reports_it(report: OSError) -> None:
    """As on Windows, whose `send` succeeds."""

    def read(size: int) -> bytes:
        raise report

    datagrams = Datagrams("127.0.0.1", 9)
    datagrams._socket = SimpleNamespace(send=len, recv=read)  # type: ignore[assignment]
    with pytest.raises(DeviceLost, match="nobody listens at 127.0.0.1:9"):
        datagrams.send(b"hello")


@pytest.mark.parametrize("nothing", [BlockingIOError(11, "nothing has come"), OSError(10040, "a longer datagram")])
def test_other_reports_of_a_read_are_ignored(nothing: OSError) -> None:
    sent: list[bytes] = []

    def read(size: int) -> bytes:
        raise nothing

    datagrams = Datagrams("127.0.0.1", 9)
    datagrams._socket = SimpleNamespace(send=sent.append, recv=read)  # type: ignore[assignment]
    datagrams.send(b"hello")
    assert sent == [b"hello"]
