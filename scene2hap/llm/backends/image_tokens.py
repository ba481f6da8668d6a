"""Tokens of pictures: their number by model, and detection of pictures that a model did not see."""

from __future__ import annotations

import math

from scene2hap.common.warning import warn_of
from scene2hap.llm.answers.usable import question_of
from scene2hap.llm.protocol import BackendWarning, LLMReply, LLMRequest

CHARACTERS_PER_TOKEN = 4.0
"""Assumed: usual for English."""
_LEAST_PER_IMAGE = 256
"""Fewest tokens of one picture (assumed: the number of Gemma 3; most models need more)."""
_FAR_BELOW = 0.5
_FAR_ABOVE = 2.0

MOST_PER_IMAGE = {"low": 6_200, "high": 48_200}
"""Most tokens of one picture in any OpenAI model: 2,500 patches times 2.46 (nano); 2,833 + 8 * 5,667 for the eight
tiles of 768 x 2,048 px (gpt-4o-mini). Source: OpenAI, "Images and vision", section "Calculating costs"."""

_TILES = {
    "gpt-4o-mini": (2833, 5667),
    "gpt-4o": (85, 170),
    "gpt-4.1": (85, 170),
    "gpt-5": (70, 140),
    "o1": (75, 150),
    "o3": (75, 150),
}
"""By model: tokens of a picture in low detail, additional tokens per tile of 512 px in high detail."""

_PATCHES = {
    "gpt-4.1-mini": (1536, 1.62),
    "gpt-4.1-nano": (1536, 2.46),
    "gpt-5-mini": (1536, 1.62),
    "gpt-5-nano": (1536, 2.46),
    "gpt-5.4-mini": (1536, 1.62),
    "gpt-5.4-nano": (1536, 2.46),
    "o4-mini": (1536, 1.72),
    "gpt-5.2": (1536, 1.0),
    "gpt-5.4": (2500, 1.0),
    "gpt-5.5": (2500, 1.0),
}
"""By model: largest number of patches of 32 px, tokens per patch."""

_PATCH_PX, _TILE_PX, _SHORT_SIDE_PX = 32, 512, 768


def image_tokens(model: str, size_px: int, detail: str) -> int | None:
    """Return the tokens of one square picture; None if they are unknown for the model.

    Source: OpenAI, "Images and vision", section "Calculating costs".
    """
    name = max(filter(model.startswith, (*_TILES, *_PATCHES)), key=len, default="")
    if name in _PATCHES:
        most, factor = _PATCHES[name]
        return math.ceil(min(math.ceil(size_px / _PATCH_PX) ** 2, most) * factor)
    if name not in _TILES:
        return None
    base, per_tile = _TILES[name]
    tiles = math.ceil(min(size_px, _SHORT_SIDE_PX) / _TILE_PX) ** 2
    return base if detail == "low" else base + per_tile * tiles


class LostImages:
    """Warn once if a model read far fewer tokens than the prompt and its pictures have.

    Ollama drops messages that exceed its context, and reports this only in its debug log.
    """

    def __init__(self) -> None:
        self._warned = False

    def look(self, request: LLMRequest, said: LLMReply) -> None:
        """Compare the reported tokens of one request with the expected number. Warns: BackendWarning."""
        expected = len(request.prompt) / CHARACTERS_PER_TOKEN + _LEAST_PER_IMAGE * len(request.images)
        read = said.usage.get("prompt_tokens")
        if self._warned or not request.images or read is None or read >= _FAR_BELOW * expected:
            return
        self._warned = True
        warn_of(
            f"{question_of(request)}: {said.model} read {read} tokens where about {expected:.0f} were sent with "
            f"{len(request.images)} pictures. It may not have seen them: raise the server's context (num_ctx), and "
            "check that the model sees.",
            BackendWarning,
        )


class ImagesAsText:
    """Warn once if a model billed far more tokens than pictures can have, for example if it read base64 as text."""

    def __init__(self, detail: str) -> None:
        self._most_per_image = MOST_PER_IMAGE[detail]
        self._warned = False

    def look(self, request: LLMRequest, said: LLMReply) -> None:
        """Compare the reported tokens of one request with the expected number. Warns: BackendWarning."""
        text = (len(request.prompt) + len(str(request.answer_schema))) / CHARACTERS_PER_TOKEN
        most = _FAR_ABOVE * text + self._most_per_image * len(request.images)
        read = said.usage.get("prompt_tokens", 0)
        if self._warned or not request.images or read <= most:
            return
        self._warned = True
        warn_of(
            f"{question_of(request)}: {said.model} billed {read} tokens where its {len(request.images)} pictures make "
            f"{most:.0f} at most. It seems to read them as text: choose another model or send no pictures.",
            BackendWarning,
        )
