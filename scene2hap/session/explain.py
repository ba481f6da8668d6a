"""Report of the sources that a hand feels: each source's path to the hand, object by object.

For models that spread vibration along paths, such as `ExponentialPlate`, the report shows the path with the least loss
by the paper's law. The field is evaluated at each contact on this path, so that the decibels of the steps add up to the
gain at the hand. A path may leave an object and return to it, as over a bar of steel on a rug: this is one step. In the
physical models (`CarryingField`) a source arrives over all paths at once and resonates. The report then shows the total
and the share of the power through each contact.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.counted import first_of
from scene2hap.common.html_tables import html_table
from scene2hap.propagation.exponential_plate import ExponentialPlate, PathCosts
from scene2hap.propagation.live import PathCostField
from scene2hap.propagation.paths.traced_paths import Leg, PathsToPoint, Point
from scene2hap.propagation.protocol import Carrier, CarryingField, follows_poses
from scene2hap.session.audibility import NOWHERE
from scene2hap.session.frame import HapticFrame, Touch
from scene2hap.session.hand_gains import TouchGains
from scene2hap.session.impacts.felt_impacts import Impact
from scene2hap.session.mix.sources import Sources
from scene2hap.session.scene_state import SceneState

LEAST_SHARE = 0.01
"""Smallest share of the power that the text mentions."""

FAINTEST_DB = -140.0
"""Lower bound of the level of a start or stop, whose amplitude may be 0."""

MOST_NAMED = 5
"""Most silent sources that the text names."""


@dataclass(frozen=True)
class PathStep:
    """One object on a path: the length through it [m], and the change of the level over that length [dB].

    by_way_of : objects on a short cut from this object back to it; their lengths are included.
    """

    object_id: str
    length_m: float
    change_db: float
    by_way_of: tuple[str, ...] = ()

    def __str__(self) -> str:
        cut = f" by way of {', '.join(self.by_way_of)}" if self.by_way_of else ""
        return f"{self.object_id} ({self.length_m:.2f} m{cut}, {self.change_db:+z.1f} dB)"


@dataclass(frozen=True)
class FeltSource:
    """A source that arrives at a hand.

    Parameters: state, on : its state, and the touched object; gain_db : its gain there, in the band in which it is felt
    most; level_db : the volume of source and user; band : that band; steps : from the source to the touched object,
    empty if the law has no path (over an object of unknown material, say) and for the physical models; carriers : in
    the physical models, the contacts through which it enters the touched object, the strongest first; over_threshold_db
    : its level over the threshold of touch at this hand, over all bands, None if the loop has no level; running,
    running_db : whether the source starts or stops at this moment, and its level re steady running, which
    `over_threshold_db` includes.
    """

    source_id: str
    state: str
    on: str
    gain_db: float
    level_db: float
    band: int
    steps: tuple[PathStep, ...]
    carriers: tuple[Carrier, ...] = ()
    over_threshold_db: float | None = None
    running: Literal["steady", "starting", "stopping"] = "steady"
    running_db: float = 0.0

    def while_passing(self, amplitude: float, *, is_start: bool) -> FeltSource:
        """Return the source during a start or stop with an amplitude re steady running [-]."""
        running_db = max(decibels(amplitude), FAINTEST_DB)
        over_db = None if self.over_threshold_db is None else self.over_threshold_db + running_db
        running: Literal["starting", "stopping"] = "starting" if is_start else "stopping"
        return replace(self, running=running, running_db=running_db, over_threshold_db=over_db)

    @property
    def is_too_weak(self) -> bool:
        """Whether it arrives too weakly to be felt."""
        return self.over_threshold_db is not None and self.over_threshold_db < 0

    @property
    def length_m(self) -> float:
        """Length of the whole path [m]."""
        return sum(step.length_m for step in self.steps)

    def __str__(self) -> str:
        volume = f", volume {self.level_db:+z.1f} dB" if abs(self.level_db) >= 0.05 else ""
        state = self.state if self.running == "steady" else f"{self.state}, {self.running}: {self.running_db:+z.1f} dB"
        total = f"{self.source_id} ({state}) {self.gain_db:+z.1f} dB"
        if self.is_too_weak:
            volume += ", too weak to be felt"
        if self.carriers:
            return f"{total}{volume}: {self.way}"
        return f"{total} over {self.length_m:.2f} m{volume}: {self.way}"

    @property
    def way(self) -> str:
        """The path object by object, or the share of the power that each neighbour brings, in words."""
        if self.carriers:
            return _in_words(self.carriers)
        return " -> ".join(map(str, self.steps)) or "no path by the paper's law"


@dataclass(frozen=True)
class Explanation:
    """Report of the vibration at one hand, as `HapticSession.explain` returns it. `print(report.text)` shows it.

    `felt` has the sources that arrive, the strongest first. `impacts` has the impacts of the last second, the latest
    first. `is_current` is false while a worker prepares a newer field, and if the model failed; `failure` then says
    why. `reasons` are sentences that say why a touching hand feels no source, or not the source that it touches, why
    the sink plays nothing, or why the model failed; empty otherwise.
    """

    hand: str
    touches: tuple[str, ...]
    felt: tuple[FeltSource, ...]
    is_current: bool = True
    impacts: tuple[Impact, ...] = ()
    reasons: tuple[str, ...] = ()
    failure: str = ""

    @property
    def text(self) -> str:
        """The report in words, a line for each source."""
        on = f"touches {', '.join(self.touches)}" if self.touches else "touches nothing"
        late = "" if self.is_current or self.failure else " (the next field is still being prepared)"
        lines = [f"{self.hand} {on}{late}" + (":" if self.felt or self.impacts else " and feels nothing.")]
        struck = (f"  {item}, {decibels(item.felt[self.hand]):+z.1f} dB re full scale" for item in self.impacts)
        return "\n".join([*lines, *(f"  {item}" for item in (*self.reasons, *self.felt)), *struck])

    def to_data(self) -> dict[str, Any]:
        """Return the report as plain data, for JSON."""
        return {**asdict(self), "text": self.text}

    def __str__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        impacts = [
            (f"impact on {item.object_id}", "-", "-", f"{decibels(item.felt[self.hand]):+z.1f} re full scale", "-", "-")
            for item in self.impacts
        ]
        rows = [
            (one.source_id, one.state, one.on, f"{one.gain_db:+z.1f}", f"{one.level_db:+z.1f}", one.way)
            for one in self.felt
        ]
        columns = ("source", "state", "felt on", "gain [dB]", "volume [dB]", "path or share of power")
        first, *_ = self.text.splitlines()
        return html_table(first, columns, [*rows, *impacts], len(rows) + len(impacts))


class Explainer:
    """Explains the gains of one moment.

    Parameters: field : the field in use, which `gains` evaluates; levels : of each source at the hand, by band
    (n_bands,) [-]; peaks : of each source in each band, in thresholds of touch (n_sources, n_bands). A gain in a band
    in which the source has no vibration is not felt, however high.
    The costs of the paths are the law's own, so its field gives the gains along a path without another search.
    """

    def __init__(
        self,
        state: SceneState,
        sources: Sources,
        model: object,
        field: object,
        gains: TouchGains,
        levels: Mapping[str, NDArray[np.float64]],
        peaks: NDArray[np.float32],
    ) -> None:
        self._state, self._sources, self._model, self._gains, self._levels = state, sources, model, gains, levels
        self._peaks = peaks.astype(np.float64)
        self._column = {source_id: column for column, source_id in enumerate(sources.ids)}
        self._carrying = field if isinstance(field, CarryingField) else None
        self._law = field if isinstance(field, PathCostField) and isinstance(model, ExponentialPlate) else None
        self._paths: dict[tuple[str, Point], PathsToPoint] = {}

    def explain(
        self,
        hand: str,
        touches: Sequence[Touch],
        frame: HapticFrame,
        *,
        is_current: bool,
        failure: str,
        is_paused: bool,
    ) -> Explanation:
        """Explain the gains of a hand in a frame with these touches. failure : see `Explanation`."""
        felt = []
        if touches and hand in frame.hands:
            gains = zip(frame.sources, frame.gains[frame.hands.index(hand)], strict=True)
            bands = {x: self._most_felt(x, given) for x, given in gains if given.any() and x in self._column}
            # No path is searched to the other sources, which are most sources of a large scene.
            limits = [math.inf if source_id in bands else NOWHERE for source_id in self._column]
            at_touches = self._gains.of([[touch] for touch in touches], limits)
            for source_id, band in bands.items():
                each = at_touches[:, self._column[source_id]]
                loudest = int(each[:, band].argmax())
                felt.append(self._felt(source_id, band, touches[loudest], each[loudest]))
        felt.sort(key=lambda item: -(item.gain_db + item.level_db))
        on = tuple(touch.object_id for touch in touches)
        reasons: list[str] = []
        if touches and all(item.is_too_weak for item in felt):
            reasons.extend(self._reasons(set(on), is_paused=is_paused))
            if not (felt or reasons or failure) and is_current:
                reasons.extend(self._why_faint(set(on)))
        elif touches:
            # A hand on a cold pan expects the pan, also if it feels another source through it.
            felt_ids = {item.source_id for item in felt}
            silent = [x for x in dict.fromkeys(on) if x in self._sources and x not in felt_ids]
            reasons.extend(self._why_silent_each("Touched", silent))
        if failure:
            reasons.insert(0, failure)
        return Explanation(hand, on, tuple(felt), is_current, reasons=tuple(reasons), failure=failure)

    def _reasons(self, on: set[str], *, is_paused: bool) -> Iterator[str]:
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
        yield from self._why_silent_each("Connected", near)

    def _why_faint(self, on: set[str]) -> Iterator[str]:
        """Yield a sentence about sources that are connected to these objects and vibrate, of which nothing arrives."""
        if near := self._connected(on):
            named = first_of([*map(repr, near)], MOST_NAMED)
            yield f"Connected, but below -140 dB here: {named}; touch nearer to it, or choose another model."

    def _connected(self, on: set[str]) -> list[str]:
        """Return the sources that are connected to any of these objects."""
        ids = self._sources.ids
        reach = self._state.reach(ids)
        columns = frozenset[int]().union(*(reach.sources(object_id) for object_id in on))
        needs_path = not follows_poses(self._model)
        return [x for column, x in enumerate(ids) if column in columns or x in on or not needs_path]

    def _why_silent_each(self, how: str, source_ids: Sequence[str]) -> Iterator[str]:
        """Yield a sentence for each cause for which some of these sources are silent."""
        silent: dict[tuple[str, str], list[str]] = {}
        for source_id in source_ids:
            if (cause := self._why_silent(source_id)) is not None:
                silent.setdefault(cause, []).append(source_id)
        for (why, remedy), several in silent.items():
            yield f"{how}, but {why}: {first_of([*map(repr, several)], MOST_NAMED)}; {remedy}."

    def _is_inside(self, object_id: str, other_id: str) -> bool:
        """Return True if the box of an object is inside the box around another one, in the other's frame."""
        boxes_m = [self._state.objects[x].geometry.mesh.bounds_m for x in (object_id, other_id)]
        pose = self._state.graph.pose
        corners_m = np.stack(np.meshgrid(*boxes_m[0].T), axis=-1).reshape(-1, 3)
        own_m = pose(other_id).to_own(pose(object_id).to_world(corners_m))
        return bool(((own_m >= boxes_m[1][0]) & (own_m <= boxes_m[1][1])).all())

    def _why_silent(self, source_id: str) -> tuple[str, str] | None:
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

    def _most_felt(self, source_id: str, gains: NDArray[np.float32]) -> int:
        """Return the band (of n_bands) in which a source is felt most at these gains."""
        felt = gains * self._peaks[self._column[source_id]]
        return int((felt if felt.any() else gains).argmax())

    def _arriving(self, source_id: str, gains: NDArray[np.float64]) -> float:
        """Return the amplitude over all bands re that on the source itself [-]."""
        peaks = self._peaks[self._column[source_id]]
        whole = float(np.linalg.norm(peaks))
        return float(np.linalg.norm(peaks * gains * self._levels[source_id])) / whole if whole > 0.0 else 0.0

    def _felt(self, source_id: str, band: int, touch: Touch, gains: NDArray[np.float64]) -> FeltSource:
        """Return the report of a source at the touch where its gains (n_bands,) are highest."""
        on = touch.object_id
        gain_db, level_db = decibels(float(gains[band])), decibels(float(self._levels[source_id][band]))
        steps: tuple[PathStep, ...] = ()
        carriers: tuple[Carrier, ...] = ()
        if self._carrying is not None and on != source_id:
            carriers = self._carrying.carriers(on, source_id, band)
        else:
            legs = self._paths_to(on, touch.point_m).legs(source_id)
            steps = () if legs is None else _steps(source_id, legs, self._gains_along(legs, source_id, band))
        source = self._sources[source_id]
        felt = source.rows[source.state].loop.felt
        over_db = None if felt is None else felt.level_db + decibels(self._arriving(source_id, gains))
        return FeltSource(source_id, source.state, on, gain_db, level_db, band, steps, carriers, over_db)

    def _gains_along(self, legs: Sequence[Leg], source_id: str, band: int) -> list[float]:
        """Return the gain of a source at the end of each leg."""
        column = self._column[source_id]
        if not legs:
            return []
        if self._law is not None:
            gains = self._gains.capped(self._gains.at(self._law, [[leg.cost] for leg in legs], [column]))[:, 0]
        else:
            gains = self._gains.of([[Touch("", leg.object_id, leg.leave_m)] for leg in legs])[:, column]
        along: list[float] = gains[:, band].tolist()
        return along

    def _paths_to(self, on: str, point_m: Point) -> PathsToPoint:
        """Return the paths to a touched point; hands touch few, so that each is searched from once."""
        if (on, point_m) not in self._paths:
            contacts = self._state.graph.contacts
            costs = PathCosts.of(self._model, self._state.bodies, contacts)
            self._paths[on, point_m] = PathsToPoint(
                costs.cost_per_m, contacts, costs.crossing_cost, costs.max_hops, on, point_m
            )
        return self._paths[on, point_m]


