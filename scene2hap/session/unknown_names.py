"""Error messages for names of hands, objects and sources that a session does not have."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from scene2hap.common import checks
from scene2hap.errors import SessionError

_MOST_REMOVED = 1000
"""Bound on the memory, since a game may remove objects for hours."""


@dataclass(eq=False)
class RemovedIds:
    """The newest ids of removed objects or sources, for error messages."""

    _ids: dict[str, None] = field(default_factory=dict)

    def add(self, removed_id: str) -> None:
        """Store an id. An id that was added to the scene again needs no message, since it is known."""
        self._ids.pop(removed_id, None)
        self._ids[removed_id] = None
        if len(self._ids) > _MOST_REMOVED:
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
