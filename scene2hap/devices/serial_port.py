"""A serial port that never blocks for long, with errors of `scene2hap.errors`.

Known behaviour of drivers: a full port raises after the write timeout, at times without reason, and a timeout of 0
spins (pyserial 3.5 on POSIX). A disconnected port raises SerialException, OSError or termios.error, depending on the
call. Closing a port with unsent bytes can take half a minute, unless they are discarded first.
"""

from __future__ import annotations

import contextlib
import errno
import sys
from typing import TYPE_CHECKING

from scene2hap.errors import DeviceError, DeviceLost, DeviceNotFound, MissingExtra

if TYPE_CHECKING:
    import serial

WRITE_TIMEOUT_S = 0.05


def require_pyserial() -> None:
    """Check that pyserial is installed. Raises: MissingExtra: it is not."""
    try:
        import serial  # noqa: F401  # imported only to see that it is installed
    except ImportError as cause:
        raise MissingExtra("serial ports need pyserial. Run: pip install 'scene2hap[serial]'") from cause


class SerialPort:
    """An open port.

    Raises: DeviceNotFound: no such port; DeviceError: it is in use, may not be opened, or refuses the baud rate.
    """

    def __init__(self, name: str, baud_rate: int) -> None:
        import serial

        self.name = name
        # SerialException is an OSError.
        self._lost: tuple[type[Exception], ...] = (OSError, ValueError, TypeError, *_termios_error())
        try:
            self._port: serial.Serial = serial.Serial(
                name, baud_rate, timeout=0.0, write_timeout=WRITE_TIMEOUT_S, exclusive=True
            )
        except self._lost as cause:
            raise _open_error(name, baud_rate, cause) from cause
        # The 16 ms timer of FTDI chips would delay every credit. Other chips have no such timer, and raise.
        if sys.platform != "win32":  # there the timer is a setting of the driver
            with contextlib.suppress(NotImplementedError, AttributeError, *self._lost):
                self._port.set_low_latency_mode(True)

    def read(self, timeout_s: float) -> bytes:
        """Return the bytes that have arrived; wait at most `timeout_s` for a first byte. Raises: DeviceLost."""
        try:
            if self._port.timeout != timeout_s:  # pyserial sends all settings to the driver again
                self._port.timeout = timeout_s
            return self._port.read(max(1, self._port.in_waiting))
        except self._lost as cause:
            raise DeviceLost(f"{self.name} has gone: {_reason(cause)}. Plug it in again.") from cause

    def write(self, data: bytes) -> None:
        """Pass bytes to the driver, or give up after 50 ms; the protocol detects losses. Raises: DeviceLost."""
        import serial

        try:
            self._port.write(data)
        except serial.SerialTimeoutException:
            # Not reliable: pyserial checks the clock again after the last byte, and on a busy machine raises although
            # all bytes were taken. A device that takes none grants no credit, which `SerialLine` detects.
            pass
        except self._lost as cause:
            raise DeviceLost(f"{self.name} has gone: {_reason(cause)}. Plug it in again.") from cause

    def close(self) -> None:
        """Discard unsent bytes, and close; never raises."""
        with contextlib.suppress(*self._lost):
            self._port.reset_output_buffer()
        with contextlib.suppress(*self._lost):
            self._port.close()


def _termios_error() -> tuple[type[Exception], ...]:
    # termios.error is no OSError, and Windows has no termios.
    if sys.platform == "win32":
        return ()
    import termios

    return (termios.error,)


def _open_error(name: str, baud_rate: int, cause: Exception) -> DeviceError:
    code = getattr(cause, "errno", None)
    text = str(cause)
    if code in (errno.ENOENT, errno.ENODEV, errno.ENXIO, errno.EIO) or "FileNotFoundError" in text:
        return DeviceNotFound(f"no serial port {name}. `python -m serial.tools.list_ports` lists what there is.")
    if code in (errno.EAGAIN, errno.EBUSY):
        return DeviceError(f"{name} is in use by another program. Close it there.")
    if code in (errno.EACCES, errno.EPERM) or "PermissionError" in text:
        return DeviceError(
            f"{name} may not be opened: permission denied. On Linux add yourself to the group that owns it "
            "(dialout or uucp) and log in again; on Windows another program holds it."
        )
    return DeviceError(f"{name} cannot be opened at {baud_rate} baud: {_reason(cause)}.")


def _reason(cause: Exception) -> str:
    return str(cause).rstrip(".") or type(cause).__name__
