"""Input and output of an update: the touches of each hand, and the gains of each source at each hand."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.common.calls import clear_attributes, clear_call, clear_construction
from scene2hap.common.counted import first_of
from scene2hap.errors import SessionError, UnknownObject
from scene2hap.session.present_scene.scene_state import SceneState
from scene2hap.session.unknown_names import require_hand, unknown_hand, unknown_source

_MOST_SHOWN = 8
_TOUCH = "Touch(hand, object_id, point_m)"


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
        hint = f"A touch is {_TOUCH}, its point in the world."
        point = checks.vector("point_m", self.point_m, "m", size=3, error=SessionError, hint=hint)
        object.__setattr__(self, "point_m", point)


GivenTouches = Touch | Iterable[Touch | tuple[str, str, Iterable[float]]]
"""All forms in which a session accepts touches; a tuple is (hand, object id, point)."""

TouchesByHand = dict[str, list[Touch]]
"""In the order of the hands; hands without touches are left out."""


def touches_by_hand(touches: Any, hands: Sequence[str], state: SceneState) -> TouchesByHand:
    """Group touches, in any form that `given_touches` accepts, by their hand.

    Raises: UnknownObject: an object is not in the scene; SessionError: an unknown hand, or another type.
    """
    if type(touches) is not list and type(touches) is not tuple:
        touches = given_touches(touches)
    try:
        by_hand = _grouped(touches, hands, state)
    except UnknownObject:
        raise
    except Exception:  # an object of another type may raise any error
        by_hand = _grouped(given_touches(touches), hands, state)
    for hand in by_hand:
        if hand not in hands:
            raise SessionError(unknown_hand(hand, hands))
    return {hand: by_hand[hand] for hand in hands if hand in by_hand}


def _grouped(touches: Sequence[Touch], hands: Collection[str], state: SceneState) -> dict[str, list[Touch]]:
    by_hand: dict[str, list[Touch]] = {}
    for touch in touches:
        if touch.object_id not in state.objects:
            state.require(touch.object_id, _swapped_hint(touch, hands))
        by_hand.setdefault(touch.hand, []).append(touch)
    return by_hand


def _swapped_hint(touch: Touch, hands: Collection[str]) -> str:
    """Return a hint if a touch has hand and object swapped."""
    is_hand = isinstance(touch.object_id, str) and touch.object_id in hands
    return f" {touch.object_id!r} is a hand; a touch is {_TOUCH}." if is_hand else ""


def given_touches(touches: object) -> list[Touch]:
    """Convert touches that are no sequence of Touch: a single one, None, or (hand, object id, point).

    Raises: SessionError: anything else, such as a mapping or a text.
    """
    if touches is None:
        return []
    if isinstance(touches, Touch):
        return [touches]
    if isinstance(touches, str | Mapping):
        _refuse_touches("is", touches)
    try:
        found = list(touches)  # type: ignore[call-overload]  # if it cannot, see below
    except Exception:  # an object of another type may raise any error
        _refuse_touches("is", touches)
    return [_given_touch(one) for one in found]


def _given_touch(touch: object) -> Touch:
    if isinstance(touch, tuple) and len(touch) == 3:
        touch = Touch(*touch)
    if not isinstance(touch, Touch):
        _refuse_touches("has", touch)
    if not isinstance(touch.hand, str):
        raise SessionError(f"hand is {checks.described(touch.hand)}; it must be a name. A touch is {_TOUCH}.")
    if not isinstance(touch.object_id, str):
        raise SessionError(f"object_id is {checks.described(touch.object_id)}; it must be an id. A touch is {_TOUCH}.")
    return touch


def _refuse_touches(verb: str, given: object) -> NoReturn:
    wrong = f"{checks.represented(given)} ({type(given).__name__})"
    raise SessionError(f"touches {verb} {wrong}; it must be a list of Touch, as [{_TOUCH}].")


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
