"""Offline conversion of sound to vibration: whole clips for baking, and files of any length."""

from scene2hap.audio.conversion.batch import Failure, convert_files
from scene2hap.audio.conversion.clips import convert_clip
from scene2hap.audio.conversion.one_file import Conversion, convert
from scene2hap.audio.conversion.writing import FORMATS
from scene2hap.audio.sensation import LevelWarning

__all__ = ["FORMATS", "Conversion", "Failure", "LevelWarning", "convert", "convert_clip", "convert_files"]
