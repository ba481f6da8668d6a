"""The anchor of a source: the component of its spectrum by which it is felt, in a whole sound or in a live stream."""

from scene2hap.audio.anchor.tracked import TrackedAnchor
from scene2hap.audio.anchor.whole_sound import Anchor, anchor_of

__all__ = ["Anchor", "TrackedAnchor", "anchor_of"]
