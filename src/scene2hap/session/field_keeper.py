"""Keeps a propagation field at hand: the newest that is ready, while a worker prepares the next.

What hangs together with what hands touch is prepared first, and everything once nothing changes any more.

Threads: all methods belong to the game's thread. The worker gets what is to be prepared by a queue, skips what is no
longer the newest, and leaves its answer in one slot; neither ever waits for the other. It ends with the keeper.
"""

from __future__ import annotations

import contextlib
import threading
import time
import warnings
import weakref
from collections import deque
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from queue import Empty, SimpleQueue

from scene2hap.errors import Scene2HapError
from scene2hap.haptics import Bands
from scene2hap.propagation.live import TouchedPoint
from scene2hap.propagation.protocol import Excitation, PropagationField, PropagationModel
from scene2hap.scene.pose import Pose
from scene2hap.session.last_field import LastField
from scene2hap.session.noted_field import NotedField
from scene2hap.session.reach import Reach
from scene2hap.session.stage import Stage, Told

AT_REST_S = 0.05
"""Time without a change after which everything is prepared, and not only what hands can feel."""


@dataclass(eq=False)
class Situation:
    """What a field is prepared for.

    Parameters: network : puts together what the model is told, of what hangs together with some objects or of
    everything for none, in whatever thread; poses : of all objects then; asked_at_s, outdated_at_s : when it began and
    ended to be how things are, by `time.monotonic` [s].
    """

    number: int
    network: Callable[[Collection[str]], Told]
    excitations: Sequence[Excitation]
    poses: Mapping[str, Pose]
    asked_at_s: float
    outdated_at_s: float | None = None


@dataclass(frozen=True, eq=False)
class Prepared:
    """A field, the situation that it tells of, and the objects of which it may say something, None for all."""

    field: PropagationField
    situation: Situation
    covers: Collection[str] | None = None


@dataclass(eq=False)
class _Desk:
    """What keeper and worker share; the worker knows nothing else, so that a keeper can be forgotten."""

    model: PropagationModel
    bands: Bands
    orders: SimpleQueue[Situation | None] = field(default_factory=SimpleQueue)
    answers: deque[Prepared | tuple[Situation, Exception]] = field(default_factory=lambda: deque(maxlen=1))
    has_answered: threading.Event = field(default_factory=threading.Event)
    touched: Sequence[TouchedPoint] = ()
    # Fields that are in use no more: giving back their memory is left to the worker, too.
    spent: deque[Prepared] = field(default_factory=lambda: deque(maxlen=4))

    def prepare(self, situation: Situation, near: Collection[str] = ()) -> Prepared:
        network, covers = situation.network(near)
        return Prepared(self.model.prepare(network, situation.excitations, self.bands), situation, covers)

    def work(self) -> None:
        order = self._newest(self.orders.get())
        while order is not None:
            self.spent.clear()
            is_whole = self._answer(order, {object_id for object_id, _ in self.touched})
            try:
                following = self.orders.get(timeout=None if is_whole else AT_REST_S)
            except Empty:
                self._answer(order, ())
                following = self.orders.get()
            order = self._newest(following)

    def _answer(self, order: Situation, near: Collection[str]) -> bool:
        """Prepare what is near some objects, or everything for none; true if it came to everything."""
        is_whole = True
        try:
            prepared = self.prepare(order, near)
            self._touch(prepared.field)
            self.answers.append(prepared)
            is_whole = prepared.covers is None
        except Exception as problem:
            self.answers.append((order, problem))
        self.has_answered.set()
        return is_whole

    def note(self, touched: Sequence[TouchedPoint]) -> None:
        """Remember what hands touch now."""
        self.touched = touched

    def _touch(self, found: PropagationField) -> None:
        """Ask a field what will be asked first, so that what it works out then is not left to the game's thread."""
        for object_id, point_m in self.touched:
            # Whatever it refuses, it refuses where it is asked in earnest.
            with contextlib.suppress(Exception):
                found.attenuation(object_id, [point_m])

    def _newest(self, order: Situation | None) -> Situation | None:
        """The last of what waits; None, the end, is always the last."""
        while order is not None:
            try:
                order = self.orders.get_nowait()
            except Empty:
                break
        return order


