"""Report of the sources that a hand feels: each source's path to the hand, object by object.

For models that spread vibration along paths, such as `ExponentialPlate`, the report shows the path with the least loss
by the paper's law. The field is evaluated at each contact on this path, so that the decibels of the steps add up to the
gain at the hand. A path may leave an object and return to it, as over a bar of steel on a rug: this is one step. In the
physical models (`CarryingField`) a source arrives over all paths at once and resonates. The report then shows the total
and the share of the power through each contact.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.exponential_plate import ExponentialPlate, PathCosts
from scene2hap.propagation.live import PathCostField
from scene2hap.propagation.paths.traced_paths import Leg, PathsToPoint, Point
from scene2hap.propagation.protocol import Carrier, CarryingField
from scene2hap.session.explanation.report import Explanation, FeltSource, PathStep, decibels
from scene2hap.session.explanation.why_silent import WhySilent
from scene2hap.session.frame import Touch
from scene2hap.session.gains.audibility import NOWHERE, arriving
from scene2hap.session.gains.hand_frames import LastFrame
from scene2hap.session.mix.sources import Sources
from scene2hap.session.present_scene.scene_state import SceneState


class Explainer:
    """Explains the gains of a hand at the last frame.

    A gain in a band in which the source has no vibration is not felt, however high. The costs of the paths are the
    law's own, so its field gives the gains along a path without another search.
    """

    def __init__(self, state: SceneState, sources: Sources, model: object, last: LastFrame) -> None:
        self._state, self._sources, self._model, self._last = state, sources, model, last
        self._why = WhySilent(state, sources, model)
        self._peaks = last.peaks
        self._column = {source_id: column for column, source_id in enumerate(sources.ids)}
        self._carrying = last.field if isinstance(last.field, CarryingField) else None
        field = last.field
        self._law = field if isinstance(field, PathCostField) and isinstance(model, ExponentialPlate) else None
        self._paths: dict[tuple[str, Point], PathsToPoint] = {}

    def explain(self, *, is_paused: bool) -> Explanation:
        """Explain the gains, or why there are none."""
        hand, touches, frame, failure = self._last.hand, self._last.touches, self._last.frame, self._last.failure
        is_current = self._last.is_current
        felt = []
        if touches and hand in frame.hands:
            gains = zip(frame.sources, frame.gains[frame.hands.index(hand)], strict=True)
            bands = {x: self._most_felt(x, given) for x, given in gains if given.any() and x in self._column}
            # No path is searched to the other sources, which are most sources of a large scene.
            limits = [math.inf if source_id in bands else NOWHERE for source_id in self._column]
            at_touches = self._last.gains.of([[touch] for touch in touches], limits)
            for source_id, band in bands.items():
                each = at_touches[:, self._column[source_id]]
                loudest = int(each[:, band].argmax())
                felt.append(self._felt(source_id, band, touches[loudest], each[loudest]))
        felt.sort(key=lambda item: -(item.gain_db + item.level_db))
        on = tuple(touch.object_id for touch in touches)
        reasons: list[str] = []
        if touches and all(item.is_too_weak for item in felt):
            reasons.extend(self._why.of_hand(set(on), is_paused=is_paused))
            if not (felt or reasons or failure) and is_current:
                reasons.extend(self._why.if_faint(set(on)))
        elif touches:
            # A hand on a cold pan expects the pan, also if it feels another source through it.
            felt_ids = {item.source_id for item in felt}
            silent = [x for x in dict.fromkeys(on) if x in self._sources and x not in felt_ids]
            reasons.extend(self._why.of_sources("Touched", silent))
        if failure:
            reasons.insert(0, failure)
        return Explanation(hand, on, tuple(felt), is_current, reasons=tuple(reasons), failure=failure)

    def _most_felt(self, source_id: str, gains: NDArray[np.float32]) -> int:
        """Return the band (of n_bands) in which a source is felt most at these gains."""
        felt = gains * self._peaks[self._column[source_id]]
        return int((felt if felt.any() else gains).argmax())

    def _felt(self, source_id: str, band: int, touch: Touch, gains: NDArray[np.float64]) -> FeltSource:
        """Return the report of a source at the touch where its gains (n_bands,) are highest."""
        on = touch.object_id
        gain_db, level_db = decibels(float(gains[band])), decibels(float(self._last.levels[source_id][band]))
        steps: tuple[PathStep, ...] = ()
        carriers: tuple[Carrier, ...] = ()
        if self._carrying is not None and on != source_id:
            carriers = self._carrying.carriers(on, source_id, band)
        else:
            legs = self._paths_to(on, touch.point_m).legs(source_id)
            steps = () if legs is None else _steps(source_id, legs, self._gains_along(legs, source_id, band))
        source = self._sources[source_id]
        felt = source.rows[source.state].loop.felt
        amplitude = float(arriving(gains * self._last.levels[source_id], self._peaks[self._column[source_id]]))
        over_db = None if felt is None else felt.level_db + decibels(amplitude)
        return FeltSource(source_id, source.state, on, gain_db, level_db, band, steps, carriers, over_db)

    def _gains_along(self, legs: Sequence[Leg], source_id: str, band: int) -> list[float]:
        """Return the gain of a source at the end of each leg."""
        column, here = self._column[source_id], self._last.gains
        if not legs:
            return []
        if self._law is not None:
            gains = here.capped(here.at(self._law, [[leg.cost] for leg in legs], [column]))[:, 0]
        else:
            gains = here.of([[Touch("", leg.object_id, leg.leave_m)] for leg in legs])[:, column]
        along: list[float] = gains[:, band].tolist()
        return along

    def _paths_to(self, on: str, point_m: Point) -> PathsToPoint:
        """Return the paths to a touched point; hands touch few, so that each is searched from once."""
        if (on, point_m) not in self._paths:
            contacts = self._state.contacts
            costs = PathCosts.of(self._model, self._state.bodies, contacts)
            self._paths[on, point_m] = PathsToPoint(
                costs.cost_per_m, contacts, costs.crossing_cost, costs.max_hops, on, point_m
            )
        return self._paths[on, point_m]


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
