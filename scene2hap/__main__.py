"""The program ``scene2hap``, also ``python -m scene2hap``."""

import signal
import sys
import threading
from types import FrameType

INTERRUPTED = 130
"""Exit status of an interrupted program: 128 and the number of the signal, as shells report it."""
TERMINATED = 143
"""Exit status of a program that one of `_ENDS` ended: `kill`, a service manager, a container or a batch system."""
_ENDS = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGBREAK") if hasattr(signal, name))
"""Requests to end: SIGTERM, and on Windows Ctrl-Break, the only one that a program there can send to another."""
_AGAIN_S = 0.05


def main() -> int:
    """Run the command line. Ctrl-C or one of `_ENDS` ends it at any time with status 130 or 143, no traceback."""
    sys.unraisablehook = _interrupt_again
    terminations: list[int] = []

    def interrupt(number: int, frame: FrameType | None) -> None:
        """Do what Ctrl-C does at present."""
        terminations.append(number)
        on_interrupt = signal.getsignal(signal.SIGINT)
        (on_interrupt if callable(on_interrupt) else signal.default_int_handler)(number, frame)

    if sys.platform != "win32" and signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        # A shell lets its background processes ignore Ctrl-C. It stays without effect there, but has a handler.
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        signal.signal(signal.SIGINT, signal.default_int_handler)
    for number in _ENDS:
        signal.signal(number, interrupt)
    try:
        # Imported here, since an interrupt may come during imports, which take a second.
        from scene2hap.cli import main as run

        status = run()
    except KeyboardInterrupt:
        print("scene2hap: interrupted.", file=sys.stderr)
        status = INTERRUPTED
    finally:
        # Python would print a traceback for an interrupt while it exits.
        for number in (signal.SIGINT, *_ENDS):
            signal.signal(number, signal.SIG_DFL)
    return TERMINATED if terminations and status == INTERRUPTED else status


def _interrupt_again(unraisable: "sys.UnraisableHookArgs") -> None:
    """Repeat an interrupt that came in a destructor or in a callback from C, where Python drops exceptions."""
    if unraisable.exc_type is not KeyboardInterrupt:
        sys.__unraisablehook__(unraisable)
        return
    # Later, since an interrupt that is raised here would be dropped too.
    again = threading.Timer(_AGAIN_S, _interrupt_main_thread)
    again.daemon = True
    again.start()


def _interrupt_main_thread() -> None:
    # Unlike `interrupt_main`, a signal ends a wait of the main thread.
    if sys.platform == "win32":
        signal.raise_signal(signal.SIGINT)
    else:
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)


if __name__ == "__main__":
    sys.exit(main())
