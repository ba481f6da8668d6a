"""The program ``scene2hap``, also ``python -m scene2hap``."""

import signal
import sys
import threading
from _thread import interrupt_main

INTERRUPTED = 130
"""Exit status of an interrupted program: 128 and the number of the signal, as shells report it."""
_AGAIN_S = 0.05


def main() -> int:
    """Run the command line. Ctrl-C ends it at any time with status 130 and without a traceback."""
    sys.unraisablehook = _interrupt_again
    try:
        # Imported here, since an interrupt may come during imports, which take a second.
        from scene2hap.cli import main as run

        return run()
    except KeyboardInterrupt:
        print("scene2hap: interrupted.", file=sys.stderr)
        return INTERRUPTED
    finally:
        # Python would print a traceback for an interrupt while it exits.
        signal.signal(signal.SIGINT, signal.SIG_DFL)


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
    if sys.platform == "win32":
        interrupt_main()
    else:
        # Unlike `interrupt_main`, a signal ends a wait of the main thread.
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)


if __name__ == "__main__":
    sys.exit(main())
