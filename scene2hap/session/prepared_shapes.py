"""Meshes, prepared in the background, so that the first motion near one delays no frame.

Contacts by triangles need a search tree over each mesh. Building it takes some 4 us per triangle, once for all copies.
Contacts that need it earlier build it themselves, with the same result.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from functools import partial
from threading import Event, Thread
from weakref import WeakKeyDictionary

from scene2hap.contact.shape import Shape, shape_of
from scene2hap.scene.shapes import TriMesh
from scene2hap.session.deadline import Deadline
from scene2hap.session.worker_threads import start_worker

N_OF_BOX = 12
"""Triangles of a box. Contacts of boxes need triangles only while one is tilted or sinks into another. A level may hold
thousands, which take 1.5 ms each, and frames beside a busy worker take twice as long. So only `wait` prepares boxes."""

_ENDING = Event()


class PreparedShapes:
    """The shapes of a session's meshes. If `in_background`, a worker prepares those of all but boxes; `wait` prepares
    the rest. If not `is_wanted`, nothing is prepared."""

    def __init__(self, *, is_wanted: bool, in_background: bool) -> None:
        self._is_wanted, self._in_background = is_wanted, in_background
        # Keeps each shape as long as its mesh lives: copies of a prefab come and go.
        self._ordered: WeakKeyDictionary[TriMesh, Shape] = WeakKeyDictionary()
        self._waiting: deque[Shape] = deque()
        self._worker: Thread | None = None

    def order(self, meshes: Iterable[TriMesh]) -> None:
        """Let the worker prepare these meshes, the largest first; each is ordered once."""
        if not self._is_wanted:
            return
        new = {mesh: shape_of(mesh) for mesh in meshes if mesh not in self._ordered}
        self._ordered.update(new)
        if not self._in_background:
            return
        n_triangles = {shape: shape.triangles.shape[2] for shape in new.values() if not shape.is_prepared}
        unprepared = [shape for shape, n in n_triangles.items() if n > N_OF_BOX]
        self._waiting += sorted(unprepared, key=lambda shape: -n_triangles[shape])
        # Starting a thread may take milliseconds, so that a wave of spawned objects has one. `wait` prepares what a
        # worker does not see that ends at this moment.
        if self._waiting and (self._worker is None or not self._worker.is_alive()):
            self._worker = start_worker(partial(_prepare, self._waiting), "shapes", _ENDING.set)

    def wait(self, end: Deadline) -> bool:
        """Wait for the worker, and prepare here what it has not; false after the deadline."""
        if self._worker is not None:
            self._worker.join(end.left_s)
            if self._worker.is_alive():
                return False
        for shape in self._ordered.values():
            if not shape.is_prepared:
                if end.left_s == 0.0:
                    return False
                shape.prepare()
        return True


def _prepare(waiting: deque[Shape]) -> None:
    while waiting and not _ENDING.is_set():
        waiting.popleft().prepare()
