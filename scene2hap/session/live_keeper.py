"""Counterpart of `FieldKeeper` for models with live fields, which read the contacts by themselves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from scene2hap.haptics import Bands
from scene2hap.propagation.live import LiveField, LiveModel
from scene2hap.propagation.protocol import Body, Excitation
from scene2hap.session.reach import Reach
from scene2hap.session.scene_state import SceneState


class LiveKeeper:
    """Provides a live field, and makes another one when sources or objects come and go. It is never out of date.

    Raises: the errors of the model.
    """

    is_current = True
    age_s = latency_s = 0.0
    n_failed = 0
    last_failure = ""

    def __init__(self, model: LiveModel, bands: Bands, state: SceneState, excitations: Sequence[Excitation]) -> None:
        self._model, self._bands, self._state = model, bands, state
        self.n_prepared = 0
        self._made_for: tuple[Mapping[str, Body], Sequence[Excitation]] | None = None
        self.request(excitations)

    @property
    def field(self) -> LiveField:
        """The field to evaluate."""
        return self.in_use

    def request(self, excitations: Sequence[Excitation]) -> None:
        """Make a field of the present objects and sources, unless the one in use is of the same."""
        self.n_prepared += 1
        bodies = self._state.bodies
        if self._made_for is None or self._made_for[0] is not bodies or self._made_for[1] is not excitations:
            self._made_for = (bodies, excitations)
            self.in_use: LiveField = self._model.live(self._state.graph, bodies, excitations, self._bands)

    def order(self) -> None:
        """Nothing is left to be prepared."""

    def method(self, source_ids: tuple[str, ...], reach: Reach) -> LiveField:
        """The field of these sources."""
        return self.in_use

    unnoted = method

    def take(self) -> bool:
        """False: there is never another field."""
        return False

    def wait(self, timeout_s: float | None = None) -> bool:
        """True: nothing is being prepared."""
        return True
