"""Objects that are added, removed or replaced while a session plays, in every part of the session that has them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle import HapticBundle
from scene2hap.bundle.differences import changed_objects
from scene2hap.haptics import ObjectHaptics
from scene2hap.scene.objects import SceneObject
from scene2hap.session.gains.hand_frames import HandFrames
from scene2hap.session.mix.loop_mixers import Clock, LoopMixers
from scene2hap.session.mix.sources import Level, LoopRow, Sources
from scene2hap.session.mix.starts_and_stops import Switching
from scene2hap.session.present_scene.prepared_shapes import PreparedShapes
from scene2hap.session.present_scene.scene_state import SceneState


class ObjectChanges:
    """Adds, removes and replaces objects: in the scene with its contacts, in the sources, the gains and the mix."""

    def __init__(
        self,
        state: SceneState,
        shapes: PreparedShapes,
        sources: Sources,
        switching: Switching,
        hand_frames: HandFrames,
        mixers: LoopMixers,
        clock: Clock,
    ) -> None:
        self._state, self._shapes, self._sources = state, shapes, sources
        self._switching, self._hand_frames, self._mixers, self._clock = switching, hand_frames, mixers, clock

    def add(
        self, item: SceneObject, haptics: ObjectHaptics | None, loops: Mapping[str, HapticLoop], level: Level
    ) -> None:
        """Add an object, which vibrates if it has loops. Raises: SceneError: its id is taken."""
        self._put_in(item, haptics, loops, level)
        self._play_sources()

    def remove(self, object_id: str) -> None:
        """Remove an object; its vibration fades out. Raises: UnknownObject."""
        self._take_out(object_id)
        self._play_sources()

    def correct(self, before: HapticBundle, bundle: HapticBundle) -> None:
        """Replace objects that differ in two bundles of the scene, and take over the levels that differ.

        Objects that the session does not have from the first bundle are left out.
        """
        # An id of the bundle may be that of another object now, which the game spawned or added with data of its own.
        haptics = self._state.haptics
        own = {x for x in self._state.objects if haptics.get(x) == before.objects.get(x)}
        for object_id in changed_objects(before, bundle):
            if object_id in own:
                self._replace(object_id, bundle)
        for object_id in bundle.loops:
            if object_id in own and object_id in self._sources:
                gain_db, mute = bundle.gain_db(object_id), bundle.is_muted(object_id)
                self._switching.set(
                    object_id,
                    on=None,
                    state=None,
                    gain_db=None if gain_db == before.gain_db(object_id) else gain_db,
                    mute=None if mute == before.is_muted(object_id) else mute,
                )
                self._hand_frames.levels_changed()

    def _replace(self, object_id: str, bundle: HapticBundle) -> None:
        """Replace the data of an object by those of a bundle, at the same pose."""
        item = replace(self._state.objects[object_id], pose=self._state.poses[object_id])
        before = self._sources.get(object_id)
        progress = None if before is None else self._switching.progress(object_id)
        self._take_out(object_id)
        haptics, loops = bundle.objects.get(object_id), bundle.loops.get(object_id, {})
        self._put_in(item, haptics, loops, Level.of(bundle, object_id))
        after, instead = self._sources.get(object_id), None
        if before is not None and after is not None and progress is not None:
            self._switching.go_on(object_id, before, progress)
            instead = after.rows[after.state], before.rows[before.state]
            self._hand_frames.levels_changed(is_other_state=True)
        self._play_sources(instead)

    def _put_in(
        self, item: SceneObject, haptics: ObjectHaptics | None, loops: Mapping[str, HapticLoop], level: Level
    ) -> None:
        """Add an object, whose loops are silent until `_play_sources`."""
        change = self._state.add(item, haptics)
        self._shapes.order([item.geometry.mesh])
        if loops:
            self._sources.add(item.id, loops, haptics, level)
        self._hand_frames.apply(change, sources_changed=bool(loops))

    def _take_out(self, object_id: str) -> None:
        """Remove an object, whose loops play on until `_play_sources`."""
        change = self._state.remove(object_id)
        is_source = object_id in self._sources
        if is_source:
            self._sources.remove(object_id)
        self._hand_frames.apply(change, sources_changed=is_source)

    def _play_sources(self, instead: tuple[LoopRow, LoopRow] | None = None) -> None:
        """Play the loops of all sources; `instead` is a new row, and the one that it replaces."""
        self._mixers.change_rows(self._sources.rows(), self._clock.now, instead)
