"""A serial port that tests unplug and plug in again: the reference device behind a link of constant name."""

import contextlib
import threading
import time
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Self

from scene2hap.devices.reference_device import PseudoTerminal, ReferenceDevice, serve


class Plug:
    """A pluggable reference device. While plugged in, `path` links to its pseudo-terminal; each plug-in restarts it."""

    def __init__(self, folder: Path, make: Callable[[], ReferenceDevice] = ReferenceDevice) -> None:
        self.path = folder / "amplifier"
        self._make = make
        self._terminal: PseudoTerminal | None = None
        self._thread: threading.Thread | None = None
        self._stop = threading.Event()
        self.device = make()

    def put_in(self) -> None:
        self.device = self._make()
        self._terminal = PseudoTerminal()
        self.path.symlink_to(self._terminal.name)
        self.wake_up()

    def wake_up(self) -> None:
        assert self._terminal is not None
        self._stop.clear()
        self._thread = threading.Thread(target=self._serve, args=(self.device, self._terminal), name="device")
        self._thread.start()

    def freeze(self) -> None:
        """Stop the device: the port stays, but nothing reads from it or writes to it."""
        self._stop.set()
        if self._thread is not None:
            self._thread.join()
            self._thread = None

    def pull_out(self) -> None:
        self.freeze()
        self.path.unlink(missing_ok=True)
        if self._terminal is not None:
            self._terminal.close()
            self._terminal = None

    def __enter__(self) -> Self:
        self.put_in()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.pull_out()

    def _serve(self, device: ReferenceDevice, terminal: PseudoTerminal) -> None:
        with contextlib.suppress(OSError):
            serve(device, terminal, self._stop)


def eventually(holds: Callable[[], bool], within_s: float = 60.0) -> bool:
    """Wait until `holds` is true. False after `within_s`, which is long because only a failure waits for all of it."""
    end = time.monotonic() + within_s
    while not holds():
        if time.monotonic() > end:
            return False
        time.sleep(0.002)
    return True
