"""Why an answer ended: by itself, cut at a limit, or withheld by a filter. Services name each differently.

Source: the API references of OpenAI, Anthropic, Google (Gemini), Cohere and Mistral, and of Hugging Face's TGI (from
memory).
"""

from __future__ import annotations

_BY_ITSELF = frozenset(
    {"stop", "eos", "eos_token", "end_turn", "stop_sequence", "complete", "tool_calls", "function_call", "tool_use"}
)
_AT_A_LIMIT = frozenset({"length", "max_tokens", "max_output_tokens", "model_length"})
_BY_A_FILTER = frozenset(
    {"content_filter", "safety", "prohibited_content", "blocklist", "recitation", "spii", "refusal"}
)


def is_whole(finish_reason: str) -> bool:
    """Return True if the model ended its answer by itself."""
    return finish_reason.lower() in _BY_ITSELF


def is_cut(finish_reason: str) -> bool:
    """Return True if the answer was cut at a limit of tokens."""
    return finish_reason.lower() in _AT_A_LIMIT


def is_filtered(finish_reason: str) -> bool:
    """Return True if a filter withheld the answer."""
    return finish_reason.lower() in _BY_A_FILTER
