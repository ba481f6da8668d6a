"""The component of a sound's spectrum by which its source is felt, in a whole sound or in a live stream."""

from scene2hap.audio.felt_component.choice import FeltComponent, felt_component_of
from scene2hap.audio.felt_component.tracked import TrackedComponent

__all__ = ["FeltComponent", "TrackedComponent", "felt_component_of"]
