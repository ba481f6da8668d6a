"""The offline stand-in for a language model: authored names read against a table of everyday objects.

Free, instant and repeatable. It sees no picture and hears no wish of the user: what a name does not say, it does not
know, and says so.
"""

from scene2hap.llm.lexicon.backend import LexiconBackend

__all__ = ["LexiconBackend"]
