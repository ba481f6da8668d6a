"""Comparison of a model's sizes with the measured sizes."""

from __future__ import annotations

from collections.abc import Sequence

from scene2hap.llm.answers import ObjectAnswer
from scene2hap.llm.validation.plausibility import EDGES
from scene2hap.scene.surface import plate_sizes


def surface_size(answer: ObjectAnswer, measured_m: Sequence[float]) -> tuple[plate_sizes.Size, tuple[str, ...]]:
    """Return length, width and thickness [m] of a surface, and doubts. Measured edges replace edges out of bounds.

    If the thickness was not measured either, it is assumed.
    """
    stated = (answer.estimated_length_m, answer.estimated_width_m, answer.estimated_thickness_m)
    wrong = plate_sizes.faults(stated, measured_m)
    if not wrong:
        return stated, ()
    known = plate_sizes.with_thickness(measured_m)
    # Length and width are replaced together: a mix of stated and measured edges would be a third, wrong plate.
    replaced = {*wrong, *(("length", "width") if {"length", "width"} & {*wrong} else ())}
    length, width, thickness = (
        other if edge in replaced else one for edge, one, other in zip(EDGES, stated, known, strict=True)
    )
    used = {edge: f"{value:.3g} m is used" for edge, value in zip(EDGES, known, strict=True)}
    return (length, width, thickness), tuple(f"{edge}: {why}; {used[edge]}" for edge, why in wrong.items())
