"""Why a hand feels no source, or not the one that it touches: sentences for the report of `explain`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from scene2hap.common.counted import first_of
from scene2hap.propagation.protocol import follows_poses
from scene2hap.scene.geometry import corners_of
from scene2hap.session.mix.sources import Sources
from scene2hap.session.present_scene.scene_state import SceneState

MOST_NAMED = 5
"""Most silent sources that a sentence names."""


class WhySilent:
    """Finds the causes for which sources are silent, each with its remedy.

    Parameters: model : the propagation model in use.
    """

    def __init__(self, state: SceneState, sources: Sources, model: object) -> None:
        self._state, self._sources, self._model = state, sources, model

    def of_hand(self, on: set[str], *, is_paused: bool) -> Iterator[str]:
        """Yield sentences that say why a hand on these objects feels no source."""
        if is_paused:
            yield "The session is paused; `resume` ends the pause, or over the bridge `unpause`."
        if self._sources.user.is_muted:
            yield "The user's level is muted; call `set_user` with mute false."
        unknown = sorted(on - self._state.bodies.keys())
        if unknown:
            yield (
                f"The material of {', '.join(map(repr, unknown))} is unknown. Correct its `name` or its "
                "`material` by `override` of the bundle, then `rebake` the bundle; or give `add` its haptics."
            )
        ids, near = self._sources.ids, self._connected(on)
        if not near:
            yield "No source touches it, directly or over other objects."
            inside = [source_id for source_id in ids if any(self._is_inside(source_id, x) for x in on)]
            if inside:
                named = first_of([*map(repr, inside)], MOST_NAMED)
                yield (
                    f"Inside it, too far from its surface to touch: {named}; move it to the surface, or add an object "
                    "that touches both."
                )
        yield from self.of_sources("Connected", near)

    def if_faint(self, on: set[str]) -> Iterator[str]:
        """Yield a sentence about sources that are connected to these objects and vibrate, of which nothing arrives."""
        if near := self._connected(on):
            named = first_of([*map(repr, near)], MOST_NAMED)
            yield f"Connected, but below -140 dB here: {named}; touch nearer to it, or choose another model."

    def of_sources(self, how: str, source_ids: Sequence[str]) -> Iterator[str]:
        """Yield a sentence for each cause for which some of these sources are silent.

        Parameters: how : their relation to the hand, in a word that begins the sentence.
        """
        silent: dict[tuple[str, str], list[str]] = {}
        for source_id in source_ids:
            if (cause := self._cause(source_id)) is not None:
                silent.setdefault(cause, []).append(source_id)
        for (why, remedy), several in silent.items():
            yield f"{how}, but {why}: {first_of([*map(repr, several)], MOST_NAMED)}; {remedy}."

    def _connected(self, on: set[str]) -> list[str]:
        """Return the sources that are connected to any of these objects."""
        ids = self._sources.ids
        reach = self._state.reach(ids)
        columns = frozenset[int]().union(*(reach.sources(object_id) for object_id in on))
        needs_path = not follows_poses(self._model)
        return [x for column, x in enumerate(ids) if column in columns or x in on or not needs_path]

    def _is_inside(self, object_id: str, other_id: str) -> bool:
        """Return True if the box of an object is inside the box around another one, in the other's frame."""
        boxes_m = [self._state.objects[x].geometry.mesh.bounds_m for x in (object_id, other_id)]
        pose = self._state.graph.pose
        corners_m = corners_of(boxes_m[0])
        own_m = pose(other_id).to_own(pose(object_id).to_world(corners_m))
        return bool(((own_m >= boxes_m[1][0]) & (own_m <= boxes_m[1][1])).all())

    def _cause(self, source_id: str) -> tuple[str, str] | None:
        """Return why a source is silent, and the remedy; None if it is not silent."""
        source = self._sources[source_id]
        if not source.is_on:
            return "off", "call `set_source` with on true"
        if source.level.is_muted:
            return "muted", "call `set_source` with mute false"
        if source.is_resting:
            return "in its off-time", "call `set_source` with on true"
        if not source.has_contact:
            return f"without contact with {source.needs[source.state]!r}, switched on", "move it there"
        return None