class FieldKeeper:
    """The field in use, and how it is kept up to date.

    Parameters: is_background : whether a worker prepares; the first field is always waited for; skips_unreachable : do
    not tell the model of what no source reaches.
    Raises: what the model raises of the first situation; later, only if it is prepared in place.
    """

    def __init__(
        self,
        model: PropagationModel,
        bands: Bands,
        stage: Stage,
        excitations: Sequence[Excitation],
        *,
        is_background: bool,
        skips_unreachable: bool,
    ) -> None:
        self._desk = _Desk(model, bands)
        self._stage = stage
        self._is_background, self._skips_unreachable = is_background, skips_unreachable
        self._worker: threading.Thread | None = None
        self._asked = self._situation(0, excitations)
        self._n_answered = self._n_ordered = 0
        self.in_use = self._whole = self._desk.prepare(self._asked)
        self.n_prepared, self.n_failed, self.last_failure = 1, 0, ""
        self.latency_s = 0.0

    @property
    def is_current(self) -> bool:
        """Whether the field in use tells of the newest situation."""
        return self.in_use.situation is self._asked

    @property
    def age_s(self) -> float:
        """For how long the field in use has been out of date [s]."""
        outdated = self.in_use.situation.outdated_at_s
        return 0.0 if outdated is None else time.monotonic() - outdated

    def ask(self, excitations: Sequence[Excitation]) -> None:
        """Want a field for things as they are now: prepared here, or by the worker from the next `order` on."""
        before, self._asked = self._asked, self._situation(self._asked.number + 1, excitations)
        before.outdated_at_s = self._asked.asked_at_s
        if not self._is_background:
            self._use(self._desk.prepare(self._asked))

    def order(self) -> None:
        """Let the worker begin with what was asked for last: at the end of an update, which it would slow down."""
        if self._is_background and self._n_ordered != self._asked.number:
            self._n_ordered = self._asked.number
            self._start()
            self._desk.orders.put(self._asked)

    def hearing(self, source_ids: tuple[str, ...], reach: Reach) -> NotedField:
        """The field in use, for these sources and what hangs together now."""
        now, n_bands = self._stage.graph.pose, self._desk.bands.n_bands

        def last(one: Prepared) -> LastField:
            then = one.situation.poses
            return LastField(one.field, then, now, source_ids, n_bands, reach, lambda: one.situation is self._asked)

        return NotedField(last(self.in_use), self.in_use.covers, last(self._whole), self._desk.note)

    def take(self) -> bool:
        """Take the newest field that is ready into use; false if it is already."""
        try:
            answer = self._desk.answers.pop()
        except IndexError:
            return False
        if isinstance(answer, Prepared):
            self._use(answer)
            return True
        situation, problem = answer
        self._n_answered = situation.number
        self._note(problem)
        return False

    def wait(self, timeout_s: float | None = None) -> bool:
        """Wait until nothing is being prepared; false after the timeout [s]. The field is then taken into use."""
        end_s = None if timeout_s is None else time.monotonic() + timeout_s
        self.order()
        while True:
            self._desk.has_answered.clear()
            self.take()
            if self._n_answered == self._asked.number:
                return True
            rest_s = None if end_s is None else end_s - time.monotonic()
            if rest_s is not None and rest_s <= 0:
                return False
            self._desk.has_answered.wait(rest_s)

    def _situation(self, number: int, excitations: Sequence[Excitation]) -> Situation:
        now, stage = time.monotonic(), self._stage
        source_ids = [item.source_id for item in excitations] if self._skips_unreachable else None
        return Situation(number, stage.network(source_ids), excitations, stage.poses, now)

    def _use(self, found: Prepared) -> None:
        situation, before = found.situation, self.in_use.situation
        if self._is_background:
            self._desk.spent.append(self.in_use)
        self.in_use = found
        if found.covers is None:
            self._whole, self._n_answered = found, situation.number
        self.n_prepared += 1
        if situation is not before:
            self.latency_s = time.monotonic() - situation.asked_at_s

    def _note(self, problem: Exception) -> None:
        self.n_failed += 1
        self.last_failure = str(problem) if isinstance(problem, Scene2HapError) else repr(problem)
        told = f"a field could not be prepared, so that the last one plays on: {self.last_failure}"
        warnings.warn(told, RuntimeWarning, stacklevel=5)

    def _start(self) -> None:
        if self._worker is None or not self._worker.is_alive():
            self._worker = threading.Thread(target=self._desk.work, name="scene2hap propagation", daemon=True)
            self._worker.start()
            weakref.finalize(self, self._desk.orders.put, None)
