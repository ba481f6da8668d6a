"""Runs AudioGen (audiocraft) for scene2hap: python audiogen.py REQUEST FOLDER.

Needs a Python 3.9 environment with audiocraft and torch 2.1, and a GPU of 16 GB. The weights are CC-BY-NC 4.0.
Source: facebookresearch/audiocraft, docs/AUDIOGEN.md.
"""

from __future__ import annotations

import sys
from typing import Any

from contract import main  # type: ignore[import-not-found,unused-ignore]  # beside this file, which is a program

LICENCE = "CC-BY-NC-4.0"
ADDRESS = "https://huggingface.co/facebook/audiogen-medium"


def generate(request: Any, arguments: Any) -> tuple[int, Any]:
    """Return takes at 16 kHz, mono. The model has no seed of its own, so torch's seed is set."""
    import torch  # type: ignore[import-not-found,unused-ignore]  # only where the model is
    from audiocraft.models import AudioGen  # type: ignore[import-not-found,import-untyped,unused-ignore]  # the same

    torch.manual_seed(request.seed % 2**63)
    model = AudioGen.get_pretrained(arguments.model, device=arguments.device or None)
    model.set_generation_params(duration=request.duration_s)
    takes = model.generate([request.prompt] * request.count)
    return model.sample_rate, [take.detach().cpu().float().tolist() for take in takes]


if __name__ == "__main__":
    sys.exit(main(__doc__, LICENCE, ADDRESS, ("torch", "audiocraft"), generate, "facebook/audiogen-medium"))
