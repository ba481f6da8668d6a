"""Meshes, prepared in the background, so that the first motion near one delays no frame.

Contacts by triangles need a search tree over each mesh. Building it takes some 4 us per triangle, once for all copies.
Contacts that need it earlier build it themselves, with the same result.
"""

from __future__ import annotations

from collections.abc import Iterable
from concurrent.futures import Future, wait
from weakref import WeakKeyDictionary

from scene2hap.common.deadline import Deadline
from scene2hap.common.worker_threads import WorkerPool
from scene2hap.contact.shape import Shape, shape_of
from scene2hap.scene.shapes import TriMesh

N_OF_BOX = 12
"""Triangles of a box. Contacts of boxes need triangles only while one is tilted or sinks into another. A level may hold
thousands, which take 1.5 ms each, and frames beside a busy worker take twice as long. So only `wait` prepares boxes."""


class PreparedShapes:
    """The shapes of a session's meshes. If `in_background`, a worker prepares those of all but boxes; `wait` prepares
    the rest. If not `is_wanted`, nothing is prepared."""

    def __init__(self, *, is_wanted: bool, in_background: bool) -> None:
        self._is_wanted, self._in_background = is_wanted, in_background
        # Keeps each shape as long as its mesh lives: copies of a prefab come and go.
        self._ordered: WeakKeyDictionary[TriMesh, Shape] = WeakKeyDictionary()
        self._worker = WorkerPool(1, "shapes")
        self._last: Future[None] | None = None

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
        for shape in sorted(unprepared, key=lambda shape: -n_triangles[shape]):
            self._last = self._worker.submit(shape.prepare)

    def wait(self, end: Deadline) -> bool:
        """Wait for the worker, and prepare here what it has not; false after the deadline."""
        if self._last is not None and wait([self._last], end.left_s).not_done:
            return False
        for shape in self._ordered.values():
            if not shape.is_prepared:
                if end.left_s == 0.0:
                    return False
                shape.prepare()
        return True
