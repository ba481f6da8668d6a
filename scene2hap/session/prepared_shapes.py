"""Meshes, prepared in the background or in a loading screen, so that the first motion near one delays no frame.

Contacts by triangles need a search tree over each mesh. Building it takes some 4 us per triangle, once for all copies.
Contacts that need it earlier build it themselves, with the same result.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial
from threading import Event, Thread
from weakref import WeakSet

from scene2hap.contact.shape import Shape, shape_of
from scene2hap.scene.shapes import TriMesh
from scene2hap.session.deadline import Deadline
from scene2hap.session.worker_threads import start_worker

FEW_TRIANGLES = 1000
"""A mesh of fewer is prepared by `wait`, or when it is needed, which takes 2 to 6 ms, once. Many small ones in the
background would hold Python's interpreter lock, and so delay the frames of a game that has begun."""

_ENDING = Event()


class PreparedShapes:
    """The shapes of a session's meshes, of which workers prepare the detailed ones if `in_background`; without
    `is_wanted` nothing is prepared."""

    def __init__(self, *, is_wanted: bool, in_background: bool) -> None:
        self._is_wanted, self._in_background = is_wanted, in_background
        self._workers: list[Thread] = []
        self._ordered: WeakSet[Shape] = WeakSet()

    def order(self, meshes: Iterable[TriMesh]) -> None:
        """Let a worker prepare the detailed ones of these meshes, the largest first; each is ordered once."""
        if not self._is_wanted:
            return
        new = [shape for shape in {shape_of(mesh) for mesh in meshes} if shape not in self._ordered]
        self._ordered.update(new)
        if not self._in_background:
            return
        detailed = [one for one in new if one.triangles.shape[2] >= FEW_TRIANGLES and not one.is_prepared]
        self._workers = [worker for worker in self._workers if worker.is_alive()]
        if detailed:
            detailed.sort(key=lambda one: -one.triangles.shape[2])
            self._workers.append(start_worker(partial(_prepare, detailed), "shapes", _ENDING.set))

    def wait(self, end: Deadline) -> bool:
        """Wait for the workers, and prepare the other shapes here; false after the deadline."""
        for worker in self._workers:
            worker.join(end.left_s)
        if any(worker.is_alive() for worker in self._workers):
            return False
        for shape in self._ordered:
            if end.left_s == 0.0:
                return False
            shape.prepare()
        return True


def _prepare(shapes: Sequence[Shape]) -> None:
    for shape in shapes:
        if _ENDING.is_set():
            return
        shape.prepare()
