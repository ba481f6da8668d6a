"""A forked process that answers questions, and is started again when it dies or hangs. Needs POSIX."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable
from typing import Any


class Child:
    """Run `answer(pipe, *arguments)`, which receives questions until None, and sends its replies to each."""

    def __init__(self, answer: Callable[..., None], *arguments: object, longest_s: float | None = None) -> None:
        self._answer, self._arguments, self._longest_s = answer, arguments, longest_s
        self._start()

    def ask(self, question: object, n_replies: int = 1) -> tuple[list[Any], str]:
        """Return the replies, and "" or how the process ended before the last of them: "crash: ..." or "hang: ..."."""
        self._pipe.send(question)
        replies: list[Any] = []
        try:
            while len(replies) < n_replies:
                if not self._pipe.poll(self._longest_s):
                    self._process.kill()
                    self._restart()
                    return replies, f"hang: no result after {self._longest_s:g} s"
                replies.append(self._pipe.recv())
        except EOFError:
            self._process.join()
            code = self._process.exitcode
            self._restart()
            return replies, f"crash: exit status {code}"
        return replies, ""

    def stop(self) -> None:
        """End the process."""
        self._pipe.send(None)
        self._process.join()

    def _start(self) -> None:
        context = multiprocessing.get_context("fork")
        self._pipe, theirs = context.Pipe()
        # Not a daemon, which multiprocessing allows no children.
        self._process = context.Process(target=self._answer, args=(theirs, *self._arguments), daemon=False)
        self._process.start()
        theirs.close()

    def _restart(self) -> None:
        self._process.join()
        self._pipe.close()
        self._start()
