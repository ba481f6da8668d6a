"""Runs Stable Audio 3 (stable-audio-3) for scene2hap: python stable_audio.py REQUEST FOLDER.

Needs Python 3.10 on and torch 2.7; the model "small-sfx" runs on a CPU. The weights want an account that has accepted
their terms (HF_TOKEN): Stability AI Community License, Gemma terms.
Source: Stability-AI/stable-audio-3, docs/workflows/inference.md.
"""

from __future__ import annotations

import sys
from typing import Any

from contract import main  # type: ignore[import-not-found,unused-ignore]  # beside this file, which is a program

LICENCE = "Stability AI Community License"
ADDRESS = "https://stability.ai/license"
STEPS = 8


def generate(request: Any, arguments: Any) -> tuple[int, Any]:
    """Return takes at 44.1 kHz, stereo."""
    import stable_audio_3  # type: ignore[import-not-found,unused-ignore]  # only where the model is

    # The class was called StableAudioPipeline at first.
    kind = getattr(stable_audio_3, "StableAudioModel", None) or stable_audio_3.StableAudioPipeline
    device = {"device": arguments.device} if arguments.device else {}
    model = kind.from_pretrained(arguments.model, **device)
    takes = model.generate(
        prompt=request.prompt,
        duration=request.duration_s,
        steps=STEPS,
        # The model's seed has 32 bits, and -1 means a random one.
        seed=request.seed % 2**31,
        batch_size=request.count,
    )
    return model.model.sample_rate, [take.detach().cpu().float().tolist() for take in takes]


if __name__ == "__main__":
    sys.exit(main(__doc__, LICENCE, ADDRESS, ("torch", "stable_audio_3"), generate, "small-sfx"))
