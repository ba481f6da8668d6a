"""Child process of the family `servers`: query a server once, or read a sound. Exits with 0 or a one-line error.

python query.py openai|ollama|page|sound WHERE
"""

from __future__ import annotations

import asyncio
import logging
import sys
import traceback
from pathlib import Path

from scene2hap.common.printable import printable
from scene2hap.errors import Scene2HapError

sys.path.insert(0, str(Path(__file__).parents[2]))

from stress.attacks.keys import KEY, NOT_COVERED, SPELLINGS, is_shown

_WITHOUT_KEY = ("page", "sound")


def main(kind: str, where: str) -> None:
    """Query a server, or read a sound, and print the reply as a log shows it."""
    if kind == "sound":
        from scene2hap.audio.files import read_clip

        print(len(read_clip(Path(where)).samples))
    elif kind == "page":
        from scene2hap.common import web

        print(printable(web.get(where, web.Limits(2.0, 1 << 20)).text[:1000]))
    else:
        from scene2hap.llm.backends.local import LocalBackend
        from scene2hap.llm.protocol import LLMRequest

        schema = {"type": "object", "properties": {"scene_category": {"type": "string"}}, "additionalProperties": False}
        request = LLMRequest("scene_analyzer", "", "What kind of place is this?", {}, schema, "1")
        backend = LocalBackend(
            "m", base_url=where, dialect="ollama" if kind == "ollama" else "openai", timeout_s=2.0, api_key=KEY
        )
        print(printable(asyncio.run(backend.complete(request)).text[:1000]))


if __name__ == "__main__":
    logging.basicConfig(level=logging.WARNING)
    try:
        main(*sys.argv[1:])
    except Scene2HapError as error:
        shown = "".join(traceback.format_exception(error)) + getattr(error, "raw_text", "")
        # Pages and sounds are requested without a key, so that the library has none to mask.
        if sys.argv[1] not in _WITHOUT_KEY and any(
            is_shown(name, shown) for name in SPELLINGS if name not in NOT_COVERED
        ):
            sys.exit(f"the key is shown: {shown}")
        print(f"scene2hap: error: {printable(str(error))[:2000]}", file=sys.stderr)
        sys.exit(1)
