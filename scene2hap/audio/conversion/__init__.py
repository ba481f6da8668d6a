"""Offline conversion of sound to vibration: whole clips for baking, and files of any length."""

from scene2hap.audio.conversion.batch import Failure, convert_files
from scene2hap.audio.conversion.clips import convert_clip
from scene2hap.audio.conversion.stream import FORMATS, Conversion, convert
from scene2hap.audio.haptic_loop import LevelWarning

__all__ = ["FORMATS", "Conversion", "Failure", "LevelWarning", "convert", "convert_clip", "convert_files"]
