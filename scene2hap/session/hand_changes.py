"""Hands that come and go, and the person who plays, in every part of the session that knows them."""

from __future__ import annotations

from collections.abc import Callable

from scene2hap.common import checks
from scene2hap.devices.protocol import Block
from scene2hap.session.gains.hand_frames import HandFrames
from scene2hap.session.impacts.felt_impacts import Impacts
from scene2hap.session.likely_mistakes import warn_if_other_hands
from scene2hap.session.mix.loop_mixers import LoopMixers
from scene2hap.session.mix.output import Output
from scene2hap.session.mix.playback import Playback
from scene2hap.session.unknown_names import require_hand
from scene2hap.session.user_profile import UserProfile


class HandChanges:
    """Adds and removes outputs, and uses the profile of a person: in the gains, the impacts, the mix and the sink.

    Parameters: device : the name of the actuator in use.
    """

    def __init__(
        self,
        device: str,
        hand_frames: HandFrames,
        impacts: Impacts,
        mixers: LoopMixers,
        playback: Playback,
        output: Output,
    ) -> None:
        self._device, self._hand_frames, self._impacts = device, hand_frames, impacts
        self._mixers, self._playback, self._output = mixers, playback, output
        self._user: UserProfile | None = None

    def add(self, name: str, fill: Callable[[int], Block]) -> None:
        """Add an output; see `HapticSession.add_hand`. A sink that is running is reopened, and filled by `fill`."""
        hands = checks.names("hands", (*self._hand_frames.hands, name))
        with self._output.reopened_for(hands, fill):
            self._mixers.add_hand(name)
            self._use_hands(hands)

    def remove(self, name: str, fill: Callable[[int], Block]) -> None:
        """Remove an output; see `HapticSession.remove_hand`."""
        require_hand(name, self._hand_frames.hands)
        hands = checks.names("hands", [hand for hand in self._hand_frames.hands if hand != name])
        with self._output.reopened_for(hands, fill):
            self._mixers.remove_hand(name)
            self._use_hands(hands)

    def use_profile(self, user: UserProfile) -> None:
        """Use the levels and limits of a person. Warns: SceneWarning: they are for other hands."""
        self._user = user
        self._hand_frames.use_profile(user)
        self._impacts.use_profile(user)
        hands = self._hand_frames.hands
        limits = user.limits(hands, self._device)
        self._playback.hold(limits)
        self._output.hold(limits)
        warn_if_other_hands(tuple(user.hands), hands)

    def _use_hands(self, hands: tuple[str, ...]) -> None:
        self._hand_frames.use_hands(hands)
        if self._user is not None:
            self.use_profile(self._user)
