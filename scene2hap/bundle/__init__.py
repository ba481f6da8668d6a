"""What baking leaves behind and playing starts from."""

from scene2hap.bundle.folder import file_stem, read_overrides
from scene2hap.bundle.haptic_bundle import HapticBundle
from scene2hap.bundle.override import Override

__all__ = ["HapticBundle", "Override", "file_stem", "read_overrides"]
