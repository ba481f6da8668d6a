"""Start and stop times from recordings, which replace inferred times.

A state's `start_up_s` and `wind_down_s` are inferred until its recording has a start or a stop. The loop then stores
the curve together with the inferred time. The inferred time is restored if a sound without such a curve replaces the
recording. A time that a person wrote into the bundle stays until the recording changes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.run_curve import RunCurve
from scene2hap.haptics import ObjectHaptics, SourceState

RECORDING = "recording"
"""Provenance of a time that comes from a recording."""

Runs = tuple[RunCurve | None, RunCurve | None]
"""The curves of a start and of a stop; None if the recording has none."""

NO_RUNS: Runs = (None, None)


def runs_of(loop: HapticLoop | None) -> Runs:
    """Return the start and stop curves that a loop stores."""
    return NO_RUNS if loop is None else (loop.start_up, loop.wind_down)


def shown_runs(runs: Runs, state: SourceState, before: HapticLoop | None) -> Runs:
    """Return the start and stop curves of a recording that apply to a state, given the state's earlier loop.

    The curve of a spinning source with constant pitch is ignored: it is a fade made in an editor.
    """
    start_up, wind_down = (None if curve is None or (state.spins and curve.keeps_pitch) else curve for curve in runs)
    start_up_before, wind_down_before = runs_of(before)
    return (
        None if start_up is None else start_up.instead_of(state.start_up_s, start_up_before),
        None if wind_down is None else wind_down.instead_of(state.wind_down_s, wind_down_before),
    )


def with_recorded_times(
    objects: Mapping[str, ObjectHaptics],
    loops: Mapping[str, Mapping[str, HapticLoop]],
    before: Mapping[str, Mapping[str, HapticLoop]],
) -> dict[str, ObjectHaptics]:
    """Return objects by id, with new times where a loop's recorded start or stop differs from the earlier loop's."""
    return {
        key: _object(haptics, loops.get(key, {}), before.get(key, {})) if haptics.states else haptics
        for key, haptics in objects.items()
    }


def _object(haptics: ObjectHaptics, loops: Mapping[str, HapticLoop], before: Mapping[str, HapticLoop]) -> ObjectHaptics:
    states, provenance = haptics.states, dict(haptics.provenance)
    for place, name in enumerate(("start_up_s", "wind_down_s")):
        curves = [
            (runs_of(loops.get(state.name))[place], runs_of(before.get(state.name))[place]) for state in haptics.states
        ]
        states = tuple(_timed(state, name, *pair) for state, pair in zip(states, curves, strict=True))
        if any(now is not None and now is not earlier for now, earlier in curves):
            provenance[name] = RECORDING
        elif provenance.get(name) == RECORDING and all(now is None for now, _ in curves):
            del provenance[name]
    return replace(haptics, states=states, provenance=provenance)


def _timed(state: SourceState, name: str, now: RunCurve | None, before: RunCurve | None) -> SourceState:
    """Return a state with the start or stop time [s] of a new curve, or the inferred time if the curve is gone."""
    if now is before:
        return state
    changes: dict[str, Any] = {}
    if now is not None:
        changes[name] = now.lasts_s
    elif before is not None and getattr(state, name) == before.lasts_s:
        changes[name] = before.inferred_s
    return replace(state, **changes)
