"""Bundles: the result of baking, and the input of playing."""

from scene2hap.bundle.checking import BundleWarning
from scene2hap.bundle.haptic_bundle import HapticBundle
from scene2hap.bundle.made_with import MadeWith
from scene2hap.bundle.override import Override

__all__ = ["BundleWarning", "HapticBundle", "MadeWith", "Override"]
