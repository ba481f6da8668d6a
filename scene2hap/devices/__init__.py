"""Actuator sinks: outputs of the mix."""

from scene2hap.plugins import PluginGroup

SINKS = PluginGroup(
    "scene2hap.devices",
    builtins={
        "wav": "scene2hap.devices.wav:WavSink",
        "memory": "scene2hap.devices.memory:MemorySink",
        "soundcard": "scene2hap.devices.soundcard:SoundCardSink",
        "serial": "scene2hap.devices.serial_amp:SerialAmplifierSink",
        "vhp": "scene2hap.devices.vhp_amp:VhpSink",
        "udp": "scene2hap.devices.udp:UdpSink",
        "tee": "scene2hap.devices.tee:TeeSink",
    },
    extras={"serial": "serial", "vhp": "serial", "soundcard": "soundcard"},
    members={"open": ("format",), "start": ("fill",), "stop": (), "close": (), "stats": None},
)
