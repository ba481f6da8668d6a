"""Detailed meshes, prepared in the background, so that the first motion near one delays no frame.

Contacts by triangles need a search tree over each mesh. Building it takes some 4 us per triangle, once for all copies.
Contacts that need it earlier build it themselves, with the same result.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial
from threading import Event, Thread

from scene2hap.contact.shape import Shape, shape_of
from scene2hap.scene.shapes import TriMesh
from scene2hap.session.deadline import Deadline
from scene2hap.session.worker_threads import start_worker

FEW_TRIANGLES = 1000
"""A mesh of fewer is prepared when it is needed, which takes 2 to 6 ms, once. Many small ones in the background would
hold Python's interpreter lock, and so delay the frames of a game that has begun."""

_ENDING = Event()


class PreparedShapes:
    """The shapes of a session's meshes that workers prepare; without `is_wanted`, `order` does nothing."""

    def __init__(self, *, is_wanted: bool) -> None:
        self._is_wanted = is_wanted
        self._workers: list[Thread] = []

    def order(self, meshes: Iterable[TriMesh]) -> None:
        """Prepare the detailed ones of these meshes, the largest first."""
        if not self._is_wanted:
            return
        shapes = {shape_of(mesh) for mesh in meshes if len(mesh.faces) >= FEW_TRIANGLES}
        waiting = sorted((one for one in shapes if not one.is_prepared), key=lambda one: -one.triangles.shape[2])
        self._workers = [worker for worker in self._workers if worker.is_alive()]
        if waiting:
            self._workers.append(start_worker(partial(_prepare, waiting), "shapes", _ENDING.set))

    def wait(self, end: Deadline) -> bool:
        """Wait for the workers; false after the deadline."""
        for worker in self._workers:
            worker.join(end.left_s)
        return not any(worker.is_alive() for worker in self._workers)


def _prepare(shapes: Sequence[Shape]) -> None:
    for shape in shapes:
        if _ENDING.is_set():
            return
        shape.prepare()
