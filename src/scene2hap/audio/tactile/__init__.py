"""Converters from sound to touch."""

from __future__ import annotations

from scene2hap.plugins import PluginGroup

CONVERTERS = PluginGroup(
    "scene2hap.tactile",
    builtins={"svf_bandpass": "scene2hap.audio.tactile.svf_bandpass:SvfBandpass"},
    extras={},
)
