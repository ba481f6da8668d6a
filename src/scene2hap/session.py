"""Play time: poses and touches in, vibration for every hand out.

`update` belongs to the game's thread and `render` to the audio thread. `update` keeps the contact graph, prepares the
propagation field when a contact changed, and turns touches into gains; `render` mixes the sources' loops with them.
Nothing here reaches a network, and `render` never waits for `update`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import TracebackType
from typing import Annotated, Any, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from scene2hap import checks
from scene2hap.bundle import HapticBundle
from scene2hap.contact.graph import ContactGraph
from scene2hap.devices import SINKS
from scene2hap.devices.protocol import ActuatorSink, Block, SinkFormat
from scene2hap.errors import ConfigError, SessionError, UnknownObject
from scene2hap.haptics import Bands, SourceState
from scene2hap.propagation import MODELS
from scene2hap.propagation.exponential_plate import ExponentialPlate
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.protocol import (
    Body,
    ContactNetwork,
    Excitation,
    PropagationField,
    PropagationModel,
)
from scene2hap.render.loop_bank import LoopBank
from scene2hap.render.mixer import Mixer
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import Contact, SceneSnapshot, unknown_object

MIN_RAMP_S = 0.010
"""Shortest time over which a gain change is spread; see `scene2hap.render.mixer`."""

MAX_GAIN_DB = 120.0


class SessionConfig(BaseModel):
    """How a scene is played. Every part with alternatives is chosen by a `kind`, so that a table of TOML will do.

    propagation : a kind, a mapping with `kind` and settings, or a model; `scene2hap.propagation.MODELS` lists kinds.
    bands : bands in which gains are told; `Bands.dominant()` is the paper's.
    gain_limit_db : cap on what one source may gain at a hand by propagation, None for no cap.
    control_period_s : usual time between updates; gain changes are spread over it, and over at least 10 ms.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", arbitrary_types_allowed=True)

    propagation: Annotated[Any, BeforeValidator(MODELS.build)] = Field(default_factory=ExponentialPlate)
    bands: Bands = Field(default_factory=Bands.dominant)
    gain_limit_db: float | None = Field(0.0, le=MAX_GAIN_DB, allow_inf_nan=False)
    sample_rate_hz: int = Field(48000, ge=1000, le=192000)
    control_period_s: float = Field(0.02, gt=0.0, le=1.0)

    @classmethod
    def parse(cls, settings: SessionConfig | Mapping[str, Any] | None) -> SessionConfig:
        """A configuration from settings, or the default.

        Raises: ConfigError: a setting that does not exist or is out of bounds.
        """
        if isinstance(settings, cls):
            return settings
        try:
            return cls.model_validate(settings or {})
        except ValidationError as cause:
            problem = cause.errors()[0]
            place = ".".join(str(part) for part in problem["loc"])
            raise ConfigError(f"session setting {place}: {problem['msg']}, got {problem['input']!r}.") from cause


@dataclass(frozen=True)
class Touch:
    """A hand on an object at a world point [m]."""

    hand: str
    object_id: str
    point_m: tuple[float, float, float]

    def __post_init__(self) -> None:
        point = checks.vector("point_m", self.point_m, "m", size=3, error=SessionError)
        object.__setattr__(self, "point_m", point)


@dataclass(frozen=True, eq=False)
class HapticFrame:
    """What one update decided: gains (n_hands, n_sources, n_bands) float32 [-]."""

    gains: NDArray[np.float32]
    hands: tuple[str, ...]
    sources: tuple[str, ...]

    def gain(self, hand: str, source_id: str) -> float:
        """The loudest band's gain of a source at a hand [-].

        Raises: SessionError: no such hand; UnknownObject: no such source.
        """
        if hand not in self.hands:
            raise SessionError(f"no hand {hand!r}; this session has {', '.join(map(repr, self.hands))}.")
        if source_id not in self.sources:
            raise UnknownObject(_unknown_source(source_id, self.sources))
        return float(self.gains[self.hands.index(hand), self.sources.index(source_id)].max())


@dataclass(frozen=True)
class SessionStats:
    """What a session has done so far; `bodiless` objects carry no vibration since their material is unknown."""

    updates: int = 0
    fields_prepared: int = 0
    gains_capped: int = 0
    bodiless: tuple[str, ...] = ()


@dataclass
class _Level:
    """A volume knob with a mute switch."""

    gain: float = 1.0
    is_muted: bool = False

    @property
    def factor(self) -> float:
        return 0.0 if self.is_muted else self.gain


@dataclass
class _Source:
    """A vibrating object as it is played."""

    state: str
    is_on: bool = True
    level: _Level = field(default_factory=_Level)