def decibels(gain: float) -> float:
    """20 lg of a gain [dB], -infinity for 0."""
    return 20 * math.log10(gain) if gain > 0 else -math.inf


def _steps(source_id: str, legs: Sequence[Leg], gains: Sequence[float]) -> tuple[PathStep, ...]:
    """Steps of a path, from the gain at the end of each leg. The loss of a contact belongs to the object behind it."""
    steps, before_db = [PathStep(source_id, 0.0, 0.0)], 0.0
    for leg, gain in zip(legs, gains, strict=True):
        after_db = decibels(gain)
        change_db = after_db - before_db if math.isfinite(before_db) else 0.0
        steps.append(PathStep(leg.object_id, math.dist(leg.enter_m, leg.leave_m), change_db))
        before_db = after_db
        first = [step.object_id for step in steps].index(leg.object_id)
        steps[first:] = [_as_one(steps[first:])]
    return tuple(steps)


def _as_one(steps: Sequence[PathStep]) -> PathStep:
    """Join the steps from an object back to the same object into one; return a single step unchanged."""
    if len(steps) == 1:
        return steps[0]
    others = [x for step in steps for x in (step.object_id, *step.by_way_of) if x != steps[0].object_id]
    length_m, change_db = sum(step.length_m for step in steps), sum(step.change_db for step in steps)
    return PathStep(steps[0].object_id, length_m, change_db, tuple(dict.fromkeys(others)))


def _in_words(carriers: Sequence[Carrier]) -> str:
    """Describe each neighbour's share of the power, from `LEAST_SHARE` up, and its number of contacts."""
    by: dict[str, list[float]] = {}
    for carrier in carriers:
        by.setdefault(carrier.by, []).append(carrier.share)
    parts = sorted(by.items(), key=lambda item: -sum(item[1]))
    described = [
        f"{100 * sum(shares):.0f} % from {object_id} over {len(shares)} contact{'s' * (len(shares) > 1)}"
        for object_id, shares in parts
        if sum(shares) >= LEAST_SHARE
    ]
    return ", ".join(described)
