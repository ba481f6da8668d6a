"""Counters of a session: updates, fields, impacts, and the work that was skipped."""

from __future__ import annotations

from dataclasses import dataclass, field

from scene2hap.common.calls import clear_attributes


@clear_attributes
@dataclass
class SkipCounts:
    """How often a session skipped each kind of work; see `SkipConfig`. `HapticSession.stats` returns a copy.

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
    skipped: SkipCounts = field(default_factory=SkipCounts)
    touches_off_surface: int = 0
    impacts: int = 0
    impacts_felt: int = 0
    impacts_left_out: int = 0


@dataclass
class Counts:
    """The counts of a session that its parts raise: skipped work and capped gains; and whether a warning was given."""

    skipped: SkipCounts = field(default_factory=SkipCounts)
    gains_capped: int = 0
    has_warned_of_gains: bool = False
