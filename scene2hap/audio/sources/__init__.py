"""Sound sources. Only baking imports this package: some sources use the network."""

from __future__ import annotations

from scene2hap.plugins import PluginGroup

SOURCES = PluginGroup(
    "scene2hap.audio",
    builtins={
        "library": "scene2hap.audio.sources.library:FolderLibrary",
        "freesound": "scene2hap.audio.sources.freesound:Freesound",
        "text_to_audio": "scene2hap.audio.sources.text_to_audio:TextToAudio",
        "synth": "scene2hap.audio.sources.synth:Synthesizer",
    },
    extras={},
    members={"find": ("description",)},
)
