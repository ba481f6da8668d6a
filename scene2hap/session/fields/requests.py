"""Decides when the propagation field must be prepared again: after which changes of objects, contacts and sources.

A change that no source reaches over contacts needs no new field. A game may add and remove many objects between two
frames, which are handled at once in the next one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

from scene2hap.common.deadline import Deadline
from scene2hap.contact.graph import ContactChange
from scene2hap.propagation.exponential_plate import ExponentialPlate
from scene2hap.propagation.live import LiveField, live_model
from scene2hap.propagation.protocol import Body, Excitation, PropagationField, follows_poses
from scene2hap.propagation.reference import FeltNear
from scene2hap.scene.pose import Pose
from scene2hap.session.config import SessionConfig
from scene2hap.session.fields.keeper import FieldKeeper
from scene2hap.session.fields.live_keeper import LiveKeeper
from scene2hap.session.mix.sources import Sources
from scene2hap.session.present_scene.network import excitations_of
from scene2hap.session.present_scene.reach import Reach
from scene2hap.session.present_scene.scene_state import SceneState
from scene2hap.session.stats import SessionStats, SkipCounts


class FieldProvider(Protocol):
    """Provides the field of the present scene."""

    @property
    def field(self) -> PropagationField | LiveField:
        """The field in use, as the model made it."""
        ...

    @property
    def is_current(self) -> bool:
        """Whether the field in use is that of the newest scene state."""
        ...

    @property
    def failure(self) -> str:
        """A sentence: why there is no newer field, though none is being prepared; empty if the model did not fail."""
        ...

    @property
    def stats(self) -> SessionStats:
        """The counters of fields; all others are 0."""
        ...

    def request(self, excitations: Sequence[Excitation]) -> None:
        """Request a field for the present scene."""
        ...

    def order(self) -> None:
        """Pass the newest request to the worker. Call it at the end of an update, so as not to slow down the update."""
        ...

    def take(self) -> bool:
        """Use the newest prepared field. Returns false if there is no newer one."""
        ...

    def wait(self, end: Deadline) -> bool:
        """Wait until no field is being prepared, and use the newest one. Returns false after the deadline."""
        ...

    def for_touches(self, source_ids: tuple[str, ...], reach: Reach) -> LiveField:
        """The field in use at touches, for these sources and connected objects. It is another one after a change."""
        ...

    def for_points(self, source_ids: tuple[str, ...], reach: Reach, n_points: int) -> LiveField:
        """See `for_touches`; for points that no hand touches, so that no worker prepares their objects."""
        ...


class FieldRequests:
    """Follows the groups of connected objects, and requests a field after each change that concerns a source.

    keeper : provides the field; reach : the groups, and the sources in each, for the scene at the last `catch_up`;
    is_caught_up : false while objects or sources were added or removed since then.
    Raises: the errors of the model, if no worker prepares.
    """

    def __init__(self, config: SessionConfig, state: SceneState, sources: Sources, counts: SkipCounts) -> None:
        self._config, self._state, self._sources, self._counts = config, state, sources, counts
        # None if the model does not follow poses.
        self._poses: Mapping[str, Pose] | None = state.poses if follows_poses(config.propagation) else None
        self._excitations: Sequence[Excitation] | None = None
        self._n_unreachable: int | None = None
        # Changes since objects or sources were added or removed, and whether one of them needs a field in any case.
        self._pending: list[ContactChange] = []
        self._must_request = False
        self.is_caught_up: bool = True
        self._find_reach()
        self.keeper: FieldProvider = _keeper_of(config, state, self.excitations)
        self._count_unreachable()

    @property
    def excitations(self) -> Sequence[Excitation]:
        """The excitation of each source in its present state; the same sequence until one changes."""
        if self._excitations is None:
            loops = [(row.source_id, row.loop) for row in self._sources.active_rows()]
            self._excitations = excitations_of(loops, self._state.bodies, self._state.haptics)
        return self._excitations

    def apply(self, change: ContactChange, *, sources_changed: bool) -> bool:
        """Apply a change of contacts; `sources_changed` is true if sources were added or removed.

        Returns true if the field may be another one with the next frame.
        """
        if sources_changed:
            self._excitations = None
        if sources_changed or self._bodies is not self._state.bodies:
            self.is_caught_up = False
        is_new = self._is_moved() or bool(change)
        if not self.is_caught_up:
            if not (is_new or sources_changed):
                return False
            self._pending.append(change)
            self._must_request = self._must_request or sources_changed or self._concerns_sources(change)
            return True
        if not is_new:
            return False
        concerned_sources = self._concerns_sources(change)
        if change.appeared or change.vanished:
            self.reach.follow(change)
            self._n_unreachable = None
        if concerned_sources or self.reach.concerns(change):
            self._request()
            return True
        self._counts.changes_out_of_reach += 1
        return False

    def states_changed(self) -> None:
        """Request a field: in another state a source has another frequency."""
        self._excitations = None
        if self.is_caught_up:
            self._request()
        else:
            self._must_request = True

    def catch_up(self) -> None:
        """Apply the additions and removals of objects and sources since the last call."""
        pending, must_request = self._pending, self._must_request
        self._pending, self._must_request, self.is_caught_up = [], False, True
        self._find_reach()
        if must_request or any(map(self.reach.concerns, pending)):
            self._request()
        else:
            self._counts.changes_out_of_reach += len(pending)

    def _concerns_sources(self, change: ContactChange) -> bool:
        return not self._config.skips_unreachable or self.reach.concerns(change)

    def _is_moved(self) -> bool:
        """Whether any object was moved, added or removed since the last call; False unless the model follows poses."""
        if self._poses is None:
            return False
        before, self._poses = self._poses, self._state.poses
        return self._poses != before

    def _find_reach(self) -> None:
        self._bodies: Mapping[str, Body] = self._state.bodies
        self.reach: Reach = self._state.reach(self._sources.ids)
        self._bodiless = [x for x in self._sources.ids if x not in self._bodies]
        self._n_unreachable = None

    def _request(self) -> None:
        self.keeper.request(self.excitations)
        self._count_unreachable()

    def _count_unreachable(self) -> None:
        if self._config.skips_unreachable:
            if self._n_unreachable is None:
                self._n_unreachable = len(self._bodies) - self.reach.n_without(self._bodiless)
            self._counts.unreachable_objects += self._n_unreachable


def _keeper_of(config: SessionConfig, state: SceneState, excitations: Sequence[Excitation]) -> FieldProvider:
    """Return the keeper for the configured model: `LiveKeeper` if it has a live field that need not be scaled."""
    model, bands = config.propagation, config.bands
    # The law is its own reference.
    is_scaled = config.reference == "felt_near" and not isinstance(model, ExponentialPlate)
    live = live_model(model)
    if live is not None and not is_scaled:
        return LiveKeeper(live, bands, state, excitations)
    if is_scaled:
        model = FeltNear(model)
    is_background, skips_unreachable = config.prepare == "background", config.skips_unreachable
    return FieldKeeper(
        model, bands, state, excitations, is_background=is_background, skips_unreachable=skips_unreachable
    )
