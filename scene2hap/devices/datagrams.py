"""Non-blocking UDP datagrams to one address, with errors of `scene2hap.errors`."""

from __future__ import annotations

import contextlib
import errno
import socket
import time

from scene2hap.devices.link import CarryOn
from scene2hap.errors import DeviceError, DeviceLost, DeviceNotFound, reason_of

PROBES = 2
_PROBE_S = 0.02
_FULL = (errno.EAGAIN, errno.EWOULDBLOCK, errno.ENOBUFS)


class Datagrams:
    """A UDP socket for one host and port.

    UDP has no handshake, but most machines report a closed port after a datagram. So the socket is probed with a first
    datagram. Without a report, as in networks that drop them, a listener is assumed.
    """

    def __init__(self, host: str, port: int) -> None:
        self._place = f"{host}:{port}"
        self._host = host
        self._port = port
        self._socket: socket.socket | None = None
        self.not_sent: int = 0

    def connect(self, probe: bytes, carry_on: CarryOn) -> None:
        """Resolve the address and probe it. Raises: DeviceNotFound: there is no such host, or no listener."""
        try:
            family, kind, protocol, _, address = socket.getaddrinfo(self._host, self._port, type=socket.SOCK_DGRAM)[0]
            self._socket = socket.socket(family, kind, protocol)
            self._socket.setblocking(False)
            self._socket.connect(address)
        except OSError as cause:
            raise DeviceNotFound(
                f"{self._place} cannot be reached: {reason_of(cause)}. Check host and network."
            ) from cause
        try:
            for _ in range(PROBES):
                self.send(probe)
                end = time.monotonic() + _PROBE_S
                while carry_on() and time.monotonic() < end:
                    time.sleep(0.005)
                    self._require_listener()
        except DeviceLost as cause:
            raise DeviceNotFound(str(cause)) from cause

    def send(self, data: bytes) -> None:
        """Send a datagram. It counts as not sent if the system's queue is full. Raises: DeviceLost."""
        if self._socket is None:
            raise DeviceLost(f"{self._place} is not open.")
        self._require_listener()
        try:
            self._socket.send(data)
        except ConnectionRefusedError as cause:
            raise self._unheard() from cause
        except OSError as cause:
            if cause.errno not in _FULL:
                raise DeviceLost(f"{self._place} cannot be reached: {reason_of(cause)}. Check the network.") from cause
            self.not_sent += 1

    def _require_listener(self) -> None:
        """Read the report of a closed port, if one has come: Windows gives it to a read alone. Raises: DeviceLost."""
        if self._socket is None:
            return
        try:
            self._socket.recv(1)
        except (ConnectionRefusedError, ConnectionResetError) as cause:  # the latter is that of Windows
            raise self._unheard() from cause
        except OSError:  # nothing has come, or on Windows a longer datagram
            return

    def _unheard(self) -> DeviceLost:
        return DeviceLost(f"nobody listens at {self._place}. Start the receiver there.")

    def close(self, *farewell: bytes) -> None:
        """Send the datagrams `farewell` and close. Never raises; may be called twice."""
        for data in farewell:
            with contextlib.suppress(DeviceError):
                self.send(data)
        if self._socket is not None:
            self._socket.close()
            self._socket = None
