"""Objects that hands touch, prepared for impacts in advance, so that an impact is felt with the next block.

A worker solves the scene around a touched object once, for forces at any of its points
(`propagation.coupled.struck_object`), and again after contacts changed. Until then the last answer stays in use.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Collection, Sequence
from concurrent.futures import Future, wait
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.errors import Scene2HapError
from scene2hap.propagation.coupled.struck_object import StruckObject
from scene2hap.propagation.coupled.substructuring import prepare_struck
from scene2hap.propagation.live import TouchedPoint
from scene2hap.propagation.protocol import Body, CoupledModel
from scene2hap.session.scene_state import SceneState
from scene2hap.session.struck import at_least_itself

Floats = NDArray[np.float64]
Point = tuple[float, float, float]

AT_REST_S, EVERY_S = 0.05, 1.0
"""An object is prepared again once its contacts have rested for `AT_REST_S`, or after `EVERY_S` of changes [s]."""
MOST = 4
"""Number of prepared objects that are kept; two hands touch two."""


class Answer(NamedTuple):
    """Gains (n_hands, n_frequencies) [-], in any thread, and whether an update can spare the time for them."""

    gains: Callable[[], Floats]
    is_quick: bool


class StruckAhead:
    """Prepares objects as hands touch them. `expect` and `answer` belong to the game's thread.

    Parameters: submit : has a worker call a function.
    """

    def __init__(
        self, model: CoupledModel, state: SceneState, submit: Callable[[Callable[[], None]], Future[None]]
    ) -> None:
        self._model, self._state, self._submit = model, state, submit
        self._prepared: dict[str, tuple[Body, StruckObject]] = {}
        self._versions: dict[str, int] = {}
        self._job: Future[None] | None = None
        self._expected: Collection[str] = ()
        self._version, self._changed_at_s, self._ordered_at_s = -1, 0.0, 0.0

    def expect(self, object_ids: Collection[str]) -> None:
        """Order the next of these objects that is not prepared for the present contacts; one at a time."""
        self._expected, version, now = object_ids, self._state.graph.version, time.monotonic()
        if version != self._version:
            self._version, self._changed_at_s = version, now
        if self._job is None or self._job.done():
            rests = now - self._changed_at_s >= AT_REST_S or now - self._ordered_at_s >= EVERY_S
            self._order_next(version, rests=rests)

    def wait(self, timeout_s: float | None) -> bool:
        """Wait until all that is expected is prepared; false after the timeout [s]."""
        end_s = math.inf if timeout_s is None else time.monotonic() + timeout_s
        while True:
            rest_s = None if timeout_s is None else max(0.0, end_s - time.monotonic())
            if self._job is not None and wait([self._job], rest_s).not_done:
                return False
            if not self._order_next(self._state.graph.version, rests=True):
                return True

    def answer(
        self, object_id: str, point_m: Point, hands: Sequence[Sequence[TouchedPoint]], frequencies_hz: Floats
    ) -> Answer | None:
        """Return the gains of an impact at hands that touch only the struck object; the largest of each hand's touches.

        None if the object is not prepared.
        """
        body, struck = self._prepared.get(object_id, (None, None))
        if struck is None or body is not self._state.bodies.get(object_id):
            return None
        ready, places = struck, [point_m, *(at for hand in hands for _, at in hand)]
        points = np.array([self._state.on_plate(object_id, place) for place in places], dtype=np.float64)
        starts = np.cumsum([0, *map(len, hands)])[:-1]

        def gains() -> Floats:
            found = ready.gains(points[:1], points[1:], frequencies_hz)
            return at_least_itself(np.maximum.reduceat(found, starts, axis=0), object_id, hands)

        return Answer(gains, ready.is_quick)

    def _order_next(self, version: int, *, rests: bool) -> bool:
        """Order the first missing object, or an outdated one if contacts rest. Returns True if there was one."""
        for object_id in self._expected:
            before = self._versions.get(object_id)
            if (before is None or (before != version and rests)) and object_id in self._state.bodies:
                self._order(object_id, version)
                return True
        return False

    def _order(self, object_id: str, version: int) -> None:
        self._versions.pop(object_id, None)
        self._versions[object_id], self._ordered_at_s = version, time.monotonic()
        for oldest in list(self._versions)[:-MOST]:
            del self._versions[oldest]
            self._prepared.pop(oldest, None)
        body = self._state.bodies[object_id]
        # An object without contacts is in no network of connected objects.
        put_together = self._state.network([object_id] if self._state.graph.beside.get(object_id) else None)

        def work() -> None:
            try:
                struck = prepare_struck(self._model, put_together({object_id}).network, object_id)
            except Scene2HapError:  # the field in use fails in the same way, and says so
                self._prepared.pop(object_id, None)
            else:
                self._prepared[object_id] = body, struck

        self._job = self._submit(work)
