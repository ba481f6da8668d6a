"""Offline replacement for a language model: looks up authored names in a table of everyday objects.

It is free, instant and deterministic. It ignores pictures and user prompts. If a name is not enough, it answers
"unknown".
"""

from scene2hap.llm.lexicon.backend import LexiconBackend

__all__ = ["LexiconBackend"]
