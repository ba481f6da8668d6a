"""Converters from sound to vibration; docs/conversion.md says when to use each."""

from __future__ import annotations

from scene2hap.plugins import PluginGroup

_HERE = "scene2hap.audio.tactile"

DEFAULT_CONVERTER = "auto"
"""The default converter of scenes and files."""

CONVERTERS = PluginGroup(
    "scene2hap.tactile",
    builtins={
        "adaptive": f"{_HERE}.adaptive:Adaptive",
        "auto": f"{_HERE}.auto:Auto",
        "envelope": f"{_HERE}.envelope:EnvelopeCarrier",
        "frequency_shift": f"{_HERE}.frequency_shift:FrequencyShift",
        "lowpass": f"{_HERE}.lowpass:Lowpass",
        "perception_level": f"{_HERE}.perception_level:PerceptionLevel",
        "svf_bandpass": f"{_HERE}.svf_bandpass:SvfBandpass",
    },
    extras={},
    members={"stream": ("sample_rate_hz", "context")},
)
