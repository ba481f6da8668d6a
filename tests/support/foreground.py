"""Start Python as a terminal does: Ctrl-C reaches it."""

# A shell makes its background processes ignore the signal, which their children inherit, as those of a test.
IN_FOREGROUND = """import os, signal, sys
signal.signal(signal.SIGINT, signal.SIG_DFL)
os.execv(sys.executable, [sys.executable, *sys.argv[1:]])
"""
