"""The worker that prepares fields: first for the objects near the hands, then for all objects once the scene rests.

Threads: the worker takes the newest scene state from a queue and drops older ones. It publishes the result in a single
slot. Neither side waits for the other.
"""

from __future__ import annotations

import contextlib
import dataclasses
from collections import deque
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum, auto
from functools import partial
from queue import Empty, SimpleQueue
from threading import Event, Thread

import numpy as np

from scene2hap.common.worker_threads import start_worker
from scene2hap.haptics import Bands
from scene2hap.propagation.live import TouchedPoint
from scene2hap.propagation.protocol import (
    Excitation,
    ExpectantField,
    PropagationField,
    PropagationModel,
    checked_field,
)
from scene2hap.scene.pose import Pose
from scene2hap.session.present_scene.scene_state import ModelInput

AT_REST_S = 0.05
"""Time without a change after which the whole scene is prepared, not only the objects near the hands [s]."""


@dataclass(eq=False)
class FieldRequest:
    """A scene state for which a field is prepared.

    Parameters: network : makes the model's input in any thread, for the objects connected to the given objects, or for
    all objects if none are given; poses : of all objects in this state; requested_at_s, outdated_at_s : begin and end
    of this state, by `time.monotonic` [s].
    """

    number: int
    network: Callable[[Collection[str]], ModelInput]
    excitations: Sequence[Excitation]
    poses: Mapping[str, Pose]
    requested_at_s: float
    outdated_at_s: float | None = None


class WorkerSignal(Enum):
    """Signals to the worker besides scene states."""

    TOUCHED = auto()
    """Hands touch an object for which the newest field has not called `expect`."""
    END = auto()


Order = FieldRequest | WorkerSignal


@dataclass(frozen=True, eq=False)
class PreparedField:
    """A field, its scene state, the objects that it covers (None for all), and the objects prepared by `expect`."""

    field: PropagationField
    request: FieldRequest
    covers: Collection[str] | None = None
    expected: set[str] = dataclasses.field(default_factory=set)

    def expect(self, touched: Sequence[TouchedPoint]) -> None:
        """Evaluate the field at touches in advance, since the first evaluation would slow down `update`."""
        for object_id, point_m in touched:
            if self.covers is None or object_id in self.covers:
                self.expected.add(object_id)
                # Errors are raised again by the evaluation in `update`, where they are handled.
                with contextlib.suppress(Exception):
                    if isinstance(self.field, ExpectantField):
                        self.field.expect(object_id)
                    self.field.attenuation(object_id, np.array([point_m]))


@dataclass(eq=False)
class FieldWorker:
    """Prepares fields, on the keeper's thread or on its own; see `start`.

    It has no reference to the keeper, so that an unused keeper can be freed.
    """

    model: PropagationModel
    bands: Bands
    orders: SimpleQueue[Order] = dataclasses.field(default_factory=SimpleQueue)
    answers: deque[PreparedField | tuple[FieldRequest, Exception]] = dataclasses.field(
        default_factory=lambda: deque(maxlen=1)
    )
    has_answered: Event = dataclasses.field(default_factory=Event)
    touched: Sequence[TouchedPoint] = ()
    n_followed: int = 0
    """Number of orders that were carried out, or dropped for a newer one."""
    # Fields that are no longer in use. The worker frees their memory, since that takes time.
    spent: deque[PreparedField] = dataclasses.field(default_factory=lambda: deque(maxlen=4))

    def prepare(self, request: FieldRequest, near: Collection[str] = ()) -> PreparedField:
        """Prepare a field of the objects connected to the objects `near`; of all objects if none are given."""
        network, covers = request.network(near)
        field = self.model.prepare(network, request.excitations, self.bands)
        return PreparedField(checked_field(self.model, field, request.excitations), request, covers)

    def start(self, newest: PreparedField) -> Thread:
        """Start a thread that carries out orders until `WorkerSignal.END`; `newest` is the field that is in use."""
        return start_worker(partial(self._work, newest), "propagation", partial(self.orders.put, WorkerSignal.END))

    def _work(self, newest: PreparedField) -> None:
        is_whole, (order, n_orders) = True, self._newest(self.orders.get())
        while order is not WorkerSignal.END:
            if isinstance(order, FieldRequest):
                self.spent.clear()
                found = self._answer(order, {object_id for object_id, _ in self.touched})
                newest, is_whole = found or newest, found is None or found.covers is None
            else:
                newest.expect(self.touched)
            self.n_followed += n_orders
            self.has_answered.set()
            try:
                order, n_orders = self._newest(self.orders.get(timeout=None if is_whole else AT_REST_S))
            except Empty:
                newest, is_whole = self._answer(newest.request, ()) or newest, True
                self.has_answered.set()
                order, n_orders = self._newest(self.orders.get())

    def _answer(self, order: FieldRequest, near: Collection[str]) -> PreparedField | None:
        """Prepare and publish a field; see `prepare`. If the model fails, publish the error and return None."""
        try:
            prepared = self.prepare(order, near)
        except Exception as problem:
            self.answers.append((order, problem))
            return None
        else:
            prepared.expect(self.touched)
            self.answers.append(prepared)
            return prepared

    def _newest(self, order: Order) -> tuple[Order, int]:
        """The next order (`END`, else the newest scene state), and the number of orders taken from the queue."""
        waiting = [order]
        with contextlib.suppress(Empty):
            while True:
                waiting.append(self.orders.get_nowait())
        if WorkerSignal.END in waiting:
            return WorkerSignal.END, len(waiting)
        return next((one for one in reversed(waiting) if isinstance(one, FieldRequest)), order), len(waiting)
