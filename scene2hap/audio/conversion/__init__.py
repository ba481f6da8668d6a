"""Sound into touch offline: whole clips for baking, files of any length for everyone else."""

from scene2hap.audio.conversion.batch import Failure, convert_files
from scene2hap.audio.conversion.clips import convert_clip
from scene2hap.audio.conversion.stream import FORMATS, Conversion, convert

__all__ = ["FORMATS", "Conversion", "Failure", "convert", "convert_clip", "convert_files"]
