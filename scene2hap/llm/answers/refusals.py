"""Detection of refusals, in any form in which a model declines to answer.

A refusal must not be repaired like a fault of form: the repeated call, with all its pictures, would be billed and
refused again.
"""

from __future__ import annotations

import re

from scene2hap.llm.answers.json_text import fields_of, first_object

FILTERED_REQUEST = frozenset({"content_filter", "content_policy_violation", "moderation_blocked"})
"""Codes of status 400 for a question that was withheld from the model: Azure's and OpenAI's."""

_CANNOT = r"(?:cannot|can\s?not|can't|won't|will\s+not|unable|not\s+able|not\s+allowed)"
_DEED = (
    r"(?:help|assist|comply|continue|fulfil\w*|provide|answer|analy[sz]e|identify|process|engage|discuss|participate|"
    r"describe|generate|create|complete|support|do\s+th)"
)
_REFUSAL = re.compile(
    rf"\b(?:{_CANNOT}\s+(?:to\s+)?(?:\w+\s+){{0,2}}{_DEED}|(?:sorry|apologi[sz]e|unfortunately)\b[^.]{{0,40}}\b{_CANNOT}|"
    r"(?:must|have\s+to)\s+(?:decline|refuse)|(?:violates|against)\s+(?:my|our|the)\s+(?:\w+\s+)?(?:guideline|polic)|"
    r"as\s+an\s+ai\b)",
    re.IGNORECASE,
)
_LOOKED_AT = 300
"""Number of characters searched at the beginning of a text (assumed: a text begins with its refusal)."""
_EXCUSES = frozenset({"refusal", "error", "message", "reason", "response", "answer"})
"""The fields of an object that holds only a refusal."""


def refusal_in(text: str) -> str | None:
    """Return the refusal in a model's message; None if it does not refuse.

    A text with a JSON object counts as an answer, even with prose around it, unless the object holds only an excuse.
    """
    found = first_object(text)
    if found is None:
        opening = text.strip()[:_LOOKED_AT].replace("\u2019", "'")
        return text.strip() if "{" not in opening and _REFUSAL.search(opening) else None
    fields = fields_of(found)
    if not fields or not fields.keys() <= _EXCUSES:
        return None
    excuse = " ".join(value for value in fields.values() if isinstance(value, str))
    is_refusal = "refusal" in fields or _REFUSAL.search(excuse.replace("\u2019", "'"))
    return excuse if excuse.strip() and is_refusal else None
