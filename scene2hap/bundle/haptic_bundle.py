"""HapticBundle: a baked scene that can be changed, saved and loaded."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, overload

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.loops import MIN_CLIP_S
from scene2hap.bundle.checking import require_plausible
from scene2hap.bundle.contents import BundleContents
from scene2hap.bundle.corrections import read_corrections
from scene2hap.bundle.edited_loops import to_be_made_again
from scene2hap.bundle.notebook import bundle_table
from scene2hap.bundle.override import (
    ANY_STATE,
    BY_STATE,
    MAKES_LOOPS,
    NONE,
    USER,
    Override,
    answers_before,
    warn_if_percent,
)
from scene2hap.bundle.reading import read_bundle
from scene2hap.bundle.writing import write_bundle
from scene2hap.clips.haptic_clip import HapticClip
from scene2hap.common import checks
from scene2hap.common.calls import clear_calls
from scene2hap.common.counted import counted
from scene2hap.common.warning import warn_of
from scene2hap.errors import AudioError, BundleError, CallError, MaterialError, SceneError
from scene2hap.haptics import is_unknown
from scene2hap.materials import Material
from scene2hap.scene.plausibility.check import too_heavy
from scene2hap.scene.surface import plate_sizes

if TYPE_CHECKING:
    from matplotlib.figure import Figure, SubFigure


@contextmanager
def _named(place: object) -> Iterator[None]:
    """Put the name of an object or a file before the message of an error."""
    try:
        yield
    except (AudioError, BundleError, MaterialError, SceneError) as cause:
        raise type(cause)(f"{checks.shown(place) if isinstance(place, str) else place}: {cause}") from cause


def _locked(object_id: str, change: str) -> BundleError:
    return BundleError(
        f"{object_id!r} is locked, so that {change} cannot change its loops. Unlock it first: "
        f"`override({object_id!r}, locked=False)`, or `scene2hap edit BUNDLE unlock {object_id}`."
    )


_OF_SOURCES = ("clip", "gain_db", "intensity", "pitch_hz", "start_up_s", "wind_down_s", "muted")
"""Corrections that only a vibrating object takes."""

_TO_VIBRATE = "First vibrates=True and rebake, or `scene2hap edit BUNDLE vibrate ID`."
_TO_BEGIN_SILENT = "To begin silent, mute it: muted=True, or `scene2hap edit BUNDLE mute ID`."


@clear_calls
@dataclass(frozen=True)
class HapticBundle(BundleContents):
    """A baked scene: its objects, the inferred properties of each, and the loops of each source by state.

    `overrides` are a person's corrections. `choices` give the reason for each chosen sound, as a table of its
    candidates in text, by id and state. `made_with` are the common settings of all loops, None if unknown. `inferred`
    has the objects that a person corrected, as they were before.
    Bundles are equal if all of their data are. A baked bundle equals the one that is loaded from its folder.
    """

    def override(
        self,
        object_id: str,
        *,
        name: str | None = None,
        vibrates: bool | None = None,
        gain_db: float | None = None,
        material: Material | Mapping[str, Any] | str | None = None,
        clip: AudioClip | HapticClip | str | os.PathLike[str] | None = None,
        keep: bool | None = None,
        locked: bool | None = None,
        intensity: float | Mapping[str, float] | None = None,
        pitch_hz: float | Mapping[str, float] | None = None,
        state: str | None = None,
        muted: bool | None = None,
        mass_kg: float | None = None,
        thickness_m: float | None = None,
        feet: Material | Mapping[str, Any] | str | None = None,
        start_up_s: float | Mapping[str, float] | None = None,
        wind_down_s: float | Mapping[str, float] | None = None,
    ) -> Self:
        """Correct one object, in addition to earlier corrections. Returns a new bundle. None leaves a field unchanged.

        A name says what the object is, such as "washing machine": `rebake` infers the object by it. A clip, or the
        path of one, keeps its own frequency; `keep=False` allows moving it away from the scene's other sources.
        Intensity, pitch and the times of start and stop are numbers for all states, or mappings by state. `state` is
        the state at the start. Corrections are kept in the folder and by `rebake`. Level, material, mass,
        thickness of the main surface, feet, times, first state, mute and silence take effect at once. The others, and
        vibration of an object that was inferred silent, need `rebake(bundle)`, which makes the loops. The loops of a
        locked object stay unchanged, byte for byte; a correction that would change them is rejected.
        Raises: UnknownObject; BundleError: a field out of bounds, an unknown state of the object, or a change of the
        loops of a locked object; UnknownMaterial; AudioError: a clip that cannot be read or lasts less than 0.1 s.
        Warns: SceneWarning: a correction of vibration for an object that does not vibrate; a number for all states
        beside `state`; a level that looks like a percentage; or a mass that looks like grams.
        """
        self.snapshot.object(object_id)
        changes = {
            "name": name,
            "vibrates": vibrates,
            "gain_db": gain_db,
            "material": material,
            "clip": clip,
            "keep": keep,
            "locked": locked,
            "intensity": intensity,
            "pitch_hz": pitch_hz,
            "state": state,
            "muted": muted,
            "mass_kg": mass_kg,
            "thickness_m": thickness_m,
            "feet": feet,
            "start_up_s": start_up_s,
            "wind_down_s": wind_down_s,
        }
        wish = self.overrides.get(object_id, Override())
        self._require_unlocked(object_id, wish, changes)
        with _named(object_id):
            wish = wish.changed(changes)
            if clip is not None and wish.clip is not None and wish.clip.duration_s < MIN_CLIP_S:
                sound = clip if isinstance(clip, str | os.PathLike) else repr(wish.clip.credit.title)
                raise AudioError(
                    f"the sound {sound} lasts {wish.clip.duration_s:.3g} s; it must last at least {MIN_CLIP_S:g} s. "
                    "Record a longer one, or repeat it in an audio editor."
                )
        named = {name for field in BY_STATE if changes[field] is not None for name in getattr(wish, field)}
        self._require_states(object_id, [*sorted(named - {ANY_STATE}), *([] if state is None else [state])])
        if pitch_hz is not None:
            self._require_played(object_id, wish)
        has_vibration = self.objects[object_id].vibrates if wish.vibrates is None else wish.vibrates
        vain = [name for name in _OF_SOURCES if changes[name] is not None]
        if vain and not has_vibration:
            warn_of(
                f"{object_id!r} does not vibrate; {', '.join(vain)} will change nothing until it does. Write "
                f"override({object_id!r}, vibrates=True), or `scene2hap edit BUNDLE vibrate {object_id}`."
            )
        everywhere = [name for name in BY_STATE if not isinstance(changes[name], Mapping | None)]
        if state is not None and everywhere and len(self.objects[object_id].states) > 1:
            warn_of(
                f"state={state!r} is the state of {object_id!r} at the start; {', '.join(everywhere)} changes every "
                f"state. For one state alone write {everywhere[0]}={{{state!r}: {changes[everywhere[0]]}}}."
            )
        if wish.gain_db is not None and gain_db is not None:
            warn_if_percent(wish.gain_db)
        if wish.thickness_m is not None and thickness_m is not None:
            self._require_thickness(object_id, wish.thickness_m)
        if mass_kg is not None and (heavy := too_heavy(self.snapshot.object(object_id), mass_kg)):
            warn_of(heavy)
        overrides = {**self.overrides, object_id: wish}
        inferred = answers_before(self.objects, overrides, self.inferred)
        return replace(self, overrides=overrides, inferred=inferred).with_overrides()

    def reset(self, object_id: str) -> Self:
        """Take back all corrections of one object, so that it is as inferred. Returns a new bundle.

        What an edit by hand changed in its loops, and in the row of a corrected object in `objects.json`, is taken
        back, too. Loops follow with `rebake(bundle)`. Raises: UnknownObject; BundleError: the object is locked, or the
        bundle does not know what was inferred.
        """
        self.snapshot.object(object_id)
        if self.overrides.get(object_id, NONE).locked:
            raise _locked(object_id, "reset")
        objects, loops = dict(self.objects), dict(self.loops)
        overrides, inferred = dict(self.overrides), dict(self.inferred)
        overrides.pop(object_id, None)
        before = inferred.pop(object_id, objects.get(object_id))
        if before is not None:
            if USER in before.provenance.values() and "name" not in before.reasons:
                raise BundleError(
                    f"{object_id!r} was corrected by an earlier version, which did not keep what was inferred. Remove "
                    "its row from overrides.json, and bake the scene again."
                )
            objects[object_id] = before
            if not before.vibrates:
                loops.pop(object_id, None)
        if object_id in loops:
            loops[object_id] = {name: to_be_made_again(loop) for name, loop in loops[object_id].items()}
        return replace(self, objects=objects, loops=loops, overrides=overrides, inferred=inferred)

    def corrected(self, file: str | os.PathLike[str]) -> Self:
        """Apply the corrections in a file from a report page, in addition to earlier ones. Returns a new bundle.

        Corrections of vibration, intensity and pitch need `rebake`. Raises: BundleError: not a file of corrections; and
        as `override`.
        """
        bundle, path = self, checks.path("file", file, error=BundleError)
        for object_id, fields in read_corrections(path).items():
            with _named(path):
                bundle = bundle.override(object_id, **fields)
        return bundle

    def with_overrides(self) -> Self:
        """Return the bundle with all corrections applied that need no new loops."""
        objects = {
            object_id: self.overrides[object_id].applied(haptics) if object_id in self.overrides else haptics
            for object_id, haptics in self.objects.items()
        }
        loops = dict(self.loops)
        for object_id, wish in self.overrides.items():
            if wish.vibrates is False:
                loops.pop(object_id, None)
            elif wish.state is not None and wish.state in loops.get(object_id, {}):
                # The first state in the mapping is the one that plays.
                loops[object_id] = {wish.state: loops[object_id][wish.state], **loops[object_id]}
        return replace(self, objects=objects, loops=loops)

    def _require_unlocked(self, object_id: str, wish: Override, changes: Mapping[str, Any]) -> None:
        changed = sorted(name for name in MAKES_LOOPS if changes[name] is not None)
        if changed and wish.locked and changes["locked"] is not False and object_id in self.loops:
            raise _locked(object_id, changed[0])

    def _require_states(self, object_id: str, states: Sequence[str]) -> None:
        haptics = self.objects.get(object_id)
        known = [one.name for one in haptics.states] if haptics is not None else []
        for state in states:
            if state not in known:
                has, step = "it does not vibrate and has none", _TO_VIBRATE
                if known:
                    has, step = f"it has {', '.join(map(repr, known))}", _TO_BEGIN_SILENT if state == "off" else ""
                raise BundleError(f"{object_id!r} has no state {checks.shown(state)}; {has}. {step}".rstrip())

    def _require_thickness(self, object_id: str, thickness_m: float) -> None:
        """Raise a BundleError if the object's plate cannot have a thickness."""
        measured_m = self.snapshot.object(object_id).size_m
        wrong = plate_sizes.faults((*measured_m[:2], thickness_m), measured_m)
        if "thickness" in wrong:
            raise BundleError(f"thickness_m of {object_id!r} is {wrong['thickness']}.")

    def _require_played(self, object_id: str, wish: Override) -> None:
        """Raise a BundleError if the bundle's actuator does not play a pitch."""
        actuator = self.actuator
        if actuator is None:
            return
        low_hz, high_hz = actuator.min_frequency_hz, actuator.max_frequency_hz
        for pitch_hz in wish.pitch_hz.values():
            if not low_hz <= pitch_hz <= high_hz:
                raise BundleError(
                    f"pitch_hz of {object_id!r} is {pitch_hz:g} Hz; the actuator {actuator.name!r} of this bundle "
                    f"plays {low_hz:g} to {high_hz:g} Hz. Choose a pitch in that band."
                )

    @overload
    def plot(
        self, *, sources: Sequence[str] | None = None, up_to_m: float | None = None, figure: None = None
    ) -> Figure: ...
    @overload
    def plot(
        self, *, sources: Sequence[str] | None = None, up_to_m: float | None = None, figure: Figure | SubFigure
    ) -> Figure | SubFigure: ...
    def plot(
        self,
        *,
        sources: Sequence[str] | None = None,
        up_to_m: float | None = None,
        figure: Figure | SubFigure | None = None,
    ) -> Figure | SubFigure:
        """Draw the scene from above with its sources, and for each source its sound, vibration and spectra.

        Parameters: sources : ids of the sources to draw, the first eight if None; up_to_m : leave out surfaces higher
        than this above the lowest point of the scene [m], None for ceilings that hide most of the objects; figure : an
        empty matplotlib figure to draw into, None for a new one.
        Returns: the figure, made without pyplot; lengths in m, times in s, levels in dB re full scale.
        Raises: MissingExtra: matplotlib is not installed; BundleError: no such source, or `up_to_m` is no height.
        """
        from scene2hap.bundle.plots import plot_bundle  # imported here, since it needs the extra `plots`

        if up_to_m is not None:
            up_to_m = checks.number("up_to_m", up_to_m, "m", error=BundleError)
        return plot_bundle(self, sources, up_to_m, figure)

    def __hash__(self) -> int:
        raise CallError(
            "a HapticBundle is no key of a dictionary and no item of a set, since its parts are mappings. Use the path "
            "of its folder, or bundle.snapshot."
        )

    def __repr__(self) -> str:
        n_sources = sum(map(bool, self.loops.values()))
        counts = f"{counted(len(self.snapshot.objects), 'object')}, {counted(n_sources, 'source')}"
        n_unknown = sum(is_unknown(haptics.object_category) for haptics in self.objects.values())
        unknown = f", {n_unknown} unknown" if n_unknown else ""
        return f"HapticBundle({self.snapshot.name!r}, {counts}{unknown})"

    def _repr_html_(self) -> str:
        return bundle_table(self)

    def save(self, folder: str | os.PathLike[str]) -> Path:
        """Write the folder whole or not at all. An older bundle there is replaced, and foreign files are kept.

        Raises: BundleVersionError: a bundle of a newer scene2hap is there; BundleError: the folder is not a bundle, is
        the working folder of this process, or cannot be written.
        """
        return write_bundle(self, checks.path("folder", folder, error=BundleError))

    @classmethod
    def load(cls, folder: str | os.PathLike[str]) -> Self:
        """Read a folder that `save` wrote, even if edited.

        Raises: BundleIncomplete: a file is missing or cut short; BundleVersionError: written by a newer scene2hap;
        BundleError: a file has an impossible value.
        Warns: BundleWarning: a state needs a contact that no object in the scene can provide; a correction of a state
        that its object does not have.
        """
        path = checks.path("folder", folder, error=BundleError)
        found = read_bundle(path)
        require_plausible(found, path)
        return cls(**vars(found))
