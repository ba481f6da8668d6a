"""Keeps a propagation field at hand: the newest that is ready, while a worker prepares the next.

Threads: all methods belong to the game's thread. The worker gets what is to be prepared by a queue, skips what is no
longer the newest, and leaves its answer in one slot; neither ever waits for the other. It ends with the keeper.
"""

from __future__ import annotations

import threading
import time
import warnings
import weakref
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from queue import Empty, SimpleQueue

from scene2hap.errors import Scene2HapError
from scene2hap.haptics import Bands
from scene2hap.propagation.protocol import ContactNetwork, Excitation, PropagationField, PropagationModel
from scene2hap.scene.pose import Pose
from scene2hap.session.last_field import LastField
from scene2hap.session.reach import Reach
from scene2hap.session.stage import Stage


@dataclass(eq=False)
class Situation:
    """What a field is prepared for.

    Parameters: network : puts together what the model is told, in whatever thread; poses : of all objects then;
    asked_at_s, outdated_at_s : when it began and ended to be how things are, by `time.monotonic` [s].
    """

    number: int
    network: Callable[[], ContactNetwork]
    excitations: Sequence[Excitation]
    poses: Mapping[str, Pose]
    asked_at_s: float
    outdated_at_s: float | None = None


@dataclass(frozen=True, eq=False)
class Prepared:
    """A field and the situation that it tells of."""

    field: PropagationField
    situation: Situation


@dataclass(eq=False)
class _Desk:
    """What keeper and worker share; the worker knows nothing else, so that a keeper can be forgotten."""

    model: PropagationModel
    bands: Bands
    orders: SimpleQueue[Situation | None] = field(default_factory=SimpleQueue)
    answers: deque[tuple[Situation, PropagationField | Exception]] = field(default_factory=lambda: deque(maxlen=1))
    has_answered: threading.Event = field(default_factory=threading.Event)

    def prepare(self, situation: Situation) -> PropagationField:
        return self.model.prepare(situation.network(), situation.excitations, self.bands)

    def work(self) -> None:
        while (order := self._newest(self.orders.get())) is not None:
            try:
                self.answers.append((order, self.prepare(order)))
            except Exception as problem:
                self.answers.append((order, problem))
            self.has_answered.set()

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
        self._n_answered = 0
        self.in_use = Prepared(self._desk.prepare(self._asked), self._asked)
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
        """Have a field prepared for things as they are now."""
        before, self._asked = self._asked, self._situation(self._asked.number + 1, excitations)
        before.outdated_at_s = self._asked.asked_at_s
        if self._is_background:
            self._start()
            self._desk.orders.put(self._asked)
        else:
            self._n_answered = self._asked.number
            self._use(self._asked, self._desk.prepare(self._asked))

    def hearing(self, source_ids: tuple[str, ...], reach: Reach) -> LastField:
        """The field in use, for these sources and what hangs together now."""
        in_use, now = self.in_use, self._stage.graph.pose
        n_bands = self._desk.bands.n_bands
        return LastField(in_use.field, in_use.situation.poses, now, source_ids, n_bands, reach, lambda: self.is_current)

    def take(self) -> bool:
        """Take the newest field that is ready into use; false if it is already."""
        try:
            situation, found = self._desk.answers.pop()
        except IndexError:
            return False
        self._n_answered = situation.number
        if isinstance(found, Exception):
            self._note(found)
            return False
        self._use(situation, found)
        return True

    def wait(self, timeout_s: float | None = None) -> bool:
        """Wait until nothing is being prepared; false after the timeout [s]. The field is then taken into use."""
        end_s = None if timeout_s is None else time.monotonic() + timeout_s
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

    def _use(self, situation: Situation, found: PropagationField) -> None:
        self.in_use = Prepared(found, situation)
        self._n_answered = situation.number
        self.n_prepared += 1
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
