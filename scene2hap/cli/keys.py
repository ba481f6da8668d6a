"""Keys of a terminal, read without waiting: by termios on POSIX, from the console on Windows."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

UP, DOWN, RIGHT, LEFT = "\x1b[A", "\x1b[B", "\x1b[C", "\x1b[D"
"""The arrow keys, as POSIX terminals send them."""

_ARROWS_OF_WINDOWS = {"H": UP, "P": DOWN, "M": RIGHT, "K": LEFT}
"""Second character of the arrow keys on Windows, after one of `_PREFIXES` (documented for `msvcrt.getwch`)."""
_PREFIXES = ("\x00", "\xe0")


@contextmanager
def keys() -> Iterator[Callable[[], str]]:
    """Read keys without waiting. Yields a function that returns the next key, "" if there is none."""
    if sys.platform == "win32":
        import msvcrt

        yield lambda: console_key(msvcrt.kbhit, msvcrt.getwch)
        return
    import os
    import select
    import termios
    import tty

    terminal = sys.stdin.fileno()
    before = termios.tcgetattr(terminal)
    tty.setcbreak(terminal)

    def pressed() -> str:
        if not select.select([terminal], [], [], 0)[0]:
            return ""
        key = os.read(terminal, 1).decode("latin-1")
        if key == "\x1b" and select.select([terminal], [], [], 0.01)[0]:
            key += os.read(terminal, 2).decode("latin-1")
        return key

    try:
        yield pressed
    finally:
        termios.tcsetattr(terminal, termios.TCSADRAIN, before)


def console_key(is_waiting: Callable[[], bool], read: Callable[[], str]) -> str:
    """Return the next key of a Windows console, "" if there is none or it has no meaning here.

    Parameters: is_waiting, read : `msvcrt.kbhit` and `msvcrt.getwch`.
    Raises: KeyboardInterrupt: Ctrl-C, which `getwch` returns as a character.
    """
    if not is_waiting():
        return ""
    key = read()
    if key in _PREFIXES:  # a key without a character is two characters
        return _ARROWS_OF_WINDOWS.get(read(), "")
    if key == "\x03":
        raise KeyboardInterrupt
    return key
