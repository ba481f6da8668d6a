"""Scenes prepared in advance around touched objects, so that an impact is felt with the next block.

A worker solves the joints around the touched objects once, for forces at any point of all connected objects
(`propagation.coupled.impact_solution`). It solves them again after contacts changed or a hand touched another object.
Until then the last solution stays in use.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Mapping, Sequence
from concurrent.futures import Future, wait
from typing import NamedTuple

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.common.deadline import Deadline
from scene2hap.propagation.coupled.impact_scene import ImpactScene
from scene2hap.propagation.coupled.substructuring import prepare_struck
from scene2hap.propagation.live import TouchedPoint
from scene2hap.propagation.protocol import Body, CoupledModel
from scene2hap.session.impacts.gains import Point, at_least_itself
from scene2hap.session.present_scene.scene_state import SceneState

AT_REST_S, EVERY_S = 0.05, 1.0
"""A scene is prepared again once its contacts have rested for `AT_REST_S`, or after `EVERY_S` of changes [s]."""
MOST = 4
"""Number of touched objects, the latest ones, for which a scene is prepared; two hands touch two."""


class Answer(NamedTuple):
    """Gains (n_hands, n_frequencies) [-] of the hands `among`."""

    among: Collection[str]
    gains: Floats


class ImpactPreparation:
    """Prepares the scene around touched objects. Call all methods on the game's thread.

    A worker publishes the newest scene in a single slot, so that an impact is felt with it before the next update.
    Parameters: submit : passes a function to a worker.
    """

    def __init__(
        self, model: CoupledModel, state: SceneState, submit: Callable[[Callable[[], None]], Future[None]]
    ) -> None:
        self._model, self._state, self._submit = model, state, submit
        self._prepared: tuple[Mapping[str, Body], ImpactScene] | None = None
        self._touched: list[str] = []
        self._ordered_version = -1
        self._job: Future[None] | None = None
        self._expected: Collection[str] = ()
        self._version, self._changed_at_s, self._ordered_at_s = -1, 0.0, 0.0
        self._settled_version = -1

    def expect(self, object_ids: Collection[str]) -> None:
        """Request the scene around these objects, unless it is prepared for the present contacts; one at a time."""
        version = self._state.graph.version
        if version == self._settled_version and object_ids == self._expected:
            return
        self._expected, now = object_ids, time.monotonic()
        if version != self._version:
            self._version, self._changed_at_s = version, now
        if self._job is None or self._job.done():
            rests = now - self._changed_at_s >= AT_REST_S or now - self._ordered_at_s >= EVERY_S
            if not self._order_next(version, rests=rests) and rests:
                self._settled_version = version

    def wait(self, end: Deadline) -> bool:
        """Wait until all expected objects are prepared; false after the deadline."""
        while True:
            if self._job is not None and wait([self._job], end.left_s).not_done:
                return False
            if not self._order_next(self._state.graph.version, rests=True):
                return True

    def answer(
        self,
        object_id: str,
        point_m: Point,
        hands: Mapping[str, Sequence[TouchedPoint]],
        frequencies_hz: Floats,
    ) -> Answer | None:
        """Return the gains of an impact at each hand that is prepared for it: the largest over the hand's touches.

        None if no hand is prepared.
        """
        if self._prepared is None:
            return None
        bodies, scene = self._prepared

        def is_ready(touched_id: str) -> bool:
            same = all(bodies.get(x) is self._state.bodies.get(x) for x in (touched_id, object_id))
            return same and scene.knows(touched_id, object_id)

        ready = {hand: touched for hand, touched in hands.items() if touched and all(is_ready(x) for x, _ in touched)}
        if not ready:
            return None
        struck_m = self._on_plate(object_id, point_m)
        felt = [(x, self._on_plate(x, at)) for touched in ready.values() for x, at in touched]
        starts = np.cumsum([0, *map(len, ready.values())])[:-1]

        gains = np.maximum.reduceat(scene.gains(object_id, struck_m, felt, frequencies_hz), starts, axis=0)
        return Answer(ready.keys(), at_least_itself(gains, object_id, [*ready.values()]))

    def _on_plate(self, object_id: str, point_m: Point) -> Floats:
        return np.array([self._state.on_plate(object_id, point_m)], dtype=np.float64)

    def _order_next(self, version: int, *, rests: bool) -> bool:
        """Request the scene if it lacks an expected object, or if it is outdated and `rests`. Returns true if so."""
        expected = [x for x in self._expected if x in self._state.bodies]
        is_missing = not set(expected) <= set(self._touched)
        if not expected or not (is_missing or (version != self._ordered_version and rests)):
            return False
        others = [x for x in self._touched if x not in expected and x in self._state.bodies]
        self._touched = [*others, *expected][-max(MOST, len(expected)) :]
        self._order(version)
        return True

    def _order(self, version: int) -> None:
        touched, bodies = tuple(self._touched), self._state.bodies
        self._ordered_version, self._ordered_at_s = version, time.monotonic()
        # An object that touches no other of known material is in no network, so the whole scene is prepared for it.
        put_together = self._state.network(touched if all(map(self._state.touches_a_body, touched)) else None)

        def work() -> None:
            try:
                scene = prepare_struck(self._model, put_together(touched).network, touched)
            except Exception:  # the field in use fails in the same way, and warns
                self._prepared = None
            else:
                self._prepared = bodies, scene

        self._job = self._submit(work)
