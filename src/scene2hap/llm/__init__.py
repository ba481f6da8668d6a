"""Inference: language models and what stands in for them."""

from scene2hap.plugins import PluginGroup

BACKENDS = PluginGroup(
    "scene2hap.llm",
    builtins={
        "lexicon": "scene2hap.llm.lexicon:LexiconBackend",
        "replay": "scene2hap.llm.replay:ReplayBackend",
    },
    extras={},
)
