"""The report of `HapticSession.explain` as data and as text: the sources and impacts that a hand feels."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal

from scene2hap.common.html_tables import html_table
from scene2hap.propagation.protocol import Carrier
from scene2hap.session.impacts.felt_impacts import Impact

LEAST_SHARE = 0.01
"""Smallest share of the power that the text mentions."""

FAINTEST_DB = -140.0
"""Lower bound of the level of a start or stop, whose amplitude may be 0."""


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

    def during_transition(self, amplitude: float, *, is_start: bool) -> FeltSource:
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


def decibels(gain: float) -> float:
    """20 lg of a gain [dB], -infinity for 0."""
    return 20 * math.log10(gain) if gain > 0 else -math.inf


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
