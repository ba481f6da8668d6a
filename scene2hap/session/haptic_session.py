"""A session: plays the vibration of a scene at the hands that touch it.

Call `render` on the audio thread and everything else on the game's. Nothing here uses a network. `update` never waits
for a model, and `render` never waits for `update`. A frame, in `update`:

1. The touches are grouped by hand. Loops that a worker has prepared are added to the mix.
2. Objects move, and their contacts change. If this concerns a source, a new propagation field is requested, unless the
   model has a live field.
3. Sources start and stop, in cycles and with the contacts that they need.
4. The field is evaluated at the touches. The gains, times the levels of sources and user, go to the mixer.
5. Objects that have landed add bursts to the mix.
6. The sink gets the frame, which resets its watchdog. Likely mistakes are named.

Each part owns its state: `SceneState` the objects, their poses and contacts; `Sources` states, switches and levels;
`Switching` starts and stops that are under way; `HandFrames` the field, the touches and the gains; `LoopMixers` the
loops; `Playback` the clock, the pause and the bursts; `Impacts` motions; `Output` the sink and its safety layer.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from types import TracebackType
from typing import TYPE_CHECKING, Any, NoReturn, Self, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle import HapticBundle
from scene2hap.bundle.arguments import given_pair
from scene2hap.bundle.contents import require_same_scene
from scene2hap.common import checks
from scene2hap.common.calls import clear_calls, read_only
from scene2hap.common.counted import counted
from scene2hap.common.deadline import Deadline
from scene2hap.contact.graph import ContactChange
from scene2hap.devices.protocol import ActuatorSink, Block
from scene2hap.devices.whole_frames import WholeFrames
from scene2hap.errors import SceneError, SessionError
from scene2hap.haptics import ObjectHaptics
from scene2hap.render.safety import SafetyStats
from scene2hap.scene.objects import Contact, SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.session.arguments import (
    given_contacts,
    given_frame,
    given_frames,
    given_gains,
    given_points,
    given_poses,
    given_stamp,
    given_strike,
    require_addable,
    require_correction,
    require_moves,
    require_prefab,
)
from scene2hap.session.config import SessionConfig, require_settings
from scene2hap.session.explanation.explanations import Explanations
from scene2hap.session.explanation.report import Explanation
from scene2hap.session.frame import (
    GivenTouches,
    HapticFrame,
    Touch,
    given_touches,
    touches_by_hand,
)
from scene2hap.session.gains.hand_frames import HandFrames
from scene2hap.session.hand_changes import HandChanges
from scene2hap.session.impacts.felt_impacts import Impact, Impacts
from scene2hap.session.likely_mistakes import (
    LikelyMistakes,
    warn_if_not_baked,
    warn_if_other_actuator,
    warn_of_pending_corrections,
)
from scene2hap.session.mix.loop_mixers import Clock, LoopMixers
from scene2hap.session.mix.output import Output
from scene2hap.session.mix.playback import Playback
from scene2hap.session.mix.sources import Level, SourceInfo, SourceProgress, Sources
from scene2hap.session.mix.starts_and_stops import Switching
from scene2hap.session.object_changes import ObjectChanges
from scene2hap.session.present_scene.prepared_shapes import PreparedShapes
from scene2hap.session.present_scene.scene_state import SceneState
from scene2hap.session.proximity import Proximity
from scene2hap.session.stats import SessionStats
from scene2hap.session.unknown_names import require_hand
from scene2hap.session.user_profile import UserProfile

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure


@clear_calls
@read_only
class HapticSession:
    """Play a baked scene: turn the moves and touches of each frame into vibration at each hand.

        with HapticSession(scene, bundle, sink="soundcard") as session:  # starts the sink; stops it at the end
            while game.runs():
                frame = session.update({"cup": cup_pose}, [Touch("left", "table", point_m)])
                frame.gain("left", "phone")  # 1 on the phone itself, 0 where nothing arrives

    Parameters:
    scene : objects and their present poses.
    bundle : the bundle that was baked for them. A bundle alone, `HapticSession(bundle)`, is played on its own scene.
        Scene and bundle may be paths, which are loaded here, in either order.
    config : a SessionConfig, its settings, or the path of a TOML or JSON file with a table `session`.
    hands : names of the outputs, in the order of channels.
    sink : the output to which `start` sends the mix: a sink, its kind, or a mapping with a `kind`; None if the game
        calls `render` itself.
    user : levels and limits of the person who plays: a UserProfile, its settings, or the path of a saved one.
    Raises: ConfigError; SceneError, BundleError: no scene or bundle, or files that cannot be read; UnknownObject: the
    bundle has an object that the scene does not have.
    Warns: OtherActuatorWarning: the settings name another actuator than the one that the bundle's loops were made for
    (without a name the session takes the bundle's). SceneWarning: the scene has objects that the bundle does not have,
    or the bundle has corrections that need `rebake`.
    """

    def __init__(
        self,
        scene: SceneSnapshot | HapticBundle | str | os.PathLike[str] | None = None,
        bundle: HapticBundle | SceneSnapshot | str | os.PathLike[str] | None = None,
        config: SessionConfig | Mapping[str, Any] | str | os.PathLike[str] | None = None,
        *,
        hands: Sequence[str] = ("left", "right"),
        sink: ActuatorSink | str | Mapping[str, Any] | None = None,
        user: UserProfile | Mapping[str, Any] | str | os.PathLike[str] | None = None,
    ) -> None:
        if config is not None and not isinstance(config, SessionConfig):
            require_settings(config)
        if not (isinstance(scene, SceneSnapshot) and isinstance(bundle, HapticBundle)):
            scene, bundle = given_pair(scene, bundle)
        require_same_scene(scene, bundle)
        self._config = SessionConfig.parse(config).on_actuator(bundle.actuator)
        hands = checks.names("hands", hands)
        self._bundle = bundle
        warn_if_not_baked(scene, bundle)
        warn_if_other_actuator(bundle, self.config.actuator)
        warn_of_pending_corrections(bundle)
        self._sources = Sources()
        for object_id, loops in bundle.loops.items():
            if loops:
                self._sources.add(object_id, loops, bundle.objects.get(object_id), Level.of(bundle, object_id))
        follows_outlines = bool(getattr(self.config.propagation, "follows_outlines", False))
        self._state = SceneState(scene, bundle, follows_outlines=follows_outlines)
        in_background = self.config.prepare == "background"
        self._shapes = PreparedShapes(is_wanted=scene.contacts is None, in_background=in_background)
        self._shapes.order(item.geometry.mesh for item in scene.objects)
        clock, rate_hz = Clock(), self.config.sample_rate_hz
        self._mixers = LoopMixers(self.config, self._sources.rows(), hands, clock)
        self._playback = Playback(rate_hz, self._mixers, clock)
        self._switching = Switching(self._sources, self._mixers, clock, self._state, rate_hz)
        self._hand_frames = HandFrames(self.config, self._state, self._sources, self._mixers.peaks, hands)
        self._mistakes = LikelyMistakes(self._state)
        # No reference to the session itself: only the garbage collector could free such a cycle.
        frames = self._hand_frames
        self._impacts = Impacts(self.config, self._state, self._playback, lambda: frames.field, self._sources.user)
        self._output = Output(sink, self.config)
        if user is not None:
            self._hand_changes.use_profile(UserProfile.parse(user))

    @property
    def config(self) -> SessionConfig:
        """The settings."""
        return self._config

    @property
    def hands(self) -> tuple[str, ...]:
        """Names of the outputs, in the order of channels."""
        return self._hand_frames.hands

    @property
    def source_ids(self) -> tuple[str, ...]:
        """Ids of the vibrating objects, in the order of `HapticFrame.gains`."""
        return self._sources.ids

    def source(self, source_id: str) -> SourceInfo:
        """Return the present state of a source, its switch, its level and its frequency. Raises: UnknownObject."""
        return self._sources.info(source_id, self._switching.progress(source_id))

    @property
    def object_ids(self) -> frozenset[str]:
        """Ids of the objects that are in the scene now; the same set until one is added or removed."""
        return self._state.ids

    @property
    def poses(self) -> Mapping[str, Pose]:
        """The present pose of every object, by id. Read-only; `dict(session.poses)` is a copy that can be pickled."""
        return self._state.poses

    @property
    def snapshot(self) -> SceneSnapshot:
        """The scene as it is now."""
        return self._state.snapshot

    def update(
        self,
        moved: Mapping[str, Pose] | Touch | Sequence[Touch] | None = None,
        touches: GivenTouches | None = (),
        *,
        contacts: Sequence[Contact] | None = None,
        at_sample: int | None = None,
    ) -> HapticFrame:
        """Apply a frame of the game: move objects, and set the gains of all hands.

        Parameters:
        moved : new poses of objects that moved, by id.
        touches : all touches of this frame. A hand that is not among them is lifted; a hand with several feels the
            largest gain of each source. A single Touch, and (hand, object id, point) instead of a Touch, are accepted
            too, also as the first argument.
        contacts : all contacts that an engine reports, with normals from `a` to `b`. From then on none are found from
            geometry; with None later, the last ones stay, but for those of objects that move.
        at_sample : the position on `render`'s clock from which the gains change; None for the next block, or for the
            position of the last update if that is later.
        Returns: the gains of the frame.
        Warns: SceneWarning: a hand touches an object more than 5 cm off the box around it, once per hand; nothing
        vibrates; normals of contacts that point from `b` to `a`; many touches, and the sink was never started; a sink
        that plays nothing, such as a sound card that is not there.
        Raises: UnknownObject: a touched or moved object is not in the scene; SessionError: an unknown hand, a position
        before that of the last update, or another type than poses, touches and contacts.
        """
        self._output.require_own_process()
        if moved is not None and type(moved) is not dict:
            moved, touches = given_frame(moved, touches)
        by_hand = touches_by_hand(touches, self._hand_frames.hands, self._state)
        stamp = self._stamp(at_sample)
        if self._mixers.take_prepared():
            self._hand_frames.loops_changed()
        if moved:
            self._impacts.begin(moved, stamp)
        if moved or contacts is not None:
            self._hand_frames.apply(self._move(moved or {}, contacts))
        if self._switching.advance(stamp):
            self._hand_frames.levels_changed()
        frame, gained = self._hand_frames.frame(by_hand, moved or (), is_paused=self._playback.is_paused)
        if gained is not None:
            self._mixers.set_gains(gained.mixed, self._sources.active_rows(), stamp, gained.columns)
        self._impacts.follow(moved, by_hand, stamp)
        self._output.feed(frame)
        problem, is_unplayed = self._output.untold_problem, self._output.is_unused and not self._playback.clock.position
        self._mistakes.in_frame(by_hand, self._sources.ids, problem, is_unplayed=is_unplayed)
        return frame

    def touches_at(
        self,
        points_m: Mapping[str, ArrayLike | None],
        moved: Mapping[str, Pose] | None = None,
        *,
        within_m: float = 0.01,
        depth_m: float = 0.03,
    ) -> list[Touch]:
        """Return the touches of tracked points, such as finger tips, for a game without collisions of its own.

        A point touches each object whose surface is at most `within_m` in front of it [m], or at most `depth_m` [m] if
        the point is inside, behind the nearest face. The touch is at the nearest point of the surface. An object that
        the hand touched at the last update is touched up to 1.5 times these distances, so that a finger at the limit
        does not start and stop to touch with the noise of its tracker.
        Parameters: points_m : for each hand its points (n, 3) or one point (3,) in the world [m], None or an empty list
        while the hand is not tracked; moved : poses that the next update will get, by id.
        Raises: SessionError: an unknown hand, points that are not finite or of another shape, a distance below 0 or
        above 1 m, or moved is no mapping; UnknownObject: a moved object is not in the scene; SceneError: another type
        than a pose.
        """
        points = given_points(points_m, self.hands)
        within_m = checks.number("within_m", within_m, "m", at_least=0.0, at_most=1.0, error=SessionError)
        depth_m = checks.number("depth_m", depth_m, "m", at_least=0.0, at_most=1.0, error=SessionError)
        poses = self._state.poses
        if moved is not None:
            moved = given_poses(moved)
            require_moves(moved, self._state)
            poses = {**poses, **moved}
        touched = self._hand_frames.touches
        return self._proximity.touches(points, self._state.objects, poses, within_m, depth_m, touched)

    def strike(
        self,
        object_id: str,
        point_m: Iterable[float],
        *,
        speed_m_s: float | None = None,
        impulse_n_s: float | None = None,
        with_object: str | None = None,
    ) -> Impact:
        """Strike an object at a world point [m]. Hands that touched something at the last update feel it once.

        It is felt from the next block on. The propagation model gives its strength at each hand. Moving objects strike
        without this call when they land, unless `SessionConfig.impacts` is false.
        Parameters: speed_m_s : at which the objects meet, or impulse_n_s : that they exchange; without either 0.5 m/s,
        a knock; with_object : the striking object, None for a finger.
        Returns: the impact; its `felt` is the largest sample that each hand gets.
        Raises: UnknownObject; SessionError: a speed or impulse that is not above 0, or both.
        Warns: SceneWarning: the first point that is more than 5 cm off the box around its object.
        """
        self._state.require(object_id)
        if with_object is not None:
            self._state.require(with_object)
        strike = given_strike(object_id, point_m, with_object, speed_m_s, impulse_n_s)
        self._mistakes.in_strike(object_id, strike.point_m)
        return self._impacts.strike(strike, self._hand_frames.touches, self._playback.clock.now)

    def add(
        self,
        object: SceneObject,
        haptics: ObjectHaptics | None = None,
        loops: Mapping[str, HapticLoop] | None = None,
    ) -> None:
        """Add an object to the scene. It vibrates if it has loops, by the name of each state.

        Without haptics and loops, the bundle's data for its id are used, so that a removed object comes back as it was.
        A worker prepares loops of new content; they fade in with the first `update` after that.
        Raises: SceneError: its id is taken; SessionError: a loop is no HapticLoop.
        Warns: SceneWarning: it will neither vibrate nor carry vibration.
        """
        require_addable(object, haptics, loops)
        if haptics is None and loops is None:
            haptics, loops = self._bundle.objects.get(object.id), self._bundle.loops.get(object.id)
        loops = loops or {}
        self._object_changes.add(object, haptics, loops, Level.of(self._bundle, object.id))
        self._mistakes.in_added(object.id, haptics, loops)

    def spawn(self, prefab: HapticBundle, object_id: str, pose: Pose) -> None:
        """Add a copy of a prefab, which is a bundle of one object, as `bake_object` makes it.

        All copies share the prefab's geometry, surface and loops, so only the first copy has to be prepared.
        Corrections of the prefab apply to every copy.
        Raises: SessionError: the bundle has not exactly one object; SceneError: the id is taken or empty.
        """
        require_prefab(prefab, pose)
        (original,) = prefab.snapshot.objects
        copy = replace(original, id=object_id, name=object_id, pose=pose)
        haptics, loops = prefab.objects.get(original.id), prefab.loops.get(original.id, {})
        self._object_changes.add(copy, haptics, loops, Level.of(prefab, original.id))
        self._mistakes.in_added(object_id, haptics, loops)

    def use_bundle(self, bundle: HapticBundle) -> None:
        """Play a corrected bundle of the same scene: loops that differ are cross-faded, levels change at once.

        An earlier loop is played until a worker has prepared the new one, and to the end of a start or stop that is
        under way. Objects stay where they are. Sources keep their state if they still have it, and their place in its
        cycle, and stay on or off. A level or mute of `set_source` stays unless the bundle's value has changed. Objects
        that the session does not have, and others that were spawned or added with data of their own, are left out.
        Raises: BundleError: another type, or a bundle of another scene. Warns: OtherActuatorWarning: its
        loops were made for another actuator than the session's. SceneWarning: corrections that need `rebake`.
        """
        require_correction(bundle, self._bundle)
        warn_if_other_actuator(bundle, self.config.actuator)
        warn_of_pending_corrections(bundle)
        before, self._bundle = self._bundle, bundle
        self._object_changes.correct(before, bundle)

    def remove(self, object_id: str) -> None:
        """Remove an object from the scene; its vibration fades out.

        Raises: UnknownObject; SessionError: it is the last object.
        """
        self._state.require(object_id)
        if len(self._state.objects) == 1:
            raise SessionError(f"{object_id!r} is the last object of the scene; add another one before removing it.")
        self._object_changes.remove(object_id)

    def add_hand(self, name: str) -> None:
        """Add an output. A sink that is running is faded out and reopened with one channel more.

        Raises: ConfigError: the name is taken; SessionError: the sink is running and cannot change its channels;
        DeviceError: it cannot be opened again.
        """
        self._hand_changes.add(name, self._mixed)

    def remove_hand(self, name: str) -> None:
        """Remove an output, but not the last; see `add_hand`. Raises: SessionError: an unknown hand."""
        self._hand_changes.remove(name, self._mixed)

    def set_source(
        self,
        source_id: str,
        *,
        on: bool | None = None,
        state: str | None = None,
        gain_db: float | None = None,
        mute: bool | None = None,
        progress: SourceProgress | Sequence[float | bool | None] | None = None,
    ) -> None:
        """Switch a source on, off or to another state, or set its level; felt from the next update on.

        Before the first update with the source, it is switched without a start or stop: a scene may begin with it off.
        `progress` of a saved game lets a start, a stop and a cycle go on where they were, with the next update.
        Raises: UnknownObject: not a source; SessionError: it has no such state, or a number is out of bounds.
        """
        went = None if progress is None else SourceProgress.parse(progress)
        is_other_state = self._switching.set(source_id, on, state, gain_db, mute, went)
        self._hand_frames.levels_changed(is_other_state)

    def set_user(
        self,
        *,
        gain_db: float | None = None,
        mute: bool | None = None,
        profile: UserProfile | Mapping[str, Any] | str | os.PathLike[str] | None = None,
    ) -> None:
        """Set the level of all vibration, or the profile of another person; felt from the next update on.

        Raises: SessionError: out of bounds; ConfigError: a profile that cannot be read or is out of bounds.
        """
        other = None if profile is None else UserProfile.parse(profile)
        self._sources.user.set(gain_db, mute)
        if other is not None:
            self._hand_changes.use_profile(other)
        self._hand_frames.levels_changed()

    def pause(self) -> None:
        """Fade out all vibration, and stop the clock of all loops. `update` still follows the scene.

        The fade begins now, or at the position of the last update if that is later.
        """
        self._playback.pause()
        self._hand_frames.levels_changed()
        self._output.show(self._hand_frames.silence())

    def resume(self) -> None:
        """Continue all loops from where they stopped; felt from the next update on."""
        if self._playback.is_paused:
            self._impacts.forget_motions()
        self._playback.resume()
        self._hand_frames.levels_changed()

    def explain(self, hand: str) -> Explanation:
        """Report the sources that a hand felt at the last update, their paths, and the impacts of the last second.

        Raises: SessionError: an unknown hand.
        """
        require_hand(hand, self.hands)
        return self._explanations.of(hand)

    @property
    def is_current(self) -> bool:
        """True if the gains are valid for the present scene; false while a worker prepares a newer field."""
        return self._hand_frames.keeper.is_current

    @property
    def impacts(self) -> tuple[Impact, ...]:
        """The impacts of the last second that any hand felt, the latest first."""
        return self._impacts.recent()

    def would_feel(self, touches: GivenTouches | None) -> NDArray[np.float64]:
        """Return the gains that `update` would report for each of these touches alone, without playing them.

        For maps, and for a game that plans ahead. The gains are from the field in use, with the volume of source, user
        and hand, also in a pause; no touch is counted. Call it on the thread that calls `update`.
        Returns: (n_touches, n_sources, n_bands) float64 [-], in the order of `source_ids`, 0 below -140 dB.
        Warns: SceneWarning: one of the first points is more than 5 cm off the box around its object, once.
        Raises: UnknownObject: an object is not in the scene; SessionError: an unknown hand, or another type.
        """
        given = given_touches(touches)
        touches_by_hand(given, self.hands, self._state)
        self._mistakes.in_points(given)
        if self._switching.follow_contacts(self._playback.clock.now):
            self._hand_frames.levels_changed()
        return self._hand_frames.would_feel(given)

    def over_threshold_db(self, gains: HapticFrame | ArrayLike) -> NDArray[np.float64]:
        """Return the level of each source over the threshold of touch at gains of this session.

        Bands count by the share of the source's vibration in them, unlike in `HapticFrame.gain`, the highest gain of
        all bands. Call it before a source, or its state, changes; a start or stop that is under way does not count.
        Parameters: gains : (..., n_sources, n_bands), of a frame (or the frame) or of `would_feel`.
        Returns: (..., n_sources) [dB]; -inf where nothing arrives, and until the loops of an added source are prepared;
        nan for a source whose loop has no known level.
        Raises: SessionError: gains of another shape, or a frame of other sources.
        """
        return self._hand_frames.over_threshold_db(given_gains(gains, self.source_ids, self.config.bands.n_bands))

    @overload
    def plot_felt(
        self,
        source_id: str,
        *,
        hand: str | None = None,
        cells: int = 96,
        up_to_m: float | None = None,
        axes: None = None,
    ) -> Figure: ...
    @overload
    def plot_felt(
        self, source_id: str, *, hand: str | None = None, cells: int = 96, up_to_m: float | None = None, axes: Axes
    ) -> Figure | SubFigure: ...
    def plot_felt(
        self,
        source_id: str,
        *,
        hand: str | None = None,
        cells: int = 96,
        up_to_m: float | None = None,
        axes: Axes | None = None,
    ) -> Figure | SubFigure:
        """Draw the scene from above; colours show the level of a source at a hand on each surface.

        A level is the gain that `update` would report for a touch there [dB], from the field in use, with the volume of
        source, user and hand. It does not change the mix, and no touch is counted. Call it on the thread that calls
        `update`. If a worker prepares the model, call `wait_prepared` first.
        Parameters: hand : the first if None; cells : along the longer side of the scene, each with one touch; up_to_m :
        leave out surfaces higher than this above the lowest point of the scene [m], None for ceilings that hide most of
        the objects; axes : of matplotlib, to draw into, None for a new figure.
        Returns: the figure, made without pyplot; lengths in m, levels in dB.
        Raises: MissingExtra: matplotlib is not installed; UnknownObject: no such source; SessionError: no such hand,
        fewer than 4 cells or more than 2000, or `up_to_m` is no height.
        """
        from scene2hap.session.plots import plot_felt  # by need: the extra `plots`

        self._sources[source_id]  # raises for an unknown one
        hand = self.hands[0] if hand is None else hand
        require_hand(hand, self.hands)
        column, is_current = self.source_ids.index(source_id), self.is_current

        def gains_of(touches: Sequence[Touch]) -> NDArray[np.float64]:
            gains: NDArray[np.float64] = self.would_feel(touches)[:, column].max(axis=1)
            return gains

        scene = self.snapshot
        return plot_felt(
            scene, source_id, hand, gains_of, is_current=is_current, cells=cells, up_to_m=up_to_m, axes=axes
        )

    def wait_prepared(self, timeout_s: float | None = None) -> bool:
        """Wait until the present scene, all loops and all meshes are prepared, for loading screens.

        Returns: False after the timeout [s]. True also if the model cannot prepare the scene (`stats.fields_failed`).
        """
        self._output.require_own_process()
        if timeout_s is not None:
            timeout_s = checks.number("timeout_s", timeout_s, "s", at_least=0.0, at_most=86_400.0, error=SessionError)
        end = Deadline(timeout_s)
        parts = (self._mixers, self._impacts, self._hand_frames, self._shapes)
        return all(part.wait(end) for part in parts)

    def render(self, n_frames: int) -> Block:
        """Return the next samples of the mix (n_frames, n_hands) float32 in [-1, 1], without the safety layer.

        Raises: SessionError: more than `MAX_RENDERED_FRAMES` at once; the session is started, so that its sink renders.
        """
        if self._output.is_started:
            raise SessionError(
                "the sink of this session renders, and would miss the samples that you take with `render`. Use the "
                "sink's own samples, such as `sink.pull`, or a session without a sink."
            )
        return self._playback.render_held(given_frames(n_frames))

    def render_s(self, seconds: float) -> Block:
        """Return the next `seconds` [s] of the mix. See `render`.

        Fractions of a sample are carried to the next call, so that 90 calls of 1/90 s give exactly one second.
        Raises: SessionError.
        """
        return self.render(self._whole_frames.of(seconds))

    def _mixed(self, n_frames: int) -> Block:
        return self._playback.render(given_frames(n_frames))

    @property
    def position(self) -> int:
        """Number of the next sample of `render`, on the clock of `at_sample`; it does not advance in a pause."""
        return self._playback.clock.position

    def position_s(self, source_id: str) -> float:
        """Return the position of a source in its loop [s], for a game that plays the audible loop.

        Raises: UnknownObject.
        """
        return self._playback.position_s(self._sources[source_id].row)

    def start(self) -> None:
        """Send the mix through the safety layer to the sink.

        Raises: SessionError: the session has no sink; DeviceError: the sink cannot be opened. Warns: SceneWarning:
        nothing vibrates.
        """
        self._output.require_own_process()
        self._mistakes.in_sources(self._sources.ids)
        self._output.start(self._mixed, self.hands)

    def stop(self) -> None:
        """Fade out, stop the sink and release it; may be called twice, and by any thread.

        In a forked child the parent's sink plays on.
        """
        self._output.stop()

    close = stop

    def __repr__(self) -> str:
        counts = f"{counted(len(self.object_ids), 'object')}, {counted(len(self.source_ids), 'source')}"
        return f"HapticSession({counts}, hands {', '.join(self.hands)})"

    def __reduce__(self) -> NoReturn:
        raise SessionError(
            "a session cannot be copied or pickled: it has threads and a sink. Save its bundle (`bundle.save(folder)`) "
            "and its scene (`session.snapshot`), and make another session of them."
        )

    def __enter__(self) -> Self:
        if self._output.sink is not None:
            self.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        # Many games end by Ctrl-C, which asyncio turns into CancelledError, or by sys.exit, as Panda3D's closed window
        # does. None of these is an Exception, and what was recorded is kept.
        if isinstance(error, Exception):
            self._output.abort()
        else:
            self.stop()

    @property
    def sink(self) -> ActuatorSink | None:
        """The output that `start` sends the mix to, None without one."""
        return self._output.sink

    @property
    def stats(self) -> SessionStats:
        """Counters since the session was made, such as updates, impacts and skipped work."""
        stats = self._hand_frames.stats(self._mixers.rows_not_mixed)
        self._impacts.take_late()
        return replace(
            stats,
            touches_off_surface=self._mistakes.n_touches_off,
            impacts=self._impacts.n_reported,
            impacts_felt=self._impacts.n_felt,
            impacts_left_out=self._impacts.n_left_out,
        )

    @property
    def safety_stats(self) -> SafetyStats:
        """Counters of the changes by the safety layer since the last `start`, also after `stop`."""
        return self._output.safety_stats

    @cached_property
    def _object_changes(self) -> ObjectChanges:
        parts = (self._state, self._shapes, self._sources, self._switching, self._hand_frames, self._mixers)
        return ObjectChanges(*parts, self._playback.clock)

    @cached_property
    def _hand_changes(self) -> HandChanges:
        parts = (self._hand_frames, self._impacts, self._mixers, self._playback, self._output)
        return HandChanges(self.config.actuator.name, *parts)

    @cached_property
    def _explanations(self) -> Explanations:
        parts = (self._state, self._sources, self._switching, self._hand_frames, self._playback)
        return Explanations(self.config.propagation, *parts, self._impacts, self._output)

    @cached_property
    def _proximity(self) -> Proximity:
        return Proximity()

    @cached_property
    def _whole_frames(self) -> WholeFrames:
        return WholeFrames(self.config.sample_rate_hz)

    def _stamp(self, at_sample: int | None) -> int:
        """Return the position on `render`'s clock from which an update counts, and store it."""
        clock = self._playback.clock
        stamp = clock.now
        if at_sample is not None:
            stamp = given_stamp(at_sample, clock.updated_at, clock.position, self.config.sample_rate_hz)
        clock.updated_at = stamp
        return stamp

    def _move(self, moved: Mapping[str, Pose], contacts: Sequence[Contact] | None) -> ContactChange:
        self._mistakes.in_moves(moved)
        if contacts is not None:
            contacts = given_contacts(contacts)
        try:
            change = self._state.graph.update(moved, contacts=contacts)
        except SceneError:
            require_moves(moved, self._state)  # names the object, and says how to write a pose
            raise
        if contacts is not None:
            self._mistakes.in_contacts(contacts)
        return change
