"""Actuators: where the mix goes."""

from scene2hap.plugins import PluginGroup

SINKS = PluginGroup(
    "scene2hap.devices",
    builtins={
        "wav": "scene2hap.devices.wav:WavSink",
        "memory": "scene2hap.devices.memory:MemorySink",
    },
    extras={},
)
