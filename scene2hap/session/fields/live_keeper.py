"""Provides the live field of a model, which follows contacts by itself, and needs no worker."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from scene2hap.common.deadline import Deadline
from scene2hap.haptics import Bands
from scene2hap.propagation.live import LiveField, LiveModel, SucceedingField
from scene2hap.propagation.protocol import Body, Excitation, PropagationField, PropagationModel
from scene2hap.session.fields.prepared import LastField
from scene2hap.session.present_scene.reach import Reach
from scene2hap.session.present_scene.scene_state import SceneState
from scene2hap.session.stats import SessionStats

_MANY = 100
"""Number of points from which a prepared field is used for a map. A live field searches from each point, up to where
nothing is felt, and a prepared field from each source. Both take equally long at 10 to 350 points, in furnished rooms
and on floors of 100 to 1,000 objects with 4 to 549 sources. In rooms with 2 or 3 sources, of which few points feel any,
a prepared field pays at more points or never; it takes 1 to 4 ms there."""


class LiveKeeper:
    """Provides a live field, which is never outdated. It is replaced when sources or objects are added or removed.

    Raises: the errors of the model.
    """

    is_current = True
    failure = ""

    def __init__(self, model: LiveModel, bands: Bands, state: SceneState, excitations: Sequence[Excitation]) -> None:
        self._model, self._bands, self._state = model, bands, state
        self._n_requests = 0
        self._made_for: tuple[Mapping[str, Body], Sequence[Excitation]] | None = None
        self._mapped: tuple[int, PropagationField] | None = None
        self.request(excitations)

    @property
    def stats(self) -> SessionStats:
        """See `FieldProvider`. A live field follows the scene at once."""
        return SessionStats(fields_prepared=self._n_requests)

    def request(self, excitations: Sequence[Excitation]) -> None:
        """Make a field of the present objects and sources, unless the field in use has the same ones."""
        self._n_requests += 1
        bodies = self._state.bodies
        if self._made_for is None or self._made_for[0] is not bodies or self._made_for[1] is not excitations:
            field = self._model.live(self._state.graph, bodies, excitations, self._bands)
            if self._made_for is not None and isinstance(field, SucceedingField):
                field.succeed(self.field)
            self._made_for = (bodies, excitations)
            self.field: LiveField = field
        self._mapped = None

    def order(self) -> None:
        """Do nothing: a live field needs no preparation."""

    def for_touches(self, source_ids: tuple[str, ...], reach: Reach) -> LiveField:
        """Return the field, which follows sources and contacts by itself."""
        return self.field

    def for_points(self, source_ids: tuple[str, ...], reach: Reach, n_points: int) -> LiveField:
        """See `FieldProvider`.

        For many points the model prepares a field, which stays in use until contacts, sources or objects change.
        """
        if n_points < _MANY or not isinstance(self._model, PropagationModel):
            return self.field
        version = self._state.graph.version
        if self._mapped is None or self._mapped[0] != version:
            assert self._made_for is not None
            network, (_, excitations) = self._state.network(None)(()).network, self._made_for
            self._mapped = (version, self._model.prepare(network, excitations, self._bands))
        poses, now = self._state.poses, self._state.graph.pose
        return LastField(self._mapped[1], poses, now, source_ids, self._bands.n_bands, reach, lambda: True)

    def take(self) -> bool:
        """Return False: there is never a newer field."""
        return False

    def wait(self, end: Deadline) -> bool:
        """Return True at once, since a live field needs no preparation."""
        return True
