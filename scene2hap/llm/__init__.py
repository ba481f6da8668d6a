"""Inference: language models, and the lexicon that replaces them."""

from scene2hap.plugins import PluginGroup

BACKENDS = PluginGroup(
    "scene2hap.llm",
    builtins={
        "lexicon": "scene2hap.llm.lexicon:LexiconBackend",
        "openai": "scene2hap.llm.backends.openai:OpenAIBackend",
        "local": "scene2hap.llm.backends.local:LocalBackend",
        "replay": "scene2hap.llm.backends.replay:ReplayBackend",
        "retry": "scene2hap.llm.wrappers:RetryBackend",
        "repair": "scene2hap.llm.wrappers:RepairBackend",
        "cache": "scene2hap.llm.wrappers:CacheBackend",
        "budget": "scene2hap.llm.wrappers:BudgetBackend",
        "standard": "scene2hap.llm.wrappers:standard_stack",
    },
    extras={},
    members={"complete": ("request",)},
    wraps_functions="FunctionBackend",
    synonyms={
        "gpt4o": ("openai:gpt-4o",),
        **dict.fromkeys(("gpt", "chatgpt"), ("openai",)),
        **dict.fromkeys(("ollama", "vllm", "llamacpp", "llama.cpp", "lmstudio"), ("local",)),
    },
)
