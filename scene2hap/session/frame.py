"""Input and output of an update: touches, gains, counters."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.common.calls import clear_attributes, clear_call, clear_construction
from scene2hap.common.counted import first_of
from scene2hap.errors import SessionError, UnknownObject

_MOST_SHOWN = 8
_TOUCH = "A touch is Touch(hand, object_id, point_m), its point in the world."


@clear_construction
@dataclass(frozen=True)
class Touch:
    """A hand on an object.

    Parameters: hand : its name in the session; object_id : the touched object; point_m : the touched point in the world
    [m], where the object is in this frame.
    Raises: SessionError: `point_m` is not three finite numbers.
    """

    hand: str
    object_id: str
    point_m: tuple[float, float, float]

    if TYPE_CHECKING:

        def __init__(self, hand: str, object_id: str, point_m: Iterable[float]) -> None: ...

    def __post_init__(self) -> None:
        point = checks.vector("point_m", self.point_m, "m", size=3, error=SessionError, hint=_TOUCH)
        object.__setattr__(self, "point_m", point)


GivenTouches = Touch | Iterable[Touch | tuple[str, str, Iterable[float]]]
"""All forms in which a session accepts touches; a tuple is (hand, object id, point)."""

Gains = NDArray[np.float32]


@clear_attributes
class HapticFrame:
    """The result of one update: the gain of each source at each hand.

    Parameters: gains : (n_hands, n_sources, n_bands) float32 [-], or a function that computes them.
    """

    __slots__ = ("_gains", "_work_out", "hands", "sources")

    def __init__(self, gains: Gains | Callable[[], Gains], hands: tuple[str, ...], sources: tuple[str, ...]) -> None:
        self.hands: tuple[str, ...] = hands
        self.sources: tuple[str, ...] = sources
        self._gains: Gains | None = None if callable(gains) else _read_only(gains)
        self._work_out: Callable[[], Gains] | None = gains if callable(gains) else None

    def __reduce__(self) -> tuple[object, ...]:
        # Copies and pickles hold the gains themselves: a function that computes them belongs to its session.
        return type(self), (self.gains, self.hands, self.sources)

    def __repr__(self) -> str:
        sources = first_of(self.sources, _MOST_SHOWN) or "none"
        return f"HapticFrame(hands {', '.join(self.hands)}; sources {sources})"

    @property
    def gains(self) -> Gains:
        """Gains (n_hands, n_sources, n_bands) float32 [-], 0 below -140 dB. Read-only: later frames may share them.

        Models that report path cost (`propagation.live.PathCostField`) compute them on first access, since most games
        never read them. If a contact has changed by then, only the gains of mixed sources are computed, and the others
        are 0. The first access must be in the thread that updates.
        """
        if self._gains is None:
            assert self._work_out is not None
            self._gains, self._work_out = _read_only(self._work_out()), None
        return self._gains

    @clear_call
    def gain(self, hand: str, source_id: str) -> float:
        """Return the gain of a source at a hand, the highest of its bands [-].

        Raises: SessionError: no such hand; UnknownObject: no such source.
        """
        require_hand(hand, self.hands)
        if not isinstance(source_id, str) or source_id not in self.sources:
            raise UnknownObject(unknown_source(source_id, self.sources))
        return float(self.gains[self.hands.index(hand), self.sources.index(source_id)].max())


def _read_only(gains: Gains) -> Gains:
    view = gains.view()
    view.flags.writeable = False
    return view


@clear_attributes
@dataclass(frozen=True)
class SkipCounts:
    """How often a session skipped each kind of work; see `SkipConfig`.

    Parameters: unreachable_objects : objects left out of the model's input, or without a path from a live field's
    sources, summed over preparations and changes; unreachable_touches : touches that no source reaches;
    changes_out_of_reach : contact changes after which nothing had to be prepared; below_threshold : sources left out at
    a hand although they are connected to the touched object; silent_bands : gains left out at a hand; rows_not_mixed :
    bands of loops, times cells of 3 ms, with no gain above 0; idle_hands : hands that touched nothing; unchanged_frames
    : updates without a change.
    """

    unreachable_objects: int = 0
    unreachable_touches: int = 0
    changes_out_of_reach: int = 0
    below_threshold: int = 0
    silent_bands: int = 0
    rows_not_mixed: int = 0
    idle_hands: int = 0
    unchanged_frames: int = 0


@clear_attributes
@dataclass(frozen=True)
class SessionStats:
    """Counters of a session, as `HapticSession.stats` returns them.

    Parameters: updates : calls of `update`; fields_prepared : fields taken into use, and changes of contacts that a
    live field followed; gains_capped : gains of a source at a hand above the limit; bodiless : objects that carry no
    vibration, since their material is unknown; field_age_s : time since the field in use went out of date, 0 while it
    is current [s]; field_latency_s : time from a change to the use of the field that includes it [s]; fields_failed :
    preparations that the model refused, while the last field stayed in use; last_failure : the model's message;
    touches_off_surface : touches more than 5 cm off the box around their object, in the first 16 updates with touches
    and in one of 16 later ones; impacts : impacts, reported, found, or both; impacts_felt : impacts that a hand felt;
    impacts_left_out : impacts while too many others were played, or not prepared in time.
    """

    updates: int = 0
    fields_prepared: int = 0
    gains_capped: int = 0
    bodiless: tuple[str, ...] = ()
    field_age_s: float = 0.0
    field_latency_s: float = 0.0
    fields_failed: int = 0
    last_failure: str = ""
    skipped: SkipCounts = SkipCounts()
    touches_off_surface: int = 0
    impacts: int = 0
    impacts_felt: int = 0
    impacts_left_out: int = 0


@dataclass
class Counts:
    """Counts for `SkipCounts`, the number of capped gains, and whether a warning was given."""

    unreachable_objects: int = 0
    unreachable_touches: int = 0
    changes_out_of_reach: int = 0
    below_threshold: int = 0
    silent_bands: int = 0
    idle_hands: int = 0
    unchanged_frames: int = 0
    gains_capped: int = 0
    has_warned_of_gains: bool = False

    def skipped(self, rows_not_mixed: int) -> SkipCounts:
        """Copy the present counts into a `SkipCounts`."""
        not_skips = ("gains_capped", "has_warned_of_gains")
        counted = {name: count for name, count in vars(self).items() if name not in not_skips}
        return SkipCounts(rows_not_mixed=rows_not_mixed, **counted)


class RemovedIds:
    """The newest ids of removed objects or sources, for error messages."""

    _MOST = 1000
    """Bound on the memory, since a game may remove objects for hours."""

    def __init__(self) -> None:
        self._ids: dict[str, None] = {}

    def add(self, removed_id: str) -> None:
        """Store an id. An id that was added to the scene again needs no message, since it is known."""
        self._ids.pop(removed_id, None)
        self._ids[removed_id] = None
        if len(self._ids) > self._MOST:
            del self._ids[next(iter(self._ids))]

    def hint(self, wanted_id: object) -> str:
        """A sentence, after a blank, if the id was removed; else empty."""
        if not isinstance(wanted_id, str) or wanted_id not in self._ids:
            return ""
        return f" {wanted_id!r} was removed; `add` puts it back, `spawn` a copy of a prefab."


def require_hand(hand: object, hands: Sequence[str]) -> None:
    """Raise a SessionError if this is none of the hands."""
    if not isinstance(hand, str) or hand not in hands:  # an array would be compared element by element
        raise SessionError(unknown_hand(hand, hands))


def unknown_hand(hand: object, hands: Sequence[str]) -> str:
    """The sentence for a name that is no hand."""
    near = checks.did_you_mean(hand, hands, "Name all hands when the session is made (hands=), or call add_hand.")
    return f"no hand {checks.represented(hand)}; this session has {', '.join(map(repr, hands))}. {near}"


def unknown_source(source_id: str, source_ids: Sequence[str]) -> str:
    """The sentence for an id that is not a source."""
    known = ", ".join(map(repr, source_ids)) or "none: nothing in this scene vibrates"
    near = checks.did_you_mean(source_id, source_ids)
    return f"no source {checks.represented(source_id)}; the sources are {known}. {near}".rstrip()
