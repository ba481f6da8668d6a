"""Bundles: the result of baking, and the input of playing."""

from scene2hap.bundle.checking import BundleWarning
from scene2hap.bundle.differences import Difference, differences
from scene2hap.bundle.folder import read_bundle, read_overrides, write_both, write_edited
from scene2hap.bundle.folder_replacement import require_replaceable, save_stamp
from scene2hap.bundle.haptic_bundle import HapticBundle
from scene2hap.bundle.history import pop, step_beside, steps_beside, warned_of_steps
from scene2hap.bundle.made_with import MadeWith
from scene2hap.bundle.override import Override
from scene2hap.bundle.sounds import file_stems

__all__ = [
    "BundleWarning",
    "Difference",
    "HapticBundle",
    "MadeWith",
    "Override",
    "differences",
    "file_stems",
    "pop",
    "read_bundle",
    "read_overrides",
    "require_replaceable",
    "save_stamp",
    "step_beside",
    "steps_beside",
    "warned_of_steps",
    "write_both",
    "write_edited",
]
