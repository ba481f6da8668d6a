"""A scene under hands.

`update` belongs to the game's thread and `render` to the audio thread. `update` keeps the contact graph, prepares the
propagation field when a contact changed, and turns touches into gains; `render` mixes the sources' loops with them.
Nothing here reaches a network, and `render` never waits for `update`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from scene2hap.bundle import HapticBundle
from scene2hap.contact.graph import ContactGraph
from scene2hap.devices import SINKS
from scene2hap.devices.protocol import ActuatorSink, Block, SinkFormat
from scene2hap.errors import ConfigError, SessionError, UnknownObject
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.protocol import Body, ContactNetwork, Excitation, PropagationField, PropagationModel
from scene2hap.render.loop_bank import LoopBank
from scene2hap.render.mixer import Mixer
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import Contact, SceneSnapshot, unknown_object
from scene2hap.session.config import MAX_GAIN_DB, MIN_RAMP_S, SessionConfig
from scene2hap.session.frame import HapticFrame, SessionStats, Touch
from scene2hap.session.sources import Sources


class HapticSession:
    """A scene under hands.

    Parameters: scene : objects and where they are now; bundle : what was baked for them; config : a SessionConfig or
    its settings; hands : names of the outputs; sink : where `start` sends the mix, None to call `render` oneself.
    Raises: ConfigError, UnknownObject: the bundle speaks of an object that the scene does not have.
    """

    def __init__(
        self,
        scene: SceneSnapshot,
        bundle: HapticBundle,
        config: SessionConfig | Mapping[str, Any] | None = None,
        *,
        hands: Sequence[str] = ("left", "right"),
        sink: ActuatorSink | str | Mapping[str, Any] | None = None,
    ) -> None:
        self.config = SessionConfig.parse(config)
        self.hands = tuple(hands)
        if not self.hands or len(set(self.hands)) < len(self.hands):
            raise ConfigError(f"hands is {self.hands!r}; it must be at least one name, each once.")
        self._scene = scene
        self._sources = Sources(bundle)
        for object_id in self._sources.ids:
            scene.object(object_id)
        self._bodies = _bodies(scene, bundle)
        self._graph = ContactGraph(scene)
        self._updates = self._fields_prepared = self._gains_capped = 0
        # One row of loops per state, so that switching states is a change of gains like any other: ramped, no click.
        tactile = [loop.tactile for loop in self._sources.all_loops()]
        self._bank = LoopBank(tactile, self.config.bands, self.config.sample_rate_hz)
        ramp_s = max(self.config.control_period_s, MIN_RAMP_S)
        self._mixer = Mixer(self._bank, len(self.hands), max(1, round(ramp_s * self.config.sample_rate_hz)))
        self._field = self._prepare()
        self._last_stamp = 0
        self._last_rows: NDArray[np.float32] | None = None
        built = SINKS.build(sink) if sink is not None else None
        if built is not None and not isinstance(built, ActuatorSink):
            raise ConfigError(f"sink is {built!r}; it must have open, start, stop, close and stats.")
        self._sink = built

    # -- the game's side --------------------------------------------------------------------------------------

    @property
    def source_ids(self) -> tuple[str, ...]:
        """The vibrating objects, in the order of `HapticFrame.gains`."""
        return self._sources.ids

    @property
    def snapshot(self) -> SceneSnapshot:
        """The scene as it is now."""
        return self._scene.with_poses(self._graph.poses)

    def update(
        self,
        moved: Mapping[str, Pose] | None = None,
        touches: Sequence[Touch] = (),
        *,
        contacts: Sequence[Contact] | None = None,
        at_sample: int | None = None,
    ) -> HapticFrame:
        """Take in a frame of the game, and set the gains that follow from it.

        Parameters: moved : new poses of objects that moved; touches : all touches of this frame (a hand that is not
        among them is lifted; one with several feels the largest gain per source); contacts : contacts that an engine
        tells, instead of those found from geometry; at_sample : the position on `render`'s clock from which the gains
        change, None for the next block.
        Raises: UnknownObject: a touched or moved object is not in the scene; SessionError: an unknown hand, or a
        position before that of the last update.
        """
        stamp = self._stamp(at_sample)
        felt = [(self._hand_index(touch), touch) for touch in touches]
        if moved or contacts is not None:
            change = self._graph.update(moved or {}, contacts=contacts)
            # A field is told in world coordinates, so that any move of a body in contact makes it stale.
            if change.appeared or change.vanished or change.shifted:
                self._field = self._prepare()
        gains = np.zeros((len(self.hands), len(self.source_ids), self.config.bands.n_bands))
        for hand, touch in felt:
            np.maximum(gains[hand], self._attenuation(touch), out=gains[hand])
        levels = np.array([self._sources.factor(source_id, self._graph) for source_id in self.source_ids])
        frame = HapticFrame((gains * levels[:, None]).astype(np.float32), self.hands, self.source_ids)
        rows = np.zeros((len(self.hands), len(self._bank), self.config.bands.n_bands), dtype=np.float32)
        rows[:, self._sources.active_rows()] = frame.gains
        if self._last_rows is None or not np.array_equal(rows, self._last_rows):
            self._mixer.set_gains(rows.reshape(len(self.hands), -1), stamp)
            self._last_rows = rows
        self._updates += 1
        return frame

    def set_source(
        self,
        source_id: str,
        *,
        on: bool | None = None,
        state: str | None = None,
        gain_db: float | None = None,
        mute: bool | None = None,
    ) -> None:
        """Switch a source on, off or to another state, or set its level; felt from the next update on.

        Raises: UnknownObject: not a source; SessionError: it has no such state, or the gain is out of bounds.
        """
        if state is not None and self._sources.set_state(source_id, state):
            self._field = self._prepare()
        self._sources.set(source_id, on, gain_db, mute)

    def set_user(self, *, gain_db: float | None = None, mute: bool | None = None) -> None:
        """Set the level of everything; felt from the next update on. Raises: SessionError: out of bounds."""
        self._sources.user.set(gain_db, mute)

    # -- the audio side ---------------------------------------------------------------------------------------

    def render(self, n_frames: int) -> Block:
        """The next samples of the mix (n_frames, n_hands) float32 in [-1, 1]."""
        return self._mixer.render(n_frames)

    @property
    def position(self) -> int:
        """The sample that `render` gives next, on the clock that `at_sample` speaks of."""
        return self._mixer.position

    def position_s(self, source_id: str) -> float:
        """Where in its loop a source is [s], for a game that plays the audible loop beside. Raises: UnknownObject."""
        length = self._bank.length(self._sources.active_row(source_id))
        return (self._mixer.position % length) / self.config.sample_rate_hz

    def start(self) -> None:
        """Send the mix to the sink. Raises: SessionError: the session has none; DeviceError: it cannot be opened."""
        if self._sink is None:
            raise SessionError("this session has no sink; give one to HapticSession(..., sink=), or call render.")
        self._sink.open(SinkFormat(self.config.sample_rate_hz, self.hands))
        self._sink.start(self.render)

    def stop(self) -> None:
        """Stop the sink and give it back; may be called twice."""
        if self._sink is not None:
            self._sink.stop()
            self._sink.close()

    def __enter__(self) -> Self:
        if self._sink is not None:
            self.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if error is None or self._sink is None:
            self.stop()
        else:
            # A sink that can tell a failed run from a finished one leaves no half-written file behind.
            getattr(self._sink, "abort", self.stop)()

    @property
    def stats(self) -> SessionStats:
        """What was done so far."""
        bodiless = tuple(item.id for item in self._scene.objects if item.id not in self._bodies)
        return SessionStats(self._updates, self._fields_prepared, self._gains_capped, bodiless)

    # -- from touches to gains --------------------------------------------------------------------------------

    def _stamp(self, at_sample: int | None) -> int:
        stamp = self._mixer.position if at_sample is None else at_sample
        if at_sample is not None and at_sample < self._last_stamp:
            raise SessionError(
                f"at_sample is {at_sample}; the last update was at {self._last_stamp}, and time cannot go back. "
                "Give updates in the order in which they happen."
            )
        self._last_stamp = max(stamp, self._last_stamp)
        return self._last_stamp

    def _hand_index(self, touch: Touch) -> int:
        if touch.hand not in self.hands:
            raise SessionError(f"no hand {touch.hand!r}; this session has {', '.join(map(repr, self.hands))}.")
        if touch.object_id not in self._graph.poses:
            raise UnknownObject(unknown_object(touch.object_id, self._graph.poses))
        return self.hands.index(touch.hand)

    def _attenuation(self, touch: Touch) -> NDArray[np.float64]:
        """What of each source arrives at a touch (n_sources, n_bands), capped."""
        found: NDArray[np.float64] = self._field.attenuation(touch.object_id, [touch.point_m])[0]
        # A guest model's NaN must not reach a hand.
        found = np.clip(np.nan_to_num(found, nan=0.0), 0.0, 10 ** (MAX_GAIN_DB / 20))
        if self.config.gain_limit_db is None:
            return found
        limit = 10 ** (self.config.gain_limit_db / 20)
        self._gains_capped += int((found > limit).sum())
        return np.minimum(found, limit)

    def _prepare(self) -> PropagationField:
        model: PropagationModel = self.config.propagation
        excitations = [
            Excitation(key, loop.frequency_raw_hz, loop.frequency_tactile_hz, _mass_kg(self._bodies.get(key)))
            for key, loop in self._sources.loops().items()
        ]
        self._fields_prepared += 1
        return model.prepare(ContactNetwork(self._bodies, self._graph.contacts), excitations, self.config.bands)


def _bodies(scene: SceneSnapshot, bundle: HapticBundle) -> dict[str, Body]:
    """The plate of every object whose material and thickness are known."""
    bodies: dict[str, Body] = {}
    for item in scene.objects:
        haptics = bundle.objects.get(item.id)
        if haptics is not None and haptics.material is not None and all(edge > 0 for edge in haptics.estimated_size_m):
            bodies[item.id] = Plate(*haptics.estimated_size_m, haptics.material)
    return bodies


def _mass_kg(body: Body | None) -> float:
    if isinstance(body, Plate):
        return body.length_m * body.width_m * body.thickness_m * body.material.density_kg_m3
    return body.mass_kg if body is not None else 1.0