@dataclass
class _Counters:
    updates: int = 0
    fields_prepared: int = 0
    gains_capped: int = 0
    bodiless: tuple[str, ...] = field(default_factory=tuple)


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
        self._bundle = bundle
        self._sources = {object_id: _Source(next(iter(states))) for object_id, states in bundle.loops.items()}
        for object_id in self._sources:
            scene.object(object_id)
        self.source_ids = tuple(self._sources)
        self._bodies = _bodies(scene, bundle)
        self._graph = ContactGraph(scene)
        self._counters = _Counters(bodiless=tuple(i.id for i in scene.objects if i.id not in self._bodies))
        self._bank = self._loop_bank(self.source_ids)
        ramp_s = max(self.config.control_period_s, MIN_RAMP_S)
        self._mixer = Mixer(self._bank, len(self.hands), max(1, round(ramp_s * self.config.sample_rate_hz)))
        self._field = self._prepare()
        self._user = _Level()
        self._last_stamp = 0
        self._last_gains: NDArray[np.float32] | None = None
        built = SINKS.build(sink) if sink is not None else None
        if built is not None and not isinstance(built, ActuatorSink):
            raise ConfigError(f"sink is {built!r}; it must have open, start, stop, close and stats.")
        self._sink = built

    # -- the game's side --------------------------------------------------------------------------------------

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
        rows = [self._touch_row(touch) for touch in touches]
        if moved or contacts is not None:
            change = self._graph.update(moved or {}, contacts=contacts)
            # A field is told in world coordinates, so that any move of a body in contact makes it stale.
            if change.appeared or change.vanished or change.shifted:
                self._field = self._prepare()
        gains = np.zeros((len(self.hands), len(self.source_ids), self.config.bands.n_bands))
        for hand, touch in rows:
            np.maximum(gains[hand], self._attenuation(touch), out=gains[hand])
        levels = np.array([self._level(object_id) for object_id in self.source_ids])
        frame = HapticFrame((gains * levels[:, None]).astype(np.float32), self.hands, self.source_ids)
        if self._last_gains is None or not np.array_equal(frame.gains, self._last_gains):
            self._mixer.set_gains(frame.gains.reshape(len(self.hands), -1), stamp)
            self._last_gains = frame.gains
        self._counters.updates += 1
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
        source = self._sources[self._known_source(source_id)]
        if state is not None and state != source.state:
            states = self._bundle.loops[source_id]
            if state not in states:
                raise SessionError(f"{source_id!r} has no state {state!r}; it has {', '.join(map(repr, states))}.")
            source.state = state
            self._bank.replace(self.source_ids.index(source_id), self._loop_bank((source_id,)))
            self._field = self._prepare()
        if on is not None:
            source.is_on = on
        if gain_db is not None:
            source.level.gain = _gain(gain_db)
        if mute is not None:
            source.level.is_muted = mute

    def set_user(self, *, gain_db: float | None = None, mute: bool | None = None) -> None:
        """Set the level of everything; felt from the next update on. Raises: SessionError: out of bounds."""
        if gain_db is not None:
            self._user.gain = _gain(gain_db)
        if mute is not None:
            self._user.is_muted = mute

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
        length = self._bank.length(self.source_ids.index(self._known_source(source_id)))
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
        self.stop()

    @property
    def stats(self) -> SessionStats:
        """What was done so far."""
        counters = self._counters
        return SessionStats(counters.updates, counters.fields_prepared, counters.gains_capped, counters.bodiless)

    @property
    def snapshot(self) -> SceneSnapshot:
        """The scene as it is now."""
        return self._scene.with_poses(self._graph.poses)

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

    def _touch_row(self, touch: Touch) -> tuple[int, Touch]:
        if touch.hand not in self.hands:
            raise SessionError(f"no hand {touch.hand!r}; this session has {', '.join(map(repr, self.hands))}.")
        if touch.object_id not in self._graph.poses:
            raise UnknownObject(unknown_object(touch.object_id, self._graph.poses))
        return self.hands.index(touch.hand), touch

    def _attenuation(self, touch: Touch) -> NDArray[np.float64]:
        """What of each source arrives at a touch (n_sources, n_bands), capped."""
        found = self._field.attenuation(touch.object_id, [touch.point_m])[0]
        # A guest model's NaN must not reach a hand.
        found = np.nan_to_num(found, nan=0.0, posinf=10 ** (MAX_GAIN_DB / 20), neginf=0.0)
        if self.config.gain_limit_db is None:
            return found
        limit = 10 ** (self.config.gain_limit_db / 20)
        self._counters.gains_capped += int((found > limit).sum())
        return np.minimum(found, limit)

    def _known_source(self, source_id: str) -> str:
        if source_id not in self._sources:
            raise UnknownObject(_unknown_source(source_id, self.source_ids))
        return source_id

    def _level(self, source_id: str) -> float:
        source = self._sources[source_id]
        if not source.is_on or not self._has_needed_contact(source_id):
            return 0.0
        return source.level.factor * self._user.factor

    def _has_needed_contact(self, source_id: str) -> bool:
        needed = self._state(source_id).needs_contact
        if needed is None:
            return True
        touching = self._graph.neighbours(source_id)
        return any(needed in (other, self._category(other)) for other in touching)

    def _category(self, object_id: str) -> str:
        haptics = self._bundle.objects.get(object_id)
        return haptics.object_category if haptics else ""

    def _state(self, source_id: str) -> SourceState:
        state = self._sources[source_id].state
        return next(item for item in self._bundle.objects[source_id].states if item.name == state)

    def _prepare(self) -> PropagationField:
        model: PropagationModel = self.config.propagation
        loops = {key: self._bundle.loops[key][source.state] for key, source in self._sources.items()}
        excitations = [
            Excitation(key, loop.frequency_raw_hz, loop.frequency_tactile_hz, _mass_kg(self._bodies.get(key)))
            for key, loop in loops.items()
        ]
        self._counters.fields_prepared += 1
        return model.prepare(ContactNetwork(self._bodies, self._graph.contacts), excitations, self.config.bands)

    def _loop_bank(self, source_ids: Sequence[str]) -> LoopBank:
        loops = [self._bundle.loops[key][self._sources[key].state].tactile for key in source_ids]
        return LoopBank(loops, self.config.bands, self.config.sample_rate_hz)


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


def _unknown_source(source_id: str, source_ids: Sequence[str]) -> str:
    known = ", ".join(map(repr, source_ids)) or "none: nothing in this scene vibrates"
    return f"no source {source_id!r}; the sources are {known}."


def _gain(gain_db: float) -> float:
    gain_db = checks.number("gain_db", gain_db, "dB", at_most=MAX_GAIN_DB, error=SessionError, hint="Use mute for 0.")
    return float(10 ** (gain_db / 20))
