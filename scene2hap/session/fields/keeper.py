"""Provides the newest field that a worker has prepared.

Call all methods on the game's thread. The worker ends with the keeper.
"""

from __future__ import annotations

import time
import weakref
from collections.abc import Callable, Sequence
from threading import Thread

from scene2hap.common.deadline import Deadline
from scene2hap.common.warning import warn_of
from scene2hap.errors import failure_of
from scene2hap.haptics import Bands
from scene2hap.propagation.controls import NoPropagation
from scene2hap.propagation.live import TouchedPoint
from scene2hap.propagation.protocol import (
    ContactNetwork,
    Excitation,
    ExpectantField,
    PropagationField,
    PropagationModel,
    follows_poses,
)
from scene2hap.session.fields.prepared import FieldInUse, LastField
from scene2hap.session.fields.worker import FieldRequest, FieldWorker, PreparedField, WorkerSignal
from scene2hap.session.present_scene.reach import Reach
from scene2hap.session.present_scene.scene_state import SceneState
from scene2hap.session.stats import SessionStats


class FieldWarning(RuntimeWarning):
    """The model could not prepare a field of the present scene."""


class FieldKeeper:
    """Prepares fields for the present scene. The last field stays in use until a newer one is ready.

    Parameters: is_background : whether a worker prepares, beginning now; until the first field is ready, each source is
    felt on itself alone; skips_unreachable : leave objects that no source reaches out of the model's input. An outdated
    field is silent for sources without a path, unless the model follows poses.
    Raises: the errors of the model, if no worker prepares.
    """

    def __init__(
        self,
        model: PropagationModel,
        bands: Bands,
        state: SceneState,
        excitations: Sequence[Excitation],
        *,
        is_background: bool,
        skips_unreachable: bool,
    ) -> None:
        self._worker = FieldWorker(model, bands)
        self._state, self._follows_poses = state, follows_poses(model)
        # For the fields that the keeper holds: only the garbage collector could free a cycle of strong references, and
        # a game may switch it off, or call `gc.freeze`.
        self._weak: FieldKeeper = weakref.proxy(self)
        self._is_background, self._skips_unreachable = is_background, skips_unreachable
        self._thread: Thread | None = None
        self._must_expect = self._is_expectant = False
        self._for_touches: tuple[FieldInUse, tuple[str, ...], Reach] | None = None
        # Number of the last request with a field of all objects or an error, number of the last request for the worker,
        # and how many orders the worker got.
        self._n_answered = self._n_ordered = self._n_put = 0
        self._n_prepared = self._n_failed = 0
        self._last_failure, self._latency_s = "", 0.0
        self.failure: str = ""
        """See `FieldProvider`."""
        before = self._request(0, excitations)
        self._whole = PreparedField(NoPropagation().prepare(ContactNetwork({}), excitations, bands), before)
        self.in_use: PreparedField = self._whole
        self._requested = before
        self.request(excitations)
        self.order()

    @property
    def field(self) -> PropagationField:
        """The prepared field in use, which may not cover all objects."""
        return self.in_use.field

    @property
    def is_current(self) -> bool:
        """Whether the field in use was prepared for the newest scene state."""
        return self.in_use.request is self._requested

    @property
    def stats(self) -> SessionStats:
        """See `FieldProvider`."""
        outdated = self.in_use.request.outdated_at_s
        return SessionStats(
            fields_prepared=self._n_prepared,
            field_age_s=0.0 if outdated is None else time.monotonic() - outdated,
            field_latency_s=self._latency_s,
            fields_failed=self._n_failed,
            last_failure=self._last_failure,
        )

    def request(self, excitations: Sequence[Excitation]) -> None:
        """Request a field for the present scene. It is prepared at once, or by the worker from the next `order` on."""
        before, self._requested = self._requested, self._request(self._requested.number + 1, excitations)
        before.outdated_at_s = self._requested.requested_at_s
        if not self._is_background:
            self._use(self._worker.prepare(self._requested))

    def order(self) -> None:
        """See `FieldProvider`."""
        if not self._is_background:
            return
        if self._n_ordered != self._requested.number:
            self._n_ordered = self._requested.number
            self._put(self._requested)
        elif self._must_expect:
            self.in_use.expected.update(object_id for object_id, _ in self._worker.touched)
            self._put(WorkerSignal.TOUCHED)
        self._must_expect = False

    def for_touches(self, source_ids: tuple[str, ...], reach: Reach) -> FieldInUse:
        """See `FieldProvider`. It switches to each newer field by itself."""
        if self._for_touches is not None and self._for_touches[1:] == (source_ids, reach):
            return self._for_touches[0]
        keeper = self._weak
        field = self._in_use(source_ids, reach, lambda touched: keeper._note_touched(touched))
        self._for_touches = (field, source_ids, reach)
        return field

    def for_points(self, source_ids: tuple[str, ...], reach: Reach, n_points: int) -> FieldInUse:
        """See `FieldProvider`."""
        return self._in_use(source_ids, reach, lambda touched: None)

    def _in_use(
        self, source_ids: tuple[str, ...], reach: Reach, note: Callable[[Sequence[TouchedPoint]], None]
    ) -> FieldInUse:
        now, n_bands, keeper = self._state.graph.pose, self._worker.bands.n_bands, self._weak

        def as_now(one: PreparedField) -> LastField:
            then, request = one.request.poses, one.request
            return LastField(
                one.field,
                then,
                now,
                source_ids,
                n_bands,
                reach,
                lambda: keeper._follows_poses or request is keeper._requested,
            )

        field = FieldInUse(source_ids, as_now, note)
        field.use(self.in_use, self._whole)
        return field

    def take(self) -> bool:
        """See `FieldProvider`."""
        try:
            answer = self._worker.answers.pop()
        except IndexError:
            return False
        if isinstance(answer, PreparedField):
            self._use(answer)
            return True
        request, problem = answer
        self._n_answered = request.number
        self._note_failure(problem)
        return False

    def wait(self, end: Deadline) -> bool:
        """Wait until no field is being prepared and `expect` has run for all touched objects, and use the new field.

        Returns false after the deadline.
        """
        self.order()
        while True:
            self._worker.has_answered.clear()
            self.take()
            if self._n_answered == self._requested.number and self._worker.n_followed == self._n_put:
                return True
            if end.left_s == 0:
                return False
            self._worker.has_answered.wait(end.left_s)

    def _request(self, number: int, excitations: Sequence[Excitation]) -> FieldRequest:
        now, state = time.monotonic(), self._state
        source_ids = [item.source_id for item in excitations] if self._skips_unreachable else None
        return FieldRequest(number, state.network(source_ids), excitations, state.poses, now)

    def _use(self, found: PreparedField) -> None:
        request, before = found.request, self.in_use.request
        if self._is_background:
            self._worker.spent.append(self.in_use)
        self.in_use, self._is_expectant = found, isinstance(found.field, ExpectantField)
        if found.covers is None:
            self._whole, self._n_answered = found, request.number
        if self._for_touches is not None:
            self._for_touches[0].use(found, self._whole)
        self._n_prepared += 1
        self.failure = ""
        if request is not before:
            self._latency_s = time.monotonic() - request.requested_at_s

    def _note_touched(self, touched: Sequence[TouchedPoint]) -> None:
        self._worker.touched = touched
        if self._is_expectant:
            expected = self.in_use.expected
            self._must_expect = not expected.issuperset([object_id for object_id, _ in touched])

    def _note_failure(self, problem: Exception) -> None:
        self._n_failed += 1
        self._last_failure = failure_of(problem)
        instead = "the last one plays on" if self._n_prepared else "each source is felt on itself alone"
        failure = f"The model could not prepare a field, so that {instead}: {self._last_failure}"
        # Once until a field is prepared again, since a game may change its scene in every frame.
        if not self.failure:
            warn_of(failure, FieldWarning)
        self.failure = failure

    def _put(self, order: FieldRequest | WorkerSignal) -> None:
        if self._thread is None or not self._thread.is_alive():
            self._thread = self._worker.start(self.in_use)
            weakref.finalize(self, self._worker.orders.put, WorkerSignal.END)
        self._n_put += 1
        self._worker.orders.put(order)
